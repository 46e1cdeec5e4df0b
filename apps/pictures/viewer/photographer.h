// SPDX-License-Identifier: Apache-2.0
// Saves what the viewer shows as a picture, at full precision.
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "draw/renderer.h"
#include "gpu/context.h"
#include "scene/snapshot.h"

namespace luxo {

class Photographer {
 public:
  /// What became of a picture.
  struct Outcome {
    std::filesystem::path file;
    std::optional<Error> error = std::nullopt;
  };

  /// Its end waits for the file that is being written.
  explicit Photographer(gpu::Context& context) : context_(&context) {}

  /// Draws the picture now and writes it beside, as luxo-0001.png or the next free number in the current
  /// folder. Waits for the one before, if that is still being written. Throws what Renderer::render() throws.
  void take(const Snapshot& snapshot, const DrawOptions& options);

  /// What it draws with is as large as all that the window is drawn with. It is kept for ten seconds, so that
  /// pictures in a row are quick; then it goes. True when it just went: waits for the device to be idle.
  bool rest();
  /// Seconds until rest() has something to give up; nothing while it has nothing.
  [[nodiscard]] std::optional<double> secondsToRest() const;

  /// Whether a picture's outcome is still to come.
  [[nodiscard]] bool busy() const { return writing_.valid(); }
  /// The outcome of the picture taken last, once.
  [[nodiscard]] std::optional<Outcome> poll();

 private:
  gpu::Context* context_;
  std::unique_ptr<Renderer> renderer_;  // made for a picture
  std::chrono::steady_clock::time_point taken_;
  std::future<Outcome> writing_;
};

}  // namespace luxo
