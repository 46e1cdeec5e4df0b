// SPDX-License-Identifier: Apache-2.0
#include "window/swapchain.h"

#include "base/error.h"
#include "gpu/debug.h"
#include "gpu/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace luxo::window {
namespace {

constexpr VkPipelineStageFlags2 kFirstUse = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr std::uint64_t kPatience = 1'000'000'000;  // nanoseconds for an image to become free

gpu::Handle<VkSemaphore> createSemaphore(gpu::Context& context, const char* name) {
  const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  gpu::check(vkCreateSemaphore(context.device(), &info, nullptr, &semaphore), "create a semaphore");
  gpu::setName(context, semaphore, name);
  return {context, semaphore};
}

gpu::Handle<VkImageView> createView(gpu::Context& context, VkImage image, VkFormat format) {
  const VkImageViewCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = image,
      .viewType = VK_IMAGE_VIEW_TYPE_2D,
      .format = format,
      .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
  VkImageView view = VK_NULL_HANDLE;
  gpu::check(vkCreateImageView(context.device(), &info, nullptr, &view), "view an image of the window");
  return {context, view};
}

// The window's own size where it has one; else ours, within its limits.
VkExtent2D extentFor(const VkSurfaceCapabilitiesKHR& can, VkExtent2D framebuffer) {
  if (can.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) return can.currentExtent;
  return {std::clamp(framebuffer.width, can.minImageExtent.width, can.maxImageExtent.width),
          std::clamp(framebuffer.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR alphaFor(const VkSurfaceCapabilitiesKHR& can) {
  for (const auto mode : {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
                          VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR}) {
    if ((can.supportedCompositeAlpha & mode) != 0) return mode;
  }
  return VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR;
}

}  // namespace

Swapchain::Swapchain(gpu::Context& context, const Window& window)
    : context_(&context),
      surface_(window.createSurface(context.instance()), DestroySurface{context.instance()}) {
  for (auto& semaphore : acquired_) semaphore = createSemaphore(context, "image acquired");
  chooseFormat();
}

Swapchain::~Swapchain() {
  images_.clear();
  swapchain_.reset();
  // A surface must outlive its swapchain, so what was dropped has to go now.
  try {
    context_->waitIdle();
  } catch (const Error&) {  // the device is lost and does nothing any more
    context_->timeline().destruction().drain();
  }
}

void Swapchain::chooseFormat() {
  std::uint32_t count = 0;
  const VkPhysicalDevice device = context_->physicalDevice();
  gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface_.get(), &count, nullptr),
             "list the window's formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface_.get(), &count, formats.data()),
             "list the window's formats");
  // UNORM: the sRGB encode is ours, in present.frag.
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
    for (const VkSurfaceFormatKHR& format : formats) {
      if (format.format != wanted || format.colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) continue;
      format_ = format;
      return;
    }
  }
  throw Error(ErrorKind::Device,
              fmt::format("cannot draw into the window: none of its {} formats is 8-bit RGBA", count),
              "use a screen of 24 bits per pixel, or -o FILE to render without a window");
}

SwapchainStatus Swapchain::update(VkExtent2D framebuffer) {
  if (framebuffer.width == 0 || framebuffer.height == 0) return SwapchainStatus::Hidden;
  const bool fits = framebuffer.width == extent_.width && framebuffer.height == extent_.height;
  return fits && !stale_ ? SwapchainStatus::Ready : recreate(framebuffer);
}

SwapchainStatus Swapchain::recreate(VkExtent2D framebuffer) {
  // Nothing else says when the presentation of the old images is over.
  context_->waitIdle();
  VkSurfaceCapabilitiesKHR can;
  gpu::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context_->physicalDevice(), surface_.get(), &can),
             "ask for the window's size");
  const VkExtent2D extent = extentFor(can, framebuffer);
  if (extent.width == 0 || extent.height == 0) return SwapchainStatus::Hidden;
  const std::uint32_t most =
      can.maxImageCount > 0 ? can.maxImageCount : std::numeric_limits<std::uint32_t>::max();
  const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                      .surface = surface_.get(),
                                      .minImageCount = std::min(std::max(can.minImageCount, 3u), most),
                                      .imageFormat = format_.format,
                                      .imageColorSpace = format_.colorSpace,
                                      .imageExtent = extent,
                                      .imageArrayLayers = 1,
                                      .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                      .preTransform = can.currentTransform,
                                      .compositeAlpha = alphaFor(can),
                                      .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                      .clipped = VK_TRUE,
                                      .oldSwapchain = swapchain_};
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  gpu::check(vkCreateSwapchainKHR(context_->device(), &info, nullptr, &swapchain),
             fmt::format("make {}x{} images for the window", extent.width, extent.height));
  images_.clear();  // views before what they view
  swapchain_ = {*context_, swapchain};
  extent_ = extent;
  takeImages();
  stale_ = false;
  ++generation_;
  return SwapchainStatus::Ready;
}

void Swapchain::takeImages() {
  std::uint32_t count = 0;
  gpu::check(vkGetSwapchainImagesKHR(context_->device(), swapchain_, &count, nullptr),
             "list the window's images");
  std::vector<VkImage> images(count);
  gpu::check(vkGetSwapchainImagesKHR(context_->device(), swapchain_, &count, images.data()),
             "list the window's images");
  views_.clear();
  for (const VkImage image : images) {
    gpu::setName(*context_, image, "window");
    images_.push_back({.image = image,
                       .view = createView(*context_, image, format_.format),
                       .shown = createSemaphore(*context_, "image drawn")});
    views_.push_back(images_.back().view);
  }
}

SwapchainStatus Swapchain::acquire(std::size_t slot) {
  const VkResult result = vkAcquireNextImageKHR(context_->device(), swapchain_, kPatience, acquired_[slot],
                                                VK_NULL_HANDLE, &index_);
  if (result == VK_TIMEOUT || result == VK_NOT_READY) return SwapchainStatus::Hidden;
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    stale_ = true;
    return SwapchainStatus::Resized;
  }
  gpu::check(result, "get an image to draw to");
  stale_ = result == VK_SUBOPTIMAL_KHR;  // it is ours all the same and wants to be shown
  wait_ = {.semaphore = acquired_[slot], .stage = kFirstUse};
  images_[index_].state = gpu::ResourceState::acquired(kFirstUse);
  return SwapchainStatus::Ready;
}

SwapchainStatus Swapchain::present() {
  const VkSwapchainKHR swapchain = swapchain_;
  const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = images_[index_].shown.pointer(),
                              .swapchainCount = 1,
                              .pSwapchains = &swapchain,
                              .pImageIndices = &index_};
  const VkResult result = vkQueuePresentKHR(context_->queue(), &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) stale_ = true;
  if (result != VK_ERROR_OUT_OF_DATE_KHR) gpu::check(result, "show a picture in the window");
  return stale_ ? SwapchainStatus::Resized : SwapchainStatus::Ready;
}

}  // namespace luxo::window
