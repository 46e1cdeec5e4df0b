// SPDX-License-Identifier: Apache-2.0
#include "plot_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/suggestion.h"
#include "colormap.h"
#include "formula/tape.h"
#include "plot_camera.h"
#include "scene/fitted_camera.h"
#include "scene/formula_set.h"
#include "scene/scene_builder.h"
#include "scene/scene_problems.h"
#include "scene/scene_variables.h"
#include "scene_request.h"

namespace luxo {
namespace {

constexpr const char* kSourceName = "plot";
constexpr std::size_t kMaxSwept = 32;
constexpr const char* kPositionHint = "give three formulas of u and v, as in \"[cos(u), v, sin(u)]\"";
constexpr const char* kRangeHint = "give from:to, as in 0:tau";
constexpr const char* kDefinitionHint = "give name=formula, as in -L k=3";

bool startsName(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The names a formula uses.
std::set<std::string> namesIn(std::string_view formula) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < formula.size();) {
    if (!startsName(formula[i])) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < formula.size() && (startsName(formula[end]) || isDigit(formula[end]))) ++end;
    names.emplace(formula.substr(i, end - i));
    i = end;
  }
  return names;
}

/// What was typed as one text, a line for each argument, so that messages can show the line and the place.
class Typed {
 public:
  /// A part of the text.
  struct Part {
    std::string text;
    std::size_t begin = 0;

    [[nodiscard]] Part from(std::size_t first, std::size_t count = std::string::npos) const {
      return {text.substr(first, count), begin + first};
    }
    [[nodiscard]] Part trimmed() const {
      const std::size_t first = text.find_first_not_of(" \t\n");
      if (first == std::string::npos) return {"", begin};
      return from(first, text.find_last_not_of(" \t\n") + 1 - first);
    }
  };

  Part add(std::string_view option, const std::string& argument) {
    text_ += option;
    const Part part{argument, text_.size()};
    text_ += argument + "\n";
    return part;
  }

  [[noreturn]] void refuse(const Part& part, const std::string& message, const std::string& hint) const {
    const SourceRange where{part.begin, part.begin + part.text.size()};
    throw Error(ErrorKind::Usage, describe(kSourceName, text_, {where, message, hint}));
  }

  /// Places of formulas include one character on either side: the quotes that they stand in in scene files.
  [[nodiscard]] Quantity quantity(const Part& part) const {
    const Part formula = part.trimmed();
    const auto begin = static_cast<std::uint32_t>(formula.begin),
               end = static_cast<std::uint32_t>(formula.begin + formula.text.size());
    if (const auto number = finiteNumber(formula.text)) return {*number, {begin, end}};
    return {formula.text, {begin - 1, end + 1}};
  }

  [[nodiscard]] SceneSource source() const {
    return {kSourceName, std::make_shared<const std::string>(text_)};
  }

 private:
  std::string text_;
};

using Part = Typed::Part;

/// Between the commas that are in no bracket.
std::vector<Part> splitAtCommas(const Part& whole) {
  std::vector<Part> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < whole.text.size(); ++i) {
    const char c = whole.text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c != ',' || depth > 0) continue;
    parts.push_back(whole.from(begin, i - begin));
    begin = i + 1;
  }
  parts.push_back(whole.from(begin));
  return parts;
}

Quantity3 positionOf(const Typed& typed, const Part& argument) {
  const Part whole = argument.trimmed();
  if (whole.text.size() < 2 || whole.text.front() != '[' || whole.text.back() != ']')
    typed.refuse(whole, "the position stands in no brackets", kPositionHint);
  const std::vector<Part> parts = splitAtCommas(whole.from(1, whole.text.size() - 2));
  if (parts.size() != 3)
    typed.refuse(whole, fmt::format("the position has {} components instead of 3", parts.size()),
                 kPositionHint);
  return {typed.quantity(parts[0]), typed.quantity(parts[1]), typed.quantity(parts[2])};
}

QuantityPair rangeOf(const Typed& typed, const Part& argument) {
  const std::size_t colon = argument.text.find(':');
  if (const auto colons = std::ranges::count(argument.text, ':'); colons != 1)
    typed.refuse(argument, fmt::format("expected the two ends of a range, found {}", colons + 1), kRangeHint);
  return {typed.quantity(argument.from(0, colon)), typed.quantity(argument.from(colon + 1))};
}

