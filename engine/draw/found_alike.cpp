// SPDX-License-Identifier: Apache-2.0
#include "draw/found_alike.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <vector>

namespace luxo {
namespace {

/// Bit by bit. Bytes between members may differ without a reason: then no.
template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class T>
bool sameBytes(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool same(const DrawBatch& a, const DrawBatch& b) {
  const auto members = [](const DrawBatch& batch) {
    return std::tie(batch.state, batch.again, batch.mesh, batch.shell, batch.firstIndex, batch.indexCount,
                    batch.someClusters, batch.culling, batch.half, batch.shared, batch.flat, batch.twoSided,
                    batch.bothSides, batch.frontOnly, batch.mirrored, batch.lightSet, batch.firstInstance,
                    batch.instanceCount);
  };
  return members(a) == members(b);
}

bool same(const FoundNode& a, const FoundNode& b) {
  return a.node == b.node && a.lightSet == b.lightSet && a.state == b.state &&
         sameBytes(a.instance, b.instance);
}

bool same(const CasterDraw& a, const CasterDraw& b) {
  return a.state == b.state && a.caster == b.caster && a.area == b.area;
}

bool same(const FlatShadowDraw& a, const FlatShadowDraw& b) {
  return a.state == b.state && a.mesh == b.mesh && sameBytes(a.shadow, b.shadow) &&
         sameBytes(a.caster, b.caster);
}

bool same(const LightMapDrawn::Caster& a, const LightMapDrawn::Caster& b) {
  return a.mesh == b.mesh && sameBytes(a.clipFromObject, b.clipFromObject);
}

bool same(const PlacedNode& a, const PlacedNode& b) { return a.node == b.node && a.material == b.material; }

bool same(const FoundLayer& a, const FoundLayer& b) { return a.node == b.node && a.material == b.material; }

bool same(const LightGroup& a, const LightGroup& b);

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, [](const T& x, const T& y) { return same(x, y); });
}

bool same(const std::optional<LightMapDrawn>& a, const std::optional<LightMapDrawn>& b) {
  return a.has_value() == b.has_value() &&
         (!a || (sameBytes(a->map, b->map) && same(a->casters, b->casters)));
}

/// Which lights they are of, and what finds their shadows.
bool same(const LightGroup& a, const LightGroup& b) {
  return a.lightSet == b.lightSet && a.transmits == b.transmits && a.plainLights == b.plainLights &&
         a.shadedLights == b.shadedLights && a.spots == b.spots && a.lights == b.lights &&
         same(a.shadows, b.shadows) && same(a.flatShadows, b.flatShadows) && same(a.map, b.map) &&
         same(a.transmittances, b.transmittances) && same(a.flatTransmittances, b.flatTransmittances) &&
         same(a.layerShadows, b.layerShadows) && same(a.layerTransmittances, b.layerTransmittances);
}

/// What is seen through, and how it is blended.
bool same(const Layers& a, const Layers& b) {
  return same(a.searches, b.searches) && same(a.meshes, b.meshes) && same(a.places, b.places) &&
         a.placed == b.placed && same(a.found, b.found) && a.blend == b.blend && a.details == b.details;
}

bool same(const Casters& a, const Casters& b) {
  return sameBytes(a.closed, b.closed) && sameBytes(a.meshes, b.meshes) && sameBytes(a.casters, b.casters) &&
         a.gridStarts == b.gridStarts && sameBytes(a.gridEntries, b.gridEntries) &&
         sameBytes(a.cells, b.cells) && sameBytes(a.parameters, b.parameters);
}

/// What finds points asks of a material whether it lets something through, and where it ends.
bool findAlike(const shared::MaterialData& a, const shared::MaterialData& b) {
  return a.flags == b.flags && a.blend == b.blend && a.opacity == b.opacity &&
         a.leastOpaque == b.leastOpaque &&
         (a.pattern == shared::kDrawnAgain) == (b.pattern == shared::kDrawnAgain);
}

/// Whether both let the same of a light through: their opacity says how much, in mode Multiply the colour,
/// too; a map may say either.
bool letThroughAlike(const Material& a, const Material& b) {
  if (!a.letsLightThrough() && !b.letsLightThrough()) return true;
  if (a.blend == Blend::Multiply || a.mapOpacity || b.mapOpacity) return a == b;
  const auto opacities = [](const Material& material) {
    const bool varies = material.diffusePattern.hasOpacity();
    return std::tuple(material.opacity, material.blend, varies ? material.diffusePattern : Pattern(),
                      varies ? material.patternParameters : std::vector<double>());
  };
  return opacities(a) == opacities(b);
}

/// What is not about the light that a point reflects, or goes with points that are asked for it.
bool findAlike(const Material& a, const Material& b) {
  const auto facts = [](const Material& material) {
    return std::tuple(material.transparent(), material.letsLightThrough(), material.invisible(),
                      material.twoSided, material.shading, material.mapOpacity, material.cutoff,
                      material.lightsBelowHorizon(), material.readsFootprint(), material.drawsMaps(),
                      Paint::of(material).readsFrame(), material.shader != nullptr);
  };
  return facts(a) == facts(b) && letThroughAlike(a, b);
}

}  // namespace

