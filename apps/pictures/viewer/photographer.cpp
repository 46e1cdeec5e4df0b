// SPDX-License-Identifier: Apache-2.0
#include "viewer/photographer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "background.h"
#include "image/format.h"

namespace luxo {
namespace {

std::filesystem::path nextFreeFile() {
  for (int number = 1;; ++number) {
    std::filesystem::path file = fmt::format("luxo-{:04}.png", number);
    std::error_code failure;  // what cannot be looked at cannot be overwritten either; saving will tell
    if (!std::filesystem::exists(file, failure)) return file;
  }
}

Photographer::Outcome save(const Image& image, const std::filesystem::path& file) {
  try {
    saveImage(image, file);
    return {.file = file};
  } catch (const Error& error) {
    return {.file = file, .error = error};
  }
}

}  // namespace

void Photographer::take(const Snapshot& snapshot, const DrawOptions& options) {
  if (writing_.valid()) writing_.wait();
  if (!renderer_) renderer_ = std::make_unique<Renderer>(*context_);
  writing_ = inBackground(
      [image = renderer_->render(snapshot, options).image] { return save(image, nextFreeFile()); });
  taken_ = std::chrono::steady_clock::now();
}

bool Photographer::rest() {
  if (secondsToRest().value_or(1) > 0) return false;
  renderer_.reset();
  context_->waitIdle();  // which destroys it
  return true;
}

std::optional<double> Photographer::secondsToRest() const {
  constexpr double kKept = 10;
  if (!renderer_) return std::nullopt;
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - taken_;
  return std::max(0.0, kKept - since.count());
}

std::optional<Photographer::Outcome> Photographer::poll() {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  return writing_.get();
}

}  // namespace luxo
