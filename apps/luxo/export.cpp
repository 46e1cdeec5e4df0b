// SPDX-License-Identifier: Apache-2.0
// luxo export: a scene's surfaces as the triangles of a model file, which are proven to be near them.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "console.h"
#include "exit_code.h"
#include "export/carried_scene.h"
#include "export/exported_model.h"
#include "image/file.h"
#include "interruption.h"
#include "mesh/model_writer.h"
#include "open_scene.h"
#include "option_values.h"
#include "options.h"
#include "output_files.h"
#include "progress_bar.h"
#include "scene_request.h"
#include "verbs.h"

namespace luxo {
namespace {

constexpr const char* kFooter =
    "\nThe deviation that is proven stands in the file: in comments, of a GLB in asset.extras.luxo. Without\n"
    "--tolerance it is at most a 2000th of the scene's diagonal. One that is asked for and cannot be kept "
    "is\n"
    "exit code 6; the file is written. What is closed is watertight: along every edge as many triangles go\n"
    "one way as the other. A GLB carries its formulas, too (LUXO_parametric_surface), with the files that\n"
    "the scene names: luxo render x.glb draws these; other programs, and { \"type\": \"mesh\" } in scenes,\n"
    "use the triangles.\n"
    "  luxo export torus -o torus.stl --tolerance 0.01mm --unit mm\n"
    "  luxo export flag --time 2 --thicken 1.2mm -o flag.stl";

/// The options as typed.
struct ExportOptions {
  std::unique_ptr<RenderOptions> scene;
  std::string output;
  std::optional<std::string> format, tolerance, thickness, unit;
  bool noFormulas = false;
};

/// What the options say.
struct ExportRequest {
  RenderRequest scene;
  std::filesystem::path output;  ///< a name of the format where it is printed
  bool printed = false;
  std::optional<double> tolerance;
  double thickness = 0;
  LengthUnit unit;
  bool formulas = true;

