// SPDX-License-Identifier: Apache-2.0
// What `--validate` demands.
#pragma once

#include "gpu/validation.h"

namespace luxo {

/// Error(Internal) with the texts, if Vulkan's validation said anything. Ask once the context is gone: leaks
/// are reported last.
void requireNoMessage(const gpu::ValidationLog& log);

}  // namespace luxo
