// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...?" for names that people type.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace luxo {

/// The candidate that takes the fewest slips (a letter added, left out, changed, or two swapped) to reach, or
/// empty when even that one takes more than a third of its letters or replaces all of them. Case does not
/// count.
[[nodiscard]] std::string closestName(std::string_view typed, std::span<const std::string> candidates);

/// "did you mean 'x'?", or `otherwise` when nothing is close.
[[nodiscard]] std::string didYouMean(std::string_view typed, std::span<const std::string> candidates,
                                     std::string otherwise = {});

/// "a, b, c"
[[nodiscard]] std::string listed(std::span<const std::string> names);

}  // namespace luxo
