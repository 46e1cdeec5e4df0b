// SPDX-License-Identifier: Apache-2.0
// Text that comes from anywhere, for messages.
#pragma once

#include <string>
#include <string_view>

namespace luxo {

/// Characters that a terminal would act on, and bytes that are no UTF-8, become '?'.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace luxo
