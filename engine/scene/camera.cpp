// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

namespace luxo {

bool Camera::movesWithTime() const {
  return eye.movesWithTime() || lookAt.movesWithTime() || up.movesWithTime() || fovY.movesWithTime() ||
         near.movesWithTime() || height.movesWithTime();
}

}  // namespace luxo
