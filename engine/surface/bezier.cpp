// SPDX-License-Identifier: Apache-2.0
#include "surface/bezier.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/error.h"
#include "math/rounding.h"
#include "surface/spread.h"

namespace luxo {
namespace {

// Variables beyond u and v: the control points' coordinates, weighted, point by point, then the lower end of
// u.
constexpr std::uint32_t kFirstCoordinate = 2, kLowerU = kFirstCoordinate + 48;

/// Bernstein's factors: control points are multiplied by them once instead of at every point of the surface.
constexpr std::array<double, 4> kWeights{1, 3, 3, 1};

/// The cubic Bernstein polynomials, over their weights.
std::array<Expr, 4> bernstein(Expr t) {
  const Expr s = 1 - t;
  return {pow(s, 3), t * pow(s, 2), pow(t, 2) * s, pow(t, 3)};
}

double weightOf(std::size_t point) { return kWeights[point / 4] * kWeights[point % 4]; }

/// The row sums depend on one parameter only, so that a grid takes them once per row.
ExprPoint bezierPosition(Graph& graph) {
  const auto across = bernstein(graph.variable(0) - graph.variable(kLowerU));
  const auto along = bernstein(graph.variable(1));
  ExprPoint position;
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    for (std::uint32_t i = 0; i < 4; ++i) {
      Expr column;
      for (std::uint32_t j = 0; j < 4; ++j)
        column = column + along[j] * graph.variable(kFirstCoordinate + 3 * (4 * j + i) + axis);
      position[axis] = position[axis] + across[i] * column;
    }
  return position;
}

/// Control points of a polynomial patch of degree M - 1 in u and N - 1 in v; [j][i], v first.
template <int M, int N>
using Net = std::array<std::array<Vec3, M>, N>;

/// Control points of the part over [a, b] of a Bezier curve: blossoms (L. Ramshaw 1987), from corner cutting
/// only, so that every intermediate value is a mean of control points.
template <int M>
std::array<Vec3, M> part(const std::array<Vec3, M>& curve, double a, double b) {
  std::array<std::array<Vec3, M>, M>
      cut;  // [k]: the blossoms whose arguments so far are b in k places, else a
  cut[0] = curve;
  for (int level = 1; level < M; ++level)
    for (int k = level; k >= 0; --k) {
      const std::array<Vec3, M>& from = cut[std::max(k - 1, 0)];
      const double t = k == 0 ? a : b;
      for (int i = 0; i < M - level; ++i) cut[k][i] = from[i] + t * (from[i + 1] - from[i]);
    }
  std::array<Vec3, M> result;
  for (int k = 0; k < M; ++k) result[k] = cut[k][0];
  return result;
}

/// The point at t, likewise.
template <int M>
Vec3 pointAt(std::array<Vec3, M> curve, double t) {
  for (int level = M - 1; level > 0; --level)
    for (int i = 0; i < level; ++i) curve[i] += t * (curve[i + 1] - curve[i]);
  return curve[0];
}

template <int M, int N>
Net<M, N> part(const Net<M, N>& net, const Interval& u, const Interval& v) {
  Net<M, N> rows, result;
  for (int j = 0; j < N; ++j) rows[j] = part<M>(net[j], u.lo, u.hi);
  for (int i = 0; i < M; ++i) {
    std::array<Vec3, N> column;
    for (int j = 0; j < N; ++j) column[j] = rows[j][i];
    column = part<N>(column, v.lo, v.hi);
    for (int j = 0; j < N; ++j) result[j][i] = column[j];
  }
  return result;
}

template <int M, int N>
double longest(const Net<M, N>& net) {
  double length = 0;
  for (const auto& row : net)
    for (const Vec3& p : row) length = std::max(length, glm::length(p));
  return length;
}

/// What corner cutting on up to six levels, and forming differences before, may round away.
constexpr double kNetRounding = roundingGamma(64);

/// By the convex hull property, no point of the part is longer than its longest control point.
template <int M, int N>
double lengthBound(const Net<M, N>& net, const Interval& u, const Interval& v, double magnitude) {
  return longest<M, N>(part<M, N>(net, u, v)) + kNetRounding * magnitude;
}

Net<4, 4> netOf(std::span<const double> inputs) {
  Net<4, 4> net;
  for (std::size_t k = 0; k < 16; ++k)
    net[k / 4][k % 4] = Vec3(inputs[3 * k], inputs[3 * k + 1], inputs[3 * k + 2]) / weightOf(k);
  return net;
}

/// u within its patch, 0..1. Exact: the lower end is a whole number.
Interval local(const Interval& u, std::span<const double> inputs) {
  return {u.lo - inputs[48], u.hi - inputs[48]};
}

Box widened(const Box& box, double by) { return {box.min - by, box.max + by}; }

/// By the convex hull property: every point of the part.
template <int M, int N>
Box boxAround(const Net<M, N>& net, const Interval& u, const Interval& v, double magnitude) {
  Box box;
  for (const auto& row : part<M, N>(net, u, v))
    for (const Vec3& p : row) box.add(p);
  return widened(box, kNetRounding * magnitude);
}

Box boundPosition(const Interval& u, const Interval& v, std::span<const double> inputs) {
  const Net<4, 4> net = netOf(inputs);
  return boxAround<4, 4>(net, local(u, inputs), v, longest<4, 4>(net));
}

TangentBounds boundTangents(const Interval& u, const Interval& v, std::span<const double> inputs) {
  const Net<4, 4> p = netOf(inputs);
  Net<3, 4> du;
  Net<4, 3> dv;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i) du[j][i] = 3.0 * (p[j][i + 1] - p[j][i]);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) dv[j][i] = 3.0 * (p[j + 1][i] - p[j][i]);
  const Interval s = local(u, inputs);
  const double size = longest<4, 4>(p), magnitude = 6 * size;
  std::array<Vec3, 4> column;
  for (int j = 0; j < 4; ++j) column[j] = pointAt<4>(p[j], local(u.mid(), inputs).lo);
  Box middle;
  middle.add(pointAt<4>(column, v.mid()));
  return {.position = boxAround<4, 4>(p, s, v, size),
          .middle = widened(middle, kNetRounding * size),
          .du = boxAround<3, 4>(du, s, v, magnitude),
          .dv = boxAround<4, 3>(dv, s, v, magnitude)};
}

