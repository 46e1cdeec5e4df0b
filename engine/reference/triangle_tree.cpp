// SPDX-License-Identifier: Apache-2.0
#include "reference/triangle_tree.h"

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "reference/krawczyk.h"

namespace luxo::reference {
namespace {

// Both decide about time, and which of two triangles that meet where the ray does is told: a ray looks at
// every triangle whose box it may meet. Chosen, not measured.
constexpr std::uint32_t kMaxInLeaf = 4;
constexpr std::size_t kBins = 16;               // of the surface area heuristic (I. Wald 2007)
constexpr std::size_t kWorthThreads = 1 << 13;  // triangles, about a millisecond
constexpr double kNever = std::numeric_limits<double>::infinity();

using Node = TriangleTree::Node;

struct FloatBox {
  Vec3f low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

  void add(const Vec3f& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const FloatBox& box) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
  /// Half of it.
  [[nodiscard]] float area() const {
    const Vec3f e = high - low;
    return e.x < 0 ? 0 : e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

class Builder {
 public:
  Builder(std::span<const FloatBox> boxes, std::span<std::uint32_t> order) : boxes_(boxes), order_(order) {}

  /// The nodes of a part of the order, children counted from its own root.
  [[nodiscard]] std::vector<Node> build(std::size_t begin, std::size_t end) const {
    FloatBox box, middles;
    for (std::size_t i = begin; i < end; ++i) {
      box.add(boxes_[order_[i]]);
      middles.add(middleOf(order_[i]));
    }
    const std::size_t count = end - begin;
    if (count <= kMaxInLeaf)
      return {{box.low, box.high, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(count)}};
    const std::size_t middle = split(begin, end, middles);
    std::vector<Node> first, second;
    const auto halves = [&](const auto& a, const auto& b) {
      count >= kWorthThreads ? tbb::parallel_invoke(a, b) : (a(), b());
    };
    halves([&] { first = build(begin, middle); }, [&] { second = build(middle, end); });
    std::vector<Node> nodes;
    nodes.reserve(1 + first.size() + second.size());
    nodes.push_back({box.low, box.high, static_cast<std::uint32_t>(1 + first.size()), 0});
    append(nodes, first);
    append(nodes, second);
    return nodes;
  }

 private:
  [[nodiscard]] Vec3f middleOf(std::uint32_t triangle) const {
    return 0.5F * boxes_[triangle].low + 0.5F * boxes_[triangle].high;
  }

  static void append(std::vector<Node>& nodes, const std::vector<Node>& part) {
    const auto offset = static_cast<std::uint32_t>(nodes.size());
    for (Node node : part) {
      if (node.count == 0) node.first += offset;
      nodes.push_back(node);
    }
  }

  /// Where the halves' areas times their triangles are least; in half where all is in one place.
  [[nodiscard]] std::size_t split(std::size_t begin, std::size_t end, const FloatBox& middles) const {
    const Vec3f extent = middles.high - middles.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t half = begin + (end - begin) / 2;
    const float scale = static_cast<float>(kBins) / extent[axis];
    if (!(extent[axis] > 0) || !std::isfinite(scale)) return half;
    const auto binOf = [&](std::uint32_t triangle) {
      return std::min(static_cast<std::size_t>((middleOf(triangle)[axis] - middles.low[axis]) * scale),
                      kBins - 1);
    };
    std::array<FloatBox, kBins> boxes;
    std::array<std::size_t, kBins> counts{};
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t bin = binOf(order_[i]);
      boxes[bin].add(boxes_[order_[i]]);
      ++counts[bin];
    }
    std::array<float, kBins> costs{};  // of the bins from there on
    FloatBox above;
    std::size_t countAbove = 0;
    for (std::size_t bin = kBins; bin-- > 1;) {
      above.add(boxes[bin]);
      countAbove += counts[bin];
      costs[bin] = above.area() * static_cast<float>(countAbove);
    }
    FloatBox below;
    std::size_t countBelow = 0, best = 1;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t bin = 1; bin < kBins; ++bin) {
      below.add(boxes[bin - 1]);
      countBelow += counts[bin - 1];
      const float cost = below.area() * static_cast<float>(countBelow) + costs[bin];
      if (cost < least) least = cost, best = bin;
    }
    const auto part = order_.subspan(begin, end - begin);
    const auto upper =
        std::stable_partition(part.begin(), part.end(), [&](std::uint32_t t) { return binOf(t) < best; });
    const auto middle = begin + static_cast<std::size_t>(upper - part.begin());
    return middle == begin || middle == end ? half : middle;
  }

