// SPDX-License-Identifier: Apache-2.0
#include "surface/scaled.h"

#include <map>
#include <memory>
#include <utility>

namespace luxo {
namespace {

std::shared_ptr<const SurfaceFunction> scaled(const SurfaceFunction& function, const Vec3& scale) {
  Graph graph;
  const std::vector<Expr> p = function.position.expressions(graph);
  return compileSurface(graph, {p[0] * scale.x, p[1] * scale.y, p[2] * scale.z}, {}, function.originOfU);
}

}  // namespace

Surface scaled(const Surface& surface, const Vec3& scale) {
  std::map<const SurfaceFunction*, std::shared_ptr<const SurfaceFunction>> functions;
  std::vector<Patch> patches = surface.patches();
  for (Patch& patch : patches) {
    auto& function = functions[patch.function.get()];
    if (!function) function = scaled(*patch.function, scale);
    patch.function = function;
    patch.general.reset();
  }
  SurfaceTraits traits{.name = surface.name(),
                       .orientation = surface.topology().orientation(),
                       .borders = surface.statedBorders()};
  // Normals are scaled by the inverse.
  if (const auto normal = surface.flatNormal()) traits.flatNormal = unit(*normal / scale);
  const std::vector<double>& initial = surface.initialParameters();
  return Surface(std::move(patches), {initial.begin(), initial.end()}, std::move(traits));
}

}  // namespace luxo
