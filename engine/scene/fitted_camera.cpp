// SPDX-License-Identifier: Apache-2.0
#include "scene/fitted_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/error.h"
#include "scene/view.h"
#include "surface/bounds.h"
#include "surface/spread.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

constexpr double kFill = 0.85;
/// By how much of the picture's half width or height a part may reach farther than what was sampled, and
/// count as seen.
constexpr double kProven = 0.01;
/// Interval evaluations of a fit, 1 to 5 us each; a torus takes 200, 25 Gaussians on a square 1,500.
constexpr int kMaxCells = 8192;
/// Samples of all surfaces together, and of one along a side. One with poles or borders has more: nothing but
/// samples tells where it ends.
constexpr int kSamples = 1 << 16, kMaxPerSide = 33, kMaxPerOpenSide = 257;
/// How much farther out than nine of ten points what is worth looking at may lie.
constexpr double kWorthSeeing = 4;

/// The directions of the picture: x to its right, y up, z toward the viewer.
struct Axes {
  Vec3 x, y, z;
};

enum FrameSide { kRight, kLeft, kTop, kBottom, kFront, kFrameSides };
using Reach = std::array<double, kFrameSides>;

/// How far something reaches along a normal of each side of a frame.
struct Frame {
  std::array<Vec3, kFrameSides> normals;  ///< world
  Reach reach;

  Frame(const Axes& axes, const Vec2& slope)
      : normals{axes.x + slope.x * axes.z, -axes.x + slope.x * axes.z, axes.y + slope.y * axes.z,
                -axes.y + slope.y * axes.z, axes.z} {
    reach.fill(-kInfinity);
  }

  /// Whether the point reaches farther than those before.
  bool add(const Vec3& point) {
    const Reach before = reach;
    for (int side = 0; side < kFrameSides; ++side)
      reach[side] = std::max(reach[side], glm::dot(normals[side], point));
    return reach != before;
  }
};

/// Points of surfaces, in the world, and the frame around them.
struct Seen {
  std::vector<Vec3> points;
  Frame frame;
};

double reachOf(const Box& box, const Vec3& normal) {
  return glm::dot(normal, box.center()) + glm::dot(glm::abs(normal), 0.5 * box.extent());
}

Interval along(const Vec3& normal, std::span<const Interval> vector) {
  return Interval(normal.x) * vector[0] + Interval(normal.y) * vector[1] + Interval(normal.z) * vector[2];
}

/// A part of a patch, in the world.
struct Cell {
  const SnapshotNode* node;
  std::uint32_t patch;
  Domain domain;
};

/// Proves that surfaces reach no farther than what was seen of them, by `slack`; what reaches farther is
/// looked at more closely.
class FrameProof {
 public:
  FrameProof(Seen& seen, const Reach& slack) : seen_(seen), slack_(slack) { proven_.fill(-kInfinity); }

  void add(const SnapshotNode& node) {
    for (std::uint32_t patch = 0; patch < node.surface.patchCount(); ++patch)
      open_.push_back({&node, patch, node.surface.patchDomain(patch)});
    while (!open_.empty()) {
      const Cell cell = open_.back();
      open_.pop_back();
      look(cell);
    }
  }

  /// No smaller than what was seen.
  [[nodiscard]] Reach proven() const {
    Reach reach = proven_;
    for (int side = 0; side < kFrameSides; ++side)
      reach[side] = std::max(reach[side], seen_.frame.reach[side]);
    return reach;
  }

 private:
  void look(const Cell& cell) {
    const Patch& patch = cell.node->surface.patches()[cell.patch];
    const PatchInputs inputs(patch, cell.node->parameters);
    const Box here = boundPosition(*patch.function, cell.domain, inputs);
    if (here.empty()) return;
    const Box box = transformBounds(cell.node->worldFromObject, here);
    Reach bound;
    for (int side = 0; side < kFrameSides; ++side) bound[side] = reachOf(box, seen_.frame.normals[side]);
    ++looked_;
    if (!farther(bound)) return keep(bound);
    const Vec2 lean = sharpen(cell, patch, inputs, bound);
    if (!farther(bound) || looked_ >= kMaxCells) return keep(bound);
    Domain lower = cell.domain, upper = cell.domain;
    if (lean.x >= lean.y)
      lower.u.hi = upper.u.lo = cell.domain.u.mid();
    else
      lower.v.hi = upper.v.lo = cell.domain.v.mid();
    open_.push_back({cell.node, cell.patch, lower});
    open_.push_back({cell.node, cell.patch, upper});
  }

  [[nodiscard]] bool farther(const Reach& bound) const {
    for (int side = 0; side < kFrameSides; ++side)
      if (!(bound[side] <= seen_.frame.reach[side] + slack_[side])) return true;
    return false;
  }

  void keep(const Reach& bound) {
    for (int side = 0; side < kFrameSides; ++side) proven_[side] = std::max(proven_[side], bound[side]);
  }

