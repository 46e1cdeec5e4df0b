// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include "draw/exact_data.h"
#include "error_lines.h"
#include "scene/shading.h"

namespace luxo {
namespace {

using window::Panel;

std::string counted(std::uint64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string pictureText(const Status& status, const DrawOptions& draw) {
  const std::string shading =
      status.shading == draw.shading
          ? std::string(nameOf(draw.shading))
          : fmt::format("{} until {} is ready", nameOf(status.shading), nameOf(draw.shading));
  return fmt::format("{} × {}, {}, {}{}", status.size.width, status.size.height, shading,
                     counted(static_cast<std::uint64_t>(status.samples), "sample"),
                     draw.cullBackFaces ? "" : ", no culling");
}

std::string speedText(const FrameMeter::Reading& reading) {
  const std::string times = fmt::format("gpu {:.1f} ms, cpu {:.1f} ms", reading.gpu, reading.cpu);
  return reading.rate ? fmt::format("{:.0f} fps, {}", *reading.rate, times) : times;
}

/// As many as a panel has room for, those that take most first; the rest is one.
std::vector<Panel::Row> passRows(std::vector<PassTime> passes) {
  constexpr std::size_t kMaxShown = 5;
  std::ranges::stable_sort(passes, std::ranges::greater{}, &PassTime::milliseconds);
  for (; passes.size() > kMaxShown; passes.pop_back())
    passes[kMaxShown - 1] = {"the rest", passes[kMaxShown - 1].milliseconds + passes.back().milliseconds};
  std::vector<Panel::Row> rows;
  for (const PassTime& pass : passes)
    rows.push_back(
        {.label = fmt::format("  {}", pass.name), .text = fmt::format("{:.2f} ms", pass.milliseconds)});
  return rows;
}

std::string timeText(double seconds, const window::Playback& playback) {
  const std::string end = playback.loop() > 0 ? fmt::format(" of {:.3f}", playback.loop()) : "";
  return fmt::format("{:.3f}{} s{}", seconds, end, playback.playing() ? "" : ", paused");
}

std::string drawnText(const FrameCounts& count) {
  return fmt::format("{}, {}", counted(count.triangles, "triangle"), counted(count.drawCalls, "draw"));
}

std::string nodesText(const FrameCounts& count) {
  const std::uint64_t culled = count.culledFrustum + count.culledSmall + count.culledBackface;
  return fmt::format("{} drawn, {} culled", count.drawn, culled);
}

std::string errorText(const FrameError& error) {
  // Where surfaces are found in every pixel, nothing may be a mesh.
  if (error.found && !error.residualMaxPx && error.boundPx == 0)  // residuals are not read back
    return fmt::format("searched to {:.2g} px", kExactTolerancePx);
  const bool meshes = !error.residualMaxPx || error.boundPx > 0;
  if (meshes && !std::isfinite(error.boundPx)) return "no bound from so close";
  const double most = std::max(error.residualMaxPx.value_or(0), meshes ? error.boundPx : 0);
  return fmt::format("at most {:.2g} px", most);
}

std::string auditText(const ProgressiveMean::Audit& audit) {
  const std::string found = audit.byRays > 0 ? fmt::format("; {} by rays", audit.byRays) : "";
  if (audit.wrong > 0)
    return fmt::format("{} of {} px were wrong, mended{}", audit.wrong, audit.pixels, found);
  if (audit.open > 0) return fmt::format("{} px; {} px are not known{}", audit.pixels, audit.open, found);
  return fmt::format("{} px, all right{}", audit.pixels, found);
}

// Of the overlay's letters at content scale 1, a little generously.
constexpr double kLetterWidthPx = 8.6, kLineHeightPx = 18.5, kFramePx = 64;

std::size_t fitting(int pixels, double contentScale, double unitPx) {
  return static_cast<std::size_t>(std::max(1.0, (pixels / contentScale - kFramePx) / unitPx));
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
      {"time", timeText(status.seconds, controls.playback())},
  };
  if (status.tellsPasses) {
    const std::vector<Panel::Row> passes = passRows(status.reading.passes);
    panel.rows.insert(panel.rows.begin() + 3, passes.begin(), passes.end());
  }
  if (status.audit.pixels > 0) panel.rows.push_back({"audit", auditText(status.audit)});
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
  Panel panel{.place = Panel::Place::Top, .title = {}, .rows = {}, .alert = message.alert};
  if (message.alert) {
    panel.title = message.text;
  } else {
    panel.rows.push_back({"", message.text});
  }
  return panel;
}

Panel errorPanel(const std::string& title, const std::string& text, PixelSize window, double contentScale) {
  Panel panel{.place = Panel::Place::Center, .title = title, .rows = {}, .alert = true, .monospaced = true};
  const std::size_t lines = fitting(window.height, contentScale, kLineHeightPx);
  const std::size_t columns = fitting(window.width, contentScale, kLetterWidthPx);
  for (const std::string& line : errorLines(text, columns)) {
    const bool isLast = panel.rows.size() + 1 == lines;
    panel.rows.push_back({"", isLast ? "..." : line});
    if (isLast) break;
  }
  return panel;
}

}  // namespace luxo
