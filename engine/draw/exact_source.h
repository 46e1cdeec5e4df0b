// SPDX-License-Identifier: Apache-2.0
// What the fragment shader that finds a surface is compiled from, when luxo is built (shaders/exact/emit.cpp)
// and when a scene has a formula of its own.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/shader_compiler.h"
#include "luxo/shaders/sources.h"
#include "surface/surface_code.h"

namespace luxo {

/// Refers to the texts it is given.
class ExactSource {
 public:
  /// `pattern` is the pattern's GLSL, if there is one; not `grazing`: no ray may graze the surface;
  /// `parameters`: where points are lit later, their parameters are told, too.
  ExactSource(const SurfaceCode& surface, std::string_view pattern, bool grazing, bool parameters = false)
      : name_(pattern.empty() ? "exact/surface.frag" : "exact/pattern.frag"),
        includes_(std::begin(kShaderSources), std::end(kShaderSources)) {
    includes_.push_back({"surface", surface.glsl});
    includes_.push_back({"pattern", pattern});
    if (surface.number == GlslNumber::Double) preamble_ += "#define LUXO_DOUBLE\n";
    if (!grazing) preamble_ += "#define LUXO_TRANSVERSAL\n";
    if (parameters) preamble_ += "#define LUXO_FINDS_PARAMETERS\n";
  }

  /// What a shader finds of a surface, whose formula this is, that rays meet in its cells (lib/caster.glsl):
  /// whether it keeps a light from what is seen, or how much of the light it lets through; the same of what
  /// is seen through; or all that is seen of it where it is seen through; or which of its points a mesh
  /// shows, or one that is seen through.
  enum class Caster { Shadow, Transmittance, LayerShadow, LayerTransmittance, Layer, MeshPlace, LayerPlace };
  /// `pattern`: of one that lets light through.
  [[nodiscard]] static ExactSource of(Caster caster, const SurfaceCode& surface,
                                      std::string_view pattern = {}) {
    constexpr std::string_view kNames[] = {"exact/shadow.frag",       "exact/transmittance.frag",
                                           "exact/layer_shadow.frag", "exact/layer_transmittance.frag",
                                           "exact/layer.frag",        "exact/mesh_place.frag",
                                           "exact/layer_place.frag"};
    ExactSource source(surface, pattern, true);
    source.name_ = kNames[static_cast<std::size_t>(caster)];
    if (!pattern.empty()) source.preamble_ += "#define LUXO_PATTERN\n";
    return source;
  }

  /// Lines that are read before all.
  void add(std::string_view lines) { preamble_ += lines; }

  /// Texts that it may include, too.
  void add(const std::vector<gpu::ShaderSource>& sources) {
    includes_.insert(includes_.end(), sources.begin(), sources.end());
  }

  /// Valid as long as this object.
  [[nodiscard]] gpu::ShaderDesc desc() const {
    return {.source = *std::ranges::find(kShaderSources, name_, &gpu::ShaderSource::name),
            .includes = includes_,
            .preamble = preamble_,
            .sharedFunction = "surfaceAt"};
  }

 private:
  std::string_view name_;
  std::string preamble_;
  std::vector<gpu::ShaderSource> includes_;
};

}  // namespace luxo
