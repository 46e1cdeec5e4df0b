// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "console.h"
#include "image/file.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json deviceJson(const DeviceReport& device) {
  return {{"name", device.name},
          {"type", device.type},
          {"driver", device.driver ? Json(*device.driver) : Json()},
          {"sin_cos", sinCosJson(device.sinCos)}};
}

Json passesJson(std::span<const PassTime> passes) {
  Json json = Json::object();
  for (const PassTime& pass : passes) json[std::string(pass.name)] = pass.milliseconds;
  return json;
}

/// What only a drawn frame has.
Json drawn(const FrameReport& frame, const auto& value) { return frame.reference ? Json() : Json(value); }

Json millisecondsJson(const FrameReport& frame) {
  const auto& ms = frame.statistics.ms;
  const auto of = [&](const auto& value) { return drawn(frame, value); };
  return {{"total", ms.total},
          {"animate", ms.animate},
          {"tessellate", of(ms.tessellate)},
          {"cull", of(ms.cull)},
          {"upload", of(ms.upload)},
          {"gpu", of(ms.gpu)},
          {"passes", of(passesJson(ms.passes))},
          {"rays", of(ms.rays)},
          {"ray_trees", of(ms.rayTrees)},
          {"readback", of(ms.readback)},
          {"encode", ms.encode}};
}

Json countJson(const FrameReport& frame) {
  const auto& count = frame.statistics.count;
  const auto of = [&](const auto& value) { return drawn(frame, value); };
  return {{"nodes", count.nodes},
          {"drawn", of(count.drawn)},
          {"culled_frustum", of(count.culledFrustum)},
          {"culled_small", of(count.culledSmall)},
          {"culled_backface", of(count.culledBackface)},
          {"culled_lights", of(count.culledLights)},
          {"culled_hidden", of(count.culledHidden)},
          {"culled_triangles_frustum", of(count.culledTrianglesFrustum)},
          {"culled_triangles_backface", of(count.culledTrianglesBackface)},
          {"too_large", of(count.tooLarge)},
          {"draw_calls", of(count.drawCalls)},
          {"instances", of(count.instances)},
          {"triangles", of(count.triangles)},
          {"vertices", of(count.vertices)},
          {"submits", of(count.submits)},
          {"upload_bytes", of(count.uploadBytes)},
          {"tessellated", of(count.tessellated)},
          {"pipelines_created", of(count.pipelinesCreated)},
          {"shaders_compiled", of(count.shadersCompiled)},
          {"cut_numbers", frame.cutNumbers},
          {"passes", of(count.passes)},
          {"deferred", of(count.deferred)},
          {"shadow_passes", of(count.shadowPasses)},
          {"layer_points", of(count.layerPoints)},
          {"traced_rays", of(count.tracedRays)}};
}

Json errorJson(const FrameReport& frame) {
  const FrameError& error = frame.statistics.error;
  const auto of = [&](const auto& value) { return drawn(frame, value); };
  // What only exact shading has.
  const auto found = [&](std::uint64_t pixels) { return error.found ? Json(pixels) : Json(); };
  // And meshes in shadows.
  const auto settled = [&](std::uint64_t pixels) {
    return error.found || error.shadowed ? Json(pixels) : Json();
  };
  return {{"tolerance_px", of(error.tolerancePx)},
          {"bound_px", finite(error.boundPx)},
          {"residual_max_px", error.residualMaxPx ? Json(*error.residualMaxPx) : Json()},
          {"unconverged_px", settled(error.unconvergedPx)},
          {"uncertified_px", settled(error.uncertifiedPx)},
          {"resolved_by_rays_px", settled(error.resolvedByRaysPx)},
          {"approximate_shadows", of(frame.approximateShadows)},
          {"shadow_rays_px", settled(error.shadowRaysPx)},
          {"layers_missing", of(error.layersMissing)},
          {"audited_px", found(error.auditedPx)},
          {"audit_failed_px", found(error.auditFailedPx)},
          {"audit_undecided_px", found(error.auditUndecidedPx)},
          {"nonfinite_px", of(error.nonfinitePx)}};
}

Json frameJson(const FrameReport& frame) {
  Json json = {{"frame", frame.frame},          {"time", frame.time},        {"file", frame.file.string()},
               {"ms", millisecondsJson(frame)}, {"count", countJson(frame)}, {"error", errorJson(frame)}};
  if (const auto& reference = frame.reference)
    json["reference"] = {{"hits", reference->hits},
                         {"misses", reference->misses},
                         {"undecided", reference->undecided},
                         {"standard_error_rms", reference->standardErrorRms},
                         {"standard_error_max", reference->standardErrorMax}};
  if (!frame.scene.empty()) json["scene"] = frame.scene;
  if (frame.at) json["at"] = *frame.at;
  if (!frame.parameters.empty()) {
    json["parameters"] = Json::object();
    for (const auto& [name, value] : frame.parameters) json["parameters"][name] = value;
  }
  if (frame.error) {
    json["file"] = nullptr;
    json["failure"] = *frame.error;
  }
  return json;
}

}  // namespace

Json sinCosJson(const std::optional<SinCosError>& error) {
  if (!error) return nullptr;
  return {{"used", "own"},
          {"max_error", finite(error->ofFormulas)},
          {"driver_max_error", finite(error->ofDriver)}};
}

std::string reportJson(const RunReport& report) {
  Json frames = Json::array();
  for (const FrameReport& frame : report.frames) frames.push_back(frameJson(frame));
  const Json json = {
      {"luxo", LUXO_VERSION},
      {"report", 1},
      {"device", deviceJson(report.device)},
      {"scene", report.scene},
      {"size", {report.size.width, report.size.height}},
      {"startup_ms", report.startupMs},
      {"frames", std::move(frames)},
  };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeReport(const RunReport& report, const std::filesystem::path& file) {
  const std::string json = reportJson(report);
  if (file == "-") return printData(json);
  writeFileAtomically(file, std::as_bytes(std::span(json)));
}

}  // namespace luxo
