// SPDX-License-Identifier: Apache-2.0
#include "reference/layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/picture_rules.h"

namespace luxo::reference {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kSamePointPx = 0.02;      // closer in space: one point, whatever the parameters say
constexpr double kNeighbourhoodPx = 1e-3;  // kPointPx: points that are off by less are right
/// Cosine below which a surface is not taken for its tangent plane, 89 degrees: what is farther off than 50
/// times the neighbourhood is another layer. Chosen, not measured; of triangles, and across patches, alone.
constexpr double kMaxGrazing = 0.02;
constexpr int kSteps = 8;  // of a path along the surface

bool holds(const Domain& domain, const Vec2& parameters) {
  const auto within = [](const Interval& range, double x) {
    const double slack = kPatchSlack * range.width();
    return range.lo - slack <= x && x <= range.hi + slack;
  };
  return within(domain.u, parameters.x) && within(domain.v, parameters.y);
}

Vec2 clamped(const Domain& domain, const Vec2& parameters) {
  return {std::clamp(parameters.x, domain.u.lo, domain.u.hi),
          std::clamp(parameters.y, domain.v.lo, domain.v.hi)};
}

}  // namespace

Layers::Layers(const Snapshot& snapshot) : snapshot_(snapshot) {
  for (std::uint32_t i = 0; i < snapshot.nodes.size(); ++i) {
    const SnapshotNode& node = snapshot.nodes[i];
    if (node.number >= nodeOfNumber_.size()) nodeOfNumber_.resize(node.number + 1U, kNone);
    nodeOfNumber_[node.number] = i;
    std::vector<BoundedPatch>& patches = patches_.emplace_back();
    for (std::uint32_t patch = 0; patch < node.surface.patchCount(); ++patch)
      patches.emplace_back(node.surface, patch, node.parameters);
  }
}

std::optional<std::uint32_t> Layers::nodeOf(double number) const {
  if (!(number >= 1) || number >= static_cast<double>(nodeOfNumber_.size())) return std::nullopt;
  const std::uint32_t node = nodeOfNumber_[static_cast<std::size_t>(number)];
  return node == kNone ? std::nullopt : std::optional(node);
}

std::optional<Place> Layers::place(std::uint32_t node, std::uint32_t patch, const Vec2& parameters) const {
  const Transform& worldFromObject = snapshot_.nodes[node].worldFromObject;
  return placed(
      node, patch, parameters,
      transformPoint(worldFromObject, patches_[node][patch].at(parameters.x, parameters.y).position));
}

std::optional<Place> Layers::onTriangle(std::uint32_t node, const Vec2& parameters,
                                        const Vec3& position) const {
  return placed(node, 0, parameters, position);
}

std::optional<Place> Layers::placed(std::uint32_t node, std::uint32_t patch, const Vec2& parameters,
                                    const Vec3& position) const {
  const Vec3 inEye = eyeFromWorldPoint(snapshot_.view, position);
  if (!std::isfinite(inEye.x + inEye.y + inEye.z) || (snapshot_.view.perspective() && !(inEye.z < 0)))
    return std::nullopt;
  return Place{node, patch, parameters, position, pixelFromEye(snapshot_.view, inEye)};
}

std::optional<Place> Layers::at(std::uint32_t node, const Vec2& parameters, const Vec3& near) const {
  std::optional<Place> nearest;
  for (std::uint32_t patch = 0; patch < patches_[node].size(); ++patch) {
    const Domain& domain = patches_[node][patch].domain();
    if (!holds(domain, parameters)) continue;
    std::optional<Place> candidate = place(node, patch, parameters);
    // A formula need not have values beyond its domain.
    if (!candidate) candidate = place(node, patch, clamped(domain, parameters));
    if (candidate &&
        (!nearest || glm::distance(candidate->position, near) < glm::distance(nearest->position, near)))
      nearest = candidate;
  }
  return nearest;
}

double Layers::footprint(const Vec3& position) const {
  const View& view = snapshot_.view;
  const double depth = view.perspective() ? glm::dot(position - view.eye, view.forward()) : 1;
  return depth / view.pixelsPerUnit;
}

bool Layers::staysNear(const Place& from, const Vec2& to, const Vec2& pixel, double radius) const {
  for (int k = 1; k < kSteps; ++k) {
    const auto step =
        place(from.node, from.patch, glm::mix(from.parameters, to, static_cast<double>(k) / kSteps));
    if (!step || !(glm::distance(step->pixel, pixel) <= radius)) return false;
  }
  return true;
}

bool Layers::same(const Place& shown, const Place& seen, const Vec3& normal, const Vec2& pixel) const {
  if (shown.node != seen.node) return false;
  const double pixelMetres = footprint(seen.position);
  const double between = glm::distance(shown.position, seen.position) / pixelMetres;
  if (between <= kSamePointPx) return true;
  const double off = glm::distance(shown.pixel, pixel);
  const double radius = 2 * off + kNeighbourhoodPx;
  const bool onTriangles = patches_[shown.node].empty();
  if (!onTriangles && shown.patch == seen.patch) {
    const Domain& domain = patches_[shown.node][shown.patch].domain();
    if (staysNear(shown, seen.parameters, pixel, radius)) return true;
    // Across a seam, where the formula goes on as at the other edge.
    for (const double du : {-domain.u.width(), 0.0, domain.u.width()})
      for (const double dv : {-domain.v.width(), 0.0, domain.v.width()}) {
        if (du == 0 && dv == 0) continue;
        const auto shifted = place(shown.node, shown.patch, shown.parameters + Vec2(du, dv));
        if (shifted && glm::distance(shifted->position, shown.position) < kNeighbourhoodPx * pixelMetres &&
            staysNear(*shifted, seen.parameters, pixel, radius))
          return true;
      }
    return false;
  }
  // On triangles, and across an edge of patches, whose parameters have nothing in common: as far as the
  // tangent plane leads.
  const Vec3 toViewer =
      snapshot_.view.perspective() ? unit(snapshot_.view.eye - seen.position) : -snapshot_.view.forward();
  return between <= radius / std::max(std::abs(glm::dot(normal, toViewer)), kMaxGrazing);
}

}  // namespace luxo::reference
