// SPDX-License-Identifier: Apache-2.0
#include "draw/place_list.h"

#include <algorithm>

#include "draw/caster_list.h"
#include "math/transform.h"

namespace luxo {
namespace {

/// Whether there is room for the parts of a node, and a shader for each.
bool fits(const Casters& casters, const std::vector<CasterPart>& parts) {
  std::size_t patches = 0, parameters = 0;
  for (const CasterPart& part : parts) {
    if (part.code->isTooLarge()) return false;
    patches += part.patches.size();
    for (const std::vector<double>& own : part.parameters) parameters += own.size();
  }
  return (casters.cells.size() + patches) * sizeof(shared::CasterCell) <= kMaxCasterBytes &&
         (casters.parameters.size() + parameters) * sizeof(float) <= kMaxCasterBytes;
}

/// Their domains, and their parameters.
void addPatches(const Surface& surface, const CasterPart& part, Casters& casters) {
  for (std::size_t i = 0; i < part.patches.size(); ++i) {
    const Patch& patch = surface.patches()[part.patches[i]];
    const double hu = 0.5 * patch.domain.u.width(), hv = 0.5 * patch.domain.v.width();
    const double originOfU = patch.general ? 0 : patch.originOfU();
    casters.cells.push_back({.middle = Vec2f(patch.domain.u.lo - originOfU + hu, patch.domain.v.lo + hv),
                             .half_ = Vec2f(hu, hv),
                             .patch_ = static_cast<std::uint32_t>(i),
                             .originOfU = static_cast<float>(originOfU)});
    casters.parameters.insert(casters.parameters.end(), part.parameters[i].begin(), part.parameters[i].end());
  }
}

}  // namespace

bool isOnlyNear(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  const Shading shading = snapshot.materials[node.material.index].shadingIn(options.shading);
  const bool isLit = shading == Shading::Flat || shading == Shading::Gouraud || shading == Shading::Phong ||
                     shading == Shading::Toon;
  return isLit && !node.surface.triangles() && !node.surface.flatNormal();
}

void listPlaces(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                Geometry& geometry, const MaterialList& materials, DrawList& list) {
  if (!list.findsPlaces) return;
  const CasterList pixels(snapshot, geometry, list);
  const View& view = snapshot.view;
  Casters& casters = list.casters;
  for (const VisibleNode& v : visible.opaque) {
    const SnapshotNode& node = snapshot.nodes[v.node];
    const std::uint32_t material = materials.numberOfNode(v.node);
    if (!isOnlyNear(snapshot, node, options) || material == shared::kMaxFoundMaterials) continue;
    const std::vector<CasterPart> parts = casterParts(geometry.codes, node);
    if (!fits(casters, parts)) continue;
    list.placed.push_back({v.node, material});
    const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
    const auto area = isFinite(node.boundsWorld) ? pixels.pixelsAround(cornersOf(node.boundsWorld)) : all;
    if (!area) continue;
    for (const CasterPart& part : parts) {
      list.places.push_back({.state = {.form = Form::MeshPlace, .surface = part.code},
                             .caster = static_cast<std::uint32_t>(casters.meshes.size()),
                             .area = *area});
      casters.meshes.push_back({.relativeFromObject = Mat3f(node.worldFromObject.linear),
                                .translation = Vec3f(node.worldFromObject.translation - list.origin),
                                .firstPatch = static_cast<std::uint32_t>(casters.cells.size()),
                                .patches = static_cast<std::uint32_t>(part.patches.size()),
                                .firstParameter = static_cast<std::uint32_t>(casters.parameters.size()),
                                .parameters = static_cast<std::uint32_t>(part.parameters[0].size()),
                                .material = material});
      addPatches(node.surface, part, casters);
    }
  }
  std::ranges::sort(list.placed, {}, &PlacedNode::node);
}

}  // namespace luxo
