// SPDX-License-Identifier: Apache-2.0
// Luxo Grandpa: a lamp of three spinning joints, with a light in the focus of its shade.
#pragma once

#include "scene/scene.h"

namespace luxo {

[[nodiscard]] Scene luxoGrandpa();

}  // namespace luxo
