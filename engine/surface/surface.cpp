// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/error.h"
#include "surface/bounds.h"
#include "surface/cloth.h"
#include "surface/holes.h"
#include "surface/normal.h"
#include "surface/spread.h"
#include "surface/surface_description.h"

namespace luxo {

namespace {

constexpr int kPositionCells = 16;
constexpr int kMaxRectangles = 512;
constexpr int kFramingSamples = 33;
/// How much farther out than nine of ten points what is worth looking at may lie.
constexpr double kWorthSeeing = 4;

/// A number per direction, shared fairly: as many cells in all on n patches as on one, or `least` on each.
int perPatch(int cells, std::size_t patches, int least) {
  return std::max(least, static_cast<int>(cells / std::sqrt(static_cast<double>(patches))));
}

void requireDomain(const Domain& domain, const std::string& name) {
  for (const Interval& range : {domain.u, domain.v})
    if (!(std::isfinite(range.lo) && std::isfinite(range.hi) && std::isfinite(range.width()) &&
          range.lo < range.hi))
      throw Error(ErrorKind::Scene,
                  fmt::format("surface '{}': its domain [{:.9g}, {:.9g}] is empty or not finite", name,
                              range.lo, range.hi),
                  "give u and v a finite range with the smaller value first");
}

Domain hullOf(const std::vector<Patch>& patches) {
  Domain all = patches.front().domain;
  for (const Patch& patch : patches) all = {hull(all.u, patch.domain.u), hull(all.v, patch.domain.v)};
  return all;
}

Box boundsOf(const std::vector<Patch>& patches, std::span<const double> parameters) {
  const int cells = perPatch(kPositionCells, patches.size(), 4);
  Box box;
  for (const Patch& patch : patches)
    box.add(boundPosition(*patch.function, patch.domain, PatchInputs(patch, parameters), cells));
  return box;
}

PartialBounds partialsOf(const std::vector<Patch>& patches, bool revolution,
                         std::span<const double> parameters) {
  const int rectangles = std::max(16, kMaxRectangles / static_cast<int>(patches.size()));
  PartialBounds all;
  for (const Patch& patch : patches) {
    // Turning about the axis changes no length: one meridian has them all.
    const Domain domain{revolution ? Interval(patch.domain.u.lo) : patch.domain.u, patch.domain.v};
    const PartialBounds part =
        boundPartials(*patch.function, domain, PatchInputs(patch, parameters), rectangles);
    all = {std::max(all.uu, part.uu), std::max(all.uv, part.uv), std::max(all.vv, part.vv)};
  }
  return all;
}

Box boundsOf(const SurfaceTriangles& triangles) {
  if (triangles.count == triangles.mesh.triangleCount()) return triangles.mesh.bounds();
  Box box;
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const Vec3& point : triangles.points(i)) box.add(point);
  return box;
}

Domain domainOf(const SurfaceTriangles& triangles) {
  const std::span<const Vec2f> uvs = triangles.mesh.uvs();
  if (uvs.empty()) return {};
  Vec2f low(std::numeric_limits<float>::infinity()), high(-low);
  for (std::uint32_t i = 0; i < triangles.count; ++i)
    for (const std::uint32_t vertex : triangles.corners(i)) {
      low = glm::min(low, uvs[vertex]);
      high = glm::max(high, uvs[vertex]);
    }
  const auto range = [](double from, double to) { return Interval(from, from < to ? to : from + 1); };
  return {range(low.x, high.x), range(low.y, high.y)};
}

/// Where all points are in the first triangle's plane, but for what double rounds away of their distance.
std::optional<Vec3> flatNormalOf(const SurfaceTriangles& triangles, const Box& bounds) {
  const auto [a, b, c] = triangles.points(0);
  const Vec3 normal = unit(glm::cross(b - a, c - a));
  const double slack = 0x1p-50 * glm::length(bounds.extent());
  for (std::uint32_t i = 0; i < triangles.count; ++i) {
    const auto [p, q, r] = triangles.points(i);
    for (const Vec3& point : {p, q, r})
      if (!(std::abs(glm::dot(normal, point - a)) <= slack)) return std::nullopt;
    if (!(glm::dot(normal, glm::cross(q - p, r - p)) > 0)) return std::nullopt;
  }
  return normal;
}

}  // namespace