/// Of the second derivatives.
struct SecondNets {
  Net<2, 4> uu;
  Net<3, 3> uv;
  Net<4, 2> vv;
  double magnitude = 0;  ///< of the numbers that they are differences of
};

SecondNets secondNets(const Net<4, 4>& p) {
  SecondNets nets{.magnitude = 36 * longest<4, 4>(p)};
  auto& [uu, uv, vv, magnitude] = nets;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 2; ++i) uu[j][i] = 6.0 * (p[j][i] - 2.0 * p[j][i + 1] + p[j][i + 2]);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) uv[j][i] = 9.0 * ((p[j + 1][i + 1] - p[j + 1][i]) - (p[j][i + 1] - p[j][i]));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) vv[j][i] = 6.0 * (p[j][i] - 2.0 * p[j + 1][i] + p[j + 2][i]);
  return nets;
}

std::array<double, 3> boundSecond(const Interval& u, const Interval& v, std::span<const double> inputs) {
  const SecondNets nets = secondNets(netOf(inputs));
  const Interval s = local(u, inputs);
  return {lengthBound<2, 4>(nets.uu, s, v, nets.magnitude), lengthBound<3, 3>(nets.uv, s, v, nets.magnitude),
          lengthBound<4, 2>(nets.vv, s, v, nets.magnitude)};
}

SecondBounds boundSecondBoxes(const Interval& u, const Interval& v, std::span<const double> inputs) {
  const SecondNets nets = secondNets(netOf(inputs));
  const Interval s = local(u, inputs);
  return {boxAround<2, 4>(nets.uu, s, v, nets.magnitude), boxAround<3, 3>(nets.uv, s, v, nets.magnitude),
          boxAround<4, 2>(nets.vv, s, v, nets.magnitude)};
}

/// Compiled once, for all patches of all surfaces.
std::shared_ptr<const SurfaceFunction> bezierFunction() {
  static const std::shared_ptr<const SurfaceFunction> function = [] {
    Graph graph;
    const ExprPoint position = bezierPosition(graph);
    return compileSurface(graph, position,
                          {.position = boundPosition,
                           .tangents = boundTangents,
                           .second = boundSecond,
                           .secondBoxes = boundSecondBoxes},
                          kLowerU);
  }();
  return function;
}

}  // namespace

Surface bezier(const std::vector<BezierPatch>& patches, SurfaceTraits traits) {
  std::vector<Patch> all;
  for (const BezierPatch& points : patches) {
    const double lower = static_cast<double>(all.size());
    Patch patch{bezierFunction(), {{lower, lower + 1}, {0, 1}}, {}};
    patch.constants.reserve(49);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3& p = points[k];
      if (!isFinite(p))
        throw Error(ErrorKind::Scene,
                    fmt::format("surface '{}': control point {} of patch {} is ({}, {}, {})", traits.name,
                                k + 1, all.size() + 1, p.x, p.y, p.z),
                    "give finite coordinates");
      const Vec3 weighted = weightOf(k) * p;
      patch.constants.insert(patch.constants.end(), {weighted.x, weighted.y, weighted.z});
    }
    patch.constants.push_back(lower);
    all.push_back(std::move(patch));
  }
  return Surface(std::move(all), {}, std::move(traits));
}

}  // namespace luxo
