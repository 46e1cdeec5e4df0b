// SPDX-License-Identifier: Apache-2.0
// A benchmark as one page that needs no other file: tables, plots, pictures and maps of their errors.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bench_summary.h"

namespace luxo {

/// Base64 (RFC 4648, section 4), padded, without line breaks.
[[nodiscard]] std::string base64Of(std::span<const std::byte> bytes);

/// HTML that is well-formed XML, all of it but what is in the body.
[[nodiscard]] std::string pageOf(const std::string& title, const std::string& body);
[[nodiscard]] std::string tableOf(const TextTable& table);
/// An SVG file in the page.
[[nodiscard]] std::string plotOf(const std::string& svg, const std::string& text);

/// HTML that is well-formed XML. `plots` are SVG files: of all scenes together, then of each; empty: no
/// gnuplot.
[[nodiscard]] std::string benchPage(const BenchResult& result, const std::vector<std::string>& plots);

}  // namespace luxo
