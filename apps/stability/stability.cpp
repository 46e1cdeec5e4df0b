// SPDX-License-Identifier: Apache-2.0
#include "stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "stability/cases.h"
#include "stability/known_misses.h"

namespace luxo {
namespace {

using Group = std::vector<StressCase> (*)();

constexpr Group kGroups[] = {parameterisationCases,
                             derivativeCases,
                             accuracyCases,
                             rasterisationCases,
                             tessellationCases,
                             depthCases,
                             transformCases,
                             invarianceCases,
                             shadingCases,
                             hazardCases,
                             lampCases,
                             shadowCases,
                             systemCases};

std::vector<StressCase> allCases() {
  std::vector<StressCase> cases;
  for (const Group group : kGroups)
    for (StressCase& one : group()) cases.push_back(std::move(one));
  std::sort(cases.begin(), cases.end(), [](const StressCase& a, const StressCase& b) { return a.id < b.id; });
  return cases;
}

const StressCase& caseOf(const std::string& id) {
  std::string wanted;
  for (const char c : id) wanted += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (!wanted.starts_with("ST-")) wanted = (wanted.size() < 2 ? "ST-0" : "ST-") + wanted;
  const auto cases = stressCases();
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const StressCase& one) { return one.id == wanted; });
  if (found == cases.end())
    throw Error(ErrorKind::Usage, fmt::format("there is no stress test '{}'", id),
                fmt::format("they are named {} to {}; without a name all are run", cases.front().id,
                            cases.back().id));
  return *found;
}

std::vector<const StressCase*> chosen(const std::vector<std::string>& ids) {
  std::vector<const StressCase*> cases;
  for (const std::string& id : ids) cases.push_back(&caseOf(id));
  if (ids.empty())
    for (const StressCase& one : stressCases()) cases.push_back(&one);
  return cases;
}

/// What a run of a case, or of its canary, gave.
struct Outcome {
  std::vector<Measurement> measurements;
  std::string error;  ///< empty: it ran to its end

  /// Measurements that miss for a reason that is known.
  [[nodiscard]] std::size_t knownMisses(std::string_view id) const {
    return static_cast<std::size_t>(std::ranges::count_if(measurements, [&](const Measurement& one) {
      return !one.passed() && reasonForMiss(id, one.what).has_value();
    }));
  }
  [[nodiscard]] bool onlyKnownMisses(std::string_view id) const {
    return error.empty() && std::ranges::all_of(measurements, [&](const Measurement& one) {
             return one.passed() || reasonForMiss(id, one.what).has_value();
           });
  }
  [[nodiscard]] bool passed() const {
    return error.empty() && std::all_of(measurements.begin(), measurements.end(),
                                        [](const Measurement& one) { return one.passed(); });
  }
};

// A machine without a device says so; every other failure is a result of the test.
Outcome outcomeOf(const StressRun& run, StressContext& context) {
  try {
    return {run(context), {}};
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::Device) throw;
    return {{}, error.what()};
  }
}

std::string limitOf(const Measurement& one) {
  return fmt::format("{} {:.6g} {}", one.bound == Measurement::Bound::AtMost ? "<=" : ">=", one.threshold,
                     one.unit);
}

std::string textOf(const StressCase& one, const Outcome& outcome, bool canary) {
  std::string text = fmt::format("{}{} {}\n", one.id, canary ? " canary, has to fail:" : "", one.title);
  for (const Measurement& m : outcome.measurements) {
    text += fmt::format("  {:<4} {:<60} {:>12.5g}  {}\n",
                        m.passed()                                 ? "pass"
                        : reasonForMiss(one.id, m.what) && !canary ? "miss"
                                                                   : "FAIL",
                        m.what, m.measured, limitOf(m));
    if (const auto reason = reasonForMiss(one.id, m.what); reason && !m.passed() && !canary)
      text += fmt::format("       known: {}\n", *reason);
  }
  if (!outcome.error.empty()) text += fmt::format("  FAIL {}\n", outcome.error);
  return text;
}

// JSON has no infinity and no NaN: null.
nlohmann::ordered_json finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json jsonOf(const StressCase& one, const Outcome& outcome, bool canary) {
  nlohmann::ordered_json measurements = nlohmann::ordered_json::array();
  for (const Measurement& m : outcome.measurements) {
    measurements.push_back({{"what", m.what},
                            {"measured", finite(m.measured)},
                            {m.bound == Measurement::Bound::AtMost ? "at_most" : "at_least", m.threshold},
                            {"unit", m.unit},
                            {"passed", m.passed()}});
    if (const auto reason = reasonForMiss(one.id, m.what); reason && !m.passed())
      measurements.back()["known"] = *reason;
  }
  nlohmann::ordered_json json = {
      {"id", one.id}, {"title", one.title}, {"canary", canary}, {"passed", outcome.passed()}};
  if (!outcome.error.empty()) json["error"] = outcome.error;
  json["measurements"] = std::move(measurements);
  return json;
}

}  // namespace

Measurement atMost(std::string what, double measured, double threshold, std::string unit) {
  return {std::move(what), measured, threshold, Measurement::Bound::AtMost, std::move(unit)};
}

Measurement atLeast(std::string what, double measured, double threshold, std::string unit) {
  return {std::move(what), measured, threshold, Measurement::Bound::AtLeast, std::move(unit)};
}

Measurement none(std::string what, double count, std::string unit) {
  return atMost(std::move(what), count, 0, std::move(unit));
}

StressContext::StressContext(StressOptions options) : options_(std::move(options)) {}

gpu::Context& StressContext::device() {
  if (!device_)
    device_ = std::make_unique<gpu::Context>(gpu::ContextDesc{
        .device = options_.device, .validation = options_.validate, .validationLog = options_.validationLog});
  return *device_;
}

Renderer& StressContext::renderer() {
  if (!renderer_) renderer_ = std::make_unique<Renderer>(device());
  return *renderer_;
}

Image StressContext::draw(const Scene& scene, const Camera& camera, Output output) {
  return draw(takeSnapshot(scene, 0, size(), camera), {.output = output}).image;
}

Picture StressContext::draw(const Snapshot& snapshot, DrawOptions options) {
  options.shading = options_.shading;
  return renderer().render(snapshot, options);
}

std::span<const StressCase> stressCases() {
  static const std::vector<StressCase> cases = allCases();
  return cases;
}

bool runStability(const StabilityRequest& request) {
  const auto cases = chosen(request.ids);
  StressContext context(request.options);
  nlohmann::ordered_json report = nlohmann::ordered_json::array();
  int failures = 0;
  std::size_t known = 0;
  const auto show = [&](const StressCase& one, const StressRun& run, bool canary) {
    if (!run) return;
    const Outcome outcome = outcomeOf(run, context);
    const std::size_t misses = canary ? 0 : outcome.knownMisses(one.id);
    known += misses;
    const bool good = outcome.passed() || (misses > 0 && !request.strict && outcome.onlyKnownMisses(one.id));
    if (good == canary) ++failures;
    if (request.json)
      report.push_back(jsonOf(one, outcome, canary));
    else
      request.print(textOf(one, outcome, canary));
  };
  for (const StressCase* one : cases) {
    show(*one, one->run, false);
    show(*one, one->canary, true);
  }
  if (request.json)
    request.print(report.dump(2) + "\n");
  else
    request.print(
        (failures == 0 ? fmt::format("all {} stress tests passed", cases.size())
                       : fmt::format("{} of {} stress tests failed", failures, cases.size())) +
        (known > 0 && !request.strict ? fmt::format(", but for {} misses that are known\n", known) : "\n"));
  return failures == 0;
}

}  // namespace luxo
