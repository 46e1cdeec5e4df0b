// SPDX-License-Identifier: Apache-2.0
#include "verification_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "measured_picture.h"
#include "reference/caster.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

/// An error of a verification as it is called in text and in JSON.
struct Metric {
  std::string_view label, unit, key;
  const ErrorSpread& spread;
};

std::array<Metric, 7> metricsOf(const Verification& v) {
  return {{{"position on screen", "px", "position_px", v.positionPx},
           {"parameters in space", "px", "parameter_px", v.parameterPx},
           {"point in space", "px", "point_px", v.pointPx},
           {"depth", "ulp", "depth_ulp", v.depthUlp},
           {"normal", "deg", "normal_deg", v.normalDegrees},
           {"  off silhouettes", "deg", "normal_inside_deg", v.normalDegreesInside},
           {"light off silhouettes", "1", "light", v.color.difference}}};
}

std::string_view nameOf(Mismatch mismatch) {
  constexpr std::array<std::string_view, 5> kNames = {"none", "missing", "extra", "wrong_node",
                                                      "wrong_layer"};
  return kNames[static_cast<std::size_t>(mismatch)];
}

/// By number; 0 is nothing.
class NodeNames {
 public:
  NodeNames(const Scene& scene, const Snapshot& snapshot) : scene_(scene), snapshot_(snapshot) {}

  [[nodiscard]] std::string operator()(std::uint32_t number) const {
    if (number == 0) return "nothing";
    for (const SnapshotNode& node : snapshot_.nodes)
      if (node.number == number) return scene_[node.id].name;
    return fmt::format("no node ({})", number);
  }

 private:
  const Scene& scene_;
  const Snapshot& snapshot_;
};

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }
Json finite(const std::optional<double>& value) { return value ? finite(*value) : Json(); }

Json jsonOf(const std::vector<Offence>& worst, const NodeNames& nameOfNode) {
  Json list = Json::array();
  for (const Offence& o : worst) {
    Json json = {{"pixel", {o.x, o.y}},
                 {"error", finite(o.error)},
                 {"node", o.measuredNode},
                 {"true_node", o.trueNode},
                 {"name", nameOfNode(o.measuredNode)},
                 {"true_name", nameOfNode(o.trueNode)},
                 {"uv", {finite(o.measuredParameters.x), finite(o.measuredParameters.y)}},
                 {"true_uv", {o.trueParameters.x, o.trueParameters.y}}};
    if (o.mismatch != Mismatch::None) json["kind"] = nameOf(o.mismatch);
    list.push_back(std::move(json));
  }
  return list;
}

Json jsonOf(const ErrorSpread& spread, const NodeNames& nameOfNode) {
  return {{"pixels", spread.pixels},
          {"rms", finite(spread.rms)},
          {"p99", finite(spread.p99)},
          {"p99.9", finite(spread.p999)},
          {"max", finite(spread.max)},
          {"floor", finite(spread.floor)},
          {"worst", jsonOf(spread.worst, nameOfNode)}};
}

Json jsonOf(const CoverageErrors& c, const NodeNames& nameOfNode) {
  return {
      {"compared", c.compared},      {"covered", c.covered},        {"both", c.both},
      {"undecided", c.undecided},    {"missing", c.missing},        {"extra", c.extra},
      {"wrong_node", c.wrongNode},   {"wrong_layer", c.wrongLayer}, {"mismatches", c.mismatches()},
      {"farthest_px", c.farthestPx}, {"beyond_0.01_px", c.beyond},  {"worst", jsonOf(c.worst, nameOfNode)}};
}

/// What shadows have too much and too little is told where some are approximations, and how much of the light
/// where a map estimates that.
Json jsonOf(const WrongPixels& wrong, bool approximateShadows, bool estimates) {
  const auto ofShadows = [&](std::uint64_t pixels) { return approximateShadows ? Json(pixels) : Json(); };
  return {{"pixels", wrong.total()},
          {"hit_miss", wrong.hitMiss},
          {"layer", wrong.layer},
          {"point", wrong.point},
          {"light", wrong.light},
          {"color", wrong.color},
          {"shadow_extra", ofShadows(wrong.shadowExtra)},
          {"shadow_missing", ofShadows(wrong.shadowMissing)},
          {"seen_part_off", estimates ? Json(reference::kSeenPartOff) : Json()}};
}

