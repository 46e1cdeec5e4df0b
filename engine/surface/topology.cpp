// SPDX-License-Identifier: Apache-2.0
#include "surface/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "math/disjoint_sets.h"
#include "surface/holes.h"
#include "surface/normal.h"
#include "surface/spread.h"

namespace luxo {

bool Topology::wraps(Side lower, Side upper) const {
  const PatchEdge a{0, lower}, b{0, upper};
  return edges.size() == 1 && std::ranges::any_of(joints, [&](const Joint& j) {
           return j.smooth && !j.flipped && !j.reversed && ((j.a == a && j.b == b) || (j.a == b && j.b == a));
         });
}

namespace {

constexpr int kEdgeSamples = 17;  // odd, so that the middle and the ends of every edge are among them
constexpr int kInnerSamples = 5;
constexpr double kCoincident = 1e-9;  // of the extent
constexpr double kRounding = 1e-13;   // of the coordinates, where a small surface is far from its origin
constexpr double kLargest = 1e100;    // metres; squares of lengths must not overflow
constexpr double kSameDirection = 1e-6;
constexpr double kSamePole = 1e-5;
constexpr double kNoVolume = 1e-9;  // rounding leaves 1e-13 of a volume that cancels

/// Places along an edge, symmetric about the middle as reversed edges need it, and not evenly spaced: a wave
/// could be zero at every one of those.
double samplePart(int k) {
  const double even = static_cast<double>(k) / (kEdgeSamples - 1);
  return k == 0 || k == kEdgeSamples - 1 ? even : even + 0.013 * std::sin(kTau * even);
}

using EdgeCurve = std::array<Vec3, kEdgeSamples>;

/// The number of an edge among all edges of all patches, and back.
std::uint32_t edgeIndex(const PatchEdge& e) { return 4 * e.patch + static_cast<std::uint32_t>(e.side); }
PatchEdge edgeAt(std::uint32_t index) { return {index / 4, static_cast<Side>(index % 4)}; }

/// The corner at the lower (0) or upper (1) end of an edge. Corners of a patch: 2 * (u upper) + (v upper).
std::uint32_t cornerOf(const PatchEdge& e, int end) {
  const auto upper = static_cast<std::uint32_t>(end);
  switch (e.side) {
    case Side::UMin:
      return 4 * e.patch + upper;
    case Side::UMax:
      return 4 * e.patch + 2 + upper;
    case Side::VMin:
      return 4 * e.patch + 2 * upper;
    case Side::VMax:
      break;
  }
  return 4 * e.patch + 2 * upper + 1;
}

/// +1 where a counter-clockwise walk around the rectangle follows the edge upward, -1 where downward.
int walk(Side side) { return side == Side::VMin || side == Side::UMax ? 1 : -1; }

class Search {
 public:
  Search(std::span<const Patch> patches, std::span<const double> parameters, const StatedTopology& stated)
      : patches_(patches), parameters_(parameters), stated_(stated), normals_(4 * patches.size()) {}

  Topology run() {
    sample();
    measure();
    topology_.edges.resize(patches_.size());
    topology_.orientations.assign(patches_.size(), 0);
    findCollapsed();
    findJoints();
    orientPatches();
    judgeJoints();
    judgeWholes();
    topology_.eulerCharacteristic = eulerCharacteristic();
    return std::move(topology_);
  }

 private:
  using EdgeNormals = std::vector<Vec3>;

  [[nodiscard]] std::uint32_t edgeCount() const { return static_cast<std::uint32_t>(4 * patches_.size()); }
  EdgeKind& kind(std::uint32_t e) { return topology_.edges[e / 4][e % 4]; }

