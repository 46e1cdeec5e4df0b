// SPDX-License-Identifier: Apache-2.0
// Thresholds that are not met, and why: they stay where they are.
#pragma once

#include <optional>
#include <string_view>

namespace luxo {

/// The reason why this measurement of a case misses its threshold; nothing where it is not known to.
[[nodiscard]] std::optional<std::string_view> reasonForMiss(std::string_view id, std::string_view what);

}  // namespace luxo
