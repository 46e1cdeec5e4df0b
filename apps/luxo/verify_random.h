// SPDX-License-Identifier: Apache-2.0
// luxo verify --random: thousands of hard scenes against the ground truth, one line of JSON each.
#pragma once

#include <memory>

#include "options.h"

namespace luxo {

/// The options of `luxo verify` that are about random scenes.
class RandomOptions {
 public:
  explicit RandomOptions(CLI::App& command);
  RandomOptions(const RandomOptions&) = delete;
  RandomOptions& operator=(const RandomOptions&) = delete;
  ~RandomOptions();

  /// Whether --random was given.
  [[nodiscard]] bool asked() const;
  /// Error(Usage): one of the others was given without it.
  void requireUnused() const;

  /// Runs them, with the request's samples if it says so; `findings` takes what fails (empty: nothing does).
  /// The exit code.
  [[nodiscard]] int run(const RenderRequest& render, const std::string& findings) const;

 private:
  struct Texts;
  std::unique_ptr<Texts> texts_;
};

}  // namespace luxo
