// SPDX-License-Identifier: Apache-2.0
// What mathematics knows about the named surfaces, written down a second time: positions and normals as the
// literature has them (z up, its own parameters, long double), implicit equations, areas, volumes,
// curvatures.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "surface/catalogue.h"

namespace luxo {

using Real = long double;
using Point = glm::vec<3, Real>;

struct CatalogueReference {
  std::string label;
  std::string entry;
  std::vector<SurfaceArgument> arguments = {};
  std::function<Point(Real u, Real v)> position = {};  ///< luxo's frame and domain
  std::function<Point(Real u, Real v)> normal = {};    ///< outward, any length; the limit at singular points
  std::function<Real(Point)> residual = {};            ///< of an implicit equation, about a length
  std::optional<double> area = {}, volume = {};
  std::optional<double> gaussianCurvature = {};
  bool minimal = false;  ///< mean curvature 0
  bool kinked = false;   ///< some patches meet at an angle
  bool smooth = true;    ///< finite curvature everywhere
};

/// For GoogleTest's messages.
inline void PrintTo(const CatalogueReference& reference, std::ostream* out) { *out << reference.label; }

[[nodiscard]] const std::vector<CatalogueReference>& catalogueReferences();

}  // namespace luxo
