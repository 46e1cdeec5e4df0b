// SPDX-License-Identifier: Apache-2.0
// Google Benchmark's console output, followed by a table of the ratios.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

namespace luxo::bench {

class Report : public benchmark::ConsoleReporter {
 public:
  Report() : ConsoleReporter(OO_None) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// Whether any benchmark reported an error.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::vector<Run> compared_;
  bool failed_ = false;
};

}  // namespace luxo::bench
