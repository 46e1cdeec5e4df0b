// SPDX-License-Identifier: Apache-2.0
// Runs when luxo is built: the exact fragment shaders of the named surfaces, and of the surfaces and patterns
// of some scenes, made from their formulas, and the shaders of the light on these patterns, as C++ tables.
//
//     luxo_exact_shaders HEADER [SCENE.luxo.json ...]
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "draw/exact_source.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "surface/caster_code.h"
#include "surface/catalogue.h"
#include "surface/surface_code.h"

namespace luxo {
namespace {

using Words = std::vector<std::uint32_t>;

using Caster = ExactSource::Caster;

/// GLSL of a surface, and of its pattern if it has one; whether rays may graze it; or what is found of it
/// where rays meet its cells.
struct Formulas {
  std::string surface, pattern;
  GlslNumber number;
  bool grazing;
  std::optional<Caster> caster = std::nullopt;
  bool parameters = false;  ///< which are told where points are lit later

  friend auto operator<=>(const Formulas&, const Formulas&) = default;
};

/// A shader of the light on a pattern.
struct PatternLight {
  std::string name, pattern;

  friend auto operator<=>(const PatternLight&, const PatternLight&) = default;
};

struct Wanted {
  std::set<Formulas> formulas;
  std::set<PatternLight> lights;
};

constexpr GlslNumber kNumbers[] = {GlslNumber::Float, GlslNumber::Double};

void addFormula(std::set<Formulas>& all, const SurfaceCode& code, const std::string& pattern,
                bool parameters = false) {
  for (const bool grazing : {false, true})
    all.insert({code.glsl, pattern, code.number, grazing, std::nullopt, parameters});
}

void addCaster(std::set<Formulas>& all, const Surface& surface, std::span<const double> parameters,
               Caster caster, const std::string& pattern = {}) {
  SurfaceCodes codes;
  all.insert({casterCode(codes, surface, parameters).code->glsl, pattern, GlslNumber::Float, true, caster});
}

void addSurface(std::set<Formulas>& all, const Surface& surface, std::span<const double> parameters,
                const std::string& pattern, bool tellsParameters = false) {
  for (const Caster caster : {Caster::Shadow, Caster::MeshPlace}) addCaster(all, surface, parameters, caster);
  const auto add = [&](const std::string& glsl, GlslNumber number) {
    all.insert({glsl, pattern, number, true, std::nullopt, tellsParameters});
  };
  const auto equations = equationsOf(surface, parameters);
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i)
    for (const GlslNumber number : kNumbers)
      if (equations[i])
        add(equationCode(equations[i]->form(), 0, number).glsl, number);
      else
        addFormula(all, surfaceCode(*surface.patches()[i].function, 0, number), pattern, tellsParameters);
  if (equations.size() == 1 && equations[0] && equations[0]->isPlane())
    add(planeCode(0).glsl, GlslNumber::Double);
}

/// What finds a named surface whatever its arguments.
void addGeneralForms(std::set<Formulas>& all, const Surface& surface) {
  for (const Caster caster : {Caster::Shadow, Caster::MeshPlace}) addCaster(all, surface, {}, caster);
  const auto equations = equationsOf(surface, {});
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i)
    if (const auto& general = surface.patches()[i].general; general && !equations[i])
      for (const GlslNumber number : kNumbers) addFormula(all, surfaceCode(*general, 0, number), {});
}

/// The structure of a superquadric's formula depends on which of its exponents are at most 1, and which 2.
void addSuperquadrics(std::set<Formulas>& all) {
  const auto exponents = {0.5, 1.5, 2.0};
  for (const char* name : {"superellipsoid", "supertoroid"})
    for (const double e : exponents)
      for (const double f : exponents) addGeneralForms(all, makeSurface(name, {{"exponents", {e, f}}}));
}

void addScene(Wanted& wanted, const Scene& scene) {
  std::set<Formulas>& all = wanted.formulas;
  const Snapshot snapshot = takeSnapshot(scene, 0, {64, 64});
  const auto materialOf = [&](const SnapshotNode& node) -> const Material& {
    return snapshot.materials[node.material.index];
  };
  const auto isSeenThrough = [&](const SnapshotNode& node) { return materialOf(node).transparent(); };
  const bool layers = std::ranges::any_of(snapshot.nodes, isSeenThrough),
             shadows = std::ranges::any_of(snapshot.lights, &SnapshotLight::hasShadow),
             patterns = std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode&node) {
               return materialOf(node).diffusePattern.valid();
             });
  for (const SnapshotNode& node : snapshot.nodes) {
    const bool through = isSeenThrough(node);
    const Pattern& pattern = materialOf(node).diffusePattern;
    const std::string text = pattern.valid() ? pattern.glsl() : "";
    if (through) addCaster(all, node.surface, node.parameters, Caster::Layer);
    if (layers && shadows) {
      if (through) addCaster(all, node.surface, node.parameters, Caster::Transmittance, text);
      for (const Caster caster : {Caster::LayerTransmittance, Caster::LayerShadow})
        if ((caster == Caster::LayerTransmittance) == through)
          addCaster(all, node.surface, node.parameters, caster, through ? text : "");
    }
    addSurface(all, node.surface, node.parameters, {});
    if (pattern.valid()) addSurface(all, node.surface, node.parameters, text);
    if (!layers && !shadows) continue;
    // Points are lit later.
    if (patterns && !through) addSurface(all, node.surface, node.parameters, {}, true);
    if (!pattern.valid()) continue;
    // Groups of lights without shadows light them, too.
    if (through) wanted.lights.insert({"pattern/shade_layers.frag", text});
    if (!through) wanted.lights.insert({"pattern/shade.frag", text});
    if (!through && shadows) wanted.lights.insert({"pattern/shade_in_shadows.frag", text});
  }
}

