// SPDX-License-Identifier: Apache-2.0
#include "reference/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "base/assert.h"
#include "reference/krawczyk.h"

namespace luxo::reference {
namespace {

constexpr double kOutward = 1 + 1e-12;  // beams are a little wider than their squares
constexpr double kSmallest = 1e-13;     // side of a cell, of the domain
constexpr double kInflation = 2;        // a rectangle's size over that of what the beam sees of it
constexpr int kNewtonSteps = 8;
constexpr double kNearEnough = 0.05;    // of the rectangle
constexpr int kMaxTrials = 3;           // proofs per square: most cells lead to the same point
constexpr int kMaxCandidates = 20'000;  // cells of one square, after which it stays undecided

/// A square of the picture, in pixels.
struct Square {
  double x = 0, y = 0, half = 0;
};

/// All rays through a square, as a surface placed in the world sees them. Point p lies on the ray of
/// picture coordinates (a, b), x to the right and y down, where f1(p) = f2(p) = 0; a and b are anywhere
/// within half1 and half2 of those in the middle: perspective f1 = (right - a forward) . (p - eye),
/// orthographic f1 = right . (p - eye) - a.
class Beam {
 public:
  Beam(const View& view, const Transform& worldFromObject, const Square& square)
      : perspective_(view.perspective()) {
    const double a = (2 * square.x / view.size.width - 1) * view.halfExtent.x;
    const double b = (2 * square.y / view.size.height - 1) * view.halfExtent.y;
    // The second term: what rounding left in a and b.
    half1_ =
        2 * square.half / view.size.width * view.halfExtent.x * kOutward + 4 * kEpsilon * view.halfExtent.x;
    half2_ =
        2 * square.half / view.size.height * view.halfExtent.y * kOutward + 4 * kEpsilon * view.halfExtent.y;
    const Mat3 transposed = glm::transpose(worldFromObject.linear);
    const Vec3 from = worldFromObject.translation - view.eye, forward = view.forward();
    const Vec3 n1 = view.right() - (perspective_ ? a * forward : Vec3(0));
    const Vec3 n2 = -view.up() - (perspective_ ? b * forward : Vec3(0));
    across_ = {transposed * n1, transposed * n2};
    offset_ = {glm::dot(n1, from) - (perspective_ ? 0 : a), glm::dot(n2, from) - (perspective_ ? 0 : b)};
    along_ = transposed * forward;
    start_ = glm::dot(forward, from);
  }

  [[nodiscard]] Ball depth(const Enclosure& p) const { return value(along_, p, start_); }

  /// c f1 + s f2 over all p, and all rays.
  [[nodiscard]] Ball at(double c, double s, const Enclosure& p) const {
    Ball f = mixed(c, s, p, c * offset_[0] + s * offset_[1]);
    f.radius += 4 * kEpsilon * (std::abs(c * offset_[0]) + std::abs(s * offset_[1]));
    return spread(f, c, s, perspective_ ? depth(p).magnitude() : 1);
  }

  /// What that changes by along a tangent.
  [[nodiscard]] Ball slope(double c, double s, const Enclosure& tangent) const {
    return spread(mixed(c, s, tangent, 0), c, s, perspective_ ? value(along_, tangent, 0).magnitude() : 0);
  }

  [[nodiscard]] Slopes slopes(const CellBounds& b) const {
    return {slope(1, 0, b.du), slope(1, 0, b.dv), slope(0, 1, b.du), slope(0, 1, b.dv)};
  }

  /// Half the beam's width at a depth: along f1, along f2.
  [[nodiscard]] Vec2 halfWidth(double depth) const {
    return Vec2(half1_, half2_) * (perspective_ ? std::abs(depth) : 1.0);
  }

  /// In the middle of the beam.
  [[nodiscard]] Vec2 offset(const Vec3& p) const {
    return {glm::dot(across_[0], p) + offset_[0], glm::dot(across_[1], p) + offset_[1]};
  }
  [[nodiscard]] Vec2 offsetSlope(const Vec3& tangent) const {
    return {glm::dot(across_[0], tangent), glm::dot(across_[1], tangent)};
  }

