// SPDX-License-Identifier: Apache-2.0
// What mathematics knows about the named surfaces, written down a second time: positions and normals as the
// literature has them (z up, its own parameters, long double), implicit equations, areas, volumes,
// curvatures.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "surface/catalogue.h"

namespace luxo {

using Real = long double;
using RealPoint = glm::vec<3, Real>;

inline constexpr Real kPiL = std::numbers::pi_v<Real>;
inline constexpr Real kTauL = 2 * kPiL;

/// The literature's z-up frame to luxo's.
inline RealPoint upright(Real x, Real y, Real z) { return {x, z, -y}; }
inline RealPoint upright(const RealPoint& p) { return upright(p.x, p.y, p.z); }

/// (radius cos phi, radius sin phi, z) of the literature.
inline RealPoint around(Real u, Real radius, Real z) {
  return upright(radius * std::cos(kTauL * u), radius * std::sin(kTauL * u), z);
}

inline Real rho(const RealPoint& p) { return std::hypot(p.x, p.z); }

struct CatalogueReference {
  std::string label;
  std::string entry;  ///< of the catalogue; empty for what is built otherwise
  std::vector<SurfaceArgument> arguments = {};
  std::function<RealPoint(Real u, Real v)> position = {};  ///< luxo's frame and domain
  std::function<RealPoint(Real u, Real v)> normal =
      {};                                        ///< outward, any length; the limit at singular points
  std::function<Real(RealPoint)> residual = {};  ///< of an implicit equation, about a length
  std::optional<double> area = {}, volume = {};
  std::optional<double> gaussianCurvature = {};
  bool minimal = false;                 ///< mean curvature 0
  bool kinked = false;                  ///< some patches meet at an angle
  bool smooth = true;                   ///< finite curvature everywhere
  std::function<Surface()> build = {};  ///< where there is no entry

  [[nodiscard]] Surface surface() const { return entry.empty() ? build() : makeSurface(entry, arguments); }
};

/// For GoogleTest's messages.
inline void PrintTo(const CatalogueReference& reference, std::ostream* out) { *out << reference.label; }

[[nodiscard]] const std::vector<CatalogueReference>& catalogueReferences();

// The part of them that is in catalogue_closed_references.cpp.
void addOneSided(std::vector<CatalogueReference>& all);
void addPinched(std::vector<CatalogueReference>& all);
void addSuperquadrics(std::vector<CatalogueReference>& all);
void addTubes(std::vector<CatalogueReference>& all);
/// Surfaces whose shape their author writes: turned profiles, tubes, patches.
void addStructured(std::vector<CatalogueReference>& all);

}  // namespace luxo
