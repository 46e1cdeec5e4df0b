// SPDX-License-Identifier: Apache-2.0
#include "reference/silhouette.h"

#include <algorithm>
#include <cmath>

namespace luxo::reference {
namespace {

constexpr double kPrecision = 1e-5;
constexpr double kFirstRadius = 1e-3;
constexpr int kDirections = 16;

class OutlineSearch {
 public:
  OutlineSearch(const std::function<bool(const Vec2&)>& holds, const Vec2& center, double farthest)
      : holds_(holds), center_(center), farthest_(farthest) {}

  double distance() {
    for (double inner = 0, outer = std::min(kFirstRadius, farthest_);;
         inner = outer, outer = std::min(2 * outer, farthest_)) {
      double nearest = farthest_, towards = 0;
      bool found = false;
      for (int k = 0; k < kDirections; ++k) {
        const double angle = kTau * k / kDirections;
        if (!holdsAt(outer, angle)) continue;
        found = true;
        if (const double d = border(inner, outer, angle); d < nearest) nearest = d, towards = angle;
      }
      if (found) return turned(nearest, towards);
      if (outer >= farthest_) return farthest_;
    }
  }

 private:
  [[nodiscard]] bool holdsAt(double radius, double angle) const {
    return holds_(center_ + radius * Vec2(std::cos(angle), std::sin(angle)));
  }

  /// Between a radius where it does not hold and one where it does; the latter side.
  [[nodiscard]] double border(double out, double in, double angle) const {
    while (in - out > kPrecision) {
      const double middle = 0.5 * (out + in);
      (holdsAt(middle, angle) ? in : out) = middle;
    }
    return in;
  }

  /// A border that is nearest in one of sixteen directions is nearer still in between.
  [[nodiscard]] double turned(double nearest, double angle) const {
    for (double step = 0.5 * kTau / kDirections; step > 0.02; step *= 0.5)
      for (const double turn : {-step, step}) {
        if (!holdsAt(nearest, angle + turn)) continue;
        nearest = border(0, nearest, angle + turn);
        angle += turn;
        break;
      }
    return nearest;
  }

  const std::function<bool(const Vec2&)>& holds_;
  Vec2 center_;
  double farthest_;
};

}  // namespace

double distanceTo(const std::function<bool(const Vec2&)>& holds, const Vec2& center, double farthest) {
  return OutlineSearch(holds, center, farthest).distance();
}

std::vector<Vec2> placesAround(const Vec2& center, double farthest, bool coarse) {
  const std::vector<double> radii = coarse ? std::vector{1.0} : std::vector{0.1, 0.2, 0.4, 0.8, 1.02};
  const int directions = coarse ? 4 : kDirections;
  std::vector<Vec2> places;
  double turn = 0;
  for (const double radius : radii) {
    for (int k = 0; k < directions; ++k) {
      const double angle = kTau * (k + turn) / directions;
      places.push_back(center + radius * farthest * Vec2(std::cos(angle), std::sin(angle)));
    }
    turn = 0.5 - turn;
  }
  return places;
}

}  // namespace luxo::reference
