// SPDX-License-Identifier: Apache-2.0
#include "shadow/light_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

namespace luxo {
namespace {

/// What floats of a fragment may make of a border between texels, in texels; and of one between faces.
constexpr double kBorder = 1.0 / 16, kFaceBorder = 1e-4;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Orthonormal, z first given.
Mat3 axesAlong(const Vec3& z) {
  const Vec3 away = std::abs(z.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 x = unit(glm::cross(away, z));
  return glm::transpose(Mat3(x, glm::cross(z, x), z));
}

/// A cell on a face.
struct Spread {
  std::uint32_t cell;
  Vec2 low, high;
  double nearest;
};

/// Between two parallel lines, in texels: low <= normal . place <= high. Everywhere, as it is made.
struct Strip {
  Vec2 normal{0};
  double low = -kInfinity, high = kInfinity;
};

/// What is not in all of them misses a cell.
using Outline = std::array<Strip, 4>;

/// The quotients of [low, high] and [nearest, farthest], which is above 0.
Interval over(double low, double high, double nearest, double farthest) {
  return {low / (low < 0 ? nearest : farthest), high / (high > 0 ? nearest : farthest)};
}

/// From where to where a row of texels may meet what is outlined.
Interval columnsOf(const Outline& outline, int row) {
  const double first = row - kBorder, last = row + 1 + kBorder;
  Interval columns{-kInfinity, kInfinity};
  for (const Strip& strip : outline) {
    const double low = strip.low - std::max(strip.normal.y * first, strip.normal.y * last),
                 high = strip.high - std::min(strip.normal.y * first, strip.normal.y * last),
                 slope = strip.normal.x;
    if (slope == 0 && (low > 0 || high < 0)) return {kInfinity, -kInfinity};
    if (slope == 0) continue;
    columns.lo = std::max(columns.lo, std::min(low / slope, high / slope) - kBorder);
    columns.hi = std::min(columns.hi, std::max(low / slope, high / slope) + kBorder);
  }
  return columns;
}

class GridMaker {
 public:
  GridMaker(const CasterCells& caster, const Vec4& light, double margin, int size)
      : caster_(caster), parallel_(light.w == 0), margin_(margin) {
    grid_.size = size;
    if (!parallel_) grid_.middle = caster.bounds.center();
    const Vec3 ahead = parallel_ ? -Vec3(light) : grid_.middle - Vec3(light);
    const double length = glm::length(ahead);
    if (!parallel_) grid_.distance = length;
    grid_.axes = axesAlong(length > 0 ? ahead / length : Vec3(0, 0, 1));
  }

  /// Nothing where that takes too many entries.
  std::optional<LightGrid> make() && {
    for (std::uint32_t face = 0; face < grid_.faces.size(); ++face)
      if (!parallel_ || face == LightGrid::kFirstFace) fill(face);
    if (entries_ > kMaxGridEntries) return std::nullopt;
    return std::move(grid_);
  }

 private:
  /// Where a cell is on a face, if it is.
  [[nodiscard]] std::optional<Spread> spread(std::uint32_t index, std::uint32_t face) const {
    const CasterCell& cell = caster_.cells[index];
    const Vec3 middle = grid_.fromLight(cell.middle);
    Vec3 reach;
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis(grid_.axes[0][i], grid_.axes[1][i], grid_.axes[2][i]);
      const double byBox = glm::dot(glm::abs(axis), cell.reach);
      const double byTangents =
          std::abs(glm::dot(axis, cell.a)) + std::abs(glm::dot(axis, cell.b)) + cell.bend;
      reach[i] = (cell.proven() ? std::min(byBox, byTangents) : byBox) + margin_;
    }
    const int k = static_cast<int>(face / 2), kx = (k + 1) % 3, ky = (k + 2) % 3;
    const double ahead = face % 2 == 0 ? middle[k] : -middle[k];
    const double nearest = ahead - reach[k], farthest = ahead + reach[k];
    const Vec2 low(middle[kx] - reach[kx], middle[ky] - reach[ky]),
        high(middle[kx] + reach[kx], middle[ky] + reach[ky]);
    if (parallel_) return Spread{index, low, high, nearest};
    // A face sees what is no farther aside than ahead.
    constexpr double kEdge = 1 + kFaceBorder;
    const Vec2 aside = glm::max(glm::max(low, -high), Vec2(0));
    const double visible = std::max({nearest, aside.x / kEdge, aside.y / kEdge});
    if (farthest <= 0 || visible > farthest) return std::nullopt;
    if (visible <= 0) return Spread{index, Vec2(-kEdge), Vec2(kEdge), 0};
    const Interval x = over(low.x, high.x, visible, farthest), y = over(low.y, high.y, visible, farthest);
    if (x.lo > kEdge || x.hi < -kEdge || y.lo > kEdge || y.hi < -kEdge) return std::nullopt;
    return Spread{index, glm::max(Vec2(x.lo, y.lo), -kEdge), glm::min(Vec2(x.hi, y.hi), kEdge), visible};
  }

  /// By the edges of the parallelogram of tangents, which no point of the cell is farther from than `off`. A
  /// line normal . place = c of the face is a plane through the light, upright on n = (normal, -c). Inside of
  /// an edge's plane are points with n . p <= 0, so that points of the cell have n . p <= off |n|. One that
  /// is at `place`, and `nearest` ahead or farther, has n . p >= nearest (normal . place - c) if that is
  /// above 0.
  [[nodiscard]] Outline outlineOf(const Spread& spread, const LightGrid::Face& face,
                                  std::uint32_t number) const {
    Outline outline;
    const CasterCell& cell = caster_.cells[spread.cell];
    if (!cell.proven() || (!parallel_ && spread.nearest <= 0)) return outline;
    const int k = static_cast<int>(number / 2), kx = (k + 1) % 3, ky = (k + 2) % 3;
    std::array<Vec2, 4> corners{Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)};
    for (Vec2& corner : corners) {
      const Vec3 p = grid_.fromLight(cell.middle) + grid_.axes * (corner.x * cell.a + corner.y * cell.b);
      const double ahead = parallel_ ? 1 : number % 2 == 0 ? p[k] : -p[k];
      if (!parallel_ && ahead < 0.5 * spread.nearest) return outline;  // may be behind the light
      corner = (Vec2(p[kx], p[ky]) / ahead - face.low) * face.texels;
    }
    const double offPerNearest = (cell.bend + margin_) / (parallel_ ? 1 : spread.nearest);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 along = corners[(i + 1) % 4] - corners[i], normal(-along.y, along.x);
      Interval across{kInfinity, -kInfinity};
      for (const Vec2& corner : corners) {
        across.lo = std::min(across.lo, glm::dot(normal, corner));
        across.hi = std::max(across.hi, glm::dot(normal, corner));
      }
      const Vec2 onFace = normal * face.texels;
      const auto beyond = [&](double c) {
        return offPerNearest * glm::length(Vec3(onFace, parallel_ ? 0 : c + glm::dot(onFace, face.low)));
      };
      outline[i] = {normal, across.lo - beyond(across.lo), across.hi + beyond(across.hi)};
    }
    return outline;
  }