  void sample() {
    for (const Patch& patch : patches_) {
      std::vector<double> us, vs;
      for (const Side side : kSides)
        for (int k = 0; k < kEdgeSamples; ++k) {
          const EdgePoint p = edgePoint(patch.domain, side, samplePart(k));
          us.push_back(p.u);
          vs.push_back(p.v);
        }
      for (int j = 0; j < kInnerSamples; ++j)
        for (int i = 0; i < kInnerSamples; ++i) {
          us.push_back(patch.domain.u.lo + patch.domain.u.width() * (i + 0.5) / kInnerSamples);
          vs.push_back(patch.domain.v.lo + patch.domain.v.width() * (j + 0.5) / kInnerSamples);
        }
      const auto s = patch.function->position.evaluate(us, vs, PatchInputs(patch, parameters_));
      for (std::size_t i = 0; i < us.size(); ++i) {
        const Vec3 p(s[0][i], s[1][i], s[2][i]);
        if (i % kEdgeSamples == 0 && i < 4 * kEdgeSamples) curves_.emplace_back();
        if (i < 4 * kEdgeSamples) curves_.back()[i % kEdgeSamples] = p;
        if (isFinite(p)) points_.push_back(p);
      }
    }
  }

  void measure() {
    if (!points_.empty()) {
      const Spread spread = spreadOf(points_);
      center_ = spread.center;
      extent_ = 2 * spread.radius;
      tolerance_ = kCoincident * extent_ + kRounding * glm::length(center_);
    }
    if (extent_ > kLargest)
      throw Error(ErrorKind::Scene,
                  fmt::format("surface '{}' is too large: its points are more than {:g} metres apart",
                              stated_.name, kLargest),
                  "check the formula and its domain");
    const Domain& d = patches_.front().domain;
    if (!(extent_ > kRounding * glm::length(center_)))
      throw Error(
          ErrorKind::Scene,
          fmt::format(
              "surface '{}' has no {}: over u in [{:.9g}, {:.9g}], v in [{:.9g}, {:.9g}]{} its formula is {} "
              "everywhere",
              stated_.name, points_.empty() ? "points" : "size", d.u.lo, d.u.hi, d.v.lo, d.v.hi,
              patches_.size() > 1 ? " and its other patches" : "",
              points_.empty() ? "not a number"
                              : fmt::format("the same point up to rounding, ({:.4g}, {:.4g}, {:.4g}),",
                                            center_.x, center_.y, center_.z)),
          "check the formula and its domain");
  }

  /// Limits of Su x Sv at every other sample of an edge; found when first asked for.
  const EdgeNormals& normalsAlong(std::uint32_t e) {
    EdgeNormals& normals = normals_[e];
    if (!normals.empty()) return normals;
    const Patch& patch = patches_[e / 4];
    std::vector<double> us, vs;
    for (int k = 0; k < kEdgeSamples; k += 2) {
      const EdgePoint p = edgePoint(patch.domain, edgeAt(e).side, samplePart(k));
      us.push_back(p.u);
      vs.push_back(p.v);
    }
    normals = limitNormals(*patch.function, patch.domain, us, vs, PatchInputs(patch, parameters_));
    return normals;
  }

  [[nodiscard]] bool same(const Vec3& p, const Vec3& q) const { return glm::length(p - q) <= tolerance_; }

  [[nodiscard]] bool isStatedBorder(std::uint32_t e) const {
    return std::ranges::find(stated_.borders, edgeAt(e)) != stated_.borders.end();
  }

  void findCollapsed() {
    for (std::uint32_t e = 0; e < edgeCount(); ++e) {
      if (isStatedBorder(e) ||
          !std::ranges::all_of(curves_[e], [&](const Vec3& p) { return same(p, curves_[e].front()); }))
        continue;
      const EdgeNormals& normals = normalsAlong(e);
      const Vec3 normal = normals[normals.size() / 2];
      const bool pole =
          std::ranges::all_of(normals, [&](const Vec3& n) { return glm::length(n - normal) < kSamePole; });
      kind(e) = pole ? EdgeKind{Edge::Pole, normal} : EdgeKind{Edge::Apex, Vec3(0)};
    }
  }

  enum class Match { None, Straight, Reversed };

  [[nodiscard]] Match match(const EdgeCurve& a, const EdgeCurve& b) const {
    const auto agree = [&](const Vec3& p, const Vec3& q) { return same(p, q); };
    if (std::equal(a.begin(), a.end(), b.begin(), agree)) return Match::Straight;
    return std::equal(a.begin(), a.end(), b.rbegin(), agree) ? Match::Reversed : Match::None;
  }