struct Definition {
  Part name, formula;
  std::set<std::string> uses;
};

std::vector<Definition> definitionsOf(Typed& typed, const std::vector<std::string>& texts) {
  std::vector<Definition> definitions;
  for (const std::string& text : texts) {
    const Part whole = typed.add("-L ", text);
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) typed.refuse(whole, "there is no '='", kDefinitionHint);
    const Part name = whole.from(0, equals).trimmed();
    if (namesIn(name.text) != std::set{name.text})
      typed.refuse(name, fmt::format("'{}' is not a name", name.text), kDefinitionHint);
    const Part formula = whole.from(equals + 1);
    definitions.push_back({name, formula, namesIn(formula.text)});
  }
  return definitions;
}

/// The names of those that need u or v, these two included.
std::set<std::string> namesOfPlace(const std::vector<Definition>& definitions) {
  std::set<std::string> found = {"u", "v"};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const Definition& definition : definitions)
      if (std::ranges::any_of(definition.uses, [&](const std::string& name) { return found.contains(name); }))
        found.insert(definition.name.text);
  }
  return found;
}

FileName nameAt(const Part& part) {
  return {
      part.text,
      {static_cast<std::uint32_t>(part.begin), static_cast<std::uint32_t>(part.begin + part.text.size())}};
}

void replaceParameter(Typed& typed, SceneFile& file, const ParameterValue& value) {
  const auto found = std::ranges::find(file.parameters, value.name,
                                       [](const ParameterDesc& parameter) { return parameter.name.text; });
  if (found == file.parameters.end()) {
    std::vector<std::string> names;
    for (const ParameterDesc& parameter : file.parameters) names.push_back(parameter.name.text);
    throw Error(ErrorKind::Usage, fmt::format("the plot has no parameter '{}'", value.name),
                didYouMean(value.name, names, fmt::format("define it: -L {}={}", value.name, value.value)));
  }
  found->value = typed.quantity(typed.add(fmt::format("-P {}=", value.name), value.value));
}

RenderDesc renderOf(const RenderRequest& request) {
  RenderDesc render;
  if (request.size) render.size = {request.size->width, request.size->height};
  if (request.time) render.time = *request.time;
  if (request.fps) render.fps = *request.fps;
  render.samples = request.samples.value_or(4);
  if (request.tolerancePx) render.tolerance = *request.tolerancePx;
  if (request.shading) render.shading = *request.shading;
  render.hiddenLines = request.hiddenLines;
  // Paper, and light from all sides: nothing is black.
  render.background = {0.86, 0.88, 0.9};
  render.ambient = repeated(0.22);
  return render;
}

constexpr const char *kValueName = "color_value", *kPartName = "color_part";

/// Of those definitions that need the place, what the material's formulas use, directly or not.
std::vector<LetDesc> letOf(const Typed& typed, const std::vector<Definition>& definitions,
                           std::set<std::string> used) {
  for (std::size_t before = 0; before != used.size();) {
    before = used.size();
    for (const Definition& definition : definitions)
      if (used.contains(definition.name.text)) used.insert(definition.uses.begin(), definition.uses.end());
  }
  const std::set<std::string> ofPlace = namesOfPlace(definitions);
  std::vector<LetDesc> let;
  for (const Definition& definition : definitions)
    if (used.contains(definition.name.text) && ofPlace.contains(definition.name.text))
      let.push_back({nameAt(definition.name), typed.quantity(definition.formula)});
  return let;
}

IsolinesDesc isolinesOf(const Typed& typed, const Part& argument) {
  const std::size_t at = argument.text.rfind('@');
  IsolinesDesc lines{.of = typed.quantity(argument.from(0, at)), .opacity = 0.7};
  if (at != std::string::npos) lines.step = typed.quantity(argument.from(at + 1));
  return lines;
}

