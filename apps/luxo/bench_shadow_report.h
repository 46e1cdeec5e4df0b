// SPDX-License-Identifier: Apache-2.0
// What shadows cost, and what is wrong with them, as text, files, plots and a page.
#pragma once

#include <string>

#include "bench_shadows.h"

namespace luxo {

[[nodiscard]] std::string shadowText(const ShadowBench& bench);
[[nodiscard]] std::string shadowCsv(const ShadowBench& bench);
/// Of depth maps: scene, bias, amount, map_size, wrong_px.
[[nodiscard]] std::string biasCsv(const ShadowBench& bench);
[[nodiscard]] std::string shadowJson(const ShadowBench& bench);

/// The scenes, each with exact, mapped, planar and soft shadows beside each other, in Markdown: the time over
/// that without shadows, and what is wrong.
[[nodiscard]] std::string shadowMarkdown(const ShadowBench& bench);

/// For runGnuplot(): wrong pixels over time, over the size of maps and over each bias, and the error of soft
/// shadows over their points.
[[nodiscard]] std::string shadowScript(const ShadowBench& bench);

/// One HTML page with all of that. `plot`: an SVG file; empty: no gnuplot.
[[nodiscard]] std::string shadowPage(const ShadowBench& bench, const std::string& plot);

}  // namespace luxo
