// SPDX-License-Identifier: Apache-2.0
// Measures, in double precision, how far the triangles of a mesh are from its surface: pairs of a point of a
// triangle and the point of the surface that it stands for.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "surface/surface.h"
#include "tessellate/mesh.h"

namespace luxo {

struct PointPair {
  Vec3 onMesh, onSurface;

  [[nodiscard]] double distance() const { return glm::length(onMesh - onSurface); }
};

/// Points of every triangle, `density` to an edge, with the points of the surface that they stand for: those
/// of the same (u, v), except
/// - on a surface of revolution those of the same v and the same angle about the axis: a point may slide
/// along
///   its circle;
/// - on a flat surface, where every interior point lies on the surface, only those of the borders;
/// - in a triangle that ends in a pole, whose corner stands for the pole's whole edge: from there u fans out.
class PairFinder {
 public:
  PairFinder(const Surface& surface, std::span<const double> parameters, const Mesh& mesh, int density)
      : surface_(surface), mesh_(mesh), wanted_(surface.patchCount()) {
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      corners_ = {mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]};
      const Vec2 center = (uv(0) + uv(1) + uv(2)) / 3.0;
      patch_ = surface.patchAt(center.x, center.y);
      if (surface.flatNormal())
        addBorders(density);
      else if (const int pole = poleCorner(); pole >= 0)
        addFan(pole, density);
      else
        addInterior(density);
    }
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) evaluate(patch, parameters);
  }

  [[nodiscard]] std::vector<PointPair> pairs() && { return std::move(pairs_); }

 private:
  struct Wanted {
    std::vector<Vec3> onMesh;
    std::vector<double> u, v;
  };

  [[nodiscard]] const Vec2& uv(int k) const { return mesh_.parameters[corners_[k]]; }
  [[nodiscard]] const Vec3& position(int k) const { return mesh_.positions[corners_[k]]; }

  void add(const Vec3& onMesh, const Vec2& at) {
    Wanted& wanted = wanted_[patch_];
    const Domain& d = surface_.patchDomain(patch_);
    wanted.onMesh.push_back(onMesh);
    wanted.u.push_back(std::clamp(at.x, d.u.lo, d.u.hi));
    wanted.v.push_back(std::clamp(at.y, d.v.lo, d.v.hi));
  }

  void addInterior(int n) {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        if (i == n || j == n || i + j == 0) continue;  // corners are exact
        const double a = double(i) / n, b = double(j) / n, c = 1 - a - b;
        const Vec3 point = a * position(0) + b * position(1) + c * position(2);
        Vec2 at = a * uv(0) + b * uv(1) + c * uv(2);
        if (surface_.revolution()) {
          // u turns from +X toward -Z; the turn nearest to the triangle's own u.
          const double turn = std::atan2(-point.z, point.x) / kTau;
          at.x = turn + std::round(at.x - turn);
        }
        add(point, at);
      }
  }

  /// Which corner is a pole, or -1.
  [[nodiscard]] int poleCorner() const {
    const Domain& d = surface_.patchDomain(patch_);
    const auto collapsed = [&](Side side) { return surface_.topology().edge(patch_, side).collapsed(); };
    for (int k = 0; k < 3; ++k)
      if ((uv(k).x == d.u.lo && collapsed(Side::UMin)) || (uv(k).x == d.u.hi && collapsed(Side::UMax)) ||
          (uv(k).y == d.v.lo && collapsed(Side::VMin)) || (uv(k).y == d.v.hi && collapsed(Side::VMax)))
        return k;
    return -1;
  }

  void addFan(int pole, int n) {
    const int p = (pole + 1) % 3, q = (pole + 2) % 3;
    const Domain& d = surface_.patchDomain(patch_);
    const bool onUEdge = uv(pole).x == d.u.lo || uv(pole).x == d.u.hi;
    const bool alongV =
        onUEdge &&
        surface_.topology().edge(patch_, uv(pole).x == d.u.lo ? Side::UMin : Side::UMax).collapsed();
    for (int i = 0; i <= n; ++i)
      for (int j = 1; j <= n; ++j) {
        if (j == n && (i == 0 || i == n)) continue;
        const double s = double(i) / n, t = double(j) / n;
        const Vec2 end = (1 - s) * uv(p) + s * uv(q);
        Vec2 at = (1 - t) * uv(pole) + t * end;
        (alongV ? at.y : at.x) = alongV ? end.y : end.x;
        add((1 - t) * position(pole) + t * ((1 - s) * position(p) + s * position(q)), at);
      }
  }

  void addBorders(int n) {
    const Domain& d = surface_.patchDomain(patch_);
    const auto onBorder = [&](const Vec2& a, const Vec2& b) {
      const auto is = [&](Side side) { return surface_.topology().edge(patch_, side).kind == Edge::Border; };
      return (is(Side::UMin) && a.x == d.u.lo && b.x == d.u.lo) ||
             (is(Side::UMax) && a.x == d.u.hi && b.x == d.u.hi) ||
             (is(Side::VMin) && a.y == d.v.lo && b.y == d.v.lo) ||
             (is(Side::VMax) && a.y == d.v.hi && b.y == d.v.hi);
    };
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      if (!onBorder(uv(k), uv(l))) continue;
      for (int i = 1; i < n; ++i) {
        const double s = double(i) / n;
        add((1 - s) * position(k) + s * position(l), (1 - s) * uv(k) + s * uv(l));
      }
    }
  }

  void evaluate(std::uint32_t patch, std::span<const double> parameters) {
    const Wanted& wanted = wanted_[patch];
    const std::vector<Vec3> points = surface_.evaluate(patch, wanted.u, wanted.v, parameters).position;
    for (std::size_t i = 0; i < points.size(); ++i) pairs_.push_back({wanted.onMesh[i], points[i]});
  }

  const Surface& surface_;
  const Mesh& mesh_;
  std::array<std::uint32_t, 3> corners_{};
  std::uint32_t patch_ = 0;
  std::vector<Wanted> wanted_;
  std::vector<PointPair> pairs_;
};

[[nodiscard]] inline std::vector<PointPair> pairsOf(const Surface& surface,
                                                    std::span<const double> parameters, const Mesh& mesh,
                                                    int density = 4) {
  return PairFinder(surface, parameters, mesh, density).pairs();
}

[[nodiscard]] inline double largestDistance(const std::vector<PointPair>& pairs) {
  double largest = 0;
  for (const PointPair& pair : pairs) largest = std::max(largest, pair.distance());
  return largest;
}

}  // namespace luxo
