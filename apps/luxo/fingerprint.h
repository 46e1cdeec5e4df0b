// SPDX-License-Identifier: Apache-2.0
// Which machine and which software measured something: what explains a time, and nothing that names a person,
// a host or a folder.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"

namespace luxo {

/// Names and values, in the order to show them.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] Fingerprint fingerprintOf(const gpu::DeviceInfo& device);

}  // namespace luxo
