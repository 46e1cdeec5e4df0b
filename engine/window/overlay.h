// SPDX-License-Identifier: Apache-2.0
// Text over the picture: panels that say what is going on, and sliders. It shows, and tells where things can
// be grabbed; what a grab means is the application's business.
#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"
#include "gpu/vk.h"
#include "window/swapchain.h"
#include "window/window.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace luxo::window {

/// Text in Latin-1's characters, UTF-8 encoded.
struct Panel {
  enum class Place { TopLeft, Top, TopRight, BottomLeft, Center };
  struct Row {
    std::string label;  ///< in a column of its own; empty for a line across both
    std::string text;
    /// A slider between label and text: where its handle stands, from 0 to 1.
    std::optional<double> slider = std::nullopt;
    /// A colour in the slider's place: codes of sRGB, from 0 to 1.
    std::optional<std::array<float, 3>> swatch = std::nullopt;
    /// Of its grab area: the slider's track, the colour or else, as a button, the text. -1: none.
    int key = -1;

    friend bool operator==(const Row&, const Row&) = default;
  };

  Place place = Place::TopLeft;
  std::string title;  ///< may be empty
  std::vector<Row> rows;
  bool alert = false;       ///< something went wrong
  bool discreet = false;    ///< takes at most a quarter of the window
  bool monospaced = false;  ///< columns of different lines align

  friend bool operator==(const Panel&, const Panel&) = default;
};

/// Draws panels into the acquired image of a swapchain. There may be one overlay at a time.
class Overlay {
 public:
  Overlay(gpu::Context& context, VkFormat format);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Over what the image shows as Use::ColorAttachment, which it stays. Letters grow with `contentScale`
  /// (Window). A panel too large for the window shrinks; it is left out where it could not be read, or where
  /// a later one would cover it. Gives the grab areas of what is shown.
  [[nodiscard]] std::vector<GrabArea> record(VkCommandBuffer commands, const Swapchain& swapchain,
                                             double contentScale, std::span<const Panel> panels);

 private:
  void start(double contentScale);
  void stop();
  void prepareFramebuffers(const Swapchain& swapchain);

  gpu::Context* context_;
  gpu::Handle<VkRenderPass> pass_;
  gpu::Handle<VkDescriptorPool> descriptors_;
  std::vector<gpu::Handle<VkFramebuffer>> framebuffers_;
  std::uint64_t generation_ = 0;  // of the swapchain the framebuffers are for
  double contentScale_ = 0;       // 0 = not started
  bool uploaded_ = false;         // the letters are on the device
};

}  // namespace luxo::window
