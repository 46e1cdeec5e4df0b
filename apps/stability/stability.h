// SPDX-License-Identifier: Apache-2.0
// The stability suite: what can go wrong in floating point, each with a number and the most it may be. Behind
// `luxo verify --stability` and the tests of label `stress`.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "draw/renderer.h"
#include "gpu/context.h"

namespace luxo {

/// Something that was measured, and what it may be. Whether that holds follows from the numbers; NaN never
/// does.
struct Measurement {
  enum class Bound { AtMost, AtLeast };

  std::string what;
  double measured = 0, threshold = 0;
  Bound bound = Bound::AtMost;
  std::string unit = {};  ///< "px", "deg", "pixels", ...; empty: a pure number

  [[nodiscard]] bool passed() const {
    return bound == Bound::AtMost ? measured <= threshold : measured >= threshold;
  }
};

[[nodiscard]] Measurement atMost(std::string what, double measured, double threshold, std::string unit = {});
[[nodiscard]] Measurement atLeast(std::string what, double measured, double threshold, std::string unit = {});
/// A count that has to be 0.
[[nodiscard]] Measurement none(std::string what, double count, std::string unit = {});

struct StressOptions {
  /// Smaller pictures and fewer repetitions where the thresholds do not depend on them: for tests.
  bool quick = false;
  Shading shading = Shading::Exact;        ///< the one under test
  std::string device = "auto";             ///< as in gpu::ContextDesc
  bool validate = false;                   ///< with the validation layer
  std::string program = "/proc/self/exe";  ///< luxo: draws what other processes have to draw
  /// Where its messages go; null: nowhere.
  std::shared_ptr<gpu::ValidationLog> validationLog = nullptr;
};

/// What a case runs with: a device and a renderer, made when first needed.
class StressContext {
 public:
  explicit StressContext(StressOptions options = {});

  /// Throws Error(Device) when there is none.
  [[nodiscard]] gpu::Context& device();
  [[nodiscard]] Renderer& renderer();

  [[nodiscard]] const StressOptions& options() const { return options_; }
  [[nodiscard]] Shading shading() const { return options_.shading; }
  /// `full`, or `quick` when the options say so: sides of pictures, repetitions.
  [[nodiscard]] int of(int full, int quick) const { return options_.quick ? quick : full; }
  /// The suite's pictures are square: 1024 pixels, quick ones 256.
  [[nodiscard]] PixelSize size() const { return {of(1024, 256), of(1024, 256)}; }

  /// A picture under the shading under test. `camera` stands for the scene's.
  [[nodiscard]] Image draw(const Scene& scene, const Camera& camera, Output output = Output::Color);
  [[nodiscard]] Picture draw(const Snapshot& snapshot, DrawOptions options = {});

 private:
  StressOptions options_;
  std::unique_ptr<gpu::Context> device_;
  std::unique_ptr<Renderer> renderer_;
};

using StressRun = std::function<std::vector<Measurement>(StressContext&)>;

struct StressCase {
  std::string_view id;  ///< "ST-01"
  std::string_view title;
  StressRun run;
  /// The naive way to do it, held against the same thresholds: it must miss one, or the case has no teeth.
  /// Empty where there is none.
  StressRun canary = {};
};

/// All cases, by id.
[[nodiscard]] std::span<const StressCase> stressCases();

struct StabilityRequest {
  std::vector<std::string> ids = {};  ///< "ST-05" or "5", case does not matter; none: all
  bool json = false;
  bool strict = false;  ///< misses that are known (known_misses.h) fail, too
  StressOptions options = {};
  std::function<void(const std::string&)> print;  ///< takes whole lines as they become known
};

/// Runs cases and their canaries and prints every measurement: id, what, measured, threshold, whether it
/// passed. A case that throws an Error counts as failed, with its text. True when everything passed, but for
/// what is known unless that is asked for, and every canary failed. Throws Error(Usage) for an unknown id,
/// Error(Device) when there is no device.
[[nodiscard]] bool runStability(const StabilityRequest& request);

}  // namespace luxo
