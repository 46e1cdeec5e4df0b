// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/suggestion.h"

namespace luxo {
namespace {

using Names = std::vector<std::string>;

[[noreturn]] void refuse(std::string_view option, const std::string& text, std::string_view why,
                         const std::string& hint) {
  throw Error(ErrorKind::Usage, fmt::format("{} '{}': {}", option, text, why), hint);
}

[[noreturn]] void refuseUntilSupported(std::string_view option, const std::string& text,
                                       const std::string& hint) {
  throw Error(ErrorKind::Scene, fmt::format("{} '{}' is not supported yet", option, text), hint);
}

template <class Number>
std::optional<Number> wholeNumber(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

Names split(const std::string& text, char separator) {
  Names parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

bool isName(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || digit(c); });
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuseName(std::string_view option, const std::string& text, const Names& known,
                             std::string_view what) {
  refuse(option, text, fmt::format("there is no such {}", what),
         didYouMean(text, known, fmt::format("one of {}", listed(known))));
}

// The number or fraction in `part` of the option's whole text.
double numberIn(std::string_view option, const std::string& whole, std::string_view part) {
  const std::size_t slash = part.find('/');
  const auto above = finiteNumber(part.substr(0, slash));
  const auto below =
      slash == std::string_view::npos ? std::optional(1.0) : finiteNumber(part.substr(slash + 1));
  if (!above || !below || *below == 0)
    refuse(option, whole, part == whole ? "not a number" : fmt::format("'{}' is not a number", part),
           "give a number such as 0.5 or 1/255");
  return *above / *below;
}

// A name that is the end of another comes after it.
constexpr std::array<std::pair<std::string_view, double>, 5> kLengthUnits = {
    {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"m", 1}}};

constexpr const char* kFramesHint =
    "frames are numbers and ranges first-last or first-last:step, as in 1-250:2,300";

// "7", "1-250" or "1-250:2"
void appendRange(const std::string& whole, const std::string& part, std::vector<int>& frames) {
  const auto number = [&](const std::string& digits) {
    const auto value = wholeNumber<int>(digits);
    if (!value || *value < 0)
      refuse("--frames", whole, fmt::format("'{}' is not a frame number", digits), kFramesHint);
    return *value;
  };
  const std::size_t dash = part.find('-', 1);
  const std::size_t colon = part.find(':');
  if (dash == std::string::npos) {
    frames.push_back(number(part));
    return;
  }
  const int first = number(part.substr(0, dash));
  const int last = number(part.substr(dash + 1, colon == std::string::npos ? colon : colon - dash - 1));
  const int step = colon == std::string::npos ? 1 : number(part.substr(colon + 1));
  if (step == 0) refuse("--frames", whole, "the step is 0", kFramesHint);
  if (last < first) refuse("--frames", whole, fmt::format("'{}' ends before it begins", part), kFramesHint);
  if ((last - first) / step >= kMaxFrames)
    refuse("--frames", whole, fmt::format("more than {} frames", kMaxFrames), "render them in several runs");
  for (std::int64_t frame = first; frame <= last; frame += step) frames.push_back(int(frame));
}

}  // namespace

std::optional<double> finiteNumber(std::string_view text) {
  const auto value = wholeNumber<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double parseNumber(std::string_view option, const std::string& text) { return numberIn(option, text, text); }

PixelSize parseSize(const std::string& text) {
  const std::string hint =
      fmt::format("give width x height in pixels, each from 1 to {}, as in 1280x720", kMaxPictureSide);
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) refuse("--size", text, "not a size", hint);
  const auto side = [&](const std::string& digits, const char* name) {
    const auto value = wholeNumber<std::int64_t>(digits);
    if (!value) refuse("--size", text, fmt::format("the {} '{}' is not a whole number", name, digits), hint);
    if (*value < 1)
      refuse("--size", text, fmt::format("a picture with a {} of {} has no pixels", name, *value), hint);
    if (*value > kMaxPictureSide)
      refuse("--size", text, fmt::format("a {} of {} is more than pictures have", name, *value), hint);
    return int(*value);
  };
  return {side(text.substr(0, cross), "width"), side(text.substr(cross + 1), "height")};
}

std::vector<int> parseFrames(const std::string& text) {
  std::vector<int> all;
  for (const std::string& part : split(text, ',')) appendRange(text, part, all);
  std::vector<int> frames;
  std::set<int> seen;
  for (const int frame : all)
    if (seen.insert(frame).second) frames.push_back(frame);
  return frames;
}

double parseFps(const std::string& text) {
  const double fps = parseNumber("--fps", text);
  if (!kFpsRange.contains(fps))
    refuse("--fps", text, fmt::format("frames per second are from {} to {}", kFpsRange.lo, kFpsRange.hi),
           "as in --fps 24 or --fps 30000/1001");
  return fps;
}

int parseSamples(const std::string& text) {
  const auto samples = wholeNumber<int>(text);
  if (!samples || *samples < 1 || *samples > kMaxSamples)
    refuse("--samples", text, "not a number of samples",
           fmt::format("give a number from 1 to {}", kMaxSamples));
  return *samples;
}

double parsePixels(std::string_view option, const std::string& text, const Interval& range) {
  const bool unit = text.size() > 2 && text.ends_with("px");
  const double pixels =
      numberIn(option, text, std::string_view(text).substr(0, text.size() - (unit ? 2 : 0)));
  if (!range.contains(pixels))
    refuse(option, text, fmt::format("must be from {} to {} pixels", range.lo, range.hi),
           fmt::format("as in {} 0.25", option));
  return pixels;
}

double parseLength(std::string_view option, const std::string& text) {
  std::string_view number = text;
  double metres = 1;
  for (const auto& [name, size] : kLengthUnits)
    if (number.ends_with(name)) {
      number.remove_suffix(name.size());
      metres = size;
      break;
    }
  const double length = numberIn(option, text, number) * metres;
  if (!(length > 0 && length <= 1e9))
    refuse(option, text, "must be above 0, and at most 1e9 metres", fmt::format("as in {} 0.01mm", option));
  return length;
}

double parseLengthUnit(std::string_view option, const std::string& text) {
  Names known;
  for (const auto& [name, size] : kLengthUnits) {
    if (text == name) return size;
    known.emplace_back(name);
  }
  refuseName(option, text, known, "unit");
}

Shading parseShading(const std::string& text) {
  static const Names kPlanned = {"overdraw", "lod"};
  if (const auto shading = shadingNamed(text)) return *shading;
  const Names known(kShadingNames.begin(), kShadingNames.end());
  if (contains(kPlanned, text))
    refuseUntilSupported("--shading", text, fmt::format("one of {}", listed(known)));
  refuseName("--shading", text, known, "shading");
}

Output parseAov(const std::string& text) {
  static const Names kKnown = {"color", "depth", "position", "normal", "uv", "id", "residual", "certificate"};
  const auto found = std::find(kKnown.begin(), kKnown.end(), text);
  if (found == kKnown.end()) {
    Names all = kKnown;
    all.push_back("light-depth");
    refuseName("--aov", text, all, "output");
  }
  static constexpr Output kOutputs[] = {Output::Color, Output::Depth, Output::Position, Output::Normal,
                                        Output::Uv,    Output::Id,    Output::Residual, Output::Certificate};
  return kOutputs[found - kKnown.begin()];
}

Engine parseEngine(const std::string& text) {
  if (text == "vulkan") return Engine::Vulkan;
  if (text == "reference") return Engine::Reference;
  refuseName("--engine", text, {"vulkan", "reference"}, "engine");
}

Composition parseComposition(const std::string& text) {
  if (text == "auto") return Composition::Auto;
  if (text == "fused") return Composition::Fused;
  if (text == "deferred") return Composition::Deferred;
  refuseName("--composition", text, {"auto", "fused", "deferred"}, "composition");
}

Skips parseSkips(const std::string& text) {
  static const Names kKnown = {"all",    "none",      "frustum", "small", "backface",
                               "lights", "unchanged", "passes",  "hidden"};
  if (text == "all") return {};
  Skips skips = Skips::none();
  if (text == "none") return skips;
  const std::pair<const char*, bool*> switches[] = {
      {"frustum", &skips.frustum}, {"small", &skips.small},         {"backface", &skips.backface},
      {"lights", &skips.lights},   {"unchanged", &skips.unchanged}, {"passes", &skips.passes},
      {"hidden", &skips.hidden}};
  for (const std::string& name : split(text, ',')) {
    const auto* found = std::find_if(std::begin(switches), std::end(switches),
                                     [&](const auto& s) { return name == s.first; });
    if (found == std::end(switches)) {
      if (name == "all" || name == "none") refuse("--skip", text, fmt::format("'{}' stands alone", name), "");
      refuseName("--skip", name, kKnown, "skip");
    }
    *found->second = true;
  }
  return skips;
}

Audit parseAudit(const std::string& text) {
  if (text == "all") return {.extent = AuditExtent::All};
  if (text == "none") return {.extent = AuditExtent::None};
  const auto pixels = wholeNumber<std::uint64_t>(text);
  if (!pixels || *pixels < 1)
    refuse("--audit", text, "not a number of pixels", "give all, none or a whole number above 0");
  return {.atLeast = *pixels};
}

int parseSample(const std::string& text) {
  const auto sample = wholeNumber<int>(text);
  if (!sample || *sample < 0 || *sample >= kMaxSamples)
    refuse("--sample", text, "not the number of a sample", "they count from 0 to one less than --samples");
  return *sample;
}

int parseColumns(const std::string& text, int most) {
  const auto columns = wholeNumber<int>(text);
  if (!columns || *columns < 1 || *columns > most)
    refuse("--columns", text, "not a number of columns", fmt::format("give a number from 1 to {}", most));
  return *columns;
}

ParameterValue parseParameter(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string hint = "give name=value, as in -P speed=2";
  if (equals == std::string::npos) refuse("-P", text, "there is no '='", hint);
  const std::string name = text.substr(0, equals);
  if (!isName(name)) refuse("-P", text, fmt::format("'{}' is not a name", name), hint);
  if (equals + 1 == text.size()) refuse("-P", text, "the value is empty", hint);
  return {name, text.substr(equals + 1)};
}

Sweep parseSweep(const std::string& text) {
  const std::string hint = "give name=from:to:step, as in --sweep lobes=1:12:1";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !isName(text.substr(0, equals)))
    refuse("--sweep", text, "it does not begin with name=", hint);
  const Names parts = split(text.substr(equals + 1), ':');
  if (parts.size() != 3) refuse("--sweep", text, "it has not three numbers after the name", hint);
  const double from = numberIn("--sweep", text, parts[0]);
  const double to = numberIn("--sweep", text, parts[1]);
  const double step = numberIn("--sweep", text, parts[2]);
  if (step == 0 || (to - from) / step < 0)
    refuse("--sweep", text, fmt::format("a step of {} does not lead from {} to {}", step, from, to), hint);
  // The slack lets 0:0.3:0.1 reach 0.3, although 0.3 / 0.1 is just below 3; no value goes beyond the end.
  const double steps = std::floor((to - from) / step + 1e-9);
  if (steps >= kMaxFrames) refuse("--sweep", text, fmt::format("more than {} values", kMaxFrames), hint);
  Sweep sweep{text.substr(0, equals), {}};
  for (int i = 0; i <= int(steps); ++i) {
    const double value = from + i * step;
    sweep.values.push_back(step > 0 ? std::min(value, to) : std::max(value, to));
  }
  return sweep;
}

}  // namespace luxo
