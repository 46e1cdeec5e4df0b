// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.h"

namespace luxo {
namespace {

/// Reduced to the part that wraps know: 0 to 1, or to 2.
double inPeriod(double x, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return std::clamp(x, -1.0, 2.0);
  const double period = wrap == TextureWrap::Mirror ? 2 : 1;
  return x - period * std::floor(x / period);
}

/// Of an index that is at most one period off.
int wrapped(int i, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == TextureWrap::Mirror ? 2 * size : size;
  const int inside = i < 0 ? i + period : i >= period ? i - period : i;
  return inside < size ? inside : period - 1 - inside;
}

/// Colours times alpha.
Vec4 weighed(const std::array<float, 4>& texel) {
  return {Vec3(texel[0], texel[1], texel[2]) * double(texel[3]), texel[3]};
}

struct Sampler {
  const TextureMap& map;

  [[nodiscard]] Vec4 texel(const TextureLevel& level, int x, int y) const {
    return weighed(level.texel(wrapped(x, level.width, map.wrapU), wrapped(y, level.height, map.wrapV)));
  }

  [[nodiscard]] Vec2 inTexels(const TextureLevel& level, const Vec2& place) const {
    return {inPeriod(place.x, map.wrapU) * level.width, inPeriod(place.y, map.wrapV) * level.height};
  }

  [[nodiscard]] Vec4 nearest(const Vec2& place) const {
    const Vec2 at = glm::floor(inTexels(map.texture->levels[0], place));
    return texel(map.texture->levels[0], int(at.x), int(at.y));
  }

  [[nodiscard]] Vec4 bilinear(const TextureLevel& level, const Vec2& place) const {
    const Vec2 at = inTexels(level, place) - 0.5, low = glm::floor(at), part = at - low;
    const int x = int(low.x), y = int(low.y);
    return glm::mix(glm::mix(texel(level, x, y), texel(level, x + 1, y), part.x),
                    glm::mix(texel(level, x, y + 1), texel(level, x + 1, y + 1), part.x), part.y);
  }

  [[nodiscard]] Vec4 trilinear(double width, const Vec2& place) const {
    const auto& levels = map.texture->levels;
    const double level = std::clamp(std::log2(width), 0.0, double(levels.size() - 1));
    const auto finer = std::size_t(level), coarser = std::min(finer + 1, levels.size() - 1);
    return glm::mix(bilinear(levels[finer], place), bilinear(levels[coarser], place), level - double(finer));
  }
};

/// Of an ellipse, texels.
struct Axes {
  double longer, shorter;
  Vec2 direction;  ///< of the longer one, unit
};

/// The singular values of a matrix, and where it takes the first's vector.
Axes axesOf(const Mat2& m) {
  const double a = m[0].x * m[0].x + m[1].x * m[1].x, b = m[0].x * m[0].y + m[1].x * m[1].y,
               c = m[0].y * m[0].y + m[1].y * m[1].y;
  const double half = 0.5 * (a - c), radius = std::hypot(half, b);
  const double longer = std::sqrt(0.5 * (a + c) + radius);
  const Vec2 direction = half > 0 ? Vec2(half + radius, b) : Vec2(b, radius - half);
  const double length = glm::length(direction);
  return {longer, longer > 0 ? std::abs(glm::determinant(m)) / longer : 0,
          length > 0 ? direction / length : Vec2(1, 0)};
}

}  // namespace

TexturePlacement TextureMap::onceOver(const Surface& surface) {
  if (!surface.isParametric()) return {};
  const Domain& domain = surface.domain();
  return {.linear = {1 / domain.u.width(), 0, 0, -1 / domain.v.width()},
          .constant = {-domain.u.lo / domain.u.width(), 1 + domain.v.lo / domain.v.width()}};
}

TexturePlacement TextureMap::on(const Surface& surface) const {
  const TexturePlacement own = onceOver(surface);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const Mat2 moved = Mat2(cosine, sine, -sine, cosine) * Mat2(scale.x, 0, 0, scale.y);
  return {moved * own.linear, moved * own.constant + offset};
}

Vec4 TextureMap::at(const TexturePlacement& placement, const Vec2& uv, const Footprint& footprint) const {
  LUXO_REQUIRE(valid());
  const Sampler sampler{*this};
  const Vec2 place = placement.linear * uv + placement.constant;
  Vec4 sum(0);
  if (filter == TextureFilter::Nearest) {
    sum = sampler.nearest(place);
  } else {
    const Vec2 size(texture->levels[0].width, texture->levels[0].height);
    Mat2 steps = placement.linear * footprint;
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        steps[i][k] = size[k] * (std::abs(steps[i][k]) <= kMaxTextureStep ? steps[i][k] : kMaxTextureStep);
    const Axes axes = axesOf(steps);
    const double width = std::max({axes.shorter, axes.longer / anisotropy, 1.0});
    const double length = std::max(axes.longer / width, 1.0);
    const int side = int(std::ceil(0.5 * (length - 1)));
    for (int k = -side; k <= side; ++k)
      sum += std::clamp(0.5 * (length + 1) - std::abs(k), 0.0, 1.0) *
             sampler.trilinear(width, place + double(k) * width * axes.direction / size);
    sum /= length;
  }
  return {sum.w > 0 ? Vec3(sum) / sum.w : Vec3(0), sum.w};
}

}  // namespace luxo
