// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace luxo {

/// No side of a patch is ever cut into more pieces, except at kinks.
inline constexpr std::uint32_t kMaxSegments = 1024;

/// How many pieces each parameter direction of a surface is cut into.
struct Segments {
  std::uint32_t u = 1, v = 1;
  friend bool operator==(const Segments&, const Segments&) = default;
};

}  // namespace luxo
