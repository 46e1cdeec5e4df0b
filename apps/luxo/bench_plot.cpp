// SPDX-License-Identifier: Apache-2.0
#include "bench_plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace luxo {
namespace {

struct Panel {
  std::string_view title;
  double (*error)(const BenchError&);
};

constexpr std::array<Panel, 4> kPanels = {
    {{"largest error on the screen, silhouettes included (px)",
      [](const BenchError& e) { return e.largestPx(); }},
     {"position error of 99.9 % of the pixels (px)", [](const BenchError& e) { return e.positionP999Px; }},
     {"normal error of 99.9 % of the pixels (degrees)", [](const BenchError& e) { return e.normalP999Deg; }},
     {"part of the covered pixels with another 8-bit colour",
      [](const BenchError& e) { return e.differing8Part; }}}};

/// Where an error of zero is drawn, since a logarithm has no place for it: one step below the least others.
constexpr double kZero = 1e-7;

struct Look {
  Shading shading;
  std::string_view colour;
  int width;
};
/// Told apart by people who see no red or no green, too (Okabe and Ito's palette).
constexpr std::array<Look, 4> kLooks = {{{Shading::Flat, "#999999", 1},
                                         {Shading::Gouraud, "#e69f00", 1},
                                         {Shading::Phong, "#0072b2", 1},
                                         {Shading::Exact, "#d55e00", 2}}};
/// Filled and open marks of gnuplot, in the order of the scenes.
constexpr std::array<int, 12> kMarks = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12, 1, 2};

int markOf(std::size_t scene) { return kMarks[scene % kMarks.size()]; }

/// `time low high error` of one shading in one scene, fastest last; empty when it was not drawn.
std::string pointsOf(const BenchScene& scene, Shading shading, const Panel& panel) {
  std::string points;
  for (const BenchRow& row : scene.rows) {
    const double error = panel.error(row.error);
    if (row.way.shading != shading || row.way.samples != 1 || row.way.deferred || !std::isfinite(error))
      continue;
    const Typical& ms = row.cost.frameMs;
    points += fmt::format("{} {} {} {}\n", ms.median, ms.p10, ms.p90, std::max(error, kZero));
  }
  return points;
}

/// Names may hold anything; in single quotes gnuplot takes all but a single quote as it is.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe.append(c == '\'' ? 2 : 1, c == '\n' ? ' ' : c);
  return fmt::format("'{}'", safe);
}

std::string legend(std::span<const BenchScene> scenes) {
  std::string entries;
  for (const Look& look : kLooks)
    entries +=
        fmt::format(", keyentry with lines lc rgb '{}' lw 3 title '{}'", look.colour, nameOf(look.shading));
  for (std::size_t i = 0; i < scenes.size(); ++i)
    entries += fmt::format(", keyentry with points lc rgb '#333333' pt {} title {}", markOf(i),
                           quoted(scenes[i].name));
  return entries;
}

}  // namespace

std::string paretoScript(std::span<const BenchScene> scenes, const std::string& title) {
  std::string script =
      "set terminal svg size 1200,960 font 'sans-serif,13' background '#ffffff'\n"
      "set encoding utf8\n"
      "set logscale xy\n"
      "set format xy '%g'\n"
      "set xlabel 'time of a frame (ms)'\n"
      "set grid xtics ytics lc rgb '#dddddd'\n"
      "set bars 0\n"
      "set key off\n";
  script += fmt::format(
      "set multiplot layout 2,2 margins screen 0.07,0.83,0.07,0.91 spacing screen 0.08,0.11 title {} "
      "noenhanced\n",
      quoted(title));
  for (std::size_t p = 0; p < kPanels.size(); ++p) {
    std::string data, plots;
    int block = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i)
      for (const Look& look : kLooks) {
        const std::string points = pointsOf(scenes[i], look.shading, kPanels[p]);
        if (points.empty()) continue;
        const std::string name = fmt::format("$d{}_{}", p, block++);
        data += fmt::format("{} << EOD\n{}EOD\n", name, points);
        plots += fmt::format("{}{} using 1:4:2:3 with xerrorlines lc rgb '{}' lw {} pt {} ps 0.8 notitle",
                             plots.empty() ? "" : ", ", name, look.colour, look.width, markOf(i));
      }
    // gnuplot wants something to plot, at a finite place; this paints nothing.
    if (plots.empty()) plots = "1 with lines lt nodraw notitle";
    // One legend for all, beside the upper right one.
    const bool last = p + 1 == kPanels.size();
    if (last) script += "set key at screen 0.985,0.91 top right noenhanced\n";
    script += fmt::format("set title {}\n{}plot {}{}\n", quoted(std::string(kPanels[p].title)), data, plots,
                          last ? legend(scenes) : "");
  }
  return script + "unset multiplot\n";
}

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};
/// Nameless, gone when closed.
using Stream = std::unique_ptr<std::FILE, CloseFile>;

Stream temporaryStream() {
  Stream stream(std::tmpfile());
  if (!stream)
    throw Error(
        ErrorKind::Write,
        fmt::format("cannot make a temporary file for gnuplot: {}", std::generic_category().message(errno)),
        "look at the free space of the folder for temporary files");
  return stream;
}

std::string contentOf(std::FILE* file) {
  std::string text;
  std::rewind(file);
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), file)) > 0;)
    text.append(part.data(), n);
  return text;
}

}  // namespace

std::optional<std::string> runGnuplot(const std::string& script) {
  const Stream in = temporaryStream(), out = temporaryStream(), err = temporaryStream();
  std::fwrite(script.data(), 1, script.size(), in.get());
  std::rewind(in.get());
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err.get()), STDERR_FILENO);
  std::string program = "gnuplot";
  std::array<char*, 2> arguments = {program.data(), nullptr};
  pid_t process = 0;
  const int failure = posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return std::nullopt;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  std::string svg = contentOf(out.get());
  if (status != 0 || svg.empty())
    throw Error(ErrorKind::Internal, fmt::format("gnuplot failed: {}", contentOf(err.get())),
                "the numbers are in results.csv; is this gnuplot 5.4 or newer?");
  return svg;
}

}  // namespace luxo
