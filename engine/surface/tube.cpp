// SPDX-License-Identifier: Apache-2.0
#include "surface/tube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "formula/tape.h"
#include "surface/spread.h"

namespace luxo {
namespace {

constexpr int kTangents = 1025;
constexpr int kSpreadDirections = 64;
/// Part of the curve's greatest speed below which it stands still.
constexpr double kStandsStill = 1e-9;
/// Sine of the smallest angle between the reference and a tangent: nearer, the frame would spin.
constexpr double kTooNear = 0.02;

/// The curve's tangents, unit vectors, at the parameters' values at time 0.
std::vector<Vec3> tangentsOf(Graph& graph, const ExprPoint& velocity, const Interval& range,
                             const std::vector<Animated<double>>& parameters, const std::string& name) {
  std::vector<double> initial, us;
  for (const auto& parameter : parameters) initial.push_back(parameter.at(0));
  for (int k = 0; k < kTangents; ++k)
    us.push_back(k + 1 == kTangents ? range.hi : range.lo + range.width() * k / (kTangents - 1));
  const auto d = Tape(graph, velocity).evaluate(us, us, initial);
  std::vector<Vec3> tangents;
  double fastest = 0;
  for (std::size_t k = 0; k < us.size(); ++k) {
    tangents.emplace_back(d[0][k], d[1][k], d[2][k]);
    if (isFinite(tangents[k])) fastest = std::max(fastest, glm::length(tangents[k]));
  }
  for (std::size_t k = 0; k < us.size(); ++k) {
    if (!(isFinite(tangents[k]) && glm::length(tangents[k]) > kStandsStill * fastest))
      throw Error(ErrorKind::Scene,
                  fmt::format("surface '{}': its curve has no direction at u = {}", name, us[k]),
                  "a tube needs a curve whose derivative is never zero");
    tangents[k] = unit(tangents[k]);
  }
  return tangents;
}

/// The axes, then directions spread evenly over half a sphere by golden angles.
std::vector<Vec3> candidates() {
  std::vector<Vec3> directions{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  for (int k = 0; k < kSpreadDirections; ++k) {
    const double y = (k + 0.5) / kSpreadDirections, radius = std::sqrt(1 - y * y);
    const double turn = kTau * k / std::numbers::phi;
    directions.emplace_back(radius * std::cos(turn), y, radius * std::sin(turn));
  }
  return directions;
}

/// The candidate farthest from all tangents; the first of equals, so that axes win.
Vec3 reference(const std::vector<Vec3>& tangents, const std::string& name) {
  Vec3 best(0);
  double farthest = 0;
  for (const Vec3& direction : candidates()) {
    double nearest = 1;
    for (const Vec3& t : tangents) nearest = std::min(nearest, glm::length(glm::cross(direction, t)));
    if (nearest > farthest + 1e-9) {
      farthest = nearest;
      best = direction;
    }
  }
  if (farthest < kTooNear)
    throw Error(
        ErrorKind::Scene,
        fmt::format("surface '{}': its curve runs in nearly every direction, so that no fixed one can "
                    "guide the tube's frame",
                    name),
        "make several tubes, each of a part of the curve");
  return best;
}

ExprPoint cross(const ExprPoint& a, const ExprPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Expr length(const ExprPoint& a) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
ExprPoint scaled(const ExprPoint& a, Expr factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

}  // namespace

Surface tube(Graph& graph, const ExprPoint& curve, Expr radius, const Interval& u,
             std::vector<Animated<double>> parameters, SurfaceTraits traits) {
  const ExprPoint velocity{graph.derivative(curve[0], 0), graph.derivative(curve[1], 0),
                           graph.derivative(curve[2], 0)};
  const Vec3 d = reference(tangentsOf(graph, velocity, u, parameters, traits.name), traits.name);
  const ExprPoint aside = cross({d.x, d.y, d.z}, velocity);
  const ExprPoint n = scaled(aside, 1 / length(aside));
  const ExprPoint b = cross(scaled(velocity, 1 / length(velocity)), n);
  const Expr turn = kTau * graph.variable(1);
  const Expr c = radius * cos(turn), s = radius * sin(turn);
  ExprPoint position;
  for (std::size_t axis = 0; axis < 3; ++axis) position[axis] = curve[axis] + (c * n[axis] - s * b[axis]);
  return Surface(cutAtKinks(graph, position, {u, {0, 1}}), std::move(parameters), std::move(traits));
}

}  // namespace luxo
