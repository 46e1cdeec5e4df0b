// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "base/assert.h"
#include "base/error.h"
#include "surface/bounds.h"
#include "surface/topology.h"

namespace luxo {

struct Surface::Description {
  std::shared_ptr<const SurfaceFunction> function;
  Domain domain;
  std::vector<Animated<double>> parameters;
  SurfaceTraits traits;
  Topology topology;

  // Proven bounds of a surface without parameters never change: they are found when first asked for.
  mutable std::once_flag boundsOnce, partialsOnce;
  mutable Box bounds;
  mutable PartialBounds partials;
};

Surface::Surface(std::shared_ptr<const SurfaceFunction> function, Domain domain,
                 std::vector<Animated<double>> parameters, SurfaceTraits traits) {
  for (const Interval& range : {domain.u, domain.v})
    if (!(std::isfinite(range.lo) && std::isfinite(range.hi) && range.lo < range.hi))
      throw Error(ErrorKind::Scene,
                  fmt::format("surface '{}': its domain [{}, {}] is empty or not finite", traits.name,
                              range.lo, range.hi),
                  "give u and v a finite range with the smaller value first");
  std::vector<double> initial;
  for (const auto& parameter : parameters) initial.push_back(parameter.at(0));
  auto description = std::make_shared<Description>();
  description->topology = findTopology(*function, domain, initial, traits);
  description->function = std::move(function);
  description->domain = domain;
  description->parameters = std::move(parameters);
  description->traits = std::move(traits);
  description_ = std::move(description);
}

const std::string& Surface::name() const { return description_->traits.name; }
const Domain& Surface::domain() const { return description_->domain; }
const Topology& Surface::topology() const { return description_->topology; }
const std::vector<Animated<double>>& Surface::parameters() const { return description_->parameters; }
std::optional<Paraboloid> Surface::paraboloid() const { return description_->traits.paraboloid; }
std::optional<Vec3> Surface::flatNormal() const { return description_->traits.flatNormal; }
bool Surface::revolution() const { return description_->traits.revolution; }

namespace {

SurfacePoints gather(const std::vector<std::vector<double>>& values) {
  const std::size_t count = values[0].size();
  SurfacePoints points;
  std::vector<Vec3>* const targets[3] = {&points.position, &points.du, &points.dv};
  for (int t = 0; t < 3; ++t) {
    targets[t]->resize(count);
    for (std::size_t i = 0; i < count; ++i)
      (*targets[t])[i] = {values[3 * t][i], values[3 * t + 1][i], values[3 * t + 2][i]};
  }
  return points;
}

}  // namespace

SurfacePoints Surface::evaluate(std::span<const double> u, std::span<const double> v,
                                std::span<const double> parameters) const {
  return gather(description_->function->tangents.evaluate(u, v, parameters));
}

SurfacePoints Surface::evaluateGrid(std::span<const double> u, std::span<const double> v,
                                    std::span<const double> parameters) const {
  return gather(description_->function->tangents.evaluateGrid(u, v, parameters));
}

Vec3 Surface::position(double u, double v, std::span<const double> parameters) const {
  const auto p = description_->function->position.evaluate({&u, 1}, {&v, 1}, parameters);
  return {p[0][0], p[1][0], p[2][0]};
}

Vec3 Surface::normal(double u, double v, std::span<const double> parameters) const {
  const Topology& t = topology();
  if (v == domain().v.lo && t.vMin == Edge::Pole) return t.orientation * t.vMinNormal;
  if (v == domain().v.hi && t.vMax == Edge::Pole) return t.orientation * t.vMaxNormal;
  return t.orientation * limitNormal(*description_->function, domain(), u, v, parameters);
}

Box Surface::bounds(std::span<const double> parameters) const {
  const Description& d = *description_;
  if (!d.parameters.empty()) return boundPosition(*d.function, d.domain, parameters);
  std::call_once(d.boundsOnce, [&] { d.bounds = boundPosition(*d.function, d.domain, {}); });
  return d.bounds;
}

PartialBounds Surface::partialBounds(std::span<const double> parameters) const {
  const Description& d = *description_;
  // Turning about the axis changes no length: one meridian has them all.
  const Domain domain{d.traits.revolution ? Interval(d.domain.u.lo) : d.domain.u, d.domain.v};
  if (!d.parameters.empty()) return boundPartials(*d.function, domain, parameters);
  std::call_once(d.partialsOnce, [&] { d.partials = boundPartials(*d.function, domain, {}); });
  return d.partials;
}

}  // namespace luxo