bool keepsWhatItFinds(const DrawList& list) {
  const auto isFused = [](const auto& draw) { return draw.state.form == Form::Fused; };
  const bool drawsOver = !list.transparent.empty() || std::ranges::any_of(list.opaque, isFused) ||
                         std::ranges::any_of(list.found, isFused);
  const auto readsPattern = [](const auto& draw) { return draw.state.pattern.valid(); };
  const bool readsPatterns = std::ranges::any_of(list.opaque, readsPattern) ||
                             std::ranges::any_of(list.layers.meshes, readsPattern) ||
                             std::ranges::any_of(list.layers.searches, readsPattern);
  const bool keepsLayers = !list.layers.any() || (list.keepsShadows() && !list.hasLightMaps());
  return list.deferred && !drawsOver && !readsPatterns && !list.traces && keepsLayers &&
         (list.keepsShadows() || !list.findsShadows());
}

bool findsAlike(const Snapshot& last, const Snapshot& next) {
  return last.view == next.view && last.nodes == next.nodes && last.lights == next.lights &&
         last.blendOrder == next.blendOrder && last.ambientOcclusion == next.ambientOcclusion &&
         std::ranges::equal(last.materials, next.materials,
                            [](const Material& a, const Material& b) { return findAlike(a, b); });
}

bool findsAlike(const DrawList& last, const DrawList& next) {
  const auto facts = [](const DrawList& list) {
    return std::tie(list.origin, list.instanceNodes, list.shellIndices, list.clusterIndices, list.byRays,
                    list.shadowsByRays, list.outlines, list.tooLarge, list.findsParameters,
                    list.findsFootprints, list.findsFrames, list.occludes, list.runsShaders, list.findsPlaces,
                    list.boundPx);
  };
  return facts(last) == facts(next) && sameBytes(last.view, next.view) &&
         sameBytes(last.instances, next.instances) && sameBytes(last.exactInstances, next.exactInstances) &&
         sameBytes(last.exactPatches, next.exactPatches) &&
         sameBytes(last.exactParameters, next.exactParameters) && sameBytes(last.lightSets, next.lightSets) &&
         same(last.opaque, next.opaque) && same(last.found, next.found) && same(last.places, next.places) &&
         same(last.placed, next.placed) && same(last.groups, next.groups) &&
         same(last.casters, next.casters) && same(last.layers, next.layers) &&
         std::ranges::equal(
             last.materials, next.materials,
             [](const shared::MaterialData& a, const shared::MaterialData& b) { return findAlike(a, b); });
}

}  // namespace luxo
