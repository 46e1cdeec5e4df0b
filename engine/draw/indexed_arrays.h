// SPDX-License-Identifier: Apache-2.0
// Arrays that are read where they lie, element by element, instead of being copied to each point: a driver
// takes seconds to compile what copies a hundred numbers, and minutes for a thousand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace luxo {

/// The text with a call, `luxoAt_name(int(i), int(j))`, for each element of an array of so many dimensions
/// that is declared outside of functions, which stays as it is. Nothing: the array is there as a whole, too
/// (`sum(weights)`, `weights.length()`), or something in a function has its name.
[[nodiscard]] std::optional<std::string> withElementsRead(std::string_view glsl, std::string_view name,
                                                          std::size_t dimensions);

}  // namespace luxo
