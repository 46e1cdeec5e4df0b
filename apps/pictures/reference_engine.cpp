// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <limits>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/stopwatch.h"
#include "interruption.h"
#include "picture_engine.h"
#include "progress_bar.h"
#include "reference/reference.h"

namespace luxo {
namespace {

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
    case Output::Certificate:  // by a ray, or neither
      return imageOf(picture, 1, [&](std::size_t i) {
        return Vec3(picture.number[i] == 0 ? 0 : picture.certified[i] ? 2 : 3);
      });
  }
  throw Error(ErrorKind::Internal, "the reference does not know this output");
}

class ReferenceEngine : public PictureEngine {
 public:
  ReferenceEngine(const RenderRequest& request, const RenderSettings& settings)
      : output_(request.aov),
        // Geometry is of the pixel's centre and never averaged.
        samples_(request.aov == Output::Color ? settings.samples : 1),
        shading_(settings.shading),
        showsProgress_(request.verbosity == Verbosity::Normal) {
    requireGroundTruth(settings);
  }

  [[nodiscard]] DeviceReport device() const override {
    return {"reference", "cpu", std::nullopt, std::nullopt};
  }

  [[nodiscard]] std::optional<MadePicture> make(const Snapshot& snapshot) override {
    if (output_ == Output::Color) warnOfShaders(snapshot);
    const Stopwatch watch;
    ProgressBar bar(showsProgress_);
    // Rays know no maps: a light that has one casts the shadow which that stands for.
    ReferencePicture picture = castPicture(
        withoutShadowMaps(snapshot), {.samples = samples_, .shading = shading_, .progress = [&](double done) {
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
    made.statistics.ms.total = watch.milliseconds();
    return made;
  }

 private:
  static void requireGroundTruth(const RenderSettings& settings) {
    const Shading shading = settings.shading;
    if (shading != Shading::Flat && shading != Shading::Gouraud && shading != Shading::Phong &&
        shading != Shading::Exact && shading != Shading::Toon)
      throw Error(ErrorKind::Scene, fmt::format("shading '{}' has no ground truth", nameOf(shading)),
                  "give --shading phong; --aov writes depth, position, normal, uv or id");
  }

  void warnOfShaders(const Snapshot& snapshot) {
    for (const SnapshotNode& node : snapshot.nodes) {
      const Material& material = snapshot.materials[node.material.index];
      if (material.shader && warned_.insert(material.name).second)
        log(LogLevel::Warning,
            fmt::format("the reference cannot run the shader of '{}': it is drawn as if there were none",
                        material.name));
    }
  }

  Output output_;
  std::set<std::string> warned_;
  int samples_;
  Shading shading_;
  bool showsProgress_;
};

}  // namespace

std::unique_ptr<PictureEngine> referenceEngine(const RenderRequest& request, const RenderSettings& settings) {
  return std::make_unique<ReferenceEngine>(request, settings);
}

}  // namespace luxo
