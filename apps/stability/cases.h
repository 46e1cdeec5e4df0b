// SPDX-License-Identifier: Apache-2.0
// The groups of the stability suite, a file each.
#pragma once

#include <vector>

#include "stability/stability.h"

namespace luxo {

[[nodiscard]] std::vector<StressCase> parameterisationCases();  ///< ST-01 to 04
[[nodiscard]] std::vector<StressCase> derivativeCases();        ///< ST-05 to 07
[[nodiscard]] std::vector<StressCase> accuracyCases();          ///< ST-08 to 10
[[nodiscard]] std::vector<StressCase> rasterisationCases();     ///< ST-19 to 21
[[nodiscard]] std::vector<StressCase> tessellationCases();      ///< ST-22 to 24
[[nodiscard]] std::vector<StressCase> depthCases();             ///< ST-25 to 27
[[nodiscard]] std::vector<StressCase> transformCases();         ///< ST-11 to 15
[[nodiscard]] std::vector<StressCase> invarianceCases();        ///< ST-16 to 18
[[nodiscard]] std::vector<StressCase> shadingCases();           ///< ST-28 to 31, 33
[[nodiscard]] std::vector<StressCase> hazardCases();            ///< ST-32
[[nodiscard]] std::vector<StressCase> lampCases();              ///< ST-34
[[nodiscard]] std::vector<StressCase> shadowCases();            ///< ST-35 to 38
[[nodiscard]] std::vector<StressCase> systemCases();            ///< ST-39, 40

}  // namespace luxo
