// SPDX-License-Identifier: Apache-2.0
// Runs when luxo is built: the exact fragment shaders of the named surfaces, and of the surfaces and patterns
// of some scenes, made from their formulas, as a C++ table.
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

  friend auto operator<=>(const Formulas&, const Formulas&) = default;
};

constexpr GlslNumber kNumbers[] = {GlslNumber::Float, GlslNumber::Double};

void addFormula(std::set<Formulas>& all, const SurfaceCode& code, const std::string& pattern) {
  for (const bool grazing : {false, true}) all.insert({code.glsl, pattern, code.number, grazing});
}

/// By its general form, where it has one.
void addCaster(std::set<Formulas>& all, const Surface& surface, Caster caster,
               const std::string& pattern = {}) {
  for (const Patch& patch : surface.patches()) {
    const SurfaceCode code = patch.general ? surfaceCode(*patch.general, 0) : surfaceCode(*patch.function, 0);
    all.insert({code.glsl, pattern, GlslNumber::Float, true, caster});
  }
}

void addSurface(std::set<Formulas>& all, const Surface& surface, std::span<const double> parameters,
                const std::string& pattern) {
  addCaster(all, surface, Caster::Shadow);
  const auto equations = equationsOf(surface, parameters);
  for (std::uint32_t i = 0; i < surface.patchCount(); ++i)
    for (const GlslNumber number : kNumbers)
      if (equations[i])
        all.insert({equationCode(equations[i]->form(), 0, number).glsl, pattern, number, true});
      else
        addFormula(all, surfaceCode(*surface.patches()[i].function, 0, number), pattern);
  if (equations.size() == 1 && equations[0] && equations[0]->isPlane())
    all.insert({planeCode(0).glsl, pattern, GlslNumber::Double, true});
}

/// What finds a named surface whatever its arguments.
void addGeneralForms(std::set<Formulas>& all, const Surface& surface) {
  addCaster(all, surface, Caster::Shadow);
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

void addScene(std::set<Formulas>& all, const Scene& scene) {
  const Snapshot snapshot = takeSnapshot(scene, 0, {64, 64});
  const auto isSeenThrough = [&](const SnapshotNode& node) {
    return snapshot.materials[node.material.index].transparent();
  };
  const bool layers = std::ranges::any_of(snapshot.nodes, isSeenThrough),
             shadows = std::ranges::any_of(snapshot.lights, &SnapshotLight::hasShadow);
  for (const SnapshotNode& node : snapshot.nodes) {
    const Material& material = snapshot.materials[node.material.index];
    if (isSeenThrough(node)) addCaster(all, node.surface, Caster::Layer);
    if (layers && shadows) {
      const bool through = isSeenThrough(node);
      const std::string pattern =
          through && material.diffusePattern.valid() ? material.diffusePattern.glsl() : "";
      if (through) addCaster(all, node.surface, Caster::Transmittance, pattern);
      addCaster(all, node.surface, through ? Caster::LayerTransmittance : Caster::LayerShadow, pattern);
    }
    addSurface(all, node.surface, node.parameters, {});
    const Pattern& pattern = snapshot.materials[node.material.index].diffusePattern;
    if (pattern.valid()) addSurface(all, node.surface, node.parameters, pattern.glsl());
  }
}

/// Of the named surfaces as they are without arguments and in general, and of these scene files.
std::set<Formulas> builtInFormulas(std::span<const char* const> scenes) {
  std::set<Formulas> all;
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    addSurface(all, surface, {}, {});
    addGeneralForms(all, surface);
  }
  addSuperquadrics(all);
  for (const char* scene : scenes) {
    std::ifstream file(scene);
    if (!file) throw Error(ErrorKind::Scene, fmt::format("cannot read {}", scene));
    addScene(all, buildScene(readScene(file, scene)));
  }
  return all;
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
  const ExactSource source = formulas.caster ? ExactSource::of(*formulas.caster, surface, formulas.pattern)
                                             : ExactSource(surface, formulas.pattern, formulas.grazing);
  Words words = gpu::ShaderCompiler(std::filesystem::path()).compile(source.desc()).spirv;
  validate(words);
  return words;
}

/// On all cores: most of it is the optimiser's work.
std::vector<Words> compile(const std::vector<Formulas>& all) {
  std::vector<Words> shaders(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) { shaders[i] = compile(all[i]); });
  return shaders;
}

/// With its size: compilers count the characters of so many texts only so far.
std::string literal(const std::string& text) {
  return fmt::format("{{R\"luxo({})luxo\", {}}}", text, text.size());
}

std::string table(std::span<const char* const> scenes) {
  const std::set<Formulas> known = builtInFormulas(scenes);
  const std::vector<Formulas> all(known.begin(), known.end());
  const std::vector<Words> shaders = compile(all);
  std::string arrays, entries;
  for (std::size_t index = 0; index < all.size(); ++index) {
    const Formulas& formulas = all[index];
    const Words& words = shaders[index];
    arrays += fmt::format("inline constexpr std::uint32_t kExactShader{}[] = {{\n", index);
    for (std::size_t i = 0; i < words.size(); ++i)
      arrays += fmt::format("{},{}", words[i], i % 16 == 15 ? "\n" : "");
    arrays += "};\n";
    entries += fmt::format("    {{{}, {}, {}, {}, {}, kExactShader{}}},\n", literal(formulas.surface),
                           literal(formulas.pattern), formulas.number == GlslNumber::Double, formulas.grazing,
                           formulas.caster ? static_cast<int>(*formulas.caster) : -1, index);
  }
  return fmt::format(
      "#pragma once\n#include <cstdint>\n#include <span>\n#include <string_view>\n\nnamespace luxo {{\n\n{}\n"
      "struct ExactShader {{\n  std::string_view surface, pattern;\n  bool inDouble, grazing;\n  int "
      "caster;\n  "
      "std::span<const "
      "std::uint32_t> "
      "spirv;\n}};\n\n"
      "/// By formulas.\ninline constexpr ExactShader kExactShaders[] = {{\n{}}};\n\n}}  // namespace "
      "luxo\n",
      arrays, entries);
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
