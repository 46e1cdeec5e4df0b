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

Json frameJson(const FrameReport& frame) {
  const auto& [ms, count, error] = frame.statistics;
  // What only a drawn frame has.
  const auto drawn = [&](const auto& value) { return frame.reference ? Json() : Json(value); };
  // What only exact shading has.
  const auto found = [&error = error](std::uint64_t pixels) { return error.found ? Json(pixels) : Json(); };
  // And meshes in shadows.
  const auto settled = [&error = error](std::uint64_t pixels) {
    return error.found || error.shadowed ? Json(pixels) : Json();
  };
  Json json = {
      {"frame", frame.frame},
      {"time", frame.time},
      {"file", frame.file.string()},
      {"ms",
       {{"total", ms.total},
        {"animate", ms.animate},
        {"tessellate", drawn(ms.tessellate)},
        {"cull", drawn(ms.cull)},
        {"upload", drawn(ms.upload)},
        {"gpu", drawn(ms.gpu)},
        {"passes", drawn(passesJson(ms.passes))},
        {"rays", drawn(ms.rays)},
        {"ray_trees", drawn(ms.rayTrees)},
        {"readback", drawn(ms.readback)},
        {"encode", ms.encode}}},
      {"count",
       {{"nodes", count.nodes},
        {"drawn", drawn(count.drawn)},
        {"culled_frustum", drawn(count.culledFrustum)},
        {"culled_small", drawn(count.culledSmall)},
        {"culled_backface", drawn(count.culledBackface)},
        {"culled_lights", drawn(count.culledLights)},
        {"culled_hidden", drawn(count.culledHidden)},
        {"culled_triangles_frustum", drawn(count.culledTrianglesFrustum)},
        {"culled_triangles_backface", drawn(count.culledTrianglesBackface)},
        {"too_large", drawn(count.tooLarge)},
        {"draw_calls", drawn(count.drawCalls)},
        {"instances", drawn(count.instances)},
        {"triangles", drawn(count.triangles)},
        {"vertices", drawn(count.vertices)},
        {"submits", drawn(count.submits)},
        {"upload_bytes", drawn(count.uploadBytes)},
        {"tessellated", drawn(count.tessellated)},
        {"pipelines_created", drawn(count.pipelinesCreated)},
        {"shaders_compiled", drawn(count.shadersCompiled)},
        {"cut_numbers", frame.cutNumbers},
        {"passes", drawn(count.passes)},
        {"deferred", drawn(count.deferred)},
        {"shadow_passes", drawn(count.shadowPasses)},
        {"layer_points", drawn(count.layerPoints)},
        {"traced_rays", drawn(count.tracedRays)}}},
      {"error",
       {{"tolerance_px", drawn(error.tolerancePx)},
        {"bound_px", finite(error.boundPx)},
        {"residual_max_px", error.residualMaxPx ? Json(*error.residualMaxPx) : Json()},
        {"unconverged_px", settled(error.unconvergedPx)},
        {"uncertified_px", settled(error.uncertifiedPx)},
        {"resolved_by_rays_px", settled(error.resolvedByRaysPx)},
        {"approximate_shadows", drawn(frame.approximateShadows)},
        {"shadow_rays_px", settled(error.shadowRaysPx)},
        {"layers_missing", drawn(error.layersMissing)},
        {"audited_px", found(error.auditedPx)},
        {"audit_failed_px", found(error.auditFailedPx)},
        {"audit_undecided_px", found(error.auditUndecidedPx)},
        {"nonfinite_px", drawn(error.nonfinitePx)}}},
  };
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
