// SPDX-License-Identifier: Apache-2.0
#include "reference/roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "math/basis.h"
#include "math/mat2.h"
#include "reference/krawczyk.h"

namespace luxo::reference {
namespace {

constexpr double kSmallest = 1e-13;      // of the domain
constexpr double kSamePoint = 1e-9;      // of the distance
constexpr double kSameParameter = 1e-7;  // of the domain: Newton's last step, where a ray grazes
// Per ray. Of two million rays into hard scenes (luxo verify --random) those that were decided took 1,024
// cells at most, all but 4 of a million 512.
constexpr int kMaxCellsInside = 4096;
/// Of each cell of the tree, once something is undecided, or of all roots more than is worth it: what is
/// behind that is to be found all the same.
constexpr int kMaxInDoubt = 64;
/// Where a formula ends: a ray along the rim of a dome looks at more cells the steeper that is.
constexpr int kMaxCellsAtBorders = 1 << 16;
/// Of all roots of a ray: one that runs along its surface has no end of them.
constexpr std::size_t kMaxDoubts = 64;
constexpr int kPolishingSteps = 6;                   // of Newton's method: quadratic once it is near
constexpr int kChordSteps = 4, kMaxApproaches = 16;  // before it is tried again; after that the cell is cut
constexpr double kNarrower = 0.75;                   // a narrowing worth repeating

/// Of two roots in one place: that of the least parameters, where these differ by more than rounding.
bool comesFirst(const CellTree& tree, const Root& a, const Root& b) {
  if (a.patch != b.patch) return a.patch < b.patch;
  const double same = kSameParameter * tree.patch(a.patch).domain().u.width();
  return std::abs(a.u - b.u) > same ? a.u < b.u : a.v < b.v;
}

/// Of a search for every root.
struct AllRoots {
  std::vector<Root> roots;
  std::vector<RootsInOrder::Doubt> doubts;
};

/// Of the nearest root; or, with `all`, of every one.
class Search {
 public:
  Search(const CellTree& tree, const RayFunctions& ray, const RootQuery& query, AllRoots* all = nullptr)
      : all_(all),
        tree_(tree),
        ray_(ray),
        query_(query),
        farthest_(query.farthest),
        size_(std::min(glm::length(tree.nodes()[0].half), tree.size())) {}