  /// Edges that are the same curve have the same middle: sorted by its place along a direction that no
  /// symmetry of a real object singles out, they are neighbours.
  void findJoints() {
    const Vec3 direction(0.5479, 0.3131, 0.7757);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t e = 0; e < edgeCount(); ++e)
      if (!kind(e).collapsed() && !isStatedBorder(e) &&
          std::ranges::all_of(curves_[e], [](const Vec3& p) { return isFinite(p); }))
        order.emplace_back(glm::dot(direction, curves_[e][kEdgeSamples / 2]), e);
    std::ranges::sort(order);
    std::vector<bool> joined(edgeCount());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto [place, first] = order[i];
      if (joined[first]) continue;
      std::uint32_t shared = 1;
      const std::size_t firstJoint = topology_.joints.size();
      for (std::size_t j = i + 1; j < order.size() && order[j].first - place <= tolerance_; ++j) {
        const std::uint32_t other = order[j].second;
        if (joined[other]) continue;
        const Match found = match(curves_[first], curves_[other]);
        if (found == Match::None) continue;
        joined[first] = joined[other] = true;
        kind(first).kind = kind(other).kind = Edge::Seam;
        ++shared;
        topology_.joints.push_back({edgeAt(first), edgeAt(other), found == Match::Reversed});
      }
      // More than two sheets on one curve: it has no tangent plane, and no inside next to it.
      branches_.resize(topology_.joints.size(), false);
      if (shared > 2)
        std::fill(branches_.begin() + static_cast<std::ptrdiff_t>(firstJoint), branches_.end(), true);
    }
  }

  /// +1 when the cross products of the two patches are on the same side at the joint: then walks around both
  /// rectangles follow the common curve in opposite directions.
  static int agreement(const Joint& j) { return walk(j.a.side) * walk(j.b.side) * (j.reversed ? 1 : -1); }

  /// Gives all patches that hang together the same outside, as far as there is one.
  void orientPatches() {
    std::vector<std::vector<std::pair<std::uint32_t, int>>> neighbours(patches_.size());
    for (std::size_t k = 0; k < topology_.joints.size(); ++k) {
      if (branches_[k]) continue;
      const Joint& j = topology_.joints[k];
      neighbours[j.a.patch].emplace_back(j.b.patch, agreement(j));
      neighbours[j.b.patch].emplace_back(j.a.patch, agreement(j));
    }
    auto& orientations = topology_.orientations;
    for (std::uint32_t root = 0; root < patches_.size(); ++root) {
      if (orientations[root] != 0) continue;
      std::vector<std::uint32_t>& whole = wholes_.emplace_back(1, root);
      orientations[root] = stated_.orientation;
      for (std::size_t next = 0; next < whole.size(); ++next)
        for (const auto& [patch, agrees] : neighbours[whole[next]])
          if (orientations[patch] == 0) {
            orientations[patch] = orientations[whole[next]] * agrees;
            whole.push_back(patch);
          }
    }
  }

  void judgeJoints() {
    for (std::size_t k = 0; k < topology_.joints.size(); ++k) {
      Joint& j = topology_.joints[k];
      const int agrees = agreement(j);
      j.flipped =
          !branches_[k] && topology_.orientations[j.a.patch] * topology_.orientations[j.b.patch] * agrees < 0;
      if (j.flipped) topology_.orientable = false;
      const EdgeNormals &a = normalsAlong(edgeIndex(j.a)), &b = normalsAlong(edgeIndex(j.b));
      j.smooth = !branches_[k];
      // The ends are corners of other edges: poles and apexes among them.
      for (std::size_t i = 1; i + 1 < a.size(); ++i) {
        const Vec3& opposite = b[j.reversed ? b.size() - 1 - i : i];
        if (!(glm::length(a[i] - static_cast<double>(agrees) * opposite) < kSameDirection)) j.smooth = false;
      }
    }
  }