 private:
  [[nodiscard]] Ball mixed(double c, double s, const Enclosure& p, double offset) const {
    Ball f = value(c * across_[0] + s * across_[1], p, offset);
    const Vec3 size = std::abs(c) * glm::abs(across_[0]) + std::abs(s) * glm::abs(across_[1]);
    f.radius += 4 * kEpsilon * glm::dot(size, glm::abs(p.center) + p.radius);
    return f;
  }

  [[nodiscard]] Ball spread(Ball f, double c, double s, double depth) const {
    f.radius += (std::abs(c) * half1_ + std::abs(s) * half2_) * depth * (1 + 8 * kEpsilon);
    return f;
  }

  bool perspective_;
  std::array<Vec3, 2> across_;
  Vec3 along_;
  std::array<double, 2> offset_;
  double start_, half1_, half2_;
};

/// A node that may be seen in the pixel.
struct Body {
  const CellTree* tree;
  Transform worldFromObject;
  Facing facing;
  bool mirrored;
};

struct Candidate {
  std::uint32_t body = 0;
  Cell cell;
};

using Candidates = std::vector<Candidate>;

struct Undecided {
  Square square;
  std::shared_ptr<const Candidates> candidates;  ///< the parent's
};

class PixelCut {
 public:
  PixelCut(const Caster& caster, std::optional<std::uint32_t> node) : view_(caster.snapshot().view) {
    for (std::uint32_t i = 0; i < caster.snapshot().nodes.size(); ++i) {
      if (node && *node != i) continue;
      const PlacedShape& shape = caster.shape(i);
      LUXO_REQUIRE(!caster.snapshot().nodes[i].surface.triangles());
      bodies_.push_back(
          {&shape.shape().cells(), shape.worldFromObject(), caster.facing(i), caster.mirrored(i)});
    }
  }

  CoverageBounds run(const Square& pixel, double resolution) {
    double covered = 0, open = 1;  // parts of the area; powers of 4 add without rounding
    std::vector<Undecided> level{{pixel, std::make_shared<const Candidates>(gather(pixel))}};
    for (double area = 1; !level.empty() && open > resolution; area /= 4) {
      std::vector<Undecided> next;
      const bool last = std::sqrt(area) <= resolution / 32;
      for (const Undecided& part : level) {
        auto candidates = std::make_shared<Candidates>();
        switch (decide(part.square, *part.candidates, *candidates)) {
          case Verdict::Covered:
            covered += area;
            open -= area;
            break;
          case Verdict::Empty:
            open -= area;
            break;
          case Verdict::Open:
            for (const Square& quarter : quarters(part.square)) next.push_back({quarter, candidates});
        }
        if (open <= resolution) return {covered, covered + open};
      }
      if (last) break;
      level = std::move(next);
    }
    return {covered, covered + open};
  }

 private:
  enum class Verdict { Covered, Empty, Open };

  static std::array<Square, 4> quarters(const Square& s) {
    const double h = 0.5 * s.half;
    return {{{s.x - h, s.y - h, h}, {s.x + h, s.y - h, h}, {s.x - h, s.y + h, h}, {s.x + h, s.y + h, h}}};
  }

  /// The cells of all bodies whose boxes meet the beam.
  [[nodiscard]] Candidates gather(const Square& square) const {
    Candidates found;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      const CellTree& tree = *bodies_[i].tree;
      if (tree.nodes().empty()) continue;
      const Beam beam(view_, bodies_[i].worldFromObject, square);
      std::vector<std::uint32_t> stack{0};
      while (!stack.empty()) {
        const std::uint32_t index = stack.back();
        const CellTree::Node& node = tree.nodes()[index];
        stack.pop_back();
        if (passesBy(beam, {node.center, node.half})) continue;
        if (node.second != 0) {
          stack.push_back(node.second);
          stack.push_back(index + 1);
          continue;
        }
        Cell cell = tree.cells()[node.cell];  // without what cells have beyond the domain
        const Domain& domain = tree.patch(cell.patch).domain();
        cell.domain = {{std::max(cell.domain.u.lo, domain.u.lo), std::min(cell.domain.u.hi, domain.u.hi)},
                       {std::max(cell.domain.v.lo, domain.v.lo), std::min(cell.domain.v.hi, domain.v.hi)}};
        cell.bounds = tree.patch(cell.patch).bound(cell.domain);
        found.push_back({i, cell});
      }
    }
    return found;
  }