Json jsonOf(const ColorErrors& c) {
  Json json = {{"pixels", c.pixels},
               {"psnr_linear", finite(c.psnrLinear)},
               {"psnr_srgb", finite(c.psnrSrgb)},
               {"differing_pixels", c.differing8},
               {"differing_part", c.differing8Part},
               {"by_shader", c.byShader},
               {"unjudged", c.unjudged},
               {"flip", nullptr}};
  if (c.flipMean)
    json["flip"] = {{"mean", finite(c.flipMean)}, {"p99.9", finite(c.flipP999)}, {"max", finite(c.flipMax)}};
  return json;
}

/// Of how many lights a map estimates how much is seen.
std::ptrdiff_t estimatedLights(const Snapshot& snapshot) {
  return std::ranges::count_if(wholeLights(snapshot), [](const WholeLight& whole) {
    return whole.light.map && whole.light.map->radius > 0;
  });
}

std::string textOf(const Offence& o, const NodeNames& nameOfNode) {
  std::string text = fmt::format("  {:>5},{:<5} {:<10.4g}", o.x, o.y, o.error);
  if (o.mismatch != Mismatch::None) text += fmt::format(" {}:", nameOf(o.mismatch));
  text += fmt::format(" {}", nameOfNode(o.measuredNode));
  if (o.measuredNode != 0)
    text += fmt::format(" ({:.9g}, {:.9g})", o.measuredParameters.x, o.measuredParameters.y);
  text += fmt::format("  true: {}", o.trueNode == o.measuredNode ? "" : nameOfNode(o.trueNode) + " ");
  return text +
         (o.trueNode == 0 ? "\n" : fmt::format("({:.9g}, {:.9g})\n", o.trueParameters.x, o.trueParameters.y));
}

std::string worstText(std::string_view title, const std::vector<Offence>& worst,
                      const NodeNames& nameOfNode) {
  if (worst.empty() || worst.front().error == 0) return "";
  std::string text = fmt::format("\nworst {}\n", title);
  for (const Offence& o : worst) text += textOf(o, nameOfNode);
  return text;
}

}  // namespace

