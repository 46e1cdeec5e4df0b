// SPDX-License-Identifier: Apache-2.0
#include "surface/displaced.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "formula/factors.h"
#include "formula/pythagoras.h"
#include "formula/slope.h"
#include "formula/variables.h"

namespace luxo {
namespace {

/// Seconds. A displacement that grows from nothing is not nothing then, so that no edge seems joined for
/// that.
constexpr double kAnyTime = 0.7548776662;
constexpr double kSameHeight = 1e-9;  // of the extent, as points are the same (surface/topology.h)

ExprPoint derivative(Graph& graph, const ExprPoint& p, std::uint32_t variable) {
  return {graph.derivative(p[0], variable), graph.derivative(p[1], variable),
          graph.derivative(p[2], variable)};
}

ExprPoint cross(const ExprPoint& a, const ExprPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// -1 or 1 where the formula of u and v alone has one sign all over the rectangle, its edges left out.
std::optional<int> signOver(Graph& graph, Expr formula, const Domain& domain) {
  constexpr double kMargin = 1e-9;  // of a side
  const auto inside = [](const Interval& x) {
    return Interval(x.lo + kMargin * x.width(), x.hi - kMargin * x.width());
  };
  for (const std::uint32_t variable : variablesOf(graph, {&formula, 1}))
    if (variable >= kFirstParameter) return std::nullopt;
  Interval range;
  Tape(graph, {&formula, 1}).bound(inside(domain.u), inside(domain.v), {}, {&range, 1});
  if (range.lo > 0) return 1;
  if (range.hi < 0) return -1;
  return std::nullopt;
}

/// A tangent without what makes it 0 at edges of the rectangle.
struct Direction {
  ExprPoint along;
  int sign = 1;  ///< of what it lacks
};

Direction directionOf(Graph& graph, const ExprPoint& tangent, const Domain& domain) {
  const std::vector<Product> products = factored(graph, tangent);
  std::map<std::uint32_t, int> vanishing;
  Direction direction;
  for (const auto& [node, exponent] : commonFactors(products))
    if (const std::optional<int> sign = signOver(graph, graph.at(node), domain)) {
      vanishing.emplace(node, exponent);
      if (exponent % 2 != 0) direction.sign *= *sign;
    }
  for (std::size_t axis = 0; axis < 3; ++axis)
    direction.along[axis] =
        vanishing.empty() ? tangent[axis] : expressionOf(graph, quotient(products[axis], vanishing));
  return direction;
}

Expr dot(Graph& graph, const ExprPoint& a, const ExprPoint& b) {
  return withoutSquaresOfTurns(graph, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

ExprPoint over(const ExprPoint& a, Expr by) { return {a[0] / by, a[1] / by, a[2] / by}; }

/// Unit. Where the directions are perpendicular, as on surfaces of revolution, each is made unit alone: their
/// lengths are simpler than that of what is across.
ExprPoint normalAcross(Graph& graph, const Direction& u, const Direction& v) {
  const Expr slant = dot(graph, u.along, v.along);
  const bool perpendicular = slant.isConstant() && slant.constant() == 0;
  ExprPoint across = perpendicular ? cross(over(u.along, sqrt(dot(graph, u.along, u.along))),
                                           over(v.along, sqrt(dot(graph, v.along, v.along))))
                                   : cross(u.along, v.along);
  for (Expr& component : across) component = withoutSquaresOfTurns(graph, component);
  const Expr length = perpendicular ? Expr(1) : sqrt(dot(graph, across, across));
  return over(across, u.sign * v.sign * length);
}

bool isBounded(const Tape& tape, const Domain& cell, std::span<const double> inputs) {
  std::vector<Interval> bounds(tape.outputCount());
  tape.bound(cell.u, cell.v, inputs, bounds);
  return std::ranges::all_of(bounds, [](const Interval& x) { return std::isfinite(x.width()); });
}

/// A unit normal as a formula, with a value at edges where Su x Sv is 0, too.
class NormalFormula {
 public:
  NormalFormula(Graph& graph, const ExprPoint& position, const Surface& surface, std::uint32_t patch,
                std::span<const double> parameters)
      : graph_(graph),
        surface_(surface),
        index_(patch),
        patch_(surface.patches()[patch]),
        parameters_(parameters),
        inputs_(patch_, parameters),
        du_(derivative(graph, position, kVariableU)),
        dv_(derivative(graph, position, kVariableV)) {}

  /// Error(Scene): it cannot be found.
  [[nodiscard]] ExprPoint find() {
    const ExprPoint plain = normalAcross(graph_, directionOf(graph_, du_, patch_.domain),
                                         directionOf(graph_, dv_, patch_.domain));
    const std::optional<Side> hidden = firstWithout(plain);
    if (!hidden) return plain;
    const std::optional<ExprPoint> sloped = alongSlopes();
    if (sloped && !firstWithout(*sloped)) return *sloped;
    const bool isU = *hidden == Side::UMin || *hidden == Side::UMax;
    const EdgePoint there = edgePoint(patch_.domain, *hidden, 0);
    throw Error(
        ErrorKind::Scene,
        fmt::format("surface '{}': where {} = {:.4g} its Su x Sv is 0, and its formula does not show the "
                    "normal, which a displacement follows",
                    surface_.name(), isU ? 'u' : 'v', isU ? there.u : there.v),
        "displace one whose tangents have a factor in common there, as those of a sphere have, or "
        "whose range leaves the edge out");
  }

 private:
  /// Whether Su x Sv is 0 along it: where it is one point, or a cusp.
  [[nodiscard]] bool isSingular(Side side) {
    if (surface_.topology().edge(index_, side).collapsed()) return true;
    constexpr double kParallel = 1e-9;
    const Tape tape(graph_, std::array{du_[0], du_[1], du_[2], dv_[0], dv_[1], dv_[2]});
    for (const double part : {0.13, 0.31, 0.5, 0.72, 0.94}) {
      const EdgePoint at = edgePoint(patch_.domain, side, part);
      std::array<Vec3, 2> tangents{};
      tape.evaluatePoint(at.u, at.v, inputs_, std::span(&tangents[0].x, 6));
      const double most = glm::length(tangents[0]) * glm::length(tangents[1]);
      if (!(glm::length(glm::cross(tangents[0], tangents[1])) <= kParallel * most)) return false;
    }
    return true;
  }

  /// A singular edge beside which the formula may be 0/0.
  [[nodiscard]] std::optional<Side> firstWithout(const ExprPoint& normal) {
    constexpr int kPieces = 1024;
    constexpr double kDepth = 1e-5;  // of the other side
    const Tape tape(graph_, normal);
    const double depthU = kDepth * patch_.domain.u.width(), depthV = kDepth * patch_.domain.v.width();
    for (const Side side : kSides) {
      if (!isSingular(side)) continue;
      for (int k = 0; k < kPieces; ++k) {
        const EdgePoint from = edgePoint(patch_.domain, side, static_cast<double>(k) / kPieces);
        const EdgePoint to = edgePoint(patch_.domain, side, (k + 1.0) / kPieces);
        Domain cell{{from.u, to.u}, {from.v, to.v}};
        if (side == Side::UMin) cell.u.hi += depthU;
        if (side == Side::UMax) cell.u.lo -= depthU;
        if (side == Side::VMin) cell.v.hi += depthV;
        if (side == Side::VMax) cell.v.lo -= depthV;
        if (!isBounded(tape, cell, inputs_)) return side;
      }
    }
    return std::nullopt;
  }

  /// What is 0 along an edge whatever the parameters, which may move it, are: over its distance from there.
  /// Only rounding may be left of it.
  [[nodiscard]] std::optional<ExprPoint> alongSlopes() {
    if (!surface_.parameters().empty()) return std::nullopt;
    Direction u{du_}, v{dv_};
    for (const Side side : kSides) {
      if (!isSingular(side)) continue;
      const bool isU = side == Side::UMin || side == Side::UMax;
      Direction& along = isU ? v : u;
      Direction& vanishing = isZeroAlong(along.along, side) ? along : isU ? u : v;
      if (!isZeroAlong(vanishing.along, side)) return std::nullopt;
      const EdgePoint there = edgePoint(patch_.domain, side, 0);
      for (Expr& component : vanishing.along) {
        const auto over = slope(graph_, component, isU ? kVariableU : kVariableV, isU ? there.u : there.v);
        if (!over) return std::nullopt;
        component = *over;
      }
      if (side == Side::UMax || side == Side::VMax) vanishing.sign = -vanishing.sign;
    }
    return normalAcross(graph_, u, v);
  }

  [[nodiscard]] bool isZeroAlong(const ExprPoint& tangent, Side side) {
    constexpr int kPieces = 16;
    constexpr double kRounding = 1e-13;  // of the size
    const Tape tape(graph_, tangent);
    const double size = glm::length(surface_.framing(parameters_).extent());
    for (int k = 0; k <= kPieces; ++k) {
      const EdgePoint at = edgePoint(patch_.domain, side, (k + 0.013 * std::sin(k)) / kPieces);
      Vec3 value(0);
      tape.evaluatePoint(at.u, at.v, inputs_, std::span(&value.x, 3));
      if (!(glm::length(value) <= kRounding * size)) return false;
    }
    return true;
  }

  Graph& graph_;
  const Surface& surface_;
  std::uint32_t index_;
  const Patch& patch_;
  std::span<const double> parameters_;
  PatchInputs inputs_;
  ExprPoint du_, dv_;
};

class DisplacedPatches {
 public:
  DisplacedPatches(const Surface& surface, const Displacement& displacement, std::span<const double> initial)
      : surface_(surface), displacement_(displacement), initial_(initial) {}

  void build() {
    for (std::uint32_t patch = 0; patch < surface_.patchCount(); ++patch) append(patch);
  }
  [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }
  /// Of each of them, the patch of the surface that it is of.
  [[nodiscard]] const std::vector<std::uint32_t>& origins() const { return origins_; }

 private:
  /// Patches of one formula, in one graph: what is made of them alike is made once.
  struct OfFunction {
    Graph graph;
    ExprPoint position;
    std::map<std::array<std::uint32_t, 3>, std::shared_ptr<const SurfaceFunction>> displaced = {};
  };

  void append(std::uint32_t index) {
    const Patch& from = surface_.patches()[index];
    OfFunction& of = functionOf(from);
    Graph& graph = of.graph;
    const ExprPoint normal = NormalFormula(graph, of.position, surface_, index, initial_).find();
    const Expr height = surface_.topology().orientation(index) * heightIn(graph, from);
    ExprPoint moved;
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis] = of.position[axis] + height * normal[axis];
    if (!graph.kinks(moved).empty()) {
      for (const Patch& piece : cutAtKinks(graph, moved, from.domain))
        add(piece.function, piece.domain, from, index);
      return;
    }
    auto& function = of.displaced[{graph.nodeOf(moved[0]), graph.nodeOf(moved[1]), graph.nodeOf(moved[2])}];
    if (!function) function = compileSurface(graph, moved);
    add(function, from.domain, from, index);
  }

  void add(std::shared_ptr<const SurfaceFunction> function, const Domain& domain, const Patch& from,
           std::uint32_t index) {
    patches_.push_back({std::move(function), domain, from.constants});
    origins_.push_back(index);
  }

  OfFunction& functionOf(const Patch& patch) {
    std::unique_ptr<OfFunction>& of = functions_[patch.function.get()];
    if (!of) {
      of = std::make_unique<OfFunction>();
      const std::vector<Expr> s = patch.function->position.expressions(of->graph);
      of->position = {s[0], s[1], s[2]};
    }
    return *of;
  }

  [[nodiscard]] Expr heightIn(Graph& graph, const Patch& patch) const {
    const std::size_t before = patch.constants.size() + surface_.parameters().size();
    std::map<std::uint32_t, Expr> parameters;
    for (std::uint32_t i = 0; i < displacement_.parameters.size(); ++i)
      parameters.emplace(kFirstParameter + i,
                         graph.variable(static_cast<std::uint32_t>(kFirstParameter + before + i)));
    return displacement_.height.expressions(graph, parameters)[0];
  }

  const Surface& surface_;
  const Displacement& displacement_;
  std::span<const double> initial_;
  std::map<const SurfaceFunction*, std::unique_ptr<OfFunction>> functions_;
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> origins_;
};

/// Whether edges of a displaced surface are one curve, or one point: proven of the displacement, not only
/// seen at some points.
class EdgeComparison {
 public:
  /// `within`: metres by which it may differ.
  EdgeComparison(const Surface& surface, const DisplacedPatches& moved, const Tape& height,
                 std::span<const double> ofSurface, std::span<const double> ofHeight, double within)
      : surface_(surface),
        moved_(moved),
        height_(height),
        ofSurface_(ofSurface),
        ofHeight_(ofHeight),
        within_(within) {}

  [[nodiscard]] bool sameAlong(const Joint& joint) const {
    Graph graph;
    const Expr part = graph.variable(kVariableU);
    const Expr a = heightOn(graph, joint.a, part),
               b = heightOn(graph, joint.b, joint.reversed ? 1 - part : part);
    return sameNormals(joint) ? isSmall(graph, a - (joint.flipped ? -1 : 1) * b)
                              : isSmall(graph, a) && isSmall(graph, b);
  }
  [[nodiscard]] bool sameAllAlong(const PatchEdge& edge) const {
    Graph graph;
    return isSmall(graph, heightOn(graph, edge, graph.variable(kVariableU)) - heightOn(graph, edge, 0.5));
  }

 private:
  [[nodiscard]] Expr heightOn(Graph& graph, const PatchEdge& edge, Expr part) const {
    const Domain& domain = moved_.patches()[edge.patch].domain;
    const auto along = [&](const Interval& range) { return range.lo + range.width() * part; };
    std::map<std::uint32_t, Expr> known;
    known[kVariableU] = edge.side == Side::UMin   ? Expr(domain.u.lo)
                        : edge.side == Side::UMax ? Expr(domain.u.hi)
                                                  : along(domain.u);
    known[kVariableV] = edge.side == Side::VMin   ? Expr(domain.v.lo)
                        : edge.side == Side::VMax ? Expr(domain.v.hi)
                                                  : along(domain.v);
    for (std::uint32_t i = 0; i < ofHeight_.size(); ++i) known[kFirstParameter + i] = ofHeight_[i];
    return height_.expressions(graph, known)[0];
  }

  /// Whether the surface, before it is displaced, has no crease there.
  [[nodiscard]] bool sameNormals(const Joint& joint) const {
    constexpr double kSame = 1e-6;
    const auto normalAt = [&](const PatchEdge& edge, double part) {
      const EdgePoint p = edgePoint(moved_.patches()[edge.patch].domain, edge.side, part);
      return surface_.normal(moved_.origins()[edge.patch], p.u, p.v, ofSurface_);
    };
    for (const double part : {0.13, 0.31, 0.5, 0.72, 0.94})
      if (!(glm::length(normalAt(joint.a, part) -
                        (joint.flipped ? -1.0 : 1.0) * normalAt(joint.b, joint.reversed ? 1 - part : part)) <
            kSame))
        return false;
    return true;
  }

  /// A function that is small at points h apart is nowhere larger than M h^2 / 8 more, where M bounds its
  /// second derivative.
  [[nodiscard]] bool isSmall(Graph& graph, Expr difference) const {
    constexpr int kCells = 256;
    constexpr std::size_t kMaxPoints = 1 << 20;
    if (difference.isConstant()) return std::abs(difference.constant()) <= within_;
    if (!graph.kinks({&difference, 1}).empty()) return false;
    const Expr bend = graph.derivative(graph.derivative(difference, kVariableU), kVariableU);
    const Tape second(graph, {&bend, 1}), values(graph, {&difference, 1});
    std::vector<double> points{0};
    for (int cell = 0; cell < kCells; ++cell) {
      const double from = static_cast<double>(cell) / kCells;
      Interval most;
      second.bound({from, from + 1.0 / kCells}, 0, {}, {&most, 1});
      const double steps = std::ceil(std::sqrt(most.magnitude() / (4 * within_)) / kCells);
      if (!(points.size() + steps <= kMaxPoints)) return false;
      for (double k = 1; k <= std::max(steps, 1.0); ++k)
        points.push_back(from + k / std::max(steps, 1.0) / kCells);
    }
    const std::vector<double> zeros(points.size());
    return std::ranges::all_of(values.evaluate(points, zeros, {})[0],
                               [&](double value) { return std::abs(value) <= 0.5 * within_; });
  }

  const Surface& surface_;
  const DisplacedPatches& moved_;
  const Tape& height_;
  std::span<const double> ofSurface_, ofHeight_;
  double within_;
};

/// Edges of the displaced surface that are joined or one point by what is seen of them, and not proven to be.
std::vector<PatchEdge> unprovenEdges(const Surface& moved, const EdgeComparison& comparison) {
  std::vector<PatchEdge> unproven;
  for (const Joint& joint : moved.topology().joints)
    if (!comparison.sameAlong(joint)) unproven.insert(unproven.end(), {joint.a, joint.b});
  for (std::uint32_t patch = 0; patch < moved.patchCount(); ++patch)
    for (const Side side : kSides)
      if (moved.topology().edge(patch, side).collapsed() && !comparison.sameAllAlong({patch, side}))
        unproven.push_back({patch, side});
  return unproven;
}

bool reads(const Tape& height, std::uint32_t variable) {
  Graph graph;
  const std::vector<Expr> formula = height.expressions(graph);
  const std::vector<std::uint32_t> variables = variablesOf(graph, formula);
  return std::ranges::find(variables, variable) != variables.end();
}

std::vector<double> valuesAt(const std::vector<Animated<double>>& parameters, const Moment& moment) {
  std::vector<double> values;
  for (const Animated<double>& parameter : parameters) values.push_back(parameter.at(moment));
  return values;
}

}  // namespace

Surface displaced(const Surface& surface, const Displacement& displacement, const Moment& start) {
  if (!surface.isParametric())
    throw Error(ErrorKind::Scene,
                fmt::format("'{}' is a mesh, and a displacement is a formula of u and v", surface.name()),
                "move its vertices where the model is made");
  std::vector<Animated<double>> parameters = surface.parameters();
  parameters.insert(parameters.end(), displacement.parameters.begin(), displacement.parameters.end());
  const std::vector<double> ofSurface = valuesAt(surface.parameters(), start);
  const std::vector<double> ofHeight = valuesAt(displacement.parameters, Moment(kAnyTime, start.parameters));
  std::vector<Animated<double>> still(ofSurface.begin(), ofSurface.end());
  still.insert(still.end(), ofHeight.begin(), ofHeight.end());

  const bool alongU = reads(displacement.height, kVariableU), alongV = reads(displacement.height, kVariableV);
  SurfaceTraits traits{.name = surface.name(),
                       .orientation = surface.topology().orientation(),
                       .revolution = surface.revolution() && !alongU};
  const bool varies = alongU || alongV;
  // A plane that is moved as a whole.
  if (!varies) traits.flatNormal = surface.flatNormal();
  DisplacedPatches patches(surface, displacement, ofSurface);
  patches.build();
  Surface moved(patches.patches(), still, traits);
  if (varies) {
    const double extent = glm::length(moved.framing(valuesAt(still, start)).extent());
    traits.borders = unprovenEdges(moved, EdgeComparison(surface, patches, displacement.height, ofSurface,
                                                         ofHeight, kSameHeight * extent));
    if (!traits.borders.empty()) moved = Surface(patches.patches(), still, traits);
  }
  return moved.withParameters(std::move(parameters));
}

}  // namespace luxo
