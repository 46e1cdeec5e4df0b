// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <fmt/ostream.h>

namespace luxo::bench {

void Report::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    failed_ = failed_ || run.error_occurred;
    if (run.counters.contains("ratio")) compared_.push_back(run);
  }
}

void Report::Finalize() {
  if (compared_.empty()) return;
  fmt::print(GetOutputStream(), "\n{:<44}{:>10}{:>10}{:>8}{:>11}{:>12}\n", "side by side, medians in ms",
             "ours", "theirs", "ratio", "ratio cpu", "ours first");
  for (const Run& run : compared_) {
    const auto value = [&](const char* counter) { return run.counters.at(counter).value; };
    fmt::print(GetOutputStream(), "{:<44}{:>10.2f}{:>10.2f}{:>8.3f}{:>11.3f}{:>12.1f}\n",
               run.run_name.function_name, value("ours"), value("theirs"), value("ratio"), value("ratio_cpu"),
               value("ours_first"));
  }
  fmt::print(
      GetOutputStream(),
      "theirs: frame = one draw per strip, 64 x 64, Phong, one sample; evaluate = code written by hand; "
      "start = empty caches\n");
}

}  // namespace luxo::bench
