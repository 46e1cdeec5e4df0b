// SPDX-License-Identifier: Apache-2.0
// 2 x 2 matrices, as math/vec.h has the others.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace luxo {

using Mat2 = glm::dmat2;

}  // namespace luxo
