// SPDX-License-Identifier: Apache-2.0
#include "cull/cull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "cull/raster_slack.h"
#include "cull/reach.h"
#include "math/rounding.h"
#include "math/sampling.h"
#include "mesh/mesh_solid.h"
#include "surface/surface_triangles.h"

namespace luxo {

namespace {

/// Thinner triangles may turn over when their corners snap to the raster. A flat patch this thick has none
/// even when it is cut into 128 x 128 cells.
constexpr double kLeastThicknessPx = 16;

/// The bounds of a node in eye space.
struct Bounds {
  std::array<Vec3, 8> corners;
  Vec3 center{0};
  double slack = 0;     ///< metres by which single precision may move a point of the surface
  double nearest = 0;   ///< smallest depth, not clamped
  double farthest = 0;  ///< largest
  double tangentOffAxis =
      0;  ///< largest tangent of the angle off axis; infinite when the bounds reach the near plane
  bool finite = false;  ///< otherwise nothing above holds
};

Bounds boundsInEyeSpace(const View& view, const SnapshotNode& node) {
  const Box& box = node.boundsObject;
  const Transform place = eyeFromObject(view, node.worldFromObject);
  Bounds bounds;
  bounds.slack = vertexSlack(view, node);
  bounds.finite = std::isfinite(bounds.slack) && !box.empty();
  bounds.center = transformPoint(place, box.center());
  bounds.nearest = std::numeric_limits<double>::infinity();
  bounds.farthest = -bounds.nearest;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                      i & 4 ? box.max.z : box.min.z);
    bounds.corners[i] = transformPoint(place, corner);
    bounds.nearest = std::min(bounds.nearest, -bounds.corners[i].z - bounds.slack);
    bounds.farthest = std::max(bounds.farthest, -bounds.corners[i].z + bounds.slack);
  }
  bounds.tangentOffAxis = std::numeric_limits<double>::infinity();
  if (bounds.finite && bounds.nearest > view.near) {
    bounds.tangentOffAxis = 0;
    for (const Vec3& c : bounds.corners)
      bounds.tangentOffAxis = std::max(bounds.tangentOffAxis, std::hypot(c.x, c.y) / -c.z);
  }
  return bounds;
}

/// Whether the rectangle of pixels around the projected bounds holds a sample position. Grown by what
/// snapping, single precision and the width of lines can add. True when the bounds reach the near plane.
bool coversSample(const View& view, const Bounds& bounds, int samples, double marginPx) {
  if (!bounds.finite || bounds.nearest <= view.near) return true;
  const double slackPx =
      view.perspective() ? view.pixelsPerUnit * (1 + bounds.tangentOffAxis) * bounds.slack / bounds.nearest
                         : view.pixelsPerUnit * bounds.slack;
  Vec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Vec3& corner : bounds.corners) {
    const Vec2 pixel = pixelFromEye(view, corner);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  low -= marginPx + slackPx;
  high += marginPx + slackPx;
  const auto holds = [&](const Vec2& standard) {
    const Vec2 position = standard + view.sampleOffsetPx;
    return std::ceil(low.x - position.x) <= std::floor(high.x - position.x) &&
           std::ceil(low.y - position.y) <= std::floor(high.y - position.y);
  };
  return std::ranges::any_of(sampleLocations(samples), holds);
}

/// Whether all of a box is outside of a closed mesh: no cluster reaches into it, and the mesh does not go
/// around its middle.
bool isOutsideOfMesh(const SnapshotNode& node, const Box& box, double slack) {
  const SurfaceTriangles* triangles = node.surface.triangles();
  if (!triangles || triangles->count != triangles->mesh.triangleCount()) return false;
  const bool reached = std::ranges::any_of(triangles->mesh.clusters(), [&](const MeshCluster& cluster) {
    return overlap(transformBounds(node.worldFromObject, cluster.bounds), box, slack);
  });
  return !reached && windingNumber(triangles->mesh, node.worldFromObject, box.center(), slack) == 0;
}

/// Whether rays begin outside of a closed surface: the near plane does not cut it inside the picture, by its
/// bounds, or, of a mesh, by those of its clusters.
bool seenFromOutside(const View& view, const SnapshotNode& node, const Bounds& bounds) {
  if (!bounds.finite) return false;
  if (bounds.nearest > view.near * (1 + kVertexSlack)) return true;
  const Vec2 half = (view.halfExtent + Vec2(2 / view.pixelsPerUnit)) * (view.perspective() ? view.near : 1);
  Box window;
  for (const double x : {-half.x, half.x})
    for (const double y : {-half.y, half.y})
      window.add(view.eye + x * view.right() + y * view.up() + view.near * view.forward());
  const double slack = bounds.slack + kVertexSlack * (view.near + glm::length(half)) +
                       roundingGamma(16) * glm::length(view.eye);
  return !overlap(node.boundsWorld, window, slack) || isOutsideOfMesh(node, window, slack);
}

