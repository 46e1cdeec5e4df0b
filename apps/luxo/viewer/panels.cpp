// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/shading.h"

namespace luxo {
namespace {

using window::Panel;

std::string counted(std::uint64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string pictureText(const Status& status, const DrawOptions& draw) {
  return fmt::format("{} × {}, {}, {}{}", status.size.width, status.size.height, nameOf(draw.shading),
                     counted(static_cast<std::uint64_t>(draw.samples), "sample"),
                     draw.cullBackFaces ? "" : ", no culling");
}

std::string speedText(const FrameMeter::Reading& reading) {
  const std::string times = fmt::format("gpu {:.1f} ms, cpu {:.1f} ms", reading.gpu, reading.cpu);
  return reading.rate ? fmt::format("{:.0f} fps, {}", *reading.rate, times) : times;
}

std::string drawnText(const FrameCounts& count) {
  return fmt::format("{}, {}", counted(count.triangles, "triangle"), counted(count.drawCalls, "draw"));
}

std::string nodesText(const FrameCounts& count) {
  const std::uint64_t culled = count.culledFrustum + count.culledSmall + count.culledBackface;
  return fmt::format("{} drawn, {} culled", count.drawn, culled);
}

std::string errorText(const FrameError& error) {
  return std::isfinite(error.boundPx) ? fmt::format("at most {:.2g} px", error.boundPx)
                                      : std::string("no bound from so close");
}

}  // namespace

Panel numbersPanel(const Status& status, const Controls& controls) {
  Panel panel{.place = Panel::Place::TopLeft, .title = status.title, .rows = {}, .discreet = true};
  panel.rows = {
      {"device", status.device},
      {"picture", pictureText(status, controls.drawOptions())},
      {"frame", speedText(status.reading)},
      {"geometry", drawnText(status.statistics.count)},
      {"nodes", nodesText(status.statistics.count)},
      {"error", errorText(status.statistics.error)},
      {"time", fmt::format("{:.3f} s{}", status.seconds, controls.playback().playing() ? "" : ", paused")},
  };
  if (controls.ownCamera()) panel.rows.push_back({"camera", "yours; R gives it back"});
  panel.rows.push_back({"H", "keys"});
  return panel;
}

Panel keysPanel() {
  Panel panel{.place = Panel::Place::TopRight, .title = "Keys"};
  for (const KeyHelp& help : keyHelp()) panel.rows.push_back({help.keys, help.meaning});
  return panel;
}

Panel messagePanel(const Message& message) {
  Panel panel{.place = Panel::Place::Bottom, .title = {}, .rows = {}, .alert = message.alert};
  if (message.alert) {
    panel.title = message.text;
  } else {
    panel.rows.push_back({"", message.text});
  }
  return panel;
}

}  // namespace luxo
