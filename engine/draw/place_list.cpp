// SPDX-License-Identifier: Apache-2.0
#include "draw/place_list.h"

#include <algorithm>

#include "draw/caster_list.h"
#include "math/transform.h"

namespace luxo {
namespace {

/// Whether there is room for the patches of a node, and a shader.
bool fits(const Casters& casters, const CasterCode& found) {
  const std::size_t patches = found.parameters.size();
  return !found.code->isTooLarge() &&
         (casters.cells.size() + patches) * sizeof(shared::CasterCell) <= kMaxCasterBytes &&
         (casters.parameters.size() + patches * found.parameters[0].size()) * sizeof(float) <=
             kMaxCasterBytes;
}

/// Their domains, and their parameters.
void addPatches(const Surface& surface, const CasterCode& found, Casters& casters) {
  for (std::size_t i = 0; i < surface.patchCount(); ++i) {
    const Patch& patch = surface.patches()[i];
    const double hu = 0.5 * patch.domain.u.width(), hv = 0.5 * patch.domain.v.width();
    const double originOfU = patch.general ? 0 : patch.originOfU();
    casters.cells.push_back({.middle = Vec2f(patch.domain.u.lo - originOfU + hu, patch.domain.v.lo + hv),
                             .half_ = Vec2f(hu, hv),
                             .patch_ = static_cast<std::uint32_t>(i),
                             .originOfU = static_cast<float>(originOfU)});
    casters.parameters.insert(casters.parameters.end(), found.parameters[i].begin(),
                              found.parameters[i].end());
  }
}

}  // namespace

bool isLitMesh(Shading shading) {
  return shading == Shading::Flat || shading == Shading::Gouraud || shading == Shading::Phong ||
         shading == Shading::Toon;
}

bool isOnlyNear(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options) {
  const Shading shading = snapshot.materials[node.material.index].shadingIn(options.shading);
  return isLitMesh(shading) && !node.surface.liesOnItsMesh();
}

void listPlaces(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                Geometry& geometry, const MaterialList& materials, DrawList& list) {
  if (!materials.shadows()) return;
  const CasterList pixels(snapshot, geometry, list);
  const View& view = snapshot.view;
  Casters& casters = list.casters;
  const auto add = [&](const VisibleNode& v, Form form, std::vector<CasterDraw>& draws) {
    const SnapshotNode& node = snapshot.nodes[v.node];
    const std::uint32_t material = materials.numberOfNode(v.node);
    if (!isOnlyNear(snapshot, node, options) || material == shared::kMaxFoundMaterials) return;
    const CasterCode found = casterCode(geometry.codes, node.surface, node.parameters);
    if (!fits(casters, found)) return;
    if (form == Form::MeshPlace)
      list.placed.push_back({v.node, material});
    else
      list.layers.placed.push_back(v.node);
    const PixelRect all{{0, 0}, {view.size.width, view.size.height}};
    const auto area = isFinite(node.boundsWorld) ? pixels.pixelsAround(cornersOf(node.boundsWorld)) : all;
    if (!area) return;
    draws.push_back({.state = {.form = form, .surface = found.code},
                     .caster = static_cast<std::uint32_t>(casters.meshes.size()),
                     .area = *area});
    casters.meshes.push_back({.relativeFromObject = Mat3f(node.worldFromObject.linear),
                              .translation = Vec3f(node.worldFromObject.translation - list.origin),
                              .firstPatch = static_cast<std::uint32_t>(casters.cells.size()),
                              .patches = node.surface.patchCount(),
                              .firstParameter = static_cast<std::uint32_t>(casters.parameters.size()),
                              .parameters = static_cast<std::uint32_t>(found.parameters[0].size()),
                              .material = material});
    addPatches(node.surface, found, casters);
  };
  for (const VisibleNode& v : visible.opaque)
    if (list.findsPlaces) add(v, Form::MeshPlace, list.places);
  for (const VisibleNode& v : visible.transparent)
    if (list.layers.any()) add(v, Form::LayerPlace, list.layers.places);
  std::ranges::sort(list.placed, {}, &PlacedNode::node);
  std::ranges::sort(list.layers.placed);
}

}  // namespace luxo