  Verdict decide(const Square& square, const Candidates& candidates, Candidates& remaining) const {
    std::vector<Beam> beams;
    for (const Body& body : bodies_) beams.emplace_back(view_, body.worldFromObject, square);
    Candidates open(candidates.rbegin(), candidates.rend());
    int trials = 0;
    for (int looked = 0; !open.empty(); ++looked) {
      const Candidate c = open.back();
      open.pop_back();
      const Beam& beam = beams[c.body];
      if (misses(beam, c)) continue;
      if (trials < kMaxTrials && covers(beam, c, trials)) return Verdict::Covered;
      const auto parts = looked < kMaxCandidates ? cut(beam, c) : std::nullopt;
      if (!parts) {
        remaining.push_back(c);
        continue;
      }
      const BoundedPatch& patch = bodies_[c.body].tree->patch(c.cell.patch);
      for (const Domain& part : *parts) open.push_back({c.body, {c.cell.patch, part, patch.bound(part)}});
    }
    if (remaining.empty()) return Verdict::Empty;
    return Verdict::Open;
  }

  [[nodiscard]] bool passesBy(const Beam& beam, const Enclosure& points) const {
    const Ball depth = beam.depth(points);
    return depth.hi() < view_.near || depth.lo() > view_.far || beam.at(1, 0, points).excludesZero() ||
           beam.at(0, 1, points).excludesZero();
  }

  /// No ray of the beam meets the cell in a point that counts.
  [[nodiscard]] bool misses(const Beam& beam, const Candidate& c) const {
    const CellBounds& b = c.cell.bounds;
    if (passesBy(beam, b.position)) return true;
    if (!b.smooth) return false;
    const double hu = 0.5 * c.cell.domain.u.width() * kOutward, hv = 0.5 * c.cell.domain.v.width() * kOutward;
    const Slopes j = beam.slopes(b);
    if (backward(c.body, c.cell.patch, j)) return true;
    const auto excluded = [&](double cosine, double sine) {  // by the mean value form
      const Ball f = beam.at(cosine, sine, b.middle);
      return std::abs(f.center) > (f.radius + beam.slope(cosine, sine, b.du).magnitude() * hu +
                                   beam.slope(cosine, sine, b.dv).magnitude() * hv) *
                                      (1 + 8 * kEpsilon);
    };
    if (excluded(1, 0) || excluded(0, 1)) return true;
    // Across the longer tangent, as the picture shows it: near a silhouette the other is parallel to it.
    const Vec2 u = Vec2(j.uu.center, j.vu.center) * hu, v = Vec2(j.uv.center, j.vv.center) * hv;
    const Vec2 longer = glm::dot(u, u) > glm::dot(v, v) ? u : v;
    if (const double length = glm::length(longer);
        length > 0 && excluded(-longer.y / length, longer.x / length))
      return true;
    const auto solutions = krawczyk(j, beam.at(1, 0, b.middle), beam.at(0, 1, b.middle), hu, hv);
    return solutions && solutions->outside(hu, hv);
  }

  /// All points turn their backs, and backs do not count.
  [[nodiscard]] bool backward(std::uint32_t body, std::uint32_t patch, const Slopes& j) const {
    if (bodies_[body].facing == Facing::Both) return false;
    const auto product = [](const Ball& a, const Ball& b) {
      const double center = a.center * b.center;
      return Ball{center, std::abs(a.center) * b.radius + std::abs(b.center) * a.radius +
                              a.radius * b.radius + 4 * kEpsilon * std::abs(center)};
    };
    const Ball a = product(j.uu, j.vv), b = product(j.uv, j.vu);
    return side(body, patch) * (a.center - b.center) > (a.radius + b.radius) * (1 + 8 * kEpsilon);
  }

  /// Sign of the slopes' determinant on backs: across1 x across2 runs along the ray.
  [[nodiscard]] double side(std::uint32_t body, std::uint32_t patch) const {
    return bodies_[body].tree->surface().topology().orientation(patch) * (bodies_[body].mirrored ? -1 : 1);
  }

