// SPDX-License-Identifier: Apache-2.0
// Errors where there is little room for them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace luxo {

/// The lines of an error (base/diagnostic.h), none longer than so many characters: messages go on in further
/// lines, and a line that is quoted is cut where its marks are not, which stay below what they mark.
[[nodiscard]] std::vector<std::string> errorLines(std::string_view text, std::size_t columns);

}  // namespace luxo