  std::span<const FloatBox> boxes_;
  std::span<std::uint32_t> order_;
};

/// A corner as the ray sees it.
struct Corner {
  double x, y, t;
};

/// Twice the area that an edge spans with the ray, and what rounding may have made of it.
struct EdgeSign {
  double value, error;

  [[nodiscard]] bool positive() const { return value > error; }
  [[nodiscard]] bool negative() const { return value < -error; }
  [[nodiscard]] bool open() const { return !positive() && !negative(); }
};

/// An edge that the ray may meet, by its ends, and on which side of it a triangle is.
struct OpenEdge {
  std::array<Vec3, 2> ends;
  int side;
  double t;

  OpenEdge(const Vec3& a, const Vec3& b, int turn, double nearest) : ends{a, b}, side(turn), t(nearest) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) {
      std::swap(ends[0], ends[1]);
      side = -side;
    }
  }
};

class TriangleSearch {
 public:
  TriangleSearch(const TriangleTree& tree, const RayFunctions& ray, const RootQuery& query)
      : tree_(tree), ray_(ray), query_(query), farthest_(query.farthest) {
    // A dot product of three and a sum.
    const auto rounding = [&](const Vec3& across, double offset) {
      return 4 * kEpsilon * (glm::dot(glm::abs(across), tree.reach()) + std::abs(offset));
    };
    roundingX_ = rounding(ray.across1, ray.offset1);
    roundingY_ = rounding(ray.across2, ray.offset2);
    // Where triangles meet they are as near to the eye, but for what rounding makes of slopes.
    slack_ = 1e-9 * (glm::dot(glm::abs(ray.along), tree.reach()) + std::abs(ray.start));
  }

