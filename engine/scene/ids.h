// SPDX-License-Identifier: Apache-2.0
// Typed indices into a scene: a node cannot be mistaken for a material.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace luxo {

template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t index = kNone;  ///< none by default

  [[nodiscard]] constexpr bool valid() const { return index != kNone; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

using NodeId = Id<struct NodeTag>;
using MaterialId = Id<struct MaterialTag>;
using CameraId = Id<struct CameraTag>;
using ParameterId = Id<struct ParameterTag>;

}  // namespace luxo