  /// Whole by whole: has it a border, does it enclose a volume, and on which side of its patches?
  void judgeWholes() {
    std::vector<bool> branched(patches_.size());
    for (std::size_t k = 0; k < topology_.joints.size(); ++k)
      if (branches_[k] || topology_.joints[k].flipped)
        branched[topology_.joints[k].a.patch] = branched[topology_.joints[k].b.patch] = true;
    topology_.closed = topology_.borderless = true;
    for (const auto& whole : wholes_) {
      const bool borderless = std::ranges::all_of(whole, [&](std::uint32_t patch) {
        return std::ranges::none_of(topology_.edges[patch],
                                    [](const EdgeKind& e) { return e.kind == Edge::Border; });
      });
      const bool manifold = std::ranges::none_of(whole, [&](std::uint32_t patch) { return branched[patch]; });
      topology_.borderless = topology_.borderless && borderless;
      const double volume = borderless && manifold && !hasHoles(whole) ? signedVolumePart(whole) : 0;
      if (!(std::abs(volume) > kNoVolume)) topology_.closed = false;
      if (std::abs(volume) > kNoVolume && volume < 0)
        for (const std::uint32_t patch : whole) topology_.orientations[patch] *= -1;
    }
  }

  [[nodiscard]] bool hasHoles(const std::vector<std::uint32_t>& whole) const {
    return std::ranges::any_of(whole, [&](std::uint32_t index) {
      const Patch& patch = patches_[index];
      return !findHoles(patch, PatchInputs(patch, parameters_)).empty();
    });
  }

  /// Signed volume by the divergence theorem, midpoint rule, as a part of what would be summed without signs:
  /// its sign tells which way the oriented cross products point; near 0 there is no inside, however thin the
  /// surface.
  double signedVolumePart(const std::vector<std::uint32_t>& whole) {
    const int cells = std::max(6, static_cast<int>(48 / std::sqrt(static_cast<double>(whole.size()))));
    double volume = 0, unsignedVolume = 0;
    for (const std::uint32_t index : whole) {
      const Patch& patch = patches_[index];
      std::vector<double> us, vs;
      for (int i = 0; i < cells; ++i) {
        us.push_back(patch.domain.u.lo + patch.domain.u.width() * (i + 0.5) / cells);
        vs.push_back(patch.domain.v.lo + patch.domain.v.width() * (i + 0.5) / cells);
      }
      const double area = patch.domain.u.width() * patch.domain.v.width() / (cells * cells);
      const auto t = patch.function->tangents.evaluateGrid(us, vs, PatchInputs(patch, parameters_));
      for (std::size_t i = 0; i < t[0].size(); ++i) {
        const Vec3 arm = Vec3(t[0][i], t[1][i], t[2][i]) - center_;
        const Vec3 cross = glm::cross(Vec3(t[3][i], t[4][i], t[5][i]), Vec3(t[6][i], t[7][i], t[8][i]));
        const double cone = topology_.orientations[index] * area * glm::dot(arm, cross);
        volume += cone;
        unsignedVolume += std::abs(cone);
      }
    }
    return unsignedVolume > 0 ? volume / unsignedVolume : 0;
  }

  /// Corners, edges and faces that are left when what is joined counts once.
  int eulerCharacteristic() {
    DisjointSets corners(4 * patches_.size()), curves(4 * patches_.size());
    int collapsed = 0;
    for (std::uint32_t e = 0; e < edgeCount(); ++e)
      if (kind(e).collapsed()) {
        ++collapsed;
        corners.unite(cornerOf(edgeAt(e), 0), cornerOf(edgeAt(e), 1));
      }
    for (const Joint& j : topology_.joints) {
      curves.unite(edgeIndex(j.a), edgeIndex(j.b));
      for (const int end : {0, 1})
        corners.unite(cornerOf(j.a, end), cornerOf(j.b, j.reversed ? 1 - end : end));
    }
    return static_cast<int>(corners.count()) - (static_cast<int>(curves.count()) - collapsed) +
           static_cast<int>(patches_.size());
  }

  std::span<const Patch> patches_;
  std::span<const double> parameters_;
  const StatedTopology& stated_;
  Topology topology_;

  std::vector<EdgeCurve> curves_;                   // of every edge
  std::vector<Vec3> points_;                        // finite ones of all patches
  std::vector<EdgeNormals> normals_;                // of every edge; empty until needed
  std::vector<bool> branches_;                      // of every joint: more than two edges share its curve
  std::vector<std::vector<std::uint32_t>> wholes_;  // patches that hang together
  Vec3 center_{0};
  double extent_ = 0, tolerance_ = 0;
};

}  // namespace

Topology findTopology(std::span<const Patch> patches, std::span<const double> parameters,
                      const StatedTopology& stated) {
  return Search(patches, parameters, stated).run();
}

}  // namespace luxo
