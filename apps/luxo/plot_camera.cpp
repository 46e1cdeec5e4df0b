// SPDX-License-Identifier: Apache-2.0
#include "plot_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/fitted_camera.h"
#include "surface/spread.h"

namespace luxo {
namespace {

constexpr int kPerSide = 49;  // samples of a patch along a side
constexpr int kRaster = 160;  // cells of the depth map along a side
constexpr double kWorthSeeing = 4;
constexpr double kSlant = 0.4;  // cosine
/// Of the area, per radian away from the usual direction: a quarter turn has to show a twelfth more.
constexpr double kUnusual = 0.05;
constexpr std::array kElevations = {24.0, 32.0, 40.0};
constexpr int kAzimuths = 12;

/// A part of a surface: two triangles.
struct Facet {
  std::array<Vec3, 4> corners;
  Vec3 normal{0};  ///< unit
  double area = 0;
};

Facet facetOf(const std::array<Vec3, 4>& c) {
  const Vec3 twice = glm::cross(c[2] - c[0], c[3] - c[1]);
  return {c, unit(twice), 0.5 * glm::length(twice)};
}

std::vector<Facet> facetsOf(const SnapshotNode& node) {
  std::vector<Facet> facets;
  std::vector<Vec3> points;
  for (const Patch& patch : node.surface.patches()) {
    std::vector<double> us, vs;
    for (int k = 0; k < kPerSide; ++k) {
      us.push_back(patch.domain.u.lo + patch.domain.u.width() * k / (kPerSide - 1));
      vs.push_back(patch.domain.v.lo + patch.domain.v.width() * k / (kPerSide - 1));
    }
    const auto s = patch.function->position.evaluateGrid(us, vs, PatchInputs(patch, node.parameters));
    const auto at = [&](int i, int j) {
      const auto k = static_cast<std::size_t>(j * kPerSide + i);
      return transformPoint(node.worldFromObject, {s[0][k], s[1][k], s[2][k]});
    };
    for (int j = 0; j + 1 < kPerSide; ++j)
      for (int i = 0; i + 1 < kPerSide; ++i) {
        const Facet facet = facetOf({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        if (!std::isfinite(facet.area)) continue;
        facets.push_back(facet);
        points.push_back(facet.corners[0]);
      }
  }
  if (facets.empty() || isFinite(node.boundsObject)) return facets;
  const Spread spread = spreadOf(points);  // near a pole a few would count for all
  std::erase_if(facets, [&](const Facet& facet) {
    return glm::length(facet.corners[0] - spread.center) > kWorthSeeing * spread.radius;
  });
  return facets;
}

/// How far out what is nearest to the viewer is, seen from one direction, without perspective.
class DepthMap {
 public:
  DepthMap(const std::vector<Facet>& facets, const Vec3& toward)
      : toward_(toward),
        right_(unit(glm::cross(Vec3(0, 1, 0), toward))),
        up_(glm::cross(toward, right_)),
        depths_(kRaster * kRaster, -std::numeric_limits<double>::infinity()) {
    for (const Facet& facet : facets)
      for (const Vec3& corner : facet.corners) {
        lo_ = glm::min(lo_, Vec2(glm::dot(right_, corner), glm::dot(up_, corner)));
        hi_ = glm::max(hi_, Vec2(glm::dot(right_, corner), glm::dot(up_, corner)));
      }
    scale_ = (kRaster - 1) / std::max({hi_.x - lo_.x, hi_.y - lo_.y, 1e-300});
    for (const Facet& facet : facets) {
      draw(facet.corners[0], facet.corners[1], facet.corners[2]);
      draw(facet.corners[0], facet.corners[2], facet.corners[3]);
    }
  }

  [[nodiscard]] bool shows(const Facet& facet) const {
    const Vec3 middle = 0.25 * (facet.corners[0] + facet.corners[1] + facet.corners[2] + facet.corners[3]);
    const Vec3 p = onMap(middle);
    // A cell of the map holds what is up to a cell away on the facet's own slope.
    const double slope = 1 / std::max(std::abs(glm::dot(facet.normal, toward_)), 0.1);
    return p.z + 2 * slope / scale_ >= depths_[static_cast<std::size_t>(std::lround(p.y)) * kRaster +
                                               static_cast<std::size_t>(std::lround(p.x))];
  }

 private:
  [[nodiscard]] Vec3 onMap(const Vec3& p) const {
    return {(glm::dot(right_, p) - lo_.x) * scale_, (glm::dot(up_, p) - lo_.y) * scale_,
            glm::dot(toward_, p)};
  }

  void draw(const Vec3& worldA, const Vec3& worldB, const Vec3& worldC) {
    const Vec3 a = onMap(worldA), b = onMap(worldB), c = onMap(worldC);
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [bottom, top] = std::minmax({a.y, b.y, c.y});
    for (int y = static_cast<int>(std::ceil(bottom)); y <= top; ++y)
      for (int x = static_cast<int>(std::ceil(left)); x <= right; ++x) {
        const double partB = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
        const double partC = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
        if (partB < 0 || partC < 0 || partB + partC > 1) continue;
        double& depth = depths_[static_cast<std::size_t>(y * kRaster + x)];
        depth = std::max(depth, a.z + partB * (b.z - a.z) + partC * (c.z - a.z));
      }
  }

  Vec3 toward_, right_, up_;
  Vec2 lo_{std::numeric_limits<double>::infinity()}, hi_ = -lo_;
  double scale_ = 1;
  std::vector<double> depths_;
};

double shownPart(const std::vector<Facet>& facets, const Vec3& toward) {
  const DepthMap map(facets, toward);
  double shown = 0, all = 0;
  for (const Facet& facet : facets) {
    all += facet.area;
    if (map.shows(facet))
      shown += facet.area * std::min(1.0, std::abs(glm::dot(facet.normal, toward)) / kSlant);
  }
  return all > 0 ? shown / all : 0;
}

}  // namespace

Vec3 showingDirection(const Snapshot& snapshot) {
  std::vector<Facet> facets;
  for (const SnapshotNode& node : snapshot.nodes) {
    const std::vector<Facet> more = facetsOf(node);
    facets.insert(facets.end(), more.begin(), more.end());
  }
  const Vec3 usual = unit(kFittedDirection);
  Vec3 best = usual;
  double most = shownPart(facets, usual);
  for (const double elevation : kElevations)
    for (int k = 0; k < kAzimuths; ++k) {
      const double azimuth = radians(azimuthOf(usual)) + kTau * k / kAzimuths, up = radians(elevation);
      const Vec3 toward(std::sin(azimuth) * std::cos(up), std::sin(up), std::cos(azimuth) * std::cos(up));
      const double worth =
          shownPart(facets, toward) - kUnusual * std::acos(std::min(1.0, glm::dot(toward, usual)));
      if (worth > most) best = toward, most = worth;
    }
  return best;
}

double azimuthOf(const Vec3& direction) { return std::atan2(direction.x, direction.z) * (180 / kPi); }

}  // namespace luxo
