// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "interruption.h"
#include "picture_engine.h"
#include "reference/reference.h"

namespace luxo {
namespace {

using Clock = std::chrono::steady_clock;

/// One line on a terminal that is rewritten as the work goes on and wiped when it is over.
class ProgressBar {
 public:
  explicit ProgressBar(bool visible) : visible_(visible) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() {
    if (drawn_) fmt::print(stderr, "\r\x1b[K");
  }

  void show(double done) {
    constexpr std::chrono::milliseconds kPause(100);
    constexpr int kWidth = 40;
    const Clock::time_point now = Clock::now();
    if (!visible_ || now - last_ < kPause) return;
    last_ = now;
    drawn_ = true;
    const double passed = std::chrono::duration<double>(now - start_).count();
    const int filled = static_cast<int>(done * kWidth);
    fmt::print(stderr, "\r[{}{}] {:3.0f} %, {:.0f} s left \x1b[K", std::string(filled, '#'),
               std::string(kWidth - filled, '.'), 100 * done, passed * (1 / done - 1));
  }

 private:
  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

Image imageOf(const ReferencePicture& picture, int channels, const auto& valueOf) {
  Image image(picture.color.width(), picture.color.height(), channels);
  for (std::size_t i = 0; i < picture.depth.size(); ++i)
    for (int c = 0; c < channels; ++c)
      image.samples()[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] =
          static_cast<float>(valueOf(i)[c]);
  return image;
}

Image imageOf(ReferencePicture picture, Output output) {
  switch (output) {
    case Output::Color:
      return std::move(picture.color);
    case Output::Depth:
      return imageOf(picture, 1, [&](std::size_t i) { return Vec3(picture.depth[i]); });
    case Output::Position:
      return imageOf(picture, 3, [&](std::size_t i) { return picture.position[i]; });
    case Output::Normal:
      return imageOf(picture, 3, [&](std::size_t i) { return picture.normal[i]; });
    case Output::Uv:
      return imageOf(picture, 3, [&](std::size_t i) { return Vec3(picture.parameters[i], 0); });
    case Output::Id:
      return imageOf(picture, 1, [&](std::size_t i) { return Vec3(picture.number[i]); });
    case Output::Residual:  // below what a float can say
      return imageOf(picture, 1, [](std::size_t) { return Vec3(0); });
  }
  throw Error(ErrorKind::Internal, "the reference does not know this output");
}

class ReferenceEngine : public PictureEngine {
 public:
  ReferenceEngine(const RenderRequest& request, const RenderSettings& settings)
      : output_(request.aov),
        // Geometry is of the pixel's centre and never averaged.
        samples_(request.aov == Output::Color ? settings.samples : 1),
        showsProgress_(request.verbosity == Verbosity::Normal && isatty(STDERR_FILENO) == 1) {
    requireGroundTruth(settings);
  }

  [[nodiscard]] DeviceReport device() const override { return {"reference", "cpu", std::nullopt}; }

  [[nodiscard]] std::optional<MadePicture> make(const Snapshot& snapshot) override {
    const auto start = Clock::now();
    ProgressBar bar(showsProgress_);
    ReferencePicture picture = castPicture(snapshot, {.samples = samples_, .progress = [&](double done) {
                                                        bar.show(done);
                                                        return interruptingSignal() == 0;
                                                      }});
    if (!picture.complete) return std::nullopt;
    MadePicture made;
    made.reference = {picture.hits, picture.misses, picture.undecided, picture.standardErrorRms,
                      picture.standardErrorMax};
    made.statistics.count.nodes = snapshot.nodes.size();
    // Proven pixels show the surfaces themselves, to rounding; of the others nothing is proven.
    made.statistics.error.boundPx = picture.undecided == 0 ? 0 : std::numeric_limits<double>::infinity();
    made.image = imageOf(std::move(picture), output_);
    made.statistics.ms.total = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return made;
  }

 private:
  static void requireGroundTruth(const RenderSettings& settings) {
    const Shading shading = settings.shading;
    if (shading != Shading::Flat && shading != Shading::Gouraud && shading != Shading::Phong &&
        shading != Shading::Exact)
      throw Error(ErrorKind::Scene, fmt::format("shading '{}' has no ground truth", nameOf(shading)),
                  "give --shading phong; --aov writes depth, position, normal, uv or id");
    if (settings.samples > kMaxSamples)
      throw Error(
          ErrorKind::Scene,
          fmt::format("the scene asks for {} samples per pixel, more than {}", settings.samples, kMaxSamples),
          "give --samples");
  }

  Output output_;
  int samples_;
  bool showsProgress_;
};

}  // namespace

std::unique_ptr<PictureEngine> referenceEngine(const RenderRequest& request, const RenderSettings& settings) {
  return std::make_unique<ReferenceEngine>(request, settings);
}

}  // namespace luxo
