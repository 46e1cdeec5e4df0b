// SPDX-License-Identifier: Apache-2.0
// Time against error as pictures, drawn by gnuplot.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench_measure.h"

namespace luxo {

/// The gnuplot script of four log-log plots: the time of a frame against the largest and the 99.9 % position
/// error, the normal error, and the part of the pixels with another 8-bit colour. Colours are shadings, marks
/// are scenes; bars reach from p10 to p90. It writes an SVG to stdout.
[[nodiscard]] std::string paretoScript(std::span<const BenchScene> scenes, const std::string& title);

/// What gnuplot writes to stdout for a script: an SVG file. Nothing when there is no gnuplot; Error(Internal)
/// when it fails, with what it said.
[[nodiscard]] std::optional<std::string> runGnuplot(const std::string& script);

}  // namespace luxo