IsolinesDesc gridOf(const Typed& typed, const Part& argument) {
  const std::size_t times = argument.text.find('x');
  const Part first = argument.from(0, times),
             second = times == std::string::npos ? first : argument.from(times + 1);
  for (const Part& part : {first, second})
    if (!finiteNumber(part.text))
      typed.refuse(argument, "this is not a number of lines", "give N or NxM, as in --grid 24x12");
  return {.u = typed.quantity(first), .v = typed.quantity(second), .opacity = 0.5};
}

/// From the least to the most that a formula of a material is on a surface.
Interval rangeOn(const Surface& surface, const Quantity& formula, const SceneFile& file,
                 std::span<const LetDesc> let) {
  constexpr int kPoints = 65;
  Scene scene;
  SceneProblems problems(file.source);
  const SceneVariables variables(file, {}, problems, scene);
  const FormulaSet set({.formulas = {formula}, .let = let, .onSurface = true, .surface = surface}, variables);
  set.reportTo(problems);
  problems.raise();
  std::vector<double> parameters, u, v;
  for (const Animated<double>& parameter : set.parameters())
    parameters.push_back(parameter.at({0, *variables.initial()}));
  // Between edges: where a pole is, or a pole of the formula, there may be no value.
  for (int i = 0; i < kPoints; ++i) {
    u.push_back(surface.domain().u.lo + surface.domain().u.width() * (i + 0.5) / kPoints);
    v.push_back(surface.domain().v.lo + surface.domain().v.width() * (i + 0.5) / kPoints);
  }
  const auto values = Tape(set.graph(), set.values()).evaluateGrid(u, v, parameters);
  std::optional<Interval> range;
  for (const double value : values[0])
    if (std::isfinite(value)) range = range ? hull(*range, value) : Interval(value);
  return range.value_or(Interval(0));
}

/// Wider than nothing, and with 0 in the middle where that is asked for.
Interval shownOf(Interval range, bool aroundZero) {
  const double most = std::max(std::abs(range.lo), std::abs(range.hi));
  if (aroundZero) range = {-most, most};
  // Rounding is no range: of a constant, and of curvatures that cancel.
  constexpr double kPart = 1e-9, kNothing = 1e-12;
  if (!(range.width() > std::max(kPart * most, kNothing))) range = {range.mid() - 0.5, range.mid() + 0.5};
  return range;
}

/// Colours the material by the formula, on the surface.
void colorBy(const Quantity& formula, const std::string& colormap, const Surface& surface,
             const SceneFile& file, MaterialDesc& material) {
  const Interval range = rangeOn(surface, formula, file, material.let);
  const std::string map = !colormap.empty() ? colormap : range.lo < 0 && range.hi > 0 ? "vik" : "viridis";
  const Interval shown = shownOf(range, isDiverging(map));
  material.let.push_back({.name = kValueName, .value = formula});
  material.let.push_back(
      {.name = kPartName,
       .value = fmt::format("clamp(({} - ({:.6g}))/{:.6g}, 0, 1)", kValueName, shown.lo, shown.width())});
  material.diffuse = colorsOf(map, kPartName);
  material.specular = repeated(0.1);
}

MaterialDesc enamel() {
  return {.name = "enamel",
          .diffuse = {0.1, 0.34, 0.64},
          .specular = repeated(0.35),
          .shininess = 60,
          .twoSided = TwoSided::Yes};
}

/// The main light from above on the viewer's left, a weak one from the right. A light shines along its node's
/// -Z.
std::vector<NodeDesc> lightsOf(double azimuthDegrees) {
  const auto light = [&](const char* name, double turn, Quantity tilt, double intensity, Quantity3 color) {
    return NodeDesc{.name = name,
                    .rotate = {{.axis = {0, 1, 0}, .angle = fmt::format("{:.0f}deg", azimuthDegrees + turn)},
                               {.axis = {1, 0, 0}, .angle = std::move(tilt)}},
                    .light = LightDesc{
                        .type = Light::Type::Directional, .color = std::move(color), .intensity = intensity}};
  };
  return {light("key light", -49, "-50deg", 0.9, {1, 0.97, 0.92}),
          light("fill light", 66, "-10deg", 0.25, {0.85, 0.92, 1})};
}