  /// By the mean value form, and by looking at the cell's middle. Gives how much the cell reaches farther for
  /// its width in u, and in v.
  Vec2 sharpen(const Cell& cell, const Patch& patch, std::span<const double> inputs, Reach& bound) {
    std::array<Interval, 9> over;
    patch.function->tangents.bound(cell.domain.u, cell.domain.v, inputs, over);
    const double u = cell.domain.u.mid(), v = cell.domain.v.mid();
    const Vec3 middle = transformPoint(cell.node->worldFromObject,
                                       cell.node->surface.position(cell.patch, u, v, cell.node->parameters));
    if (seen_.frame.add(middle)) seen_.points.push_back(middle);
    const bool smooth = !mayBeKinked(*patch.function, cell.domain, inputs);
    const Mat3 objectFromWorld = glm::transpose(cell.node->worldFromObject.linear);  // for normals
    Vec2 lean(0);
    for (int side = 0; side < kFrameSides; ++side) {
      const Vec3 normal = objectFromWorld * seen_.frame.normals[side];
      const double du = along(normal, std::span(over).subspan(3, 3)).magnitude() * cell.domain.u.width(),
                   dv = along(normal, std::span(over).subspan(6, 3)).magnitude() * cell.domain.v.width();
      if (std::isfinite(du) && std::isfinite(dv)) lean += Vec2(du, dv);
      if (smooth)  // NaN where a derivative is unbounded: no better
        bound[side] = std::min(bound[side], glm::dot(seen_.frame.normals[side], middle) + 0.5 * (du + dv));
    }
    if (lean == Vec2(0)) lean = {cell.domain.u.width(), cell.domain.v.width()};
    return lean;
  }

  Seen& seen_;
  Reach slack_, proven_;
  std::vector<Cell> open_;
  int looked_ = 0;
};

int perSideOf(const Snapshot& snapshot) {
  std::size_t patches = 1;
  for (const SnapshotNode& node : snapshot.nodes) patches += node.surface.patchCount();
  return std::max(3, static_cast<int>(std::sqrt(kSamples / patches)));
}

Seen look(const Snapshot& snapshot, const Axes& axes, const Vec2& slope) {
  Seen seen{{}, Frame(axes, slope)};
  const int perSide = perSideOf(snapshot);
  const auto add = [&](const Vec3& world) {
    seen.points.push_back(world);
    seen.frame.add(world);
  };
  for (const SnapshotNode& node : snapshot.nodes)
    for (const Vec3& point : pointsToSee(node, perSide)) add(transformPoint(node.worldFromObject, point));
  if (seen.points.empty())
    for (int corner = 0; corner < 8; ++corner)
      add(Vec3(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5));
  return seen;
}

