// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "draw/renderer.h"
#include "picture_engine.h"

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
        options_(drawOptions(settings)) {
    options_.output = request.aov;
    options_.skips = request.skips;
  }

  [[nodiscard]] DeviceReport device() const override {
    const gpu::DeviceInfo& info = context_.deviceInfo();
    return {info.name, gpu::deviceTypeName(info.type), info.driver};
  }

  [[nodiscard]] std::optional<MadePicture> make(const Snapshot& snapshot) override {
    Picture picture = renderer_.render(snapshot, options_);
    return MadePicture{std::move(picture.image), picture.statistics};
  }

 private:
  gpu::Context context_;
  Renderer renderer_;
  DrawOptions options_;
};

}  // namespace

std::unique_ptr<PictureEngine> vulkanEngine(const RenderRequest& request, const RenderSettings& settings,
                                            std::shared_ptr<gpu::ValidationLog> validation) {
  return std::make_unique<VulkanEngine>(request, settings, std::move(validation));
}

}  // namespace luxo
