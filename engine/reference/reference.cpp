// SPDX-License-Identifier: Apache-2.0
#include "reference/reference.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include "base/error.h"
#include "math/sampling.h"
#include "reference/caster.h"

namespace luxo {
namespace {

using reference::Caster;
using reference::Ray;

constexpr int kRaysBetweenReports = 64;

void requireLight(const Snapshot& snapshot) {
  for (const SnapshotNode& node : snapshot.nodes) {
    const auto shading = snapshot.materials[node.material.index].shading;
    if (!shading || *shading == Shading::Flat || *shading == Shading::Gouraud || *shading == Shading::Phong ||
        *shading == Shading::Exact || *shading == Shading::Toon)
      continue;
    throw Error(ErrorKind::Scene,
                fmt::format("material '{}' is shaded as {}, which has no ground truth",
                            snapshot.materials[node.material.index].name, nameOf(*shading)),
                "use --engine vulkan, or give the material another shading");
  }
}

/// Shifted by the pixel's own fraction.
Vec2 sampleAt(int k, int x, int y) {
  const double shift = 0.5 + x / kPlastic + y / (kPlastic * kPlastic);
  return quasirandomPoint(k, {shift, shift * std::numbers::sqrt2});
}

/// Sums for the whole picture, gathered row by row so that the order of addition is fixed.
struct RowSums {
  std::uint64_t hits = 0, misses = 0, undecided = 0;
  double squares = 0, largest = 0;
};

class Exposure {
 public:
  Exposure(const Snapshot& snapshot, const ReferenceOptions& options, reference::ShapeCache& cache)
      : options_(options),
        arena_(options.threads > 0 ? options.threads : tbb::task_arena::automatic),
        caster_(arena_.execute(
            [&] { return Caster(snapshot, cache, reference::Cells::AtOnce, options.shading); })),
        size_(snapshot.view.size) {
    const auto count = static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
    picture_.color = Image(size_.width, size_.height, 3);
    picture_.depth.assign(count, std::numeric_limits<double>::infinity());
    picture_.position.assign(count, Vec3(0));
    picture_.normal.assign(count, Vec3(0));
    picture_.facet.assign(count, Vec3(0));
    picture_.parameters.assign(count, Vec2(0));
    picture_.number.assign(count, 0);
    certified_.assign(count, 1);
    chosen_.assign(count, options.pixels.empty() ? 1 : 0);
    for (const std::uint32_t pixel : options.pixels) chosen_.at(pixel) = 1;
    rows_.resize(static_cast<std::size_t>(size_.height));
  }

  ReferencePicture expose() {
    arena_.execute([&] { tbb::parallel_for(0, size_.height, [&](int y) { exposeRow(y); }); });
    double squares = 0;
    for (const RowSums& row : rows_) {
      picture_.hits += row.hits;
      picture_.misses += row.misses;
      picture_.undecided += row.undecided;
      squares += row.squares;
      picture_.standardErrorMax = std::max(picture_.standardErrorMax, row.largest);
    }
    const std::uint64_t cast = picture_.hits + picture_.misses + picture_.undecided;
    picture_.standardErrorRms = cast == 0 ? 0 : std::sqrt(squares / (3.0 * static_cast<double>(cast)));
    picture_.certified.assign(certified_.begin(), certified_.end());
    picture_.complete = !stopped_;
    return std::move(picture_);
  }

 private:
  void exposeRow(int y) {
    // Seldom enough to cost nothing, often enough to stop soon.
    const int stretch = std::max(1, kRaysBetweenReports / options_.samples);
    for (int x = 0; x < size_.width && !stopped_; x += stretch) {
      const int end = std::min(x + stretch, size_.width);
      for (int i = x; i < end; ++i) exposePixel(i, y, rows_[static_cast<std::size_t>(y)]);
      report(end - x);
    }
  }

  void report(int pixels) {
    const std::uint64_t done = pixelsDone_ += static_cast<std::uint64_t>(pixels);
    if (!options_.progress) return;
    const std::lock_guard lock(progressMutex_);
    if (!stopped_ && !options_.progress(static_cast<double>(done) / size_.width / size_.height))
      stopped_ = true;
  }

  void exposePixel(int x, int y, RowSums& sums) {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    if (chosen_[i] == 0) return;
    const Vec2 at = Vec2(x, y) + 0.5 + caster_.snapshot().view.sampleOffsetPx;
    const Ray ray = caster_.rayThrough(at.x, at.y);
    const Caster::Sight sight = caster_.look(ray, Caster::Invisible::Told);
    bool certified = sight.certified;
    const reference::Hit* shown = caster_.firstShown(sight);
    if (shown) record(i, ray, *shown);

    Vec3 mean = options_.samples == 1 ? caster_.color(ray, sight, certified) : Vec3(0), spread(0);
    for (int k = 0; options_.samples > 1 && k < options_.samples; ++k) {
      const Vec2 inPixel = sampleAt(k, x, y);
      const Ray sampleRay = caster_.rayThrough(x + inPixel.x, y + inPixel.y);
      const Caster::Sight seen = caster_.look(sampleRay);
      certified &= seen.certified;
      const Vec3 color = caster_.color(sampleRay, seen, certified);
      const Vec3 step = color - mean;  // B. P. Welford 1962
      mean += step / (k + 1.0);
      spread += step * (color - mean);
    }
    const auto out = picture_.color.pixel(x, y);
    for (int c = 0; c < 3; ++c) {
      out[static_cast<std::size_t>(c)] = static_cast<float>(mean[c]);
      if (options_.samples == 1) continue;
      const double squared = spread[c] / (options_.samples - 1.0) / options_.samples;
      sums.squares += squared;
      sums.largest = std::max(sums.largest, std::sqrt(squared));
    }
    certified_[i] = certified ? 1 : 0;
    ++(!certified ? sums.undecided : shown ? sums.hits : sums.misses);
  }

  void record(std::size_t i, const Ray& ray, const reference::Hit& hit) {
    const Snapshot& snapshot = caster_.snapshot();
    picture_.depth[i] = glm::dot(ray.direction, snapshot.view.forward()) * hit.t;
    picture_.position[i] = hit.position;
    picture_.normal[i] = hit.normal;
    picture_.facet[i] = hit.facet;
    picture_.parameters[i] = {hit.u, hit.v};
    picture_.number[i] = snapshot.nodes[hit.node].number;
  }

  const ReferenceOptions& options_;
  tbb::task_arena arena_;
  Caster caster_;
  PixelSize size_;
  ReferencePicture picture_;
  std::vector<std::uint8_t> chosen_;
  std::vector<std::uint8_t> certified_;  // threads may write neighbouring bytes, not neighbouring bits
  std::vector<RowSums> rows_;
  std::atomic<std::uint64_t> pixelsDone_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex progressMutex_;
};

}  // namespace

ReferenceCaster::ReferenceCaster() : cache_(std::make_unique<reference::ShapeCache>()) {}
ReferenceCaster::~ReferenceCaster() = default;

ReferencePicture ReferenceCaster::cast(const Snapshot& snapshot, const ReferenceOptions& options) {
  requireLight(snapshot);
  return Exposure(snapshot, options, *cache_).expose();
}

ReferencePicture castPicture(const Snapshot& snapshot, const ReferenceOptions& options) {
  return ReferenceCaster().cast(snapshot, options);
}

}  // namespace luxo
