// SPDX-License-Identifier: Apache-2.0
#include "draw/layer_lists.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "gpu/barrier.h"
#include "shared/scene_data.h"

namespace luxo {

namespace {

/// Points, by which room is made: where what reaches those of a group of lights begins may be bound then, as
/// no device asks for more than 256 bytes (minStorageBufferOffsetAlignment).
constexpr std::uint64_t kStep = 256 / sizeof(shared::ReachingLight);

}  // namespace

LayerLists::LayerLists(gpu::Context& context)
    : context_(&context),
      most_(std::min<std::uint64_t>(kMaxLayerBytes, context.limits().maxStorageBufferRange) /
                sizeof(shared::LayerPoint) / kStep * kStep -
            1) {}  // the first is none's

void LayerLists::prepare(VkExtent2D extent, bool details, std::size_t groups) {
  const VkDeviceSize pixels = VkDeviceSize{extent.width} * extent.height;
  const auto make = [this](VkDeviceSize bytes, gpu::MemoryUse memory, const char* name) {
    return gpu::Buffer(*context_,
                       {.size = bytes,
                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                 VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                        .memory = memory,
                        .name = name});
  };
  gpu::Timeline& timeline = context_->timeline();
  if (!heads_ || extent.width != extent_.width || extent.height != extent_.height) {
    timeline.wait(timeline.submitted());
    extent_ = extent;
    bands_ = 1;
    heads_ = make(pixels * sizeof(std::uint32_t), gpu::MemoryUse::Device, "heads of layers");
    sums_ = make(pixels * 2 * sizeof(float), gpu::MemoryUse::Readback, "sums of layers");
    if (!count_) {
      count_ = make(sizeof(shared::LayerCount), gpu::MemoryUse::Device, "how many layers");
      counts_ =
          make(kMaxLayerBands * sizeof(shared::LayerCount), gpu::MemoryUse::Readback, "layers of each band");
    }
  }
  // Two points a pixel until more are asked for.
  const std::uint64_t room =
      std::min((std::max<std::uint64_t>(2 * pixels, wanted_) / kStep + 1) * kStep - 1, most_);
  const bool fits = points_ && room <= room_, reachesFit = fits && reachesOf(groups) <= reaches_.size();
  if (reachesFit && (!details || details_)) return;
  timeline.wait(timeline.submitted());
  if (!fits) {
    room_ = room;
    points_ = {};
    details_ = {};
    reaches_ = {};
    points_ = make((room + 1) * sizeof(shared::LayerPoint), gpu::MemoryUse::Device, "layers");
  }
  if (!reachesFit) {
    reaches_ = {};
    reaches_ = make(reachesOf(groups), gpu::MemoryUse::Device, "light on layers");
  }
  if (details && !details_)
    details_ = make((room_ + 1) * sizeof(shared::LayerDetail), gpu::MemoryUse::Device, "details of layers");
}

std::vector<gpu::Buffer*> LayerLists::buffers() {
  std::vector<gpu::Buffer*> all{&heads_, &points_, &reaches_, &count_, &sums_};
  if (details_) all.push_back(&details_);
  return all;
}

LayerLists::Found LayerLists::found() {
  Found found;
  for (std::uint32_t band = 0; band < bands_; ++band) {
    shared::LayerCount count{};
    std::memcpy(&count, counts_.read().data() + sizeof count * band, sizeof count);
    found.points += count.points;
    found.fullest = std::max<std::uint64_t>(found.fullest, count.points);
    found.missing += count.points > room_ ? count.points - room_ : count.ended;
  }
  return found;
}

bool LayerLists::makeRoom(std::uint64_t more) {
  Found all = found();
  if (all.fullest + more <= room_) return false;
  all.points += more;
  if (room_ < most_) {
    wanted_ = all.points + all.points / 8;
    if (wanted_ <= most_) return true;
  }
  // The points of a picture are not spread evenly: bands twice as many as would be enough if they were.
  const std::uint64_t enough = 2 * (all.points / most_ + 1);
  const std::uint32_t most = std::min(kMaxLayerBands, (extent_.height + 1) / 2);
  const auto wanted =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(std::max<std::uint64_t>(enough, 2 * bands_), most));
  if (wanted <= bands_ && room_ >= most_) return false;
  bands_ = std::max(bands_, wanted);
  return true;
}

void LayerLists::recordPoints(VkCommandBuffer commands) {
  if (bands_ > 1) return;
  using enum gpu::Use;
  const auto copy = [&](gpu::Buffer& from, gpu::Buffer& to, VkDeviceSize bytes, const char* name) {
    if (!to || to.size() < bytes)
      to = gpu::Buffer(*context_, {.size = bytes,
                                   .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                   .memory = gpu::MemoryUse::Readback,
                                   .name = name});
    gpu::use(commands, {{from, TransferSource}, {to, TransferDestination}});
    const VkBufferCopy all{.size = bytes};
    vkCmdCopyBuffer(commands, from, to, 1, &all);
    gpu::use(commands, {{to, HostRead}});
  };
  const std::uint64_t points = std::min(found().points, room_);
  copy(heads_, readHeads_, heads_.size(), "heads of layers, read");
  copy(points_, readPoints_, (points + 1) * sizeof(shared::LayerPoint), "layers, read");
}

std::vector<std::vector<shared::LayerPoint>> LayerLists::pointsAt(std::span<const PixelPlace> pixels) {
  std::vector<std::vector<shared::LayerPoint>> points;
  if (bands_ > 1) return points;
  const std::span<const std::byte> heads = readHeads_.read(), all = readPoints_.read();
  for (const PixelPlace& pixel : pixels) {
    const std::size_t number =
        static_cast<std::size_t>(pixel.y) * extent_.width + static_cast<std::size_t>(pixel.x);
    std::uint32_t index = 0;
    std::memcpy(&index, heads.data() + sizeof index * number, sizeof index);
    std::vector<shared::LayerPoint>& list = points.emplace_back();
    for (; index != 0; index = list.back().next)
      std::memcpy(&list.emplace_back(), all.data() + sizeof list[0] * index, sizeof list[0]);
  }
  return points;
}

void LayerLists::goOn(VkCommandBuffer commands) {
  gpu::use(commands, {{count_, gpu::Use::TransferDestination}});
  vkCmdFillBuffer(commands, count_, offsetof(shared::LayerCount, ended), sizeof(shared::LayerCount::ended),
                  0);
}

void LayerLists::clear(VkCommandBuffer commands, std::uint32_t band) {
  using enum gpu::Use;
  gpu::use(commands,
           {{heads_, TransferDestination}, {count_, TransferDestination}, {sums_, TransferDestination}});
  vkCmdFillBuffer(commands, count_, 0, VK_WHOLE_SIZE, 0);
  if (band > 0) return;
  vkCmdFillBuffer(commands, heads_, 0, VK_WHOLE_SIZE, 0);
  vkCmdFillBuffer(commands, sums_, 0, VK_WHOLE_SIZE, 0);
}

void LayerLists::keepCount(VkCommandBuffer commands, std::uint32_t band) {
  using enum gpu::Use;
  gpu::use(commands, {{count_, TransferSource}, {counts_, TransferDestination}});
  const VkBufferCopy one{.dstOffset = band * sizeof(shared::LayerCount), .size = sizeof(shared::LayerCount)};
  vkCmdCopyBuffer(commands, count_, counts_, 1, &one);
  gpu::use(commands, {{counts_, HostRead}});
}

}  // namespace luxo