Surface::Surface(std::vector<Patch> patches, std::vector<Animated<double>> parameters, SurfaceTraits traits) {
  if (patches.empty())
    throw Error(ErrorKind::Scene, fmt::format("surface '{}' has no patches", traits.name),
                "give it at least one");
  for (const Patch& patch : patches) requireDomain(patch.domain, traits.name);
  auto description = std::make_shared<SurfaceDescription>();
  for (const auto& parameter : parameters) description->initial.push_back(parameter.at(0));
  description->parameterCount = parameters.size();
  description->patches = std::move(patches);
  description->traits = std::move(traits);
  description_ = SurfaceDescriptions::all().find(*description);
  if (!description_) {
    const SurfaceTraits& stated = description->traits;
    description->topology =
        findTopology(description->patches, description->initial,
                     {.name = stated.name, .orientation = stated.orientation, .borders = stated.borders});
    description->domain = hullOf(description->patches);
    description_ = SurfaceDescriptions::all().add(description);
  }
  parameters_ = std::make_shared<const std::vector<Animated<double>>>(std::move(parameters));
}

Surface::Surface(std::shared_ptr<const SurfaceFunction> function, Domain domain,
                 std::vector<Animated<double>> parameters, SurfaceTraits traits)
    : Surface(std::vector<Patch>{{std::move(function), domain}}, std::move(parameters), std::move(traits)) {}

Surface::Surface(const TriangleMesh& mesh)
    : Surface(mesh, {.firstTriangle = 0, .triangles = mesh.triangleCount()}) {}

Surface::Surface(const TriangleMesh& mesh, const MeshGroup& group) {
  auto description = std::make_shared<SurfaceDescription>();
  description->traits.name = mesh.name();
  description->topology.closed = mesh.closed();
  description->topology.borderless = mesh.edges().border == 0;
  SurfaceTriangles triangles{mesh, group.firstTriangle, group.triangles};
  description->bounds = boundsOf(triangles);
  std::call_once(description->boundsOnce, [] {});
  description->domain = domainOf(triangles);
  description->traits.flatNormal = flatNormalOf(triangles, description->bounds);
  description->triangles = std::move(triangles);
  description_ = std::move(description);
  parameters_ = std::make_shared<const std::vector<Animated<double>>>();
}

Surface::Surface(const Cloth& cloth) {
  validate(cloth);
  const Surface atRest = clothSurface(cloth, clothAtRest(cloth).positions);
  auto description = std::make_shared<SurfaceDescription>();
  description->traits.name = atRest.name();
  description->topology = atRest.topology();
  description->domain = atRest.domain();
  description->triangles = *atRest.triangles();
  description->triangles->cloth = std::make_shared<const Cloth>(cloth);
  description->bounds = atRest.bounds({});
  std::call_once(description->boundsOnce, [] {});
  description->parameterCount = kClothNumbers;
  description_ = std::move(description);
  std::vector<Animated<double>> numbers;
  for (const double number : numbersOf(cloth)) numbers.emplace_back(number);
  parameters_ = std::make_shared<const std::vector<Animated<double>>>(std::move(numbers));
}

Surface Surface::withParameters(std::vector<Animated<double>> parameters) const {
  LUXO_REQUIRE_COMPARE(parameters.size(), ==, description_->parameterCount);
  Surface other = *this;
  other.parameters_ = std::make_shared<const std::vector<Animated<double>>>(std::move(parameters));
  return other;
}

const std::string& Surface::name() const { return description_->traits.name; }
const SurfaceTriangles* Surface::triangles() const {
  return description_ && description_->triangles ? &*description_->triangles : nullptr;
}
const std::vector<Patch>& Surface::patches() const { return description_->patches; }
const Domain& Surface::patchDomain(std::uint32_t patch) const { return patches()[patch].domain; }
const Domain& Surface::domain() const { return description_->domain; }
const Topology& Surface::topology() const { return description_->topology; }
const std::vector<double>& Surface::initialParameters() const { return description_->initial; }
std::optional<Paraboloid> Surface::paraboloid() const { return description_->traits.paraboloid; }
std::optional<Vec3> Surface::flatNormal() const { return description_->traits.flatNormal; }
const std::vector<PatchEdge>& Surface::statedBorders() const { return description_->traits.borders; }
bool Surface::revolution() const { return description_->traits.revolution; }

