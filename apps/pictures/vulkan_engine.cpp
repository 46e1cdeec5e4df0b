// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "draw/device_precision.h"
#include "draw/picture_room.h"
#include "draw/renderer.h"
#include "interruption.h"
#include "picture_engine.h"
#include "progress_bar.h"

namespace luxo {
namespace {

class VulkanEngine : public PictureEngine {
 public:
  VulkanEngine(const RenderRequest& request, const RenderSettings& settings,
               std::shared_ptr<gpu::ValidationLog> validation)
      : context_({.device = request.device,
                  .validation = request.validate,
                  .validationLog = std::move(validation)}),
        renderer_(context_),
        options_(drawOptions(settings)),
        showsProgress_(request.verbosity == Verbosity::Normal),
        judged_(request.requireErrorPx.has_value()) {
    requireRoom(request, settings);
    options_.output = request.aov;
    options_.composition = request.composition;
    options_.skips = request.skips;
    options_.audit = request.audit;
    if (request.report) sinCos_ = sinCosError(context_);
  }

  [[nodiscard]] DeviceReport device() const override {
    const gpu::DeviceInfo& info = context_.deviceInfo();
    return {info.name, gpu::deviceTypeName(info.type), info.driver, sinCos_};
  }

  [[nodiscard]] std::optional<MadePicture> make(const Snapshot& snapshot) override {
    ProgressBar bar(showsProgress_);
    std::optional<Picture> picture = renderer_.render(snapshot, options_, [&](double done) {
      bar.show(done);
      return interruptingSignal() == 0;
    });
    if (!picture) return std::nullopt;
    tellComposition(picture->statistics.count);
    // Only colours bring the residuals along.
    if (judged_ && options_.output != Output::Color)
      picture->statistics.error.residualMaxPx = residualOf(snapshot);
    return MadePicture{std::move(picture->image), picture->statistics};
  }

 private:
  /// If it is not the one that was asked for, once.
  void tellComposition(const FrameCounts& count) {
    const bool deferred = count.deferred > 0;
    if (std::exchange(toldComposition_, true)) return;
    if (deferred && options_.composition == Composition::Fused)
      log(LogLevel::Warning,
          "--composition fused: the picture is deferred all the same, as shadows, what is seen through, "
          "ambient occlusion, rays of shaders and more than 32 lights on a surface need it");
    if (!deferred && options_.composition == Composition::Deferred)
      log(LogLevel::Warning,
          "--composition deferred: the picture is fused all the same, as it shows no light, or too many "
          "lights "
          "or materials");
  }

  /// Before anything is drawn: no retry would help.
  void requireRoom(const RenderRequest& request, const RenderSettings& settings) {
    const int samples = request.aov == Output::Color ? settings.samples : 1;
    const auto fits = sizeThatFits(context_, settings.size, samples);
    if (!fits) return;
    const bool typed = request.size || request.samples;
    throw Error(typed ? ErrorKind::Usage : ErrorKind::Scene,
                fmt::format("a picture of {}x{} pixels{} is more than {} holds", settings.size.width,
                            settings.size.height,
                            samples > 1 ? fmt::format(" with {} samples", samples) : std::string(),
                            context_.deviceInfo().name),
                fmt::format("{}x{} pixels fit{}; or draw it with --engine reference, which needs no device",
                            fits->width, fits->height, samples > 1 ? ", or fewer samples" : ""));
  }

  /// Of the same surfaces in the same pixels.
  [[nodiscard]] std::optional<double> residualOf(const Snapshot& snapshot) {
    DrawOptions color = options_;
    color.output = Output::Color;
    color.samples = 1;
    return renderer_.render(snapshot, color).statistics.error.residualMaxPx;
  }

  gpu::Context context_;
  Renderer renderer_;
  DrawOptions options_;
  bool showsProgress_;
  bool toldComposition_ = false;
  bool judged_;  ///< the run's exit code depends on the error
  std::optional<SinCosError> sinCos_;
};

}  // namespace

std::unique_ptr<PictureEngine> vulkanEngine(const RenderRequest& request, const RenderSettings& settings,
                                            std::shared_ptr<gpu::ValidationLog> validation) {
  return std::make_unique<VulkanEngine>(request, settings, std::move(validation));
}

}  // namespace luxo