  void fill(std::uint32_t index) {
    std::vector<Spread> spreads;
    Vec2 low(kInfinity), high = -low;
    for (std::uint32_t i = 0; i < caster_.cells.size(); ++i)
      if (const auto s = spread(i, index)) {
        spreads.push_back(*s);
        low = glm::min(low, s->low);
        high = glm::max(high, s->high);
      }
    if (spreads.empty()) return;
    std::ranges::stable_sort(spreads, {}, &Spread::nearest);
    const Vec2 extent = glm::max(high - low, Vec2(1e-30));
    LightGrid::Face& face = grid_.faces[index];
    face.low = low;
    face.texels = static_cast<double>(grid_.size) / extent;
    face.first = static_cast<std::uint32_t>(grid_.starts.size());
    list(face, index, spreads);
  }

  /// Sorts entries into texels, in their order.
  void list(const LightGrid::Face& face, std::uint32_t number, std::span<const Spread> spreads) {
    const int size = grid_.size;
    const auto outlined = [&](const Spread& s) { return caster_.cells[s.cell].proven(); };
    std::vector<Outline> outlines;  // none of triangles
    if (std::ranges::any_of(spreads, outlined))
      for (const Spread& s : spreads) outlines.push_back(outlineOf(s, face, number));
    const auto forTexels = [&](std::size_t i, const auto& action) {
      const Spread& s = spreads[i];
      const Vec2 from = (s.low - face.low) * face.texels - kBorder,
                 to = (s.high - face.low) * face.texels + kBorder;
      const auto texel = [size](double x) {
        return static_cast<int>(std::clamp(std::floor(x), 0.0, size - 1.0));
      };
      for (int y = texel(from.y), endY = texel(to.y); y <= endY; ++y) {
        const Interval columns = outlines.empty() ? Interval{from.x, to.x} : columnsOf(outlines[i], y);
        const double low = std::max(from.x, columns.lo), high = std::min(to.x, columns.hi);
        if (low > high) continue;
        for (int x = texel(low), endX = texel(high); x <= endX; ++x)
          action(static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x));
      }
    };
    const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    std::vector<std::uint32_t> starts(texels + 1);
    for (std::size_t i = 0; i < spreads.size(); ++i)
      forTexels(i, [&](std::size_t texel) { ++starts[texel + 1]; });
    starts[0] = static_cast<std::uint32_t>(grid_.entries.size());
    entries_ += std::accumulate(starts.begin() + 1, starts.end(), std::uint64_t{0});
    if (entries_ > kMaxGridEntries) return;
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    grid_.entries.resize(starts.back());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < spreads.size(); ++i) {
      const float nearest =
          std::nextafter(static_cast<float>(spreads[i].nearest), -std::numeric_limits<float>::max());
      forTexels(i, [&](std::size_t texel) { grid_.entries[next[texel]++] = {spreads[i].cell, nearest}; });
    }
    grid_.starts.insert(grid_.starts.end(), starts.begin(), starts.end());
  }

  const CasterCells& caster_;
  bool parallel_;
  double margin_;
  LightGrid grid_;
  std::uint64_t entries_ = 0;
};

}  // namespace

LightGrid makeLightGrid(const CasterCells& caster, const Vec4& light, double margin, int size) {
  // With one texel there are no more entries than cells on each face.
  static_assert(6 * std::max(kMaxCasterCells, kMaxCasterTriangles) < kMaxGridEntries);
  for (;; size = (size + 1) / 2)
    if (auto grid = GridMaker(caster, light, margin, size).make()) return *std::move(grid);
}

}  // namespace luxo