namespace {

SurfacePoints pointsFor(std::size_t count) {
  return {std::vector<Vec3>(count), std::vector<Vec3>(count), std::vector<Vec3>(count)};
}

/// Where S, Su and Sv go, component by component.
std::array<OutputArray, 9> arraysOf(SurfacePoints& points) {
  std::array<OutputArray, 9> arrays;
  std::size_t k = 0;
  for (std::vector<Vec3>* const target : {&points.position, &points.du, &points.dv})
    for (int component = 0; component < 3; ++component)
      arrays[k++] = {target->empty() ? nullptr : &target->front()[component], 3};
  return arrays;
}

static_assert(sizeof(Vec3) == 3 * sizeof(double));

}  // namespace

SurfacePoints Surface::evaluate(std::uint32_t patch, std::span<const double> u, std::span<const double> v,
                                std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  SurfacePoints points = pointsFor(u.size());
  p.function->tangents.evaluate(u, v, PatchInputs(p, parameters), arraysOf(points));
  return points;
}

SurfacePoints Surface::evaluateGrid(std::uint32_t patch, std::span<const double> u, std::span<const double> v,
                                    std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  SurfacePoints points = pointsFor(u.size() * v.size());
  p.function->tangents.evaluateGrid(u, v, PatchInputs(p, parameters), arraysOf(points));
  return points;
}

Vec3 Surface::position(std::uint32_t patch, double u, double v, std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  double s[3];
  p.function->position.evaluatePoint(u, v, PatchInputs(p, parameters), s);
  return {s[0], s[1], s[2]};
}

Vec3 Surface::normal(std::uint32_t patch, double u, double v, std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  return topology().orientation(patch) * limitNormal(*p.function, p.domain, u, v, PatchInputs(p, parameters));
}

std::uint32_t Surface::patchAt(double u, double v) const {
  if (!isParametric()) return 0;
  const auto holds = [&](const Patch& patch) { return patch.domain.contains(u, v); };
  const auto found = std::ranges::find_if(patches(), holds);
  return found == patches().end() ? patchCount() - 1 : static_cast<std::uint32_t>(found - patches().begin());
}

Vec3 Surface::position(double u, double v, std::span<const double> parameters) const {
  return position(patchAt(u, v), u, v, parameters);
}

Vec3 Surface::somePoint(std::span<const double> parameters) const {
  if (triangles()) return triangles()->points(0)[0];
  return position(domain().u.lo + 0.5 * domain().u.width(), domain().v.lo + 0.5 * domain().v.width(),
                  parameters);
}

Vec3 Surface::normal(double u, double v, std::span<const double> parameters) const {
  return normal(patchAt(u, v), u, v, parameters);
}

SurfacePoints Surface::evaluate(std::span<const double> u, std::span<const double> v,
                                std::span<const double> parameters) const {
  return evaluate(0, u, v, parameters);
}

SurfacePoints Surface::evaluateGrid(std::span<const double> u, std::span<const double> v,
                                    std::span<const double> parameters) const {
  return evaluateGrid(0, u, v, parameters);
}

Surface::CellBounds Surface::boundCell(std::uint32_t patch, const Domain& cell,
                                       std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  const PatchInputs inputs(p, parameters);
  CellBounds bounds{.second = boundSecond(*p.function, cell, inputs),
                    .kinked = mayBeKinked(*p.function, cell, inputs),
                    .position = {}};
  if (bounds.kinked) bounds.position = luxo::boundPosition(*p.function, cell, inputs);
  return bounds;
}

