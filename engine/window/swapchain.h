// SPDX-License-Identifier: Apache-2.0
// The images a window shows, one after the other.
#pragma once

#include "gpu/context.h"
#include "gpu/frame.h"
#include "gpu/handle.h"
#include "gpu/timeline.h"
#include "gpu/usage.h"
#include "gpu/vk.h"
#include "window/window.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace luxo::window {

enum class SwapchainStatus {
  Ready,
  Resized,  ///< the window changed: update() and draw again
  Hidden,   ///< there is nothing to draw to; wait for events
};

/// A frame, with `frames` of the same context:
///     if (swapchain.update(window.framebufferSize()) == SwapchainStatus::Hidden) return;
///     commands = frames.begin();
///     if (swapchain.acquire(frames.slot()) != SwapchainStatus::Ready) return;   // and come again
///     ... draw into image(), then use it as Use::Present ...
///     frames.submit(swapchain.waits(), swapchain.signals());
///     swapchain.present();
class Swapchain {
 public:
  /// Throws Error(Device) when the window cannot be drawn to.
  Swapchain(gpu::Context& context, const Window& window);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Makes the images fit; waits for the device when they did not. Ready or Hidden.
  SwapchainStatus update(VkExtent2D framebuffer);
  /// The next image to draw to. Resized when there is none any more, Hidden when none came within a second.
  [[nodiscard]] SwapchainStatus acquire(std::size_t slot);
  /// Shows the acquired image. Resized when it does not fit the window any more.
  SwapchainStatus present();

  [[nodiscard]] VkExtent2D extent() const { return extent_; }       ///< pixels
  [[nodiscard]] VkFormat format() const { return format_.format; }  ///< 8-bit UNORM; never changes

  // The acquired image. Its first use is to follow waits().
  [[nodiscard]] std::uint32_t index() const { return index_; }
  [[nodiscard]] VkImage image() const { return images_[index_].image; }
  [[nodiscard]] VkImageView view() const { return images_[index_].view; }
  [[nodiscard]] gpu::ResourceState& state() { return images_[index_].state; }
  [[nodiscard]] std::span<const gpu::SemaphoreWait> waits() const { return {&wait_, 1}; }
  [[nodiscard]] std::span<const VkSemaphore> signals() const { return {images_[index_].shown.pointer(), 1}; }

  /// Grows when the images are replaced: what was made from their views is stale then.
  [[nodiscard]] std::uint64_t generation() const { return generation_; }
  [[nodiscard]] std::span<const VkImageView> views() const { return views_; }

 private:
  struct Image {
    VkImage image = VK_NULL_HANDLE;  // the swapchain's
    gpu::Handle<VkImageView> view;
    // Signalled when drawn. Per image, since only its next acquisition says that the last presentation is
    // done with it.
    gpu::Handle<VkSemaphore> shown;
    gpu::ResourceState state{gpu::ResourceKind::Image};
  };

  struct DestroySurface {
    VkInstance instance = VK_NULL_HANDLE;
    using pointer = VkSurfaceKHR;
    void operator()(VkSurfaceKHR surface) const { vkDestroySurfaceKHR(instance, surface, nullptr); }
  };

  void chooseFormat();
  SwapchainStatus recreate(VkExtent2D framebuffer);
  void takeImages();

  gpu::Context* context_;
  std::unique_ptr<VkSurfaceKHR_T, DestroySurface> surface_;  // goes last
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  gpu::Handle<VkSwapchainKHR> swapchain_;
  std::vector<Image> images_;
  std::vector<VkImageView> views_;
  std::array<gpu::Handle<VkSemaphore>, gpu::FrameRing::kFrames> acquired_;  // per slot of the ring
  gpu::SemaphoreWait wait_;
  std::uint32_t index_ = 0;
  std::uint64_t generation_ = 0;
  bool stale_ = true;
};

}  // namespace luxo::window
