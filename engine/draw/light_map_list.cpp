// SPDX-License-Identifier: Apache-2.0
#include "draw/light_map_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "math/transform.h"
#include "scene/light_view.h"

namespace luxo {
namespace {

/// Texels along a side of all faces of a depth map together: what CPU devices, and most others, have at most.
constexpr std::uint32_t kMaxMapSide = 16384;

Box finiteBoundsOf(const SnapshotNode& node) {
  return isFinite(node.boundsWorld)
             ? node.boundsWorld
             : transformBounds(node.worldFromObject, node.surface.framing(node.parameters));
}

shared::LightMap settingsOf(const SnapshotLight& light, const Vec3& origin) {
  const ShadowMapThen& map = *light.map;
  const Vec4& at = light.positionWorld;
  return {.light = Vec4f(Vec4(Vec3(at) - at.w * origin, at.w)),
          .size = map.size,
          .bias = static_cast<float>(map.bias),
          .slopeBias = static_cast<float>(map.slopeBias),
          .normalOffset = static_cast<float>(map.normalOffset),
          .pcf = map.pcf,
          .receiverPlane = map.receiverPlane,
          .radius = static_cast<float>(map.radius)};
}

/// Its mesh is as near to it as half a texel.
std::shared_ptr<const Mesh> meshOf(const SnapshotNode& node, const SnapshotLight& light, const View& view,
                                   MeshCache& meshes) {
  const Box box = finiteBoundsOf(node);
  const Vec3 at(light.positionWorld);
  const double away = glm::distance(at, glm::clamp(at, box.min, box.max)),
               distance = light.directional() ? 1 : std::max(away, view.near),
               size = glm::length(box.extent()),
               tolerance = std::clamp(0.5 * distance / view.pixelsPerUnit, 1e-4 * size, 1e-2 * size);
  return meshes.get(
      node.surface, node.parameters,
      {.uniform = node.segments, .tolerance = tolerance / largestStretch(node.worldFromObject.linear)});
}

Mat4f clipFromMesh(const View& view, const SnapshotNode& node, const Vec3& origin) {
  const Transform placed = eyeFromObject(view, node.worldFromObject);
  Mat4 eyeFromMesh(placed.linear);
  eyeFromMesh[3] = Vec4(transformPoint(placed, origin), 1);
  return Mat4f(view.clipFromEye * eyeFromMesh);
}

}  // namespace

std::optional<LightMapDrawn> listLightMap(const SnapshotLight& light,
                                          std::span<const SnapshotNode* const> casters, const Box& receivers,
                                          const Vec3& origin, MeshCache& meshes) {
  Box box;
  for (const SnapshotNode* node : casters) box.add(finiteBoundsOf(*node));
  if (box.empty() || !isFinite(box) || receivers.empty()) return std::nullopt;
  const int size = static_cast<int>(light.map->size);
  const Box before = isFinite(receivers) ? receivers : box;
  const SnapshotLight asSeen = asMapped(light, box, before, size);
  const std::vector<View> views = lightViews(asSeen, box, before, size);
  LightMapDrawn drawn{.map = settingsOf(asSeen, origin), .casters = {}};
  shared::LightMap& map = drawn.map;
  if (views.size() > 1 && map.size > kMaxMapSide / shared::kLightMapFacesInRow)
    throw Error(
        ErrorKind::Scene,
        fmt::format("the depth map of node {} has {} faces of {} texels: they fit with up to {} alone",
                    light.id.index + 1, views.size(), map.size, kMaxMapSide / shared::kLightMapFacesInRow),
        "give its map a smaller \"size\", or move the light away from what casts its shadow");
  map.faceCount = static_cast<std::uint32_t>(views.size());
  map.texel = static_cast<float>(1 / views[0].pixelsPerUnit);
  map.depthOfBuffer =
      views[0].perspective() ? Vec2f(views[0].near, 0) : Vec2f(views[0].far, views[0].near - views[0].far);
  for (std::size_t i = 0; i < views.size(); ++i)
    map.faces[i] = {.right = Vec3f(views[i].right()),
                    .down = Vec3f(-views[i].up()),
                    .forward = Vec3f(views[i].forward()),
                    .origin = Vec3f(views[i].eye - origin)};
  for (const SnapshotNode* node : casters) {
    const auto mesh = meshOf(*node, asSeen, views[0], meshes);
    if (mesh->indices.empty()) continue;
    LightMapDrawn::Caster& caster = drawn.casters.emplace_back(LightMapDrawn::Caster{mesh, {}});
    for (const View& view : views) caster.clipFromObject.push_back(clipFromMesh(view, *node, mesh->origin));
  }
  return drawn;
}

}  // namespace luxo
