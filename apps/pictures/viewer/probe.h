// SPDX-License-Identifier: Apache-2.0
// What is under the mouse: the node and its point, by rays in double precision; the colour, as the picture
// has it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "gpu/context.h"
#include "gpu/texture.h"
#include "gpu/transfer.h"
#include "scene/scene.h"
#include "scene/snapshot.h"
#include "window/overlay.h"

namespace luxo {

class Probe {
 public:
  explicit Probe(gpu::Context& context) : context_(&context) {}

  /// `cursor`: pixels from the top left. Cost: as explainPixel() where the place or the snapshot is another
  /// one than the last time.
  void look(const Scene& scene, const Snapshot& shown, const Vec2& cursor);
  /// The next look is at another scene, in which nodes may have other names.
  void forget() { pixel_.reset(); }

  /// Copies the colour of that place, where it is not known yet: of the picture number `version`. True: it
  /// did; read() once that is complete.
  [[nodiscard]] bool record(VkCommandBuffer commands, gpu::Texture& picture, std::uint64_t version);
  void read();

  /// Nothing while the cursor is not in the picture.
  [[nodiscard]] std::optional<window::Panel> panel() const;
  [[nodiscard]] std::string text() const;  ///< the panel in a line

 private:
  struct Pixel {
    int x = 0, y = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  struct Point {
    std::string node;
    Vec2 parameters{0};
    Vec3 normal{0};
  };

  gpu::Context* context_;
  std::optional<Pixel> pixel_;
  Snapshot snapshot_;
  std::optional<Point> point_;  ///< none: the background
  std::optional<Pixel> colored_;
  std::uint64_t version_ = 0;  ///< of the picture that the colour is of
  std::optional<std::array<float, 3>> color_;
  gpu::Readback readback_;
  VkExtent2D extent_{};
  VkFormat format_ = VK_FORMAT_UNDEFINED;
};

}  // namespace luxo