/// With N = Su x Sv, N . Sww of every direction w has the sign of the side that the surface bends toward: the
/// second fundamental form, times |N|. It is definite where N . Suu and N . Svv have one sign, and their
/// product is above (N . Suv)^2. All over the cell, N is within a ball around that of its middle.
int Surface::bendsAwayFrom(std::uint32_t patch, const Domain& cell,
                           std::span<const double> parameters) const {
  constexpr double kProductRounding =
      1e-6;  // of each product: more than doubles lose, and floats of the cell's ends
  const Patch& p = patches()[patch];
  const PatchInputs inputs(p, parameters);
  if (mayBeKinked(*p.function, cell, inputs)) return 0;
  const SecondBounds second = boundSecondBoxes(*p.function, cell, inputs);
  const auto most = [](const Box& box) {
    return glm::length(glm::max(glm::abs(box.min), glm::abs(box.max)));
  };
  const double u = cell.u.mid(), v = cell.v.mid(), hu = 0.5 * cell.u.width(), hv = 0.5 * cell.v.width();
  const SurfacePoints at = evaluate(patch, {&u, 1}, {&v, 1}, parameters);
  const Vec3 du = at.du[0], dv = at.dv[0], normal = glm::cross(du, dv);
  const double uu = most(second.uu), uv = most(second.uv), vv = most(second.vv);
  const double turnU = uu * hu + uv * hv, turnV = uv * hu + vv * hv;
  const double off = turnU * (glm::length(dv) + turnV) + glm::length(du) * turnV;
  const auto along = [&](const Box& box, double longest) {
    const Vec3 a = normal * box.min, b = normal * box.max;
    const double slack = (off + kProductRounding * glm::length(normal)) * longest;
    const Vec3 low = glm::min(a, b), high = glm::max(a, b);
    return Interval(low.x + low.y + low.z - slack, high.x + high.y + high.z + slack);
  };
  if (!(uu + uv + vv + off < std::numeric_limits<double>::infinity())) return 0;
  const Interval ofU = along(second.uu, uu), ofBoth = along(second.uv, uv), ofV = along(second.vv, vv);
  const double mixed = ofBoth.magnitude();
  if (ofU.hi < 0 && ofV.hi < 0 && ofU.hi * ofV.hi > mixed * mixed) return 1;
  return ofU.lo > 0 && ofV.lo > 0 && ofU.lo * ofV.lo > mixed * mixed ? -1 : 0;
}

Box Surface::boundPosition(std::uint32_t patch, const Domain& cell,
                           std::span<const double> parameters) const {
  const Patch& p = patches()[patch];
  return luxo::boundPosition(*p.function, cell, PatchInputs(p, parameters));
}

Box Surface::bounds(std::span<const double> parameters) const {
  const SurfaceDescription& d = *description_;
  if (d.parameterCount > 0 && !d.triangles) return boundsOf(d.patches, parameters);
  std::call_once(d.boundsOnce, [&] { d.bounds = boundsOf(d.patches, {}); });
  return d.bounds;
}

Box Surface::framing(std::span<const double> parameters) const {
  const Box proven = bounds(parameters);
  if (isFinite(proven)) return proven;
  const int samples = perPatch(kFramingSamples, patches().size(), 5);
  std::vector<Vec3> points;
  for (const Patch& patch : patches()) {
    std::vector<double> us, vs;
    for (int k = 0; k < samples; ++k) {
      const double part = static_cast<double>(k) / (samples - 1);
      us.push_back(edgePoint(patch.domain, Side::VMin, part).u);
      vs.push_back(edgePoint(patch.domain, Side::UMin, part).v);
    }
    const auto s = patch.function->position.evaluateGrid(us, vs, PatchInputs(patch, parameters));
    for (std::size_t i = 0; i < s[0].size(); ++i)
      if (const Vec3 p(s[0][i], s[1][i], s[2][i]); isFinite(p)) points.push_back(p);
  }
  Box box;
  if (points.empty()) return box;
  const Spread spread = spreadOf(points);
  for (const Vec3& p : points)
    if (glm::length(p - spread.center) <= kWorthSeeing * spread.radius) box.add(p);
  return box;
}

PartialBounds Surface::partialBounds(std::span<const double> parameters) const {
  const SurfaceDescription& d = *description_;
  if (d.triangles) return {};
  if (d.parameterCount > 0) return partialsOf(d.patches, d.traits.revolution, parameters);
  std::call_once(d.partialsOnce, [&] { d.partials = partialsOf(d.patches, d.traits.revolution, {}); });
  return d.partials;
}

std::vector<Domain> Surface::holes(std::span<const double> parameters) const {
  std::vector<Domain> all;
  for (const Patch& patch : patches()) {
    const std::vector<Domain> holes = findHoles(patch, PatchInputs(patch, parameters));
    all.insert(all.end(), holes.begin(), holes.end());
  }
  return all;
}

}  // namespace luxo
