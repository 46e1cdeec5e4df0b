// SPDX-License-Identifier: Apache-2.0
// Whether SPIR-V that came from elsewhere is what the specification says: whoever reads it relies on that.
#pragma once

#include <cstdint>
#include <span>

namespace luxo::gpu {

/// Error(Scene): it is not, with what is wrong. Cost: linear.
void requireValid(std::span<const std::uint32_t> spirv);

}  // namespace luxo::gpu
