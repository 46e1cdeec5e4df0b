// SPDX-License-Identifier: Apache-2.0
#include "exact/table.h"

#include "luxo/shaders/exact_shaders.h"

namespace luxo {

std::span<const ExactShader> exactShaders() { return kExactShaders; }
std::span<const PatternShader> patternShaders() { return kPatternShaders; }

}  // namespace luxo
