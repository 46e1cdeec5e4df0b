// SPDX-License-Identifier: Apache-2.0
#include "mesh/polygon.h"

#include <numeric>

namespace luxo {
namespace {

double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Along the axis in which its area (Newell's) is largest, so that it turns to the left.
std::vector<Vec2> flattened(std::span<const Vec3> points) {
  Vec3 normal(0);
  for (std::size_t i = 0; i < points.size(); ++i)
    normal += glm::cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  const Vec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& point : points)
    flat.push_back(normal[axis] < 0 ? Vec2(point[b], point[a]) : Vec2(point[a], point[b]));
  return flat;
}

// Whether every fan triangle turns the same way: then the fan fills it, convex or not.
bool fans(const std::vector<Vec2>& flat) {
  for (std::size_t i = 2; i < flat.size(); ++i)
    if (area(flat[0], flat[i - 1], flat[i]) < 0) return false;
  return true;
}

// Cuts off corners that turn to the left, in rounds, no two neighbours in one: what a round leaves is no
// longer around than what it found, so that all edges together are as long as the border times the rounds,
// and a corner is in two triangles a round. Triangles that all turn to the left fill a simple polygon once.
// False, and nothing is added: a round found few corners (it is far from convex), or the last triangle turns
// over.
bool halve(const std::vector<Vec2>& flat, std::vector<std::uint32_t>& corners) {
  constexpr std::size_t kFew = 8;  // so many times fewer than there are: the rounds together are linear
  const std::size_t before = corners.size();
  std::vector<std::uint32_t> left(flat.size()), next;
  std::iota(left.begin(), left.end(), 0u);
  while (left.size() > 3) {
    next = {left[0]};
    std::size_t cuts = 0;
    for (std::size_t i = 1; i < left.size(); ++i) {
      const std::uint32_t last = next.back(), here = left[i], after = left[(i + 1) % left.size()];
      const bool neighbour = last != left[i - 1], enough = left.size() - cuts == 3;
      if (neighbour || enough || !(area(flat[last], flat[here], flat[after]) > 0)) {
        next.push_back(here);
      } else {
        corners.insert(corners.end(), {last, here, after});
        ++cuts;
      }
    }
    if (cuts * kFew < left.size()) break;
    left.swap(next);
  }
  if (left.size() == 3 && area(flat[left[0]], flat[left[1]], flat[left[2]]) > 0) {
    corners.insert(corners.end(), left.begin(), left.end());
    return true;
  }
  corners.resize(before);
  return false;
}

void cutEars(const std::vector<Vec2>& flat, std::vector<std::uint32_t>& corners) {
  std::vector<std::uint32_t> left(flat.size());
  std::iota(left.begin(), left.end(), 0u);
  std::size_t at = 0, misses = 0;
  while (left.size() > 3) {
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count], ear = left[at % count],
                        after = left[(at + 1) % count];
    const Vec2 a = flat[before], b = flat[ear], c = flat[after];
    bool cut = misses >= count;  // it crosses itself: any ear, so that it ends
    if (!cut && area(a, b, c) > 0) {
      cut = true;
      for (const std::uint32_t i : left) {
        if (i == before || i == ear || i == after) continue;
        const Vec2 p = flat[i];
        if (p == a || p == b || p == c) continue;
        if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) {
          cut = false;
          break;
        }
      }
    }
    if (cut) {
      corners.insert(corners.end(), {before, ear, after});
      left.erase(left.begin() + std::ptrdiff_t(at % count));
      misses = 0;
      at = at % count == 0 ? 0 : at % count - 1;
    } else {
      ++misses;
      at = (at + 1) % count;
    }
  }
  corners.insert(corners.end(), left.begin(), left.end());
}

}  // namespace

bool addTriangles(std::span<const Vec3> points, std::vector<std::uint32_t>& corners) {
  const std::vector<Vec2> flat = points.size() > 3 ? flattened(points) : std::vector<Vec2>();
  if (points.size() == 3 || fans(flat)) {
    if (points.size() > 3 && halve(flat, corners)) return true;
    for (std::uint32_t i = 2; i < points.size(); ++i) corners.insert(corners.end(), {0u, i - 1, i});
    return true;
  }
  if (points.size() > kMaxConcaveCorners) return false;
  cutEars(flat, corners);
  return true;
}

}  // namespace luxo
