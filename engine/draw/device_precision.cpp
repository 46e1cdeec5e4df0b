// SPDX-License-Identifier: Apache-2.0
#include "draw/device_precision.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "gpu/pipeline.h"
#include "gpu/pipeline_cache.h"
#include "gpu/whole_target.h"
#include "luxo/shaders/sin_cos_frag.h"
#include "luxo/shaders/whole_target_vert.h"
#include "shared/sin_cos_angles.h"

namespace luxo {
namespace {

constexpr VkExtent2D kExtent{shared::kAngleColumns, shared::kAngleRows};
constexpr std::size_t kAngles = std::size_t{shared::kAngleColumns} * shared::kAngleRows;

std::vector<Vec4f> drawValues(gpu::Context& context) {
  constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  const gpu::GraphicsPipeline pipeline(context, {.name = "sin cos",
                                                 .vertexShader = luxo_whole_target_vert,
                                                 .fragmentShader = luxo_sin_cos_frag,
                                                 .colors = {{kFormat}}});
  gpu::Readback drawn = std::move(gpu::drawWholeTargets(context, pipeline, kExtent, kFormat).front());
  std::vector<Vec4f> values(kAngles);
  std::memcpy(values.data(), drawn.bytes().data(), kAngles * sizeof(Vec4f));
  return values;
}

std::optional<SinCosError> unpack(const gpu::CacheIdentity& identity, std::span<const std::byte> file) {
  const auto bytes = gpu::unpackCache(identity, file);
  if (!bytes || bytes->size() != sizeof(SinCosError)) return std::nullopt;
  SinCosError error;
  std::memcpy(&error, bytes->data(), sizeof error);
  return error;
}

}  // namespace

SinCosError sinCosErrorOf(std::span<const Vec4f> values) {
  LUXO_REQUIRE_COMPARE(values.size(), ==, kAngles);
  SinCosError largest;
  const auto raise = [](double& most, double error) {
    if (!(error <= most)) most = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  };
  for (std::size_t i = 0; i < kAngles; ++i) {
    const float angle =
        (static_cast<float>(i) - static_cast<float>(kAngles / 2)) * shared::kAngleStep;  // one rounding
    const double sine = std::sin(static_cast<double>(angle)), cosine = std::cos(static_cast<double>(angle));
    const Vec4f& v = values[i];
    raise(largest.ofDriver, std::abs(v.x - sine));
    raise(largest.ofDriver, std::abs(v.y - cosine));
    raise(largest.ofFormulas, std::abs(v.z - sine));
    raise(largest.ofFormulas, std::abs(v.w - cosine));
  }
  return largest;
}

SinCosError sinCosError(gpu::Context& context, const std::filesystem::path& directory) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(context.physicalDevice(), &properties);
  const gpu::CacheIdentity identity = gpu::identityOf(properties);
  // Another shader would be another file.
  const std::uint64_t shader = gpu::hashOf(std::as_bytes(std::span(luxo_sin_cos_frag)));
  const std::filesystem::path file =
      directory / fmt::format("sin-cos-{:x}-{:x}-{:x}.bin", identity.vendor, identity.device, shader);
  if (!directory.empty())
    if (const auto known = unpack(identity, gpu::readCacheFile(file))) return *known;
  const SinCosError error = sinCosErrorOf(drawValues(context));
  if (!directory.empty())
    gpu::replaceCacheFile(file, gpu::packCache(identity, std::as_bytes(std::span(&error, 1))));
  return error;
}

}  // namespace luxo