  /// The halves of a cell that is much larger in the picture than the beam: across the side that takes up
  /// more of the picture, so that near an outline cells stay long in the direction of the rays.
  [[nodiscard]] std::optional<Halves> cut(const Beam& beam, const Candidate& c) const {
    const Domain &d = c.cell.domain, &whole = bodies_[c.body].tree->patch(c.cell.patch).domain();
    const bool cutsU = d.u.width() > kSmallest * whole.u.width(),
               cutsV = d.v.width() > kSmallest * whole.v.width();
    if (!cutsU && !cutsV) return std::nullopt;
    const CellBounds& b = c.cell.bounds;
    if (!b.smooth) return halves(c.cell, whole);
    const Vec2 width = 2.0 * beam.halfWidth(beam.depth(b.position).magnitude());
    const Slopes j = beam.slopes(b);
    const Vec2 u = 0.5 * d.u.width() * Vec2(j.uu.magnitude(), j.vu.magnitude()) / width;
    const Vec2 v = 0.5 * d.v.width() * Vec2(j.uv.magnitude(), j.vv.magnitude()) / width;
    if (u.x + v.x <= 1 && u.y + v.y <= 1) return std::nullopt;
    return cutsU && (!cutsV || u.x + u.y >= v.x + v.y) ? halvesInU(d) : halvesInV(d);
  }

  /// Whether every ray of the beam meets one smooth piece of the surface near the cell, in a point that
  /// counts.
  [[nodiscard]] bool covers(const Beam& beam, const Candidate& c, int& trials) const {
    const BoundedPatch& patch = bodies_[c.body].tree->patch(c.cell.patch);
    const Domain& domain = patch.domain();
    double u = c.cell.domain.u.mid(), v = c.cell.domain.v.mid(), hu = 0, hv = 0;
    for (int step = 0; step < kNewtonSteps; ++step) {  // to the ray in the middle
      const BoundedPatch::Point p = patch.at(u, v);
      const Vec2 f = beam.offset(p.position), fu = beam.offsetSlope(p.du), fv = beam.offsetSlope(p.dv);
      const double det = fu.x * fv.y - fv.x * fu.y;
      if (!(std::abs(det) > 0)) return false;
      const double du = (fv.x * f.y - fv.y * f.x) / det, dv = (fu.y * f.x - fu.x * f.y) / det;
      const Vec2 width = beam.halfWidth(beam.depth({p.position, Vec3(0)}).center);
      hu = kInflation * (std::abs(fv.y) * width.x + std::abs(fv.x) * width.y) / std::abs(det);
      hv = kInflation * (std::abs(fu.y) * width.x + std::abs(fu.x) * width.y) / std::abs(det);
      if (!(std::isfinite(du) && std::isfinite(dv) && std::isfinite(hu) && std::isfinite(hv))) return false;
      u = std::clamp(u + du, domain.u.lo, domain.u.hi);
      v = std::clamp(v + dv, domain.v.lo, domain.v.hi);
      if (std::abs(du) < kNearEnough * hu && std::abs(dv) < kNearEnough * hv) break;
    }
    const Domain part{{u - hu, u + hu}, {v - hv, v + hv}};
    if (part.u.lo < domain.u.lo || part.u.hi > domain.u.hi || part.v.lo < domain.v.lo ||
        part.v.hi > domain.v.hi)
      return false;
    ++trials;
    const CellBounds b = patch.bound(part);
    const Ball depth = beam.depth(b.position);
    if (!b.smooth || !(depth.lo() >= view_.near && depth.hi() <= view_.far)) return false;
    hu = 0.5 * part.u.width() * kOutward, hv = 0.5 * part.v.width() * kOutward;
    const Slopes j = beam.slopes(b);
    const auto solutions = krawczyk(j, beam.at(1, 0, b.middle), beam.at(0, 1, b.middle), hu, hv);
    // Inside of the rectangle without its outermost rounding.
    if (!solutions || !solutions->inside(hu / (kOutward * kOutward), hv / (kOutward * kOutward)))
      return false;
    return bodies_[c.body].facing == Facing::Both || side(c.body, c.cell.patch) * j.determinant() < 0;
  }

  const View& view_;
  std::vector<Body> bodies_;
};

}  // namespace

CoverageBounds pixelCoverage(const Caster& caster, int x, int y, double resolution,
                             std::optional<std::uint32_t> node) {
  LUXO_REQUIRE(resolution > 0 && (!node || *node < caster.snapshot().nodes.size()));
  return PixelCut(caster, node).run({x + 0.5, y + 0.5, 0.5}, resolution);
}

}  // namespace luxo::reference