/// Thickness in pixels of a triangle: its smallest height.
double thicknessPx(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a, ac = c - a;
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(c - b)});
  return longest > 0 ? std::abs(ab.x * ac.y - ab.y * ac.x) / longest : 0;
}

/// Whether a flat patch with straight parameter lines shows only its back, and no triangle of it is so thin
/// that rounding could turn it over.
bool turnsItsBack(const View& view, const SnapshotNode& node, const Bounds& bounds) {
  const std::optional<Vec3> normal = node.surface.flatNormal();
  if (!normal || node.surface.patchCount() != 1 || node.segments || !bounds.finite ||
      bounds.nearest <= view.near)
    return false;
  const PartialBounds curved = node.surface.partialBounds(node.parameters);
  if (curved.uu != 0 || curved.uv != 0 || curved.vv != 0) return false;

  const Transform place = eyeFromObject(view, node.worldFromObject);
  const Vec3 normalEye = unit(normalMatrix(place.linear) * *normal);
  const Domain& domain = node.surface.domain();
  std::array<Vec2, 4> pixels;
  for (int i = 0; i < 4; ++i) {
    const double u = i == 1 || i == 2 ? domain.u.hi : domain.u.lo, v = i >= 2 ? domain.v.hi : domain.v.lo;
    const Vec3 corner = transformPoint(place, node.surface.position(u, v, node.parameters));
    const Vec3 towardEye = view.perspective() ? -corner : Vec3(0, 0, 1);
    if (!(glm::dot(normalEye, towardEye) < -bounds.slack)) return false;
    pixels[i] = pixelFromEye(view, corner);
  }
  for (int i = 0; i < 4; ++i)
    if (!(thicknessPx(pixels[i], pixels[(i + 1) % 4], pixels[(i + 2) % 4]) > kLeastThicknessPx)) return false;
  return true;
}

/// Where most of a node without finite bounds begins. It sets the quality of what cannot be proven anyway.
double framingDepth(const View& view, const SnapshotNode& node) {
  const Box framing = node.surface.framing(node.parameters);
  if (framing.empty()) return view.near;
  const Sphere sphere = sphereAround(transformBounds(node.worldFromObject, framing));
  return std::max(view.near, glm::dot(sphere.center - view.eye, view.forward()) - sphere.radius);
}

/// Object units. Extreme scales would round a tolerance to 0; this one no mesh meets, and what is made of it
/// by powers of two is still above 0.
constexpr double kLeastTolerance = 1e-200;

/// Everything about a node that does not depend on what is skipped.
VisibleNode describe(const Snapshot& snapshot, std::uint32_t index, const Bounds& bounds,
                     double tolerancePx) {
  const View& view = snapshot.view;
  const SnapshotNode& node = snapshot.nodes[index];
  const Material& material = snapshot.materials[node.material.index];
  VisibleNode visible{.node = index};
  visible.nearestDepth = bounds.finite ? std::max(bounds.nearest, view.near) : view.near;
  visible.farthestDepth =
      bounds.finite ? std::max(bounds.farthest, view.near) : std::numeric_limits<double>::infinity();
  visible.centerDepth = bounds.finite ? -bounds.center.z : view.near;
  visible.stretch = largestStretch(node.worldFromObject.linear);
  const double tangent = std::min(bounds.tangentOffAxis, glm::length(view.halfExtent));
  visible.pixelsPerUnit = view.pixelsPerUnit * (view.perspective() ? std::hypot(1.0, tangent) : 1);
  const double depth = bounds.finite ? visible.nearestDepth : framingDepth(view, node);
  const double toleranceWorld = view.perspective()
                                    ? tolerancePx * depth / (visible.pixelsPerUnit + tolerancePx)
                                    : tolerancePx / visible.pixelsPerUnit;
  visible.toleranceObject = std::max(kLeastTolerance, toleranceWorld / visible.stretch);
  visible.mirrored = mirrors(node.worldFromObject);
  visible.twoSided =
      material.twoSided == TwoSided::Yes || (material.twoSided == TwoSided::Auto && !node.surface.closed());
  visible.hideBackFaces = material.twoSided == TwoSided::No;
  return visible;
}

/// Whether any point of the node may be in the light's cone. The shader finds its border in single precision,
/// across the axis as far off as positions are, which are sums of these lengths, and along the border by an
/// angle of some 2^-22.
bool spotReaches(const View& view, const SnapshotLight& light, const SnapshotNode& node,
                 const Bounds& bounds) {
  double lengths = glm::length(light.from(view.eye));
  for (const Vec3& corner : bounds.corners) lengths += glm::length(corner);
  return canLight(*light.cone, Vec3(light.positionWorld), node.worldFromObject, node.boundsObject,
                  4 * (bounds.slack + kVertexSlack * lengths));
}