std::string verificationText(const VerificationReport& report, const Scene& scene, const Snapshot& snapshot) {
  const Verification& v = report.verification;
  const CoverageErrors& c = v.coverage;
  const FrameError& error = report.statistics.error;
  const NodeNames nameOfNode(scene, snapshot);
  std::string text = fmt::format("{}  {}x{}  time {} s  {}  {} triangles  on {}\n", report.scene,
                                 report.size.width, report.size.height, report.time, report.shading,
                                 report.statistics.count.triangles, report.device.name);
  text += fmt::format("truth      {} pixels, {} covered, {} undecided, in {:.1f} s\n",
                      c.compared + c.undecided, c.covered, c.undecided, report.truthMs / 1e3);
  text += fmt::format("the picture says: bound {:.3g} px", error.boundPx);
  if (error.residualMaxPx)
    text += fmt::format(
        ", residual {:.3g} px, {} unconverged, {} uncertified\n"
        "by rays    {} points, {} shadows; {} pixels audited, {} failed, {} undecided",
        *error.residualMaxPx, error.unconvergedPx, error.uncertifiedPx, error.resolvedByRaysPx,
        error.shadowRaysPx, error.auditedPx, error.auditFailedPx, error.auditUndecidedPx);
  text += fmt::format("\n\n{:<22}{:>5}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "error", "unit", "rms", "p99",
                      "p99.9", "max", "float32");
  for (const Metric& m : metricsOf(v))
    if (m.spread.pixels > 0)
      text += fmt::format("{:<22}{:>5}{:>11.3g}{:>11.3g}{:>11.3g}{:>11.3g}{:>11.3g}\n", m.label, m.unit,
                          m.spread.rms, m.spread.p99, m.spread.p999, m.spread.max, m.spread.floor);
  text += fmt::format(
      "\ncoverage   {} missing, {} extra, {} of another node, {} of another layer\n"
      "           farthest {:.4g} px from the silhouette, {} beyond {} px\n",
      c.missing, c.extra, c.wrongNode, c.wrongLayer, c.farthestPx, c.beyond, kSilhouettePx);
  const WrongPixels& wrong = v.wrong;
  text += fmt::format("wrong      {} pixels: {} hit or miss, {} layer, {} point, {} light, {} color\n",
                      wrong.total(), wrong.hitMiss, wrong.layer, wrong.point, wrong.light, wrong.color);
  if (report.approximateShadows > 0)
    text += fmt::format(
        "shadows    {} of the lights {} no exact shadow: the light is held against exact ones\n"
        "           {} pixels are dark that are lit in truth (extra), {} lit that are dark (missing)\n",
        report.approximateShadows, report.approximateShadows == 1 ? "has" : "have", wrong.shadowExtra,
        wrong.shadowMissing);
  if (const std::ptrdiff_t count = estimatedLights(snapshot); count > 0)
    text += fmt::format(
        "           of {} with a radius and a map it is right within {} of the part of it that {} rays see\n",
        count, reference::kSeenPartOff, reference::kSeenPartRays);
  if (v.color.byShader > 0)
    text += fmt::format(
        "shaders    {} pixels are lit by materials' shaders, which the truth cannot run, or seen through "
        "before "
        "such: their colours are not judged\n",
        v.color.byShader);
  if (v.color.unjudged > 0)
    text += fmt::format(
        "unjudged   {} pixels are off in a light that nothing tells enough of (curved meshes that are seen "
        "through, or in the shadows of more than {} lights, or with ambient occlusion): they may be wrong\n",
        v.color.unjudged, kMaxAlone);
  text += fmt::format("psnr       {:.1f} dB linear, {:.1f} dB sRGB, off silhouettes\n", v.color.psnrLinear,
                      v.color.psnrSrgb);
  text += fmt::format("8 bit      {} pixels differ: {:.3g} of the covered\n", v.color.differing8,
                      v.color.differing8Part);
  if (v.color.flipMean)
    text += fmt::format("flip       mean {:.3g}  p99.9 {:.3g}  max {:.3g}\n", *v.color.flipMean,
                        *v.color.flipP999, *v.color.flipMax);
  if (v.nanPixels > 0) text += fmt::format("nan        {} pixels\n", v.nanPixels);
  text += worstText("mismatches (px to the silhouette; shown and true node and (u, v))", c.worst, nameOfNode);
  for (const Metric& m : metricsOf(v))
    text += worstText(fmt::format("{} ({})", m.label.substr(m.label.find_first_not_of(' ')), m.unit),
                      m.spread.worst, nameOfNode);
  return text;
}

std::string verificationJson(const VerificationReport& report, const Scene& scene, const Snapshot& snapshot) {
  const Verification& v = report.verification;
  const FrameError& error = report.statistics.error;
  const NodeNames nameOfNode(scene, snapshot);
  const auto ofExact = [&](std::uint64_t pixels) { return error.residualMaxPx ? Json(pixels) : Json(); };
  Json json = {
      {"luxo", LUXO_VERSION},
      {"verify", 1},
      {"scene", report.scene},
      {"size", {report.size.width, report.size.height}},
      {"time", report.time},
      {"shading", report.shading},
      {"device",
       {{"name", report.device.name},
        {"type", report.device.type},
        {"driver", report.device.driver ? Json(*report.device.driver) : Json()}}},
      {"picture",
       {{"triangles", report.statistics.count.triangles},
        {"bound_px", finite(error.boundPx)},
        {"residual_max_px", finite(error.residualMaxPx)},
        {"unconverged_px", ofExact(error.unconvergedPx)},
        {"uncertified_px", ofExact(error.uncertifiedPx)},
        {"resolved_by_rays_px", ofExact(error.resolvedByRaysPx)},
        {"shadow_rays_px", ofExact(error.shadowRaysPx)},
        {"audited_px", ofExact(error.auditedPx)},
        {"audit_failed_px", ofExact(error.auditFailedPx)},
        {"audit_undecided_px", ofExact(error.auditUndecidedPx)}}},
      {"truth_ms", report.truthMs},
      {"nan_pixels", v.nanPixels},
      {"coverage", jsonOf(v.coverage, nameOfNode)},
      {"wrong", jsonOf(v.wrong, report.approximateShadows > 0, estimatedLights(snapshot) > 0)},
  };
  for (const Metric& m : metricsOf(v)) json[std::string(m.key)] = jsonOf(m.spread, nameOfNode);
  json["color"] = jsonOf(v.color);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace luxo
