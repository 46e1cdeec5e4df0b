// SPDX-License-Identifier: Apache-2.0
// The lists of points of what is seen through, one for each pixel of a view (shaders/lib/layers.glsl), on the
// device.
//
// Devices bind no more than so many bytes at once (128 MiB on lavapipe: two million points). Where a picture
// has more, it is drawn in bands of rows, one after the other, with the same room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "draw/pixel_rows.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/vk.h"
#include "shared/scene_data.h"

namespace luxo {

/// So many bytes of points at once, or fewer, and in so many bands: what a picture has beyond that is missing
/// in it, and counted.
inline constexpr std::uint64_t kMaxLayerBytes = std::uint64_t{1} << 27;
inline constexpr std::uint32_t kMaxLayerBands = 256;

class LayerLists {
 public:
  explicit LayerLists(gpu::Context& context);

  /// Room for the lists of so many pixels, and for as many points as were asked for, with their details or
  /// without, and with what of so many groups of lights reaches them. Waits for the device where lists have
  /// to be made anew.
  void prepare(VkExtent2D extent, bool details, std::size_t groups);
  [[nodiscard]] std::uint32_t bands() const { return bands_; }

  /// Of a recording that is complete.
  struct Found {
    std::uint64_t points = 0;
    /// Points without room; where there is room for all, pixels in which a device ended a loop over them.
    std::uint64_t missing = 0;
    std::uint64_t fullest = 0;  ///< points of the band that has most
  };
  [[nodiscard]] Found found();
  /// Whether there is, next time, more room than there was for that recording, which lacked it for what it
  /// had, and `more` points.
  bool makeRoom(std::uint64_t more = 0);

  /// Copies the lists of a recording that is complete, where they are not of many bands, for the host to
  /// read. Cost: 76 bytes a point.
  void recordPoints(VkCommandBuffer commands);
  /// What pixels have in their lists, in that order; of no pixel where they are of many bands.
  [[nodiscard]] std::vector<std::vector<shared::LayerPoint>> pointsAt(std::span<const PixelPlace> pixels);

  /// The lists are lit again: forgets which loops over them the device has ended.
  void goOn(VkCommandBuffer commands);
  /// A band begins: empties the lists.
  void clear(VkCommandBuffer commands, std::uint32_t band);
  /// It ends: keeps how many points it had.
  void keepCount(VkCommandBuffer commands, std::uint32_t band);

  /// Where a pixel's list begins; the points; how many there are in a band; and of each pixel how many were
  /// blended and the sum of their depths, which the host reads.
  [[nodiscard]] gpu::Buffer& heads() { return heads_; }
  [[nodiscard]] gpu::Buffer& points() { return points_; }
  [[nodiscard]] gpu::Buffer& count() { return count_; }
  [[nodiscard]] gpu::Buffer& sums() { return sums_; }
  /// Of the points (shared::LayerDetail); where there are none something to bind.
  [[nodiscard]] gpu::Buffer& details() { return details_ ? details_ : points_; }
  /// What reaches the points (shared::ReachingLight), of one group after the other; and where a group's
  /// begin, bytes.
  [[nodiscard]] gpu::Buffer& reaches() { return reaches_; }
  [[nodiscard]] VkDeviceSize reachesOf(std::size_t group) const {
    return group * (room_ + 1) * sizeof(shared::ReachingLight);
  }
  [[nodiscard]] std::vector<gpu::Buffer*> buffers();
  /// For the host to read: of each band.
  [[nodiscard]] gpu::Buffer& counts() { return counts_; }

 private:
  gpu::Context* context_;
  VkExtent2D extent_{};
  std::uint64_t most_, room_ = 0, wanted_ = 0;  ///< points
  std::uint32_t bands_ = 1;
  gpu::Buffer heads_, points_, details_, reaches_, count_, sums_, counts_;
  gpu::Buffer readHeads_, readPoints_;
};

}  // namespace luxo
