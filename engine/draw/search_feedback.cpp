// SPDX-License-Identifier: Apache-2.0
#include "draw/search_feedback.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "draw/measured_pixels.h"
#include "gpu/barrier.h"
#include "image/half.h"

namespace luxo {
namespace {

constexpr VkDeviceSize kColorWords = 4;

/// A buffer of at least that many bytes which the host reads, all 0.
void clear(gpu::Context& context, gpu::Buffer& buffer, VkDeviceSize bytes, const char* name) {
  if (!buffer || buffer.size() < bytes)
    buffer = gpu::Buffer(context, {.size = bytes,
                                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   .memory = gpu::MemoryUse::Readback,
                                   .name = name});
  std::ranges::fill(buffer.mapped(), std::byte{0});
  buffer.flush();
}

/// Which pixels are in any of the rectangles, row by row. Of thousands of large ones only the corners are
/// visited: what a corner adds holds for all that is right of it and below, which sums along both axes say
/// (F. Crow's summed-area tables, 1984).
std::vector<bool> unionOf(std::span<const PixelRect> rects, std::int32_t width, std::int32_t height) {
  const std::size_t stride = static_cast<std::size_t>(width) + 1;
  std::vector<std::int32_t> count(stride * (static_cast<std::size_t>(height) + 1));
  const auto at = [&](std::int32_t x, std::int32_t y) -> std::int32_t& {
    return count[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
  };
  for (const PixelRect& rect : rects) {
    if (rect.low.x >= rect.high.x || rect.low.y >= rect.high.y) continue;
    ++at(rect.low.x, rect.low.y);
    --at(rect.high.x, rect.low.y);
    --at(rect.low.x, rect.high.y);
    ++at(rect.high.x, rect.high.y);
  }
  std::vector<bool> covered;
  covered.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<std::int32_t> above(static_cast<std::size_t>(width));
  for (std::int32_t y = 0; y < height; ++y) {
    std::int32_t inRow = 0;
    for (std::int32_t x = 0; x < width; ++x) {
      inRow += at(x, y);
      covered.push_back((above[static_cast<std::size_t>(x)] += inRow) > 0);
    }
  }
  return covered;
}

/// A region for each of so many pixels takes longer than all pixels at once.
constexpr std::size_t kMaxRegions = 4096;

/// How many texels copyTexels() copies of so many pixels of a picture.
VkDeviceSize copiedTexels(std::size_t pixels, VkExtent2D extent) {
  return pixels > kMaxRegions ? VkDeviceSize{extent.width} * extent.height : VkDeviceSize{pixels};
}

/// Which of these is that of a pixel.
std::size_t copiedTexel(std::span<const PixelPlace> pixels, std::size_t i, VkExtent2D extent) {
  if (pixels.size() <= kMaxRegions) return i;
  return static_cast<std::size_t>(pixels[i].y) * extent.width + static_cast<std::size_t>(pixels[i].x);
}

/// Those of the pixels one after the other, or, of many, all by rows.
void copyTexels(VkCommandBuffer commands, gpu::Texture& texture, VkImageAspectFlags aspect,
                std::span<const PixelPlace> pixels, gpu::Buffer& values, VkDeviceSize texelBytes,
                VkDeviceSize offset) {
  std::vector<VkBufferImageCopy> regions;
  const VkImageSubresourceLayers layers{.aspectMask = aspect, .layerCount = 1};
  if (pixels.size() > kMaxRegions)
    regions.push_back({.bufferOffset = offset,
                       .imageSubresource = layers,
                       .imageExtent = {texture.extent().width, texture.extent().height, 1}});
  else
    for (std::size_t i = 0; i < pixels.size(); ++i)
      regions.push_back({.bufferOffset = offset + texelBytes * i,
                         .imageSubresource = layers,
                         .imageOffset = {pixels[i].x, pixels[i].y, 0},
                         .imageExtent = {1, 1, 1}});
  gpu::use(commands, {{texture, gpu::Use::TransferSource}, {values, gpu::Use::TransferDestination}});
  vkCmdCopyImageToBuffer(commands, texture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, values,
                         static_cast<std::uint32_t>(regions.size()), regions.data());
  gpu::use(commands, {{values, gpu::Use::HostRead}});
}

void makeRoom(gpu::Context& context, gpu::Buffer& buffer, VkDeviceSize bytes, const char* name) {
  if (bytes > 0 && (!buffer || buffer.size() < bytes))
    buffer = gpu::Buffer(context, {.size = bytes, .memory = gpu::MemoryUse::Readback, .name = name});
}

/// Of a texel: four floats, of 32 or 16 bits each.
VkDeviceSize bytesOfColor(const gpu::Texture& picture) {
  return kColorWords *
         (picture.format() == VK_FORMAT_R32G32B32A32_SFLOAT ? sizeof(float) : sizeof(std::uint16_t));
}

/// Nothing where half floats have added up many lights, each time losing a little, and of what is no number.
std::optional<Vec3f> knownColor(std::span<const std::byte> texel, std::size_t lightGroups) {
  Vec3f color;
  if (texel.size() == kColorWords * sizeof(float)) {
    std::memcpy(&color, texel.data(), sizeof color);
  } else if (lightGroups > 1) {
    return std::nullopt;
  } else {
    std::array<std::uint16_t, 3> halves{};
    std::memcpy(halves.data(), texel.data(), sizeof halves);
    for (int c = 0; c < 3; ++c) color[c] = floatFromHalf(halves[static_cast<std::size_t>(c)]);
  }
  if (!isFinite(Vec3(color))) return std::nullopt;
  return color;
}

bool hasNegativeAlpha(std::span<const std::byte> texel) {
  if (texel.size() == kColorWords * sizeof(float)) return alphaAt(texel.data(), 0) < 0;
  std::uint16_t half = 0;
  std::memcpy(&half, &texel[texel.size() - sizeof half], sizeof half);
  return half > 0x8000;  // -0 is none
}

}  // namespace

void SearchFeedback::begin(const DrawList& list, VkExtent2D extent, std::vector<PixelPlace> probed) {
  current_ = (current_ + 1) % slots_.size();
  Slot& slot = slots_[current_];
  gpu::Timeline& timeline = context_->timeline();
  // A recording that was thrown away never becomes a submission.
  timeline.wait(std::min(slot.submission, timeline.submitted()));
  slot.submission = timeline.submitted() + 1;
  slot.searches = list.searches();
  slot.shadowGroups = list.findsShadows() ? list.groups.size() : 0;
  slot.lightGroups = list.groups.size();
  slot.transmits.clear();
  for (const LightGroup& group : list.groups) slot.transmits.push_back(group.transmits);
  extent_ = extent;
  if (slot.searches) prepareDoubts(slot);
  if (list.findsPlaces) prepareShown(slot);
  prepareProbes(slot, std::move(probed));
}

void SearchFeedback::prepareDoubts(Slot& slot) {
  const VkDeviceSize pixels = VkDeviceSize{extent_.width} * extent_.height;
  const VkDeviceSize bytes =
      (pixels + shared::kDoubtsPerWord - 1) / shared::kDoubtsPerWord * sizeof(std::uint32_t);
  // No larger than it is: all of it is cleared.
  if (slot.doubtful && slot.doubtful.size() != bytes) slot.doubtful = {};
  clear(*context_, slot.doubtful, bytes, "doubts");
}

void SearchFeedback::prepareShown(Slot& slot) {
  const VkDeviceSize bytes = VkDeviceSize{extent_.width} * extent_.height * sizeof(shared::ShownPoint);
  if (slot.shown && slot.shown.size() != bytes) slot.shown = {};
  clear(*context_, slot.shown, bytes, "shown points");
}

void SearchFeedback::prepareProbes(Slot& slot, std::vector<PixelPlace> probed) {
  slot.probed = std::move(probed);
  makeRoom(*context_, slot.depths, probeBytes(slot), "probes");
  makeRoom(*context_, slot.shadows, slot.shadowGroups * probeBytes(slot), "shadow probes");
  const bool transmits = std::ranges::find(slot.transmits, true) != slot.transmits.end();
  makeRoom(*context_, slot.transmittances, transmits ? slot.shadowGroups * kColorWords * probeBytes(slot) : 0,
           "transmittance probes");
}

/// A word each.
VkDeviceSize SearchFeedback::probeBytes(const Slot& slot) const {
  return sizeof(float) * copiedTexels(slot.probed.size(), extent_);
}

void SearchFeedback::recordProbes(VkCommandBuffer commands, gpu::Texture& depth) {
  recordProbes(commands, depth, VK_IMAGE_ASPECT_DEPTH_BIT, slots_[current_].depths, sizeof(float), 0);
}

void SearchFeedback::recordShadowProbes(VkCommandBuffer commands, gpu::Texture& shadows, std::size_t group) {
  Slot& slot = slots_[current_];
  recordProbes(commands, shadows, VK_IMAGE_ASPECT_COLOR_BIT, slot.shadows, sizeof(std::uint32_t),
               group * probeBytes(slot));
}

void SearchFeedback::recordTransmittanceProbes(VkCommandBuffer commands, gpu::Texture& transmittance,
                                               std::size_t group) {
  Slot& slot = slots_[current_];
  recordProbes(commands, transmittance, VK_IMAGE_ASPECT_COLOR_BIT, slot.transmittances,
               kColorWords * sizeof(float), group * kColorWords * probeBytes(slot));
}

void SearchFeedback::recordColorProbes(VkCommandBuffer commands, gpu::Texture& picture) {
  Slot& slot = slots_[current_];
  slot.colorBytes = bytesOfColor(picture);
  makeRoom(*context_, slot.colors, slot.colorBytes * copiedTexels(slot.probed.size(), extent_),
           "color probes");
  recordProbes(commands, picture, VK_IMAGE_ASPECT_COLOR_BIT, slot.colors, slot.colorBytes, 0);
}

void SearchFeedback::recordProbes(VkCommandBuffer commands, gpu::Texture& texture, VkImageAspectFlags aspect,
                                  gpu::Buffer& values, VkDeviceSize texelBytes, VkDeviceSize offset) {
  copyTexels(commands, texture, aspect, slots_[current_].probed, values, texelBytes, offset);
}

void SearchFeedback::recordShown(VkCommandBuffer commands, gpu::Texture& depth, gpu::Texture& picture,
                                 std::span<const PixelPlace> pixels) {
  const auto copy = [&](gpu::Texture& texture, VkImageAspectFlags aspect, gpu::Buffer& values,
                        VkDeviceSize texelBytes, const char* name) {
    makeRoom(*context_, values, texelBytes * copiedTexels(pixels.size(), extent_), name);
    copyTexels(commands, texture, aspect, pixels, values, texelBytes, 0);
  };
  shownColorBytes_ = bytesOfColor(picture);
  copy(depth, VK_IMAGE_ASPECT_DEPTH_BIT, shownDepths_, sizeof(float), "shown depths");
  copy(picture, VK_IMAGE_ASPECT_COLOR_BIT, shownColors_, shownColorBytes_, "shown colors");
}

std::vector<ShownDepth> SearchFeedback::shown(std::span<const PixelPlace> pixels) {
  std::vector<ShownDepth> shown(pixels.size());
  const std::span<const std::byte> depths = shownDepths_.read(), colors = shownColors_.read();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t texel = copiedTexel(pixels, i, extent_);
    std::memcpy(&shown[i].depth, depths.data() + sizeof(float) * texel, sizeof(float));
    shown[i].certified = !hasNegativeAlpha(colors.subspan(shownColorBytes_ * texel, shownColorBytes_));
  }
  return shown;
}

void SearchFeedback::goOn() { slots_[current_].submission = context_->timeline().submitted() + 1; }

std::vector<OpenPixel> SearchFeedback::open(std::span<const PixelRect> byRays,
                                            std::span<const PixelRect> shadowsByRays) {
  Slot& slot = slots_[current_];
  const auto width = static_cast<std::int32_t>(extent_.width),
             height = static_cast<std::int32_t>(extent_.height);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint32_t> words((pixels + shared::kDoubtsPerWord - 1) / shared::kDoubtsPerWord);
  if (slot.searches)
    std::memcpy(words.data(), slot.doubtful.read().data(), words.size() * sizeof(std::uint32_t));
  const auto coveredBy = [&](std::span<const PixelRect> rects) {
    return rects.empty() ? std::vector<bool>() : unionOf(rects, width, height);
  };
  const auto mark = [&](const std::vector<bool>& covered, std::uint32_t doubt) {
    if (covered.empty()) return;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
      if (covered[pixel])
        words[pixel / shared::kDoubtsPerWord] |= doubt
                                                 << shared::kDoubtBits * (pixel % shared::kDoubtsPerWord);
  };
  const std::vector<bool> left = coveredBy(byRays);
  mark(left, shared::kPointOpenHere);
  mark(coveredBy(shadowsByRays), shared::kShadowOpenHere);
  std::vector<OpenPixel> found;
  for (std::size_t word = 0; word < words.size(); ++word)
    for (std::uint32_t bits = words[word], k = 0; bits != 0; bits >>= shared::kDoubtBits, ++k) {
      constexpr std::uint32_t kAny =
          shared::kPointOpenHere | shared::kShadowOpenHere | shared::kLayersOpenHere;
      if ((bits & kAny) == 0) continue;
      const auto pixel = static_cast<std::int32_t>(word * shared::kDoubtsPerWord + k);
      found.push_back({{pixel % width, pixel / width},
                       (bits & shared::kPointOpenHere) != 0,
                       (bits & shared::kShadowOpenHere) != 0,
                       (bits & shared::kLayersOpenHere) != 0,
                       !left.empty() && left[static_cast<std::size_t>(pixel)]});
    }
  return found;
}

std::vector<shared::ShownPoint> SearchFeedback::shownPoints() {
  std::vector<shared::ShownPoint> points(std::size_t{extent_.width} * extent_.height);
  std::memcpy(points.data(), slots_[current_].shown.read().data(), points.size() * sizeof points[0]);
  return points;
}

std::vector<DepthProbe> SearchFeedback::depths() {
  Slot& slot = slots_[current_];
  std::vector<DepthProbe> probes;
  if (slot.probed.empty()) return probes;
  const std::span<const std::byte> depths = slot.depths.read(),
                                   shadows = slot.shadowGroups > 0 ? slot.shadows.read() : depths,
                                   transmittances = slot.transmittances ? slot.transmittances.read() : depths,
                                   colors = slot.colors.read();
  for (std::size_t i = 0; i < slot.probed.size(); ++i) {
    const std::size_t place = copiedTexel(slot.probed, i, extent_);
    DepthProbe probe{.pixel = slot.probed[i]};
    std::memcpy(&probe.depth, depths.data() + sizeof(float) * place, sizeof(float));
    probe.shadows.resize(slot.shadowGroups);
    probe.transmittances.resize(slot.shadowGroups, Vec3f(1));
    for (std::size_t g = 0; g < slot.shadowGroups; ++g) {
      const std::size_t at = g * probeBytes(slot) + sizeof(std::uint32_t) * place;
      std::memcpy(&probe.shadows[g], shadows.data() + at, sizeof(std::uint32_t));
      if (slot.transmits[g])
        std::memcpy(&probe.transmittances[g], transmittances.data() + kColorWords * at, sizeof(Vec3f));
    }
    probe.color = knownColor(colors.subspan(slot.colorBytes * place, slot.colorBytes), slot.lightGroups);
    probes.push_back(probe);
  }
  return probes;
}

}  // namespace luxo
