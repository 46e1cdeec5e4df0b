// SPDX-License-Identifier: Apache-2.0
// What the numbers in a picture file mean.
#pragma once

namespace luxo {

enum class Codes {
  Srgb,  ///< colours on the sRGB curve; alpha is linear
  Data,  ///< themselves: code / 255, or of 16 bits code / 65535
};

}  // namespace luxo