/// Of the named surfaces as they are without arguments and in general, and of these scene files.
Wanted builtIn(std::span<const char* const> scenes) {
  Wanted wanted;
  std::set<Formulas>& all = wanted.formulas;
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    addSurface(all, surface, {}, {});
    addGeneralForms(all, surface);
  }
  addSuperquadrics(all);
  all.insert({triangleCode().glsl, {}, GlslNumber::Float, true, Caster::Shadow});
  for (const char* scene : scenes) {
    std::ifstream file(scene);
    if (!file) throw Error(ErrorKind::Scene, fmt::format("cannot read {}", scene));
    addScene(wanted, buildScene(readScene(file, scene)));
  }
  return wanted;
}

void validate(const Words& words) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  std::string messages;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    messages += fmt::format("\n{}", message);
  });
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  if (!tools.Validate(words.data(), words.size(), options))
    throw Error(ErrorKind::Internal, fmt::format("a shader is not valid:{}", messages));
}

Words compile(const Formulas& formulas) {
  const SurfaceCode surface{.glsl = formulas.surface, .number = formulas.number};
  const ExactSource source =
      formulas.caster ? ExactSource::of(*formulas.caster, surface, formulas.pattern)
                      : ExactSource(surface, formulas.pattern, formulas.grazing, formulas.parameters);
  Words words = gpu::ShaderCompiler(std::filesystem::path()).compile(source.desc()).spirv;
  validate(words);
  return words;
}

Words compile(const PatternLight& light) {
  std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
  sources.push_back({"pattern", light.pattern});
  const auto source = std::ranges::find(kShaderSources, light.name, &gpu::ShaderSource::name);
  Words words =
      gpu::ShaderCompiler(std::filesystem::path()).compile({.source = *source, .includes = sources}).spirv;
  validate(words);
  return words;
}

/// On all cores: most of it is the optimiser's work.
template <class Shader>
std::vector<Words> compileAll(const std::vector<Shader>& all) {
  std::vector<Words> shaders(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) { shaders[i] = compile(all[i]); });
  return shaders;
}

/// With its size: compilers count the characters of so many texts only so far.
std::string literal(const std::string& text) {
  return fmt::format("{{R\"luxo({})luxo\", {}}}", text, text.size());
}

/// As table.h says.
std::string literal(const Words& words) {
  std::string text = "U\"";
  for (const std::uint32_t word : words) text += fmt::format("\\x{:x}", word);
  return fmt::format("{{{}\", {}}}", text, words.size());
}

std::string table(std::span<const char* const> scenes) {
  const Wanted wanted = builtIn(scenes);
  const std::vector<Formulas> all(wanted.formulas.begin(), wanted.formulas.end());
  const std::vector<PatternLight> lights(wanted.lights.begin(), wanted.lights.end());
  const std::vector<Words> shaders = compileAll(all), lightShaders = compileAll(lights);
  std::string entries, lightEntries;
  for (std::size_t index = 0; index < all.size(); ++index) {
    const Formulas& formulas = all[index];
    entries += fmt::format("    {{{}, {}, {}, {}, {}, {}, {}}},\n", literal(formulas.surface),
                           literal(formulas.pattern), formulas.number == GlslNumber::Double, formulas.grazing,
                           formulas.caster ? static_cast<int>(*formulas.caster) : -1, formulas.parameters,
                           literal(shaders[index]));
  }
  for (std::size_t index = 0; index < lights.size(); ++index)
    lightEntries += fmt::format("    PatternShader{{{}, {}, {}}},\n", literal(lights[index].name),
                                literal(lights[index].pattern), literal(lightShaders[index]));
  return fmt::format(
      "#pragma once\n#include <array>\n#include \"exact/table.h\"\n\nnamespace luxo {{\n\n"
      "inline constexpr ExactShader kExactShaders[] = {{\n{}}};\n\n"
      "inline constexpr std::array<PatternShader, {}> kPatternShaders = {{{{\n{}}}}};\n\n"
      "}}  // namespace luxo\n",
      entries, lights.size(), lightEntries);
}

}  // namespace
}  // namespace luxo

int main(int count, char** arguments) {
  try {
    const std::span<const char* const> words(arguments, static_cast<std::size_t>(count));
    if (count < 2) throw luxo::Error(luxo::ErrorKind::Usage, "give the header to write");
    const std::string header = luxo::table(words.subspan(2));
    std::ofstream file(arguments[1]);
    if (!(file << header).flush())
      throw luxo::Error(luxo::ErrorKind::Write, fmt::format("cannot write {}", arguments[1]));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "luxo_exact_shaders: {}\n", error.what());
    return 1;
  }
}
