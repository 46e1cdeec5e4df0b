// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <memory>

#include "base/error.h"
#include "console.h"
#include "exit_code.h"
#include "open_scene.h"
#include "plot_scene.h"
#include "render_to_files.h"
#include "scene/scene_writer.h"
#include "verbs.h"

namespace luxo {
namespace {

constexpr const char* kPlotFooter =
    "\nAxes are those of scene files: x right, y up, z toward the viewer.\n"
    "  luxo plot \"[cos(u)*cos(v), sin(v), sin(u)*cos(v)]\" --u 0:tau --v -pi/2:pi/2 -o sphere.png\n"
    "  luxo plot \"[u, a*sin(k*u)*cos(k*v), v]\" --u -1:1 --v -1:1 -L k=5 -L a=1/k --sweep k=1:8:1 -o "
    "wave.png\n"
    "  luxo plot \"[u, u*v, v]\" --u -1:1 --v -1:1 --color K --isolines y@0.1 --grid 10 -o saddle.png";

struct PlotOptions {
  PlotDesc plot;
  bool emit = false;
  std::unique_ptr<RenderOptions> render;
};

int runPlot(const PlotOptions& options) {
  const PlotDesc& plot = options.plot;
  if (plot.position.empty() || plot.u.empty() || plot.v.empty())
    throw Error(ErrorKind::Usage, "a plot needs a formula and the ranges --u and --v",
                "as in luxo plot \"[u, u*v, v]\" --u -1:1 --v -1:1 -o saddle.png");
  if (!plot.colormap.empty() && plot.color.empty())
    throw Error(ErrorKind::Usage, "a colormap is given, and no formula to colour by", "as in --color K");
  if (!options.emit && !options.render->hasOutput())
    throw Error(ErrorKind::Usage, "no output is given",
                "name the picture to write, as in -o saddle.png; or print the scene with --emit");
  const RenderRequest request =
      options.render->request(options.emit ? RenderTarget::Window : RenderTarget::File);
  const SceneFile file = plotScene(plot, request);
  std::vector<std::string> warnings;
  Scene scene = buildScene(file, {}, &warnings);
  if (request.verbosity != Verbosity::Quiet)
    for (const std::string& warning : warnings) printWarning(warning);
  if (!options.emit) return renderToFiles(std::move(scene), request);
  printData(writeScene(file));
  return exit_code::kDone;
}

}  // namespace

void addPlot(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("plot", "draw one formula to a file");
  verb->group("Verbs");
  verb->footer(kPlotFooter);
  const auto options = std::make_shared<PlotOptions>();
  verb->add_option("FORMULA", options->plot.position, "\"[x, y, z]\", each a formula of u and v")
      ->type_name("");
  verb->add_option("--u", options->plot.u, "range of u, as in 0:tau")->type_name("FROM:TO");
  verb->add_option("--v", options->plot.v, "range of v")->type_name("FROM:TO");
  verb->add_option("-L,--let", options->plot.definitions,
                   "a name for the formulas: a parameter of the scene, unless it uses u or v")
      ->type_name("NAME=FORMULA")
      ->allow_extra_args(false);
  verb->add_option("--color", options->plot.color,
                   "colour by a formula of u, v, x y z, the normal nx ny nz, the curvatures K H k1 k2")
      ->type_name("FORMULA");
  verb->add_option("--colormap", options->plot.colormap,
                   "viridis, or vik, whose middle is 0: the usual one where the formula is above and below 0")
      ->type_name("NAME");
  verb->add_option("--isolines", options->plot.isolines,
                   "lines where a formula is a multiple of STEP, or, without a step, 0; repeat it for more")
      ->type_name("FORMULA@STEP")
      ->allow_extra_args(false);
  verb->add_option("--grid", options->plot.grid, "N lines of constant u and of constant v, or NxM")
      ->type_name("N|NxM");
  verb->add_flag("--emit", options->emit,
                 "print the scene file that draws the same picture, and draw nothing");
  options->render = std::make_unique<RenderOptions>(*verb, SceneArgument::None);
  verb->get_option("--samples")->description("samples per pixel, 1 to 256 (4)");
  verb->callback([options, &chosen] { chosen = [options] { return runPlot(*options); }; });
}

}  // namespace luxo
