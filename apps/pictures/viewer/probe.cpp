// SPDX-License-Identifier: Apache-2.0
#include "viewer/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "reference/explained_pixel.h"

namespace luxo {
namespace {

std::string colorText(const std::array<float, 3>& linear) {
  if (!std::ranges::all_of(linear, [](float c) { return std::isfinite(c); })) return "no number";
  const auto code = [](float c) {
    return std::lround(255 * srgbFromLinear(std::clamp(double{c}, 0.0, 1.0)));
  };
  return fmt::format("{:.4f} {:.4f} {:.4f}, #{:02x}{:02x}{:02x}", linear[0], linear[1], linear[2],
                     code(linear[0]), code(linear[1]), code(linear[2]));
}

}  // namespace

void Probe::look(const Scene& scene, const Snapshot& shown, const Vec2& cursor) {
  const PixelSize size = shown.view.size;
  const bool inside = cursor.x >= 0 && cursor.y >= 0 && cursor.x < size.width && cursor.y < size.height;
  const std::optional<Pixel> pixel =
      inside ? std::optional(Pixel{static_cast<int>(cursor.x), static_cast<int>(cursor.y)}) : std::nullopt;
  if (pixel == pixel_ && (!pixel || shown == snapshot_)) return;
  pixel_ = pixel;
  point_.reset();
  if (!pixel) return;
  snapshot_ = shown;
  try {
    const ExplainedPixel why = explainPixel(shown, {pixel->x + 0.5, pixel->y + 0.5});
    const auto seen = std::ranges::find_if(why.points, [&](const PointOnRay& point) {
      const Material& material = shown.materials[shown.nodes[point.node].material.index];
      return point.seen && !(material.hasHoles() && point.opacity < kLeastShown);
    });
    if (seen == why.points.end()) return;
    const NodeId node = shown.nodes[seen->node].id;
    point_ = {scene[node].name.empty() ? scene.shownName(node) : scene[node].name, seen->parameters,
              seen->lit};
  } catch (const Error&) {
    // What rays cannot tell is not told; the colour is.
  }
}

bool Probe::record(VkCommandBuffer commands, gpu::Texture& picture, std::uint64_t version) {
  if (!pixel_ || (colored_ == pixel_ && version_ == version)) return false;
  const VkExtent2D extent{picture.extent().width, picture.extent().height};
  if (pixel_->y >= static_cast<int>(extent.height) || pixel_->x >= static_cast<int>(extent.width))
    return false;
  if (extent.width != extent_.width || extent.height != extent_.height || picture.format() != format_) {
    readback_ = gpu::Readback(*context_, extent, picture.format());
    extent_ = extent;
    format_ = picture.format();
  }
  const gpu::Readback::Rows row[] = {{static_cast<std::uint32_t>(pixel_->y), 1}};
  readback_.record(commands, picture, row);
  colored_ = pixel_;
  version_ = version;
  color_.reset();
  return true;
}

void Probe::read() {
  const std::span<const std::byte> row = readback_.row(static_cast<std::uint32_t>(colored_->y));
  const std::size_t texel = row.size() / extent_.width;
  const std::span<const std::byte> at = row.subspan(static_cast<std::size_t>(colored_->x) * texel, texel);
  std::array<float, 3> color{};
  if (format_ == VK_FORMAT_R32G32B32A32_SFLOAT) {
    std::memcpy(color.data(), at.data(), sizeof color);
  } else if (format_ == VK_FORMAT_R16G16B16A16_SFLOAT) {
    std::array<std::uint16_t, 3> halves{};
    std::memcpy(halves.data(), at.data(), sizeof halves);
    for (std::size_t i = 0; i < 3; ++i) color[i] = glm::unpackHalf1x16(halves[i]);
  } else {
    return;
  }
  color_ = color;
}

std::optional<window::Panel> Probe::panel() const {
  if (!pixel_) return std::nullopt;
  window::Panel panel{.place = window::Panel::Place::TopRight,
                      .title = fmt::format("pixel {},{}", pixel_->x, pixel_->y),
                      .rows = {},
                      .discreet = true};
  panel.rows.push_back({"node", point_ ? point_->node : "none"});
  if (point_) {
    panel.rows.push_back({"u, v", fmt::format("{:.5f} {:.5f}", point_->parameters.x, point_->parameters.y)});
    panel.rows.push_back({"normal", fmt::format("{:.4f} {:.4f} {:.4f}", point_->normal.x, point_->normal.y,
                                                point_->normal.z)});
  }
  if (color_ && colored_ == pixel_) panel.rows.push_back({"colour", colorText(*color_)});
  return panel;
}

std::string Probe::text() const {
  const std::optional<window::Panel> told = panel();
  if (!told) return {};
  std::string line = told->title;
  for (const window::Panel::Row& row : told->rows) line += fmt::format(", {} {}", row.label, row.text);
  return line;
}

}  // namespace luxo
