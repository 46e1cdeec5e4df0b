// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json frameJson(const FrameReport& frame) {
  const auto& [ms, count, error] = frame.statistics;
  Json json = {
      {"frame", frame.frame},
      {"time", frame.time},
      {"file", frame.file.string()},
      {"ms",
       {{"total", ms.total},
        {"animate", ms.animate},
        {"tessellate", ms.tessellate},
        {"cull", ms.cull},
        {"upload", ms.upload},
        {"gpu", ms.gpu},
        {"readback", ms.readback},
        {"encode", ms.encode}}},
      {"count",
       {{"nodes", count.nodes},
        {"drawn", count.drawn},
        {"culled_frustum", count.culledFrustum},
        {"culled_small", count.culledSmall},
        {"culled_backface", count.culledBackface},
        {"culled_lights", count.culledLights},
        {"draw_calls", count.drawCalls},
        {"instances", count.instances},
        {"triangles", count.triangles},
        {"vertices", count.vertices},
        {"submits", count.submits},
        {"upload_bytes", count.uploadBytes},
        {"tessellated", count.tessellated},
        {"pipelines_created", count.pipelinesCreated},
        {"shaders_compiled", count.shadersCompiled},
        {"passes", count.passes},
        {"shadow_passes", count.shadowPasses}}},
      {"error",
       {{"tolerance_px", error.tolerancePx},
        {"bound_px", finite(error.boundPx)},
        {"residual_max_px", nullptr},
        {"unconverged_px", nullptr}}},
  };
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

std::string reportJson(const RunReport& report) {
  Json frames = Json::array();
  for (const FrameReport& frame : report.frames) frames.push_back(frameJson(frame));
  const Json json = {
      {"luxo", LUXO_VERSION},
      {"report", 1},
      {"device",
       {{"name", report.device.name},
        {"type", gpu::deviceTypeName(report.device.type)},
        {"driver", report.device.driver}}},
      {"scene", report.scene},
      {"size", {report.size.width, report.size.height}},
      {"startup_ms", report.startupMs},
      {"frames", std::move(frames)},
  };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace luxo
