// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_cache.h"

#include <optional>
#include <utility>

#include "tessellate/mesh_cache.h"

namespace luxo {
namespace {

std::size_t bytesOf(const Shell& shell) {
  const ShellOccluder& occluder = shell.occluder;
  std::size_t bytes =
      bytesIn(shell.positions, shell.parameters, shell.cells, shell.changes, shell.patches, shell.indices,
              shell.cones, occluder.positions, occluder.slabOf, occluder.triangles);
  for (const ShellOccluder::Slab& slab : occluder.slabs)
    bytes += bytesIn(slab.tops, slab.walls, slab.bottoms);
  return bytes;
}

/// Few: what moves past a camera has one margin mostly.
double marginLevel(double margin) {
  double level = kLeastMargin;
  while (level < margin) level *= 4;
  return level;
}

}  // namespace

bool ShellCache::isInterrupted() {
  interrupted_ = interrupted_ || (interruption_ && interruption_());
  return interrupted_;
}

std::shared_ptr<const Shell> ShellCache::get(const Surface& surface, std::span<const double> parameters,
                                             double tolerance, const Vec3& margin, double mostTriangles) {
  Key key{.shape = {surface, parameters}, .tolerance = toleranceLevel(tolerance)};
  for (int axis = 0; axis < 3; ++axis) key.margin[axis] = marginLevel(margin[axis] / key.tolerance);
  // One answer, whether it is made now or was before: makeShell() counts before there are walls.
  const auto unlessTooLarge = [&](std::shared_ptr<const Shell> shell) {
    return static_cast<double>(shell->triangleCount()) > mostTriangles ? nullptr : shell;
  };
  if (auto shell = shells_.find(key)) return unlessTooLarge(std::move(shell));
  Known& known = known_.get(surface, parameters, [&] {
    return Known{CurvatureMap(surface, parameters), {}};
  });
  double& least = known.leastTriangles[key.tolerance];
  if (least >= mostTriangles) return nullptr;
  std::optional<Shell> shell = makeShell(surface, parameters, known.map,
                                         {.tolerance = key.tolerance,
                                          .margin = {key.margin[0], key.margin[1], key.margin[2]},
                                          .mostTriangles = mostTriangles,
                                          .interrupted = [this] { return isInterrupted(); }});
  if (!shell && interrupted_) return nullptr;
  if (!shell) {
    least = mostTriangles;
    return nullptr;
  }
  const std::size_t bytes = bytesOf(*shell);
  return unlessTooLarge(shells_.insert(std::move(key), surface, std::move(*shell), bytes));
}

}  // namespace luxo