/// Whether any of the light can arrive at the node. The shade itself is always lit: its normals decide.
bool reaches(const Snapshot& snapshot, const SnapshotLight& light, const SnapshotNode& node,
             const Bounds& bounds) {
  if (light.radiance == Vec3(0)) return false;
  if (light.cone && bounds.finite && !spotReaches(snapshot.view, light, node, bounds)) return false;
  if (!light.shade || light.shade->caster == node.id || !bounds.finite) return true;
  const ShadeRule& rule = *light.shade;
  // The shader decides in single precision, from positions relative to the eye. What it gets wrong near the
  // border is a strip whose width grows as the border and the distance from the focus become parallel: at
  // most by `grazing`.
  double fromEye = glm::length(rule.focus - snapshot.view.eye);
  for (const Vec3& corner : bounds.corners) fromEye += glm::length(corner);
  const double sum = rule.height + rule.focalLength;
  const double grazing =
      sum / (2 * std::sqrt(rule.height * rule.focalLength)) + std::sqrt(sum / rule.focalLength);
  return canLight(rule, node.worldFromObject, node.boundsObject,
                  grazing * (bounds.slack + kVertexSlack * fromEye));
}

void appendLights(const Snapshot& snapshot, const SnapshotNode& node, const Bounds& bounds, bool skip,
                  VisibleNode& visible, VisibleList& list) {
  visible.firstLight = static_cast<std::uint32_t>(list.lights.size());
  for (std::uint32_t i = 0; i < snapshot.lights.size(); ++i) {
    if (skip && !reaches(snapshot, snapshot.lights[i], node, bounds))
      ++list.counts.culledLights;
    else
      list.lights.push_back(i);
  }
  visible.lightCount = static_cast<std::uint32_t>(list.lights.size()) - visible.firstLight;
}

/// Sorts by a depth, then by place in the world, then by number.
template <class Depth>
void sortByDepth(std::vector<VisibleNode>& nodes, const Snapshot& snapshot, Depth depth) {
  const auto key = [&](const VisibleNode& visible) {
    const SnapshotNode& node = snapshot.nodes[visible.node];
    const bool bounded = std::isfinite(glm::dot(node.boundsWorld.extent(), Vec3(1)));
    const Vec3 center = bounded ? node.boundsWorld.center() : node.worldFromObject.translation;
    return std::tuple(depth(visible), center.x, center.y, center.z, node.number);
  };
  std::ranges::sort(nodes, [&](const VisibleNode& a, const VisibleNode& b) { return key(a) < key(b); });
}

}  // namespace

VisibleList cull(const Snapshot& snapshot, const CullOptions& options) {
  const View& view = snapshot.view;
  const Frustum filled = drawnFrustum(view, false), outlined = drawnFrustum(view, true);
  VisibleList list;
  CullCounts& counts = list.counts;
  for (std::uint32_t i = 0; i < snapshot.nodes.size(); ++i) {
    const SnapshotNode& node = snapshot.nodes[i];
    const Material& material = snapshot.materials[node.material.index];
    if (material.invisible()) continue;  // as if it were not there
    const bool lines = material.shadingIn(options.shading) == Shading::Wireframe;
    const Bounds bounds = boundsInEyeSpace(view, node);
    const bool transparent = material.seenThroughIn(options.shading, options.ofGeometry);
    ++counts.nodes;
    if (options.frustum && bounds.finite &&
        outside(lines ? outlined : filled, node.worldFromObject, node.boundsObject, bounds.slack)) {
      ++counts.culledFrustum;
      continue;
    }
    if (options.small && !coversSample(view, bounds, options.samples, kSnapPx + (lines ? kLinePx : 0))) {
      ++counts.culledSmall;
      continue;
    }
    VisibleNode visible = describe(snapshot, i, bounds, options.tolerancePx);
    if (options.backface && visible.hideBackFaces && turnsItsBack(view, node, bounds)) {
      ++counts.culledBackface;
      continue;
    }
    // Of triangles this is no skip: where both sides meet rounding decides which is nearer, but the front is
    // what is seen.
    const bool showsFronts = options.backface || node.surface.isPolygonal();
    visible.closedFromOutside =
        showsFronts && !lines && node.surface.closed() && !transparent && seenFromOutside(view, node, bounds);
    appendLights(snapshot, node, bounds, options.lights, visible, list);
    ++counts.drawn;
    (transparent ? list.transparent : list.opaque).push_back(visible);
  }
  sortByDepth(list.opaque, snapshot, [](const VisibleNode& v) { return v.nearestDepth; });
  return list;
}

double boundPx(const View& view, const VisibleNode& visible, double errorObject) {
  const double error = visible.stretch * errorObject;
  if (!view.perspective()) return visible.pixelsPerUnit * error;
  const double left = visible.nearestDepth - error;
  return left > 0 ? visible.pixelsPerUnit * error / left : std::numeric_limits<double>::infinity();
}

}  // namespace luxo