/// Of so many digits that a picture is where it was to a tenth of a pixel.
Quantity3 rounded(const Vec3& p, double distance) {
  const double step = std::pow(10, std::floor(std::log10(distance)) - 4);
  const auto one = [&](double x) { return std::stod(fmt::format("{:.12g}", std::round(x / step) * step)); };
  return {one(p.x), one(p.y), one(p.z)};
}

/// The plot at every value that is swept over, or at most kMaxSwept of them, as one.
Snapshot allOf(Scene scene, const RenderRequest& request) {
  const RenderSettings& settings = scene.settings();
  Snapshot all = takeSnapshot(scene, settings.time, settings.size, Camera{});
  if (!request.sweep) return all;
  const std::vector<double>& values = request.sweep->values;
  const ParameterId swept = sweptParameter(scene, *request.sweep);
  for (std::size_t k = 0; k < values.size(); k += 1 + values.size() / kMaxSwept) {
    scene.setParameter(swept, values[k]);
    const Snapshot one = takeSnapshot(scene, settings.time, settings.size, Camera{});
    all.nodes.insert(all.nodes.end(), one.nodes.begin(), one.nodes.end());
  }
  return all;
}

CameraDesc cameraOf(const Snapshot& snapshot, PixelSize size, const Vec3& direction) {
  const Camera camera = fitCamera(snapshot, size, direction);
  const Vec3 eye = camera.eye.at(0), lookAt = camera.lookAt.at(0);
  const double distance = glm::length(eye - lookAt);
  CameraDesc desc{.eye = rounded(eye, distance), .lookAt = rounded(lookAt, distance)};
  if (camera.near.at(0) < 0.1) desc.near = std::stod(fmt::format("{:.1g}", 0.9 * camera.near.at(0)));
  return desc;
}

}  // namespace

SceneFile plotScene(const PlotDesc& plot, const RenderRequest& request) {
  Typed typed;
  FormulaShape shape{.position = positionOf(typed, typed.add("", plot.position))};
  shape.u = rangeOf(typed, typed.add("--u ", plot.u));
  shape.v = rangeOf(typed, typed.add("--v ", plot.v));

  SceneFile file;
  const std::vector<Definition> definitions = definitionsOf(typed, plot.definitions);
  const std::set<std::string> ofPlace = namesOfPlace(definitions);
  for (const Definition& definition : definitions) {
    const Quantity value = typed.quantity(definition.formula);
    if (ofPlace.contains(definition.name.text)) {
      shape.let.push_back({nameAt(definition.name), value});
    } else {
      file.parameters.push_back({.name = nameAt(definition.name), .value = value});
    }
  }
  for (const ParameterValue& value : request.parameters) replaceParameter(typed, file, value);

  std::set<std::string> used;
  const auto use = [&](const Part& part) {
    used.merge(namesIn(part.text));
    return part;
  };
  MaterialDesc material = enamel();
  if (!plot.grid.empty()) material.isolines.push_back(gridOf(typed, typed.add("--grid ", plot.grid)));
  for (const std::string& lines : plot.isolines)
    material.isolines.push_back(isolinesOf(typed, use(typed.add("--isolines ", lines))));
  std::optional<Quantity> color;
  if (!plot.color.empty()) color = typed.quantity(use(typed.add("--color ", plot.color)));
  material.let = letOf(typed, definitions, used);

  file.render = renderOf(request);
  file.materials = {enamel()};
  file.surfaces = {{.name = "plot", .shape = std::move(shape)}};
  file.nodes = {NodeDesc{.name = "plot", .surface = "plot", .material = "enamel"}};
  file.source = typed.source();

  const Scene unlit = buildScene(file);
  const Snapshot snapshot = allOf(unlit, request);
  if (color) colorBy(*color, plot.colormap, snapshot.nodes.at(0).surface, file, material);
  file.materials = {std::move(material)};
  const Vec3 direction = showingDirection(snapshot);
  file.camera = cameraOf(snapshot, unlit.settings().size, direction);
  const std::vector<NodeDesc> lights = lightsOf(azimuthOf(direction));
  file.nodes.insert(file.nodes.end(), lights.begin(), lights.end());
  return file;
}

}  // namespace luxo
