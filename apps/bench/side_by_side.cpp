// SPDX-License-Identifier: Apache-2.0
#include "side_by_side.h"
#include "base/stopwatch.h"

#include <sys/resource.h>

#include <algorithm>
#include <vector>

namespace luxo::bench {
namespace {

struct Cost {
  double wallMs = 0, cpuMs = 0;
};

/// Of all threads, and of the children that have ended.
double processCpuMs() {
  double ms = 0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(whose, &usage);
    for (const timeval& spent : {usage.ru_utime, usage.ru_stime})
      ms += 1e3 * static_cast<double>(spent.tv_sec) + 1e-3 * static_cast<double>(spent.tv_usec);
  }
  return ms;
}

Cost measure(const Way& way, int index) {
  const double cpuStart = processCpuMs();
  const Stopwatch watch;
  way(index);
  const double wall = watch.milliseconds();
  return {wall, processCpuMs() - cpuStart};
}

Cost median(const std::vector<Cost>& costs) {
  const auto middle = [&](double Cost::*what) {
    std::vector<double> values;
    for (const Cost& cost : costs) values.push_back(cost.*what);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  return {middle(&Cost::wallMs), middle(&Cost::cpuMs)};
}

}  // namespace

void sideBySide(benchmark::State& state, const Way& ours, const Way& theirs) {
  const Cost oursFirst = measure(ours, 0), theirsFirst = measure(theirs, 0);
  std::vector<Cost> oursAll, theirsAll;
  int index = 0;
  for ([[maybe_unused]] auto _ : state) {
    oursAll.push_back(measure(ours, index));
    theirsAll.push_back(measure(theirs, index));
    state.SetIterationTime(1e-3 * oursAll.back().wallMs);
    ++index;
  }
  const Cost a = median(oursAll), b = median(theirsAll);
  state.counters["ours"] = a.wallMs;
  state.counters["theirs"] = b.wallMs;
  state.counters["ratio"] = a.wallMs / b.wallMs;
  state.counters["ours_cpu"] = a.cpuMs;
  state.counters["theirs_cpu"] = b.cpuMs;
  state.counters["ratio_cpu"] = a.cpuMs / b.cpuMs;
  state.counters["ours_first"] = oursFirst.wallMs;
  state.counters["theirs_first"] = theirsFirst.wallMs;
}

}  // namespace luxo::bench
