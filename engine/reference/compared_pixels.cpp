// SPDX-License-Identifier: Apache-2.0
#include "reference/compared_pixels.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace luxo::reference {

ComparedPixels::ComparedPixels(const Snapshot& snapshot, const ReferencePicture& truth,
                               const MeasuredPicture& measured, const VerificationOptions& options)
    : snapshot_(snapshot),
      truth_(truth),
      measured_(measured),
      options_(options),
      size_(snapshot.view.size),
      layers_(snapshot),
      hasLayers_(std::ranges::any_of(
          snapshot.nodes,
          [&](const SnapshotNode& node) { return snapshot.materials[node.material.index].transparent(); })),
      hasShadows_(std::ranges::any_of(snapshot.lights,
                                      [](const SnapshotLight& light) { return light.hasShadow(); })) {}

Vec3 ComparedPixels::valueAt(const Image& image, std::uint32_t i) {
  const std::size_t channels = static_cast<std::size_t>(image.channels());
  const std::span<const float> samples = image.samples().subspan(i * channels, channels);
  return channels == 1 ? Vec3(samples[0], 0, 0) : Vec3(samples[0], samples[1], samples[2]);
}

Vec2 ComparedPixels::centerOf(std::uint32_t i) const {
  const auto width = static_cast<std::uint32_t>(size_.width);
  return Vec2(i % width + 0.5, static_cast<double>(i / width) + 0.5) + snapshot_.view.sampleOffsetPx;
}

bool ComparedPixels::isMesh(std::uint32_t i) const {
  const auto node = layers_.nodeOf(truth_.number[i]);
  return node && shadingOf(*node) != Shading::Exact &&
         !(surfaceOf(*node).isPolygonal() && shadingOf(*node) == Shading::Phong);
}

bool ComparedPixels::showsTexture(std::uint32_t i) const {
  const auto node = layers_.nodeOf(truth_.number[i]);
  if (!node) return false;
  const Material& material = materialOf(*node);
  return material.readsFootprint() && !material.shader && shadingOf(*node) == Shading::Exact;
}

bool ComparedPixels::showsPlainColor(std::uint32_t i) const {
  const auto node = layers_.nodeOf(truth_.number[i]);
  if (!options_.colors || !node || isMesh(i)) return false;
  const Material& material = materialOf(*node);
  return !material.shader && !material.diffusePattern.valid() && !material.isolines.valid() &&
         !material.readsFootprint();
}

std::optional<Place> ComparedPixels::shownAt(std::uint32_t i, std::uint32_t node) const {
  return surfaceOf(node).isParametric()
             ? layers_.at(node, parametersAt(i), truth_.position[i])
             : layers_.onTriangle(node, parametersAt(i), valueAt(measured_.position, i));
}

Place ComparedPixels::seenAt(std::uint32_t i) const {
  const std::uint32_t node = *layers_.nodeOf(truth_.number[i]);
  const Vec2 parameters = truth_.parameters[i];
  return {node, snapshot_.nodes[node].surface.patchAt(parameters.x, parameters.y), parameters,
          truth_.position[i], centerOf(i)};
}

bool ComparedPixels::seesLayerOf(std::uint32_t i, const Hit* first, const Vec2& at) const {
  if (!first) return false;
  const std::uint32_t patch = snapshot_.nodes[first->node].surface.patchAt(first->u, first->v);
  return layers_.same(seenAt(i), {first->node, patch, {first->u, first->v}, first->position, at},
                      first->facet, at);
}

}  // namespace luxo::reference
