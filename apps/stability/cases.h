// SPDX-License-Identifier: Apache-2.0
// The groups of the stability suite, a file each.
#pragma once

#include <vector>

#include "stability/stability.h"

namespace luxo {

[[nodiscard]] std::vector<StressCase> parameterisationCases();  ///< ST-01 to 04
[[nodiscard]] std::vector<StressCase> derivativeCases();        ///< ST-05 to 07
[[nodiscard]] std::vector<StressCase> accuracyCases();          ///< ST-08 to 10
[[nodiscard]] std::vector<StressCase> rasterisationCases();     ///< ST-19 to 24
[[nodiscard]] std::vector<StressCase> depthCases();             ///< ST-25 to 27

}  // namespace luxo
