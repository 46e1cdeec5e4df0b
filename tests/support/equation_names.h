// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace luxo::test {

/// The surfaces of the catalogue that are quadrics or a torus at their initial arguments.
inline const std::set<std::string> kEquationNames{"rectangle",
                                                  "disk",
                                                  "cylinder",
                                                  "cone",
                                                  "sphere",
                                                  "ellipsoid",
                                                  "paraboloid",
                                                  "torus",
                                                  "hyperboloid",
                                                  "hyperboloid2",
                                                  "hyperbolic_paraboloid"};

}  // namespace luxo::test
