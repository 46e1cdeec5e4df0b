// SPDX-License-Identifier: Apache-2.0
// What `luxo bench` found, as CSV and JSON with stable names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench_summary.h"

namespace luxo {

/// A row per scene and way; what does not apply or is not finite is an empty field. RFC 4180 but for the line
/// ends.
[[nodiscard]] std::string benchCsv(const BenchResult& result);

/// The same numbers, the machine, and each scene's summary. What does not apply or is not finite is null.
[[nodiscard]] std::string benchJson(const BenchResult& result);

/// The columns of the CSV and the fields of a JSON row, in order: names, and units where they have one.
[[nodiscard]] std::vector<std::string_view> benchColumns();

}  // namespace luxo
