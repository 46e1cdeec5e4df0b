// SPDX-License-Identifier: Apache-2.0
// Two ways to the same thing, measured in turn (A B A B), so that whatever slows the machine slows both.
// What is claimed is the ratio of the medians; milliseconds are there to be read, never compared between
// runs.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>

namespace luxo::bench {

/// Called with 0, 1, 2, ...: the same number for both ways.
using Way = std::function<void(int)>;

/// Body of a benchmark with UseManualTime and a fixed number of iterations; the benchmark's own time is ours.
/// Counters, medians in ms: `ours`, `theirs`, `ratio`; `ours_cpu`, `theirs_cpu`, `ratio_cpu` the same in
/// processor time of all threads and ended children, which neighbours on the machine disturb less;
/// `ours_first`, `theirs_first`: the first call of each, where shaders are compiled and meshes made, which is
/// in no median.
void sideBySide(benchmark::State& state, const Way& ours, const Way& theirs);

}  // namespace luxo::bench