/// Where along an axis the eye has as much of the points on one side as on the other.
double middleOf(const std::vector<Vec3>& points, const Vec3& axis, const Vec3& outward, double out) {
  double from = kInfinity, to = -kInfinity;
  for (const Vec3& p : points) {
    from = std::min(from, glm::dot(axis, p));
    to = std::max(to, glm::dot(axis, p));
  }
  for (int k = 0; k < 50; ++k) {  // down to rounding
    const double middle = 0.5 * (from + to);
    double above = -kInfinity, below = -kInfinity;
    for (const Vec3& p : points) {
      const double tangent = (glm::dot(axis, p) - middle) / (out - glm::dot(outward, p));
      above = std::max(above, tangent);
      below = std::max(below, -tangent);
    }
    (above > below ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

struct Depth {
  double back = kInfinity;  ///< of the farthest point
  double largest = 0;       ///< of all coordinates
};

Depth depthOf(const std::vector<Vec3>& points, const Vec3& outward) {
  Depth depth;
  for (const Vec3& p : points) {
    depth.back = std::min(depth.back, glm::dot(outward, p));
    depth.largest = std::max({depth.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return depth;
}

/// The vertices of triangles; of many, those that are outermost along an axis in a column of a grid: no point
/// reaches farther than those by more than a column is wide.
std::vector<Vec3> outermost(const SurfaceTriangles& triangles) {
  constexpr std::uint32_t kFew = 1 << 14, kColumns = 128;
  std::vector<Vec3> points;
  if (triangles.count <= kFew) {
    for (std::uint32_t i = 0; i < triangles.count; ++i)
      for (const Vec3& point : triangles.points(i)) points.push_back(point);
    return points;
  }
  struct Column {
    Vec3 low{kInfinity}, high{-kInfinity};
  };
  const Box& box = triangles.mesh.bounds();
  std::array<std::vector<Column>, 3> columns;
  for (std::vector<Column>& all : columns) all.resize(std::size_t{kColumns} * kColumns);
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const Vec3& point : triangles.points(i))
      for (int axis = 0; axis < 3; ++axis) {
        const auto cell = [&](int across) {
          const double width = box.extent()[across];
          const double part = width > 0 ? (point[across] - box.min[across]) / width : 0;
          return std::min(static_cast<std::size_t>(part * kColumns), std::size_t{kColumns - 1});
        };
        Column& column =
            columns[static_cast<std::size_t>(axis)][cell((axis + 1) % 3) * kColumns + cell((axis + 2) % 3)];
        if (point[axis] < column.low[axis]) column.low = point;
        if (point[axis] > column.high[axis]) column.high = point;
      }
  for (const std::vector<Column>& all : columns)
    for (const Column& column : all)
      if (column.low.x <= box.max.x) points.insert(points.end(), {column.low, column.high});
  return points;
}

}  // namespace

std::vector<Vec3> pointsToSee(const SnapshotNode& node, int perSide) {
  if (const SurfaceTriangles* triangles = node.surface.triangles()) return outermost(*triangles);
  const bool open = !isFinite(node.boundsObject);
  const int most = open ? kMaxPerOpenSide : kMaxPerSide;
  const int samples =
      std::clamp(perSide, 3, std::max(3, most / static_cast<int>(std::sqrt(node.surface.patchCount()))));
  std::vector<Vec3> points;
  for (std::uint32_t patch = 0; patch < node.surface.patchCount(); ++patch) {
    const Domain& domain = node.surface.patchDomain(patch);
    std::vector<double> us, vs;
    for (int k = 0; k < samples; ++k) {
      const double part = static_cast<double>(k) / (samples - 1);
      us.push_back(edgePoint(domain, Side::VMin, part).u);
      vs.push_back(edgePoint(domain, Side::UMin, part).v);
    }
    const Patch& p = node.surface.patches()[patch];
    const auto s = p.function->position.evaluateGrid(us, vs, PatchInputs(p, node.parameters));
    for (std::size_t i = 0; i < s[0].size(); ++i)
      if (const Vec3 point(s[0][i], s[1][i], s[2][i]); isFinite(point)) points.push_back(point);
  }
  if (!open || points.empty()) return points;
  const Spread spread = spreadOf(points);
  std::erase_if(points,
                [&](const Vec3& p) { return glm::length(p - spread.center) > kWorthSeeing * spread.radius; });
  return points;
}

Camera fitCamera(const Snapshot& snapshot, PixelSize size, const Vec3& direction) {
  Camera camera{.name = "fitted", .eye = direction, .lookAt = Vec3(0)};
  const View view = viewAt(camera, 0, size);
  const Axes axes{view.right(), view.up(), -view.forward()};
  const Vec2 whole = view.halfExtent, filled = kFill * whole;
  Seen seen = look(snapshot, axes, filled);

  // Between two sides are the points with x + slope z <= the eye's, and -x + slope z, too: the eye is out at
  // least by half the sum of what they reach.
  const Reach& reach = seen.frame.reach;
  const auto outOfSides = [&] {
    return std::max((reach[kRight] + reach[kLeft]) / (2 * filled.x),
                    (reach[kTop] + reach[kBottom]) / (2 * filled.y));
  };
  const auto [back, largest] = depthOf(seen.points, axes.z);
  Reach slack;
  for (int side = 0; side < kFrameSides; ++side)
    slack[side] = kProven * whole[side / 2 % 2] * (outOfSides() - 0.5 * (back + reach[kFront]));
  FrameProof proof(seen, slack);
  for (const SnapshotNode& node : snapshot.nodes)
    if (isFinite(node.boundsObject)) proof.add(node);

  Reach proven = proof.proven();
  // What interval bounds cannot tell from a spike of any height, as of sin(r)/(r + 1e-9), is not looked for.
  for (int side = 0; side < kFrameSides; ++side)
    if (proven[side] > reach[side] + kWorthSeeing * outOfSides()) proven = reach;
  const double front = proven[kFront];
  // Not on the thing itself, be it a point or a line toward the eye.
  double out = std::max(outOfSides(), front + std::max(0.1 * (front - back), 1e-6 * largest + 1e-12));
  Vec2 eye;
  for (int axis = 0; axis < 2; ++axis) {
    eye[axis] = middleOf(seen.points, axis == 0 ? axes.x : axes.y, axes.z, out);
    // What is proven is in the picture: at each depth, what it may reach beyond the inner sides is less than
    // there is between these and the picture's.
    for (int end = 0; end < 2; ++end) {
      const double over = proven[2 * axis + end] - (end == 0 ? eye[axis] : -eye[axis]);
      out = std::max(out, (over + (whole[axis] - filled[axis]) * front) / whole[axis]);
    }
  }
  const double middle = out - 0.5 * (back + front);
  const Vec3 eyeWorld = eye.x * axes.x + eye.y * axes.y + out * axes.z;
  camera.eye = eyeWorld;
  camera.lookAt = eyeWorld - middle * axes.z;
  camera.near = std::min({camera.near.at(0), 0.01 * middle, 0.5 * (out - front)});
  return camera;
}

}  // namespace luxo