  Roots run() {
    struct Visit {
      std::uint32_t node;
      double nearest;
    };
    std::vector<Visit> stack;
    stack.reserve(64);
    const Vec3& origin = tree_.triangles().mesh.origin();
    const auto push = [&](std::uint32_t index) {
      const Node& n = tree_.nodes()[index];
      const Vec3 low(n.low), high(n.high);
      const Enclosure box{origin + 0.5 * (low + high), 0.5 * (high - low) + 4 * kEpsilon * tree_.reach()};
      ++roots_.cells;
      if (ray_.misses(box)) return;
      const Ball t = value(ray_.along, box, ray_.start);
      if (t.hi() < query_.nearest || t.lo() > farthest_ + slack_) return;
      stack.push_back({index, t.lo()});
    };
    push(0);
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      if (visit.nearest > farthest_ + slack_) continue;
      const Node& node = tree_.nodes()[visit.node];
      for (std::uint32_t i = 0; i < node.count; ++i) look(tree_.order()[node.first + i]);
      if (node.count > 0) continue;
      const std::size_t before = stack.size();
      push(visit.node + 1);
      push(node.first);
      if (stack.size() == before + 2 && stack[before].nearest < stack[before + 1].nearest)
        std::swap(stack[before], stack[before + 1]);  // the nearer one is looked at first
    }
    roots_.certified = decided();
    return roots_;
  }

 private:
  [[nodiscard]] Corner cornerAt(const Vec3& p) const { return {ray_.f1(p), ray_.f2(p), ray_.t(p)}; }

  [[nodiscard]] EdgeSign edge(const Corner& a, const Corner& b) const {
    const double one = a.x * b.y, other = a.y * b.x;
    return {one - other, roundingX_ * (std::abs(a.y) + std::abs(b.y)) +
                             roundingY_ * (std::abs(a.x) + std::abs(b.x)) + 2 * roundingX_ * roundingY_ +
                             kEpsilon * (std::abs(one) + std::abs(other))};
  }

  void look(std::uint32_t triangle) {
    const std::array<Vec3, 3> points = tree_.triangles().points(triangle);
    const std::array<Corner, 3> c{cornerAt(points[0]), cornerAt(points[1]), cornerAt(points[2])};
    const std::array<EdgeSign, 3> e{edge(c[1], c[2]), edge(c[2], c[0]), edge(c[0], c[1])};
    const bool anyPositive = e[0].positive() || e[1].positive() || e[2].positive(),
               anyNegative = e[0].negative() || e[1].negative() || e[2].negative();
    if (anyPositive && anyNegative) return;
    const double area = e[0].value + e[1].value + e[2].value;
    if (!anyPositive && !anyNegative) {
      lookAtThin(c);
      return;
    }
    if (query_.facing == Facing::Front && (query_.mirrored ? -area : area) > 0) return;
    const bool hit = area > 0 ? e[0].value >= 0 && e[1].value >= 0 && e[2].value >= 0
                              : e[0].value <= 0 && e[1].value <= 0 && e[2].value <= 0;
    std::array<double, 3> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += weights[i] = std::max(area > 0 ? e[i].value : -e[i].value, 0.0);
    const double u = weights[1] / sum, v = weights[2] / sum;
    const double t = c[0].t + u * (c[1].t - c[0].t) + v * (c[2].t - c[0].t);
    if (t < query_.nearest || t > farthest_ + slack_) return;
    for (std::size_t i = 0; i < 3; ++i)
      if (e[i].open()) open_.emplace_back(points[(i + 1) % 3], points[(i + 2) % 3], area > 0 ? 1 : -1, t);
    if (!hit || t > farthest_) return;
    farthest_ = t;
    roots_.nearest = Root{t, triangle, u, v};
  }

  /// All edges lead through the ray, within rounding: it is seen edge-on, or is as small as that.
  void lookAtThin(const std::array<Corner, 3>& c) {
    const auto beside = [&](double Corner::*coordinate, double rounding) {
      const auto [low, high] = std::minmax({c[0].*coordinate, c[1].*coordinate, c[2].*coordinate});
      return low > rounding || high < -rounding;
    };
    if (beside(&Corner::x, roundingX_) || beside(&Corner::y, roundingY_)) return;
    const auto [low, high] = std::minmax({c[0].t, c[1].t, c[2].t});
    if (high < query_.nearest || low > farthest_ + slack_) return;
    undecided_ = std::min(undecided_, low);
  }

  /// Whether nothing before the nearest root, nor that one, hangs on an edge with triangles on one side only.
  [[nodiscard]] bool decided() const {
    if (undecided_ <= farthest_ + slack_ && undecided_ != kNever) return false;
    return std::ranges::all_of(open_, [&](const OpenEdge& one) {
      return one.t > farthest_ + slack_ || std::ranges::any_of(open_, [&](const OpenEdge& other) {
               return other.ends == one.ends && other.side == -one.side;
             });
    });
  }

  const TriangleTree& tree_;
  const RayFunctions& ray_;
  const RootQuery& query_;
  double farthest_, roundingX_ = 0, roundingY_ = 0, slack_ = 0, undecided_ = kNever;
  Roots roots_;
  std::vector<OpenEdge> open_;
};

}  // namespace

TriangleTree::TriangleTree(const SurfaceTriangles& triangles) : triangles_(triangles) {
  const TriangleMesh& mesh = triangles_.mesh;
  std::vector<FloatBox> boxes(triangles.count);
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const std::uint32_t vertex : triangles.corners(i)) boxes[i].add(mesh.positions()[vertex]);
  order_.resize(triangles.count);
  std::iota(order_.begin(), order_.end(), 0U);
  const Builder builder(boxes, order_);
  // Isolated: a thread that waits for its part of this must not begin a ray that waits for this.
  tbb::this_task_arena::isolate([&] { nodes_ = builder.build(0, order_.size()); });
  reach_ = glm::max(glm::abs(mesh.bounds().min), glm::abs(mesh.bounds().max));
}

Roots nearestRoot(const TriangleTree& tree, const RayFunctions& ray, const RootQuery& query) {
  return TriangleSearch(tree, ray, query).run();
}

}  // namespace luxo::reference