  [[nodiscard]] bool glb() const { return namesGlb(output); }
  [[nodiscard]] bool talks() const { return scene.verbosity != Verbosity::Quiet; }
};

std::filesystem::path outputOf(const ExportOptions& options) {
  constexpr const char* kHint = "models are written as .glb, .obj, .ply, .stl, as in -o scene.glb";
  if (options.output.empty()) throw Error(ErrorKind::Usage, "no output is given", kHint);
  const bool printed = options.output == "-";
  if (!options.format && printed)
    throw Error(ErrorKind::Usage, "-o - says no format", "as in -o - --format stl");
  if (!options.format) {
    if (!namesWrittenModel(options.output))
      throw Error(ErrorKind::Usage, fmt::format("-o '{}' names no model that can be written", options.output),
                  kHint);
    return options.output;
  }
  if (!printed) throw Error(ErrorKind::Usage, "--format is for -o -", "the suffix of a file says its format");
  const std::filesystem::path named = "model." + *options.format;
  if (!namesWrittenModel(named))
    throw Error(ErrorKind::Usage, fmt::format("--format '{}': there is no such format", *options.format),
                "one of glb, ply, stl");
  if (namesOf(named).size() > 1)
    throw Error(ErrorKind::Usage, fmt::format("--format {}: that is two files", *options.format),
                "print a glb, ply or stl, or name a file");
  return named;
}

ExportRequest requestOf(const ExportOptions& options) {
  ExportRequest request{.scene = options.scene->request(RenderTarget::Window),
                        .output = outputOf(options),
                        .printed = options.output == "-",
                        .tolerance = std::nullopt,
                        .formulas = !options.noFormulas};
  if (request.scene.scene.empty())
    throw Error(ErrorKind::Usage, "no scene is given", "as in luxo export torus -o torus.glb");
  if (options.tolerance) request.tolerance = parseLength("--tolerance", *options.tolerance);
  if (options.thickness) request.thickness = parseLength("--thicken", *options.thickness);
  if (options.unit) request.unit = {*options.unit, parseLengthUnit("--unit", *options.unit)};
  if (request.glb() && options.unit && request.unit.metres != 1)
    throw Error(ErrorKind::Usage, fmt::format("--unit {}: a GLB is in metres", request.unit.name),
                "leave it out, or write an obj, ply or stl");
  if (!request.glb() && options.noFormulas)
    throw Error(ErrorKind::Usage, "--no-formulas is for GLB", "other formats carry none");
  return request;
}

void tell(const ExportRequest& request, const ExportedModel& made) {
  std::uint64_t triangles = 0;
  for (const ModelNode& node : made.model.nodes)
    if (node.mesh != kNone) triangles += made.model.meshes[node.mesh].triangleCount();
  const std::string distance = std::isfinite(made.claim.deviation)
                                   ? "at most " + shownUpward(made.claim.deviation, request.unit, 3) + " from"
                                   : "an unknown distance from";
  printNote(fmt::format("{}: {} triangles, {} their surfaces, {}{}",
                        request.printed ? "standard output" : request.output.string(), triangles, distance,
                        made.claim.closed ? "closed" : "open",
                        request.glb() ? "" : fmt::format("; 1 is 1 {}", request.unit.name)));
  if (request.thickness > 0 && !request.glb() && request.unit.metres == 1)
    printNote("programs for printing mostly take coordinates for millimetres: see --unit");
}

/// The tolerance is told as asked, but for what changing its unit rounds.
void requireWithin(const ExportRequest& request, const ModelClaim& claim) {
  if (!request.tolerance || claim.deviation <= *request.tolerance) return;
  throw Error(
      ErrorKind::Requirement,
      std::isfinite(claim.deviation)
          ? fmt::format("the triangles are proven to be within {} of their surfaces, not within {:.15g} {}",
                        shownUpward(claim.deviation, request.unit, 3),
                        *request.tolerance / request.unit.metres, request.unit.name)
          : "nothing is proven of how far the triangles are from their surfaces",
      "luxo inspect names holes; a coarser --tolerance, or a scene nearer to the origin, may do");
}

/// Into a GLB, or why not, as a warning.
void addFormulas(const ExportRequest& request, std::optional<SceneFile> description, Model& model,
                 std::vector<std::string>& warnings) {
  if (!request.glb() || !request.formulas) return;
  if (!description) {
    if (!namesModel(request.scene.scene))
      warnings.push_back("the scene is made by a program: the GLB carries no formulas");
    return;
  }
  CarriedScene carried =
      carriedScene(std::move(*description), overridesOf(request.scene.parameters), request.scene.time);
  model.scene = std::move(carried.text);
  model.sceneFiles = std::move(carried.files);
}

std::vector<NamedFile> named(const std::vector<std::filesystem::path>& files) {
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& file : files) outputs.push_back({"-o", file});
  return outputs;
}
std::vector<std::filesystem::path> pathsOf(const std::vector<ModelFile>& files) {
  std::vector<std::filesystem::path> paths;
  for (const ModelFile& file : files) paths.push_back(file.path);
  return paths;
}

int runExport(const ExportOptions& options) {
  const ExportRequest request = requestOf(options);
  rememberInterruptions();
  showLog(request.scene.verbosity);
  std::vector<std::string> warnings;
  std::vector<NamedFile> inputs;
  OpenedScene opened = openDescribedScene(request.scene.scene,
                                          {.parameters = request.scene.parameters,
                                           .warnings = &warnings,
                                           .inputs = &inputs,
                                           .allowOutside = request.scene.allowOutside,
                                           .showsProgress = request.scene.verbosity == Verbosity::Normal});
  if (!request.printed) requireOutputs(named(namesOf(request.output)), inputs);
  const Scene& scene = opened.scene;
  const double time = settingsOf(scene, request.scene).time;
  ExportedModel made;
  {
    ProgressBar bar(request.scene.verbosity == Verbosity::Normal);
    made = exportedModel(scene, time,
                         {.tolerance = request.tolerance,
                          .thickness = request.thickness,
                          .camera = cameraOf(scene, request.scene),
                          .kept = keptBy(request.output),
                          .ownLights = opened.ownLights,
                          .progress = [&](double done) { bar.show(done); }});
  }
  addFormulas(request, std::move(opened.description), made.model, warnings);
  warnings.insert(warnings.end(), made.warnings.begin(), made.warnings.end());
  if (request.talks())
    for (const std::string& warning : warnings) printWarning(warning);
  const std::vector<ModelFile> files = filesOf(made.model, request.output, made.claim, request.unit);
  if (!request.printed) requireOutputs(named(pathsOf(files)), inputs);  // images are known only now
  for (const ModelFile& file : files)
    if (request.printed)
      printData(std::string(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()));
    else
      writeFileAtomically(file.path, file.bytes);
  if (request.talks()) tell(request, made);
  requireWithin(request, made.claim);
  return exit_code::kDone;
}

}  // namespace

void addExport(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("export", "write a scene's surfaces as a model: glb obj ply stl");
  verb->group("Verbs");
  verb->footer(kFooter);
  const auto options = std::make_shared<ExportOptions>();
  options->scene = std::make_unique<RenderOptions>(*verb, SceneArgument::Taken, RenderTarget::Window);
  // No picture is drawn.
  for (const char* meaningless : {"--size", "--fps", "--samples", "--tolerance", "--shading", "--composition",
                                  "--hidden-lines", "--engine", "--skip", "--device", "--validate"})
    verb->remove_option(verb->get_option(meaningless));
  verb->get_option("--time")->description("moment to export, in seconds (the scene's own)");
  verb->get_option("--camera")->description("the camera that comes first in a GLB");
  const auto add = [&](const char* name, auto& value, const char* help, const char* type) {
    verb->add_option(name, value, help)->type_name(type);
  };
  add("-o,--output", options->output, "model to write: .glb .obj (with a .mtl) .ply .stl; - is stdout",
      "FILE");
  add("--format", options->format, "of -o -: glb ply stl", "NAME");
  add("--tolerance", options->tolerance,
      "how far triangles may be from their surfaces: 0.01mm, 5um, 1e-3 (metres)", "LENGTH");
  add("--thicken", options->thickness, "make plates of this thickness of open surfaces, for printing",
      "LENGTH");
  add("--unit", options->unit, "what 1 in an obj, ply or stl is: um mm cm in m (m)", "NAME");
  verb->add_flag("--no-formulas", options->noFormulas, "a GLB of triangles alone");
  verb->callback([options, &chosen] { chosen = [options] { return runExport(*options); }; });
}

}  // namespace luxo