  Roots run() {
    struct Visit {
      std::uint32_t node;
      double nearest;
    };
    std::array<Visit, 64> stack;
    int size = 0;
    const auto push = [&](std::uint32_t node) {
      const CellTree::Node& n = tree_.nodes()[node];
      const Enclosure box{n.center, n.half};
      if (ray_.misses(box)) return;
      const Ball t = value(ray_.along, box, ray_.start);
      if (t.hi() < query_.nearest || t.lo() > farthest_) return;
      stack[size++] = {node, t.lo()};
    };
    push(0);
    while (size > 0) {
      const Visit visit = stack[--size];
      if (visit.nearest > farthest_) continue;
      const CellTree::Node& node = tree_.nodes()[visit.node];
      if (node.second == 0) {
        search(tree_.cells()[node.cell]);
        continue;
      }
      const int before = size;
      push(visit.node + 1);
      push(node.second);
      if (size == before + 2 && stack[before].nearest < stack[before + 1].nearest)
        std::swap(stack[before], stack[before + 1]);  // the nearer one is looked at first
    }
    Roots roots{.nearest = found_,
                .certified = undecided_ == kNever || (found_ && undecided_ > found_->t),
                .cells = cells_};
    // An undecided part is within rounding of the ray: taken for a hit, but not for a proven one.
    if (doubtful_ && (!found_ || doubtful_->t < found_->t)) roots.nearest = doubtful_;
    return roots;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// Everything in one cell of the tree, in parts where need be.
  void search(const Cell& cell) {
    patch_ = cell.patch;
    parts_.clear();
    look(cell.domain, cell.bounds);
    int inDoubt = 0;
    while (!parts_.empty()) {
      const Domain part = parts_.back();
      parts_.pop_back();
      ++cells_;
      if (isTooLong(inDoubt)) {
        giveUp();
        parts_.clear();
        return;
      }
      look(part, tree_.patch(patch_).bound(part));
    }
  }

  /// Whether one more part of a cell is not looked at, of which so many were while something was in doubt.
  [[nodiscard]] bool isTooLong(int& inDoubt) const {
    if (all_) return isEndless() && ++inDoubt > kMaxInDoubt;
    return undecided_ == kNever ? cells_ > mostCells_ : ++inDoubt > kMaxInDoubt;
  }

  [[nodiscard]] bool isEndless() const {
    const auto searches = static_cast<double>(1 + all_->roots.size() + all_->doubts.size());
    return all_->doubts.size() > kMaxDoubts || cells_ > mostCells_ * searches;
  }

  void giveUp() {
    if (all_ && !gaveUp_) all_->doubts.push_back({query_.nearest, query_.farthest, {}});
    gaveUp_ = true;
    undecided_ = std::min(undecided_, query_.nearest);
  }

  /// Whether all that could be found between these distances is in doubt as it is.
  [[nodiscard]] bool isInDoubt(const Ball& t) const {
    return all_ && std::ranges::any_of(all_->doubts, [&](const RootsInOrder::Doubt& doubt) {
             const double same = kSamePoint * std::abs(doubt.low);
             return doubt.root && t.lo() >= doubt.low - same && t.hi() <= doubt.high + same;
           });
  }

  void look(Domain d, const CellBounds& b) {
    if (b.empty) {
      mostCells_ = kMaxCellsAtBorders;
      return;
    }
    const Ball t = value(ray_.along, b.position, ray_.start);
    if (ray_.misses(b.position) || t.hi() < query_.nearest || t.lo() > farthest_ || isInDoubt(t)) return;
    const double hu = 0.5 * d.u.width(), hv = 0.5 * d.v.width();
    const Domain& whole = tree_.patch(patch_).domain();
    double cutU = glm::length(b.du.center + b.du.radius) * hu,
           cutV = glm::length(b.dv.center + b.dv.radius) * hv;
    if (b.smooth) {
      const Slopes j{value(ray_.across1, b.du, 0), value(ray_.across1, b.dv, 0), value(ray_.across2, b.du, 0),
                     value(ray_.across2, b.dv, 0)};
      const Ball f1 = value(ray_.across1, b.middle, ray_.offset1);
      const Ball f2 = value(ray_.across2, b.middle, ray_.offset2);
      // Mean value form along the ray's own directions: sharper than the box.
      if (std::abs(f1.center) > f1.radius + j.uu.magnitude() * hu + j.uv.magnitude() * hv ||
          std::abs(f2.center) > f2.radius + j.vu.magnitude() * hu + j.vv.magnitude() * hv)
        return;
      if (frontless(b)) return;
      if (settle(d, hu, hv, j, krawczyk(j, f1, f2, hu, hv))) return;
    }
    const bool smallInSpace = b.smooth && cutU + cutV < kSmallest * size_;
    if (smallInSpace || (hu < kSmallest * whole.u.width() && hv < kSmallest * whole.v.width())) {
      undecided_ = std::min(undecided_, t.lo());
      const double distance = ray_.t(b.middle.center);
      doubtful_ = Root{distance, patch_, d.u.mid(), d.v.mid()};
      if (all_) {
        all_->doubts.push_back({t.lo(), t.hi(), doubtful_});
        return;
      }
      // Of a pole many cells meet the ray in the same point: one of them is enough.
      farthest_ = std::min(farthest_, distance - kSamePoint * std::abs(distance));
      return;
    }
    if (!(std::isfinite(cutU) && std::isfinite(cutV)) || cutU + cutV == 0) {
      cutU = hu / whole.u.width();
      cutV = hv / whole.v.width();
    }
    // Neither side may become so much smaller than the other that only the other is ever cut.
    if (hu < kSmallest * whole.u.width()) cutU = -1;
    if (hv < kSmallest * whole.v.width()) cutV = -1;
    for (const Domain& half : cutU >= cutV ? halvesInU(d) : halvesInV(d)) parts_.push_back(half);
  }

  /// Every point of the cell turns its back to the ray, and backs do not count.
  [[nodiscard]] bool frontless(const CellBounds& b) const {
    if (query_.facing == Facing::Both) return false;
    const Ball d1u = value(ray_.across1, b.du, 0), d1v = value(ray_.across1, b.dv, 0);
    const Ball d2u = value(ray_.across2, b.du, 0), d2v = value(ray_.across2, b.dv, 0);
    const double product = d1u.center * d2v.center - d1v.center * d2u.center;
    const double slack = std::abs(d1u.center) * d2v.radius + std::abs(d2v.center) * d1u.radius +
                         d1u.radius * d2v.radius + std::abs(d1v.center) * d2u.radius +
                         std::abs(d2u.center) * d1v.radius + d1v.radius * d2u.radius;
    return side() * product > slack * (1 + 8 * kEpsilon) + 8 * kEpsilon * std::abs(product);
  }

  /// Sign of det(f by u,v) on backs: across1 x across2 runs along the ray, so the determinant has the sign of
  /// (Su x Sv) . direction.
  [[nodiscard]] double side() const {
    return tree_.surface().topology().orientation(patch_) * (query_.mirrored ? -1 : 1);
  }

  /// Whether nothing is left to do: no root, or the only one found. May narrow the cell instead and push it.
  bool settle(const Domain& d, double hu, double hv, const Slopes& slopes,
              const std::optional<Solutions>& solutions) {
    if (!solutions) return false;
    const auto [stepU, stepV, radiusU, radiusV] = *solutions;
    if (solutions->outside(hu, hv)) return true;
    if (solutions->inside(hu, hv)) {
      const std::optional<Vec2> root = rootIn(d, slopes, Vec2(d.u.mid() + stepU, d.v.mid() + stepV));
      if (root) accept(root->x, root->y);
      return root.has_value();
    }
    const auto narrow = [](const Interval& x, double step, double radius) {
      const double middle = x.mid() + step;
      return Interval(std::max(x.lo, middle - radius), std::min(x.hi, middle + radius));
    };
    const Domain narrower{narrow(d.u, stepU, radiusU), narrow(d.v, stepV, radiusV)};
    if (narrower.u.width() < kNarrower * d.u.width() || narrower.v.width() < kNarrower * d.v.width()) {
      if (narrower.u.lo > narrower.u.hi || narrower.v.lo > narrower.v.hi) return true;
      const Domain& whole = tree_.patch(patch_).domain();
      if (narrower.u.width() > kSmallest * whole.u.width() ||
          narrower.v.width() > kSmallest * whole.v.width()) {
        parts_.push_back(narrower);
        return true;
      }
    }
    return false;
  }

  /// The root of a cell in which it is known to be the only one. The chord method, x - f(x) / J with J of the
  /// whole cell, cannot leave the cell and contracts, as Krawczyk's test has proven; Newton's method, which
  /// may run to and fro in a large one, ends it. Nothing, which rounding may cause: the cell is cut.
  [[nodiscard]] std::optional<Vec2> rootIn(const Domain& cell, const Slopes& slopes, Vec2 at) const {
    const Mat2 chord =
        glm::inverse(Mat2(slopes.uu.center, slopes.vu.center, slopes.uv.center, slopes.vv.center));
    const auto inside = [&](const Vec2& p) {
      return Vec2(std::clamp(p.x, cell.u.lo, cell.u.hi), std::clamp(p.y, cell.v.lo, cell.v.hi));
    };
    for (int approach = 0; approach < kMaxApproaches; ++approach) {
      if (const auto root = polished(at, inside)) return root;
      for (int step = 0; step < kChordSteps; ++step) {
        const Vec3 p = tree_.patch(patch_).at(at.x, at.y).position;
        const Vec2 next = inside(at - chord * Vec2(ray_.f1(p), ray_.f2(p)));
        if (!(std::isfinite(next.x) && std::isfinite(next.y))) return std::nullopt;
        at = next;
      }
    }
    return std::nullopt;
  }

  /// By Newton's method. Nothing: it has not come to rest, in two steps at least: what the first of them leaves
  /// the second squares.
  template <class Inside>
  [[nodiscard]] std::optional<Vec2> polished(Vec2 at, const Inside& inside) const {
    const Domain& whole = tree_.patch(patch_).domain();
    const Vec2 rest = kSameParameter * Vec2(whole.u.width(), whole.v.width());
    int atRest = 0;
    for (int step = 0; step < kPolishingSteps; ++step) {
      const BoundedPatch::Point p = tree_.patch(patch_).at(at.x, at.y);
      const double f1 = ray_.f1(p.position), f2 = ray_.f2(p.position);
      const double a = glm::dot(ray_.across1, p.du), b = glm::dot(ray_.across1, p.dv);
      const double c = glm::dot(ray_.across2, p.du), d = glm::dot(ray_.across2, p.dv);
      const Vec2 way = Vec2(b * f2 - d * f1, c * f1 - a * f2) / (a * d - b * c);
      if (!(std::isfinite(way.x) && std::isfinite(way.y))) break;
      // Not where the edge of the cell has held it.
      const bool rests = std::abs(way.x) <= rest.x && std::abs(way.y) <= rest.y;
      atRest = rests ? atRest + 1 : 0;
      const Vec2 last = at;
      at = inside(at + way);
      if (at == last) return rests ? std::optional(at) : std::nullopt;
    }
    return atRest > 1 ? std::optional(at) : std::nullopt;
  }

  void accept(double u, double v) {
    const BoundedPatch& patch = tree_.patch(patch_);
    const BoundedPatch::Point p = patch.at(u, v);
    const Domain& domain = patch.domain();
    const double slackU = kOnTheEdge * domain.u.width(), slackV = kOnTheEdge * domain.v.width();
    if (u < domain.u.lo - slackU || u > domain.u.hi + slackU || v < domain.v.lo - slackV ||
        v > domain.v.hi + slackV)
      return;
    u = std::clamp(u, domain.u.lo, domain.u.hi);
    v = std::clamp(v, domain.v.lo, domain.v.hi);
    const double t = ray_.t(p.position);
    if (!(t >= query_.nearest && t <= farthest_)) return;
    if (query_.facing == Facing::Front) {
      const double det = glm::dot(ray_.across1, p.du) * glm::dot(ray_.across2, p.dv) -
                         glm::dot(ray_.across1, p.dv) * glm::dot(ray_.across2, p.du);
      if (side() * det > 0) return;
    }
    take({t, patch_, u, v});
  }

  /// Of points in one place, where a surface covers itself or closes, that of the least parameters, whatever
  /// the order of cells.
  void take(const Root& root) {
    if (all_) {
      all_->roots.push_back(root);
      return;
    }
    const double same = kSamePoint * std::abs(root.t);
    if (found_ && std::abs(root.t - found_->t) <= same && comesFirst(tree_, *found_, root)) return;
    found_ = root;
    farthest_ = std::min(farthest_, root.t + same);
  }

  AllRoots* all_;
  const CellTree& tree_;
  const RayFunctions& ray_;
  const RootQuery& query_;
  double farthest_;  // no root beyond matters
  double size_;      // of the whole surface
  std::optional<Root> found_, doubtful_;
  double undecided_ = kNever;  // nearest t that an undecided part may have
  std::uint32_t patch_ = 0;
  std::vector<Domain> parts_;
  int cells_ = 0, mostCells_ = kMaxCellsInside;
  bool gaveUp_ = false;
};

}  // namespace

RayFunctions::RayFunctions(const Ray& ray, const Transform& worldFromObject) {
  const auto [n1, n2] = completed(ray.direction);
  const Mat3 transposed = glm::transpose(worldFromObject.linear);
  const Vec3 from = worldFromObject.translation - ray.origin;
  across1 = transposed * n1;
  across2 = transposed * n2;
  along = transposed * ray.direction;
  offset1 = glm::dot(n1, from);
  offset2 = glm::dot(n2, from);
  start = glm::dot(ray.direction, from);
  for (int axis = 0; axis < 3; ++axis) {
    const double part1 = across2[axis], part2 = -across1[axis];
    const auto combined = [&](double a1, double a2) { return part1 * a1 + part2 * a2; };
    const auto products = [&](double a1, double a2) { return std::abs(part1 * a1) + std::abs(part2 * a2); };
    Beside& beside = beside_[axis];
    for (int k = 0; k < 2; ++k) {
      const int other = (axis + 1 + k) % 3;
      beside.slopes[k] = combined(across1[other], across2[other]);
      beside.rounding[k] = products(across1[other], across2[other]);
    }
    beside.offset = combined(offset1, offset2);
    beside.offsetRounding = products(offset1, offset2);
  }
}

bool RayFunctions::misses(const Enclosure& box) const {
  for (int axis = 0; axis < 3; ++axis) {
    const Beside& b = beside_[axis];
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const double center = b.slopes[0] * box.center[j] + b.slopes[1] * box.center[k] + b.offset;
    const double radius = std::abs(b.slopes[0]) * box.radius[j] + std::abs(b.slopes[1]) * box.radius[k];
    // Two products and a sum make each slope and the offset; two products and two sums, these. No slope is
    // larger than its products.
    const double rounding = b.rounding[0] * (std::abs(box.center[j]) + box.radius[j]) +
                            b.rounding[1] * (std::abs(box.center[k]) + box.radius[k]) + b.offsetRounding;
    if (std::abs(center) > radius + 8 * kEpsilon * rounding) return true;
  }
  return false;
}

Roots nearestRoot(const CellTree& tree, const RayFunctions& ray, const RootQuery& query) {
  if (tree.nodes().empty()) return {};  // no point has a value
  return Search(tree, ray, query).run();
}

RootsInOrder::RootsInOrder(const CellTree& tree, const RayFunctions& ray, const RootQuery& query)
    : tree_(tree) {
  if (tree.nodes().empty()) return;
  AllRoots all;
  cells_ = Search(tree, ray, query, &all).run().cells;
  roots_ = std::move(all.roots);
  doubts_ = std::move(all.doubts);
  std::ranges::sort(roots_, {}, &Root::t);
}

Roots RootsInOrder::from(double nearest) const {
  Roots roots{.cells = cells_};
  const auto first = std::ranges::lower_bound(roots_, nearest, {}, &Root::t);
  if (first != roots_.end()) {
    roots.nearest = *first;
    for (auto next = first + 1; next != roots_.end() && next->t - first->t <= kSamePoint * std::abs(first->t);
         ++next)
      if (comesFirst(tree_, *next, *roots.nearest)) roots.nearest = *next;
  }
  for (const Doubt& doubt : doubts_) {
    if (doubt.high < nearest || (roots.nearest && doubt.low > roots.nearest->t)) continue;
    roots.certified = false;
    if (doubt.root && doubt.root->t >= nearest && (!roots.nearest || doubt.root->t < roots.nearest->t))
      roots.nearest = doubt.root;
  }
  return roots;
}

}  // namespace luxo::reference
