// SPDX-License-Identifier: Apache-2.0
#include "reference/verification.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "image/flip.h"
#include "reference/judged_picture.h"

namespace luxo {
namespace {

using reference::JudgedPicture;
using reference::JudgedPixel;
using reference::kUnset;

/// What is told of a picture, of what each of its pixels is off by.
class Sums {
 public:
  Sums(const JudgedPicture& judged, const ReferencePicture& truth, const MeasuredPicture& measured,
       const VerificationOptions& options)
      : judged_(judged), truth_(truth), measured_(measured), options_(options) {}

  [[nodiscard]] Verification all() const {
    const reference::Floors& floor = judged_.floors;
    Verification result;
    result.coverage = coverage();
    result.positionPx = spreadOf(&JudgedPixel::position, floor.position);
    result.parameterPx = spreadOf(&JudgedPixel::parameter, floor.parameter);
    result.pointPx = spreadOf(&JudgedPixel::point, floor.point);
    result.depthUlp = spreadOf(&JudgedPixel::depth, floor.depth);
    result.normalDegrees = spreadOf(&JudgedPixel::normal, floor.normal);
    result.normalDegreesInside = spreadOf(&JudgedPixel::normal, floor.normal, true);
    result.color = colors();
    for (const JudgedPixel& pixel : judged_.pixels) result.nanPixels += pixel.nan ? 1 : 0;
    if (options_.silhouettes) result.wrong = wrongPixels();
    result.positionMap = positionMap();
    return result;
  }

 private:
  [[nodiscard]] WrongPixels wrongPixels() const {
    using enum reference::LightVerdict;
    WrongPixels wrong;
    for (std::size_t k = 0; k < judged_.pixels.size(); ++k) {
      const JudgedPixel& pixel = judged_.pixels[k];
      const bool away = pixel.silhouettePx > kSilhouettePx;
      std::uint64_t* count = nullptr;
      if (!pixel.compared) continue;
      if (away && (pixel.mismatch == Mismatch::Missing || pixel.mismatch == Mismatch::Extra))
        count = &wrong.hitMiss;
      else if (away)
        count = &wrong.layer;
      else if (pixel.light == TooDark || pixel.light == TooBright)
        count = &wrong.light;
      else if (pixel.nan || pixel.offPoint)
        count = &wrong.point;
      else if (pixel.light == OtherColor)
        count = &wrong.color;
      if (count == nullptr) continue;
      ++*count;
      if (count == &wrong.light) ++(pixel.light == TooDark ? wrong.shadowExtra : wrong.shadowMissing);
      wrong.pixels.push_back(judged_.chosen[k]);
    }
    return wrong;
  }

  [[nodiscard]] Offence offenceAt(std::size_t k, double error) const {
    const std::uint32_t i = judged_.chosen[k];
    const auto number = [](double value) {
      return value >= 0 && value < 4294967296.0 ? static_cast<std::uint32_t>(value) : 0U;
    };
    return {.x = static_cast<int>(i) % width(),
            .y = static_cast<int>(i) / width(),
            .error = error,
            .mismatch = judged_.pixels[k].mismatch,
            .measuredNode = number(measured_.id.samples()[i]),
            .trueNode = truth_.number[i],
            .measuredParameters = parametersAt(i),
            .trueParameters = truth_.parameters[i]};
  }

  /// The pixels with the largest of these errors; of equal ones the first.
  template <class ErrorAt>
  [[nodiscard]] std::vector<Offence> worstOf(std::vector<std::size_t> candidates,
                                             const ErrorAt& errorAt) const {
    const std::size_t count =
        std::min(candidates.size(), static_cast<std::size_t>(std::max(options_.worst, 0)));
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(candidates.begin(), end, candidates.end(), [&](std::size_t a, std::size_t b) {
      return errorAt(a) != errorAt(b) ? errorAt(a) > errorAt(b) : a < b;
    });
    std::vector<Offence> worst;
    for (auto k = candidates.begin(); k != end; ++k) worst.push_back(offenceAt(*k, errorAt(*k)));
    return worst;
  }

  [[nodiscard]] ErrorSpread spreadOf(double JudgedPixel::*error, double floor,
                                     bool insideOnly = false) const {
    ErrorSpread spread{.floor = floor};
    std::vector<std::size_t> candidates;
    std::vector<double> values;
    double squares = 0;
    for (std::size_t k = 0; k < judged_.pixels.size(); ++k) {
      const double value = judged_.pixels[k].*error;
      if (value == kUnset || (insideOnly && !judged_.pixels[k].inside)) continue;
      candidates.push_back(k);
      values.push_back(value);
      squares += value * value;
    }
    if (values.empty()) return spread;
    spread.pixels = values.size();
    spread.rms = std::sqrt(squares / static_cast<double>(values.size()));
    const auto quantile = [&](double part) {
      const auto rank =
          values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
      std::nth_element(values.begin(), rank, values.end());
      return *rank;
    };
    spread.p99 = quantile(0.99);
    spread.p999 = quantile(0.999);
    spread.max = quantile(1);
    spread.worst = worstOf(std::move(candidates), [&](std::size_t k) { return judged_.pixels[k].*error; });
    return spread;
  }

  [[nodiscard]] CoverageErrors coverage() const {
    CoverageErrors c;
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < judged_.pixels.size(); ++k) {
      const JudgedPixel& pixel = judged_.pixels[k];
      if (!pixel.compared) {
        ++c.undecided;
        continue;
      }
      const bool covered = truth_.number[judged_.chosen[k]] != 0;
      ++c.compared;
      c.covered += covered ? 1 : 0;
      c.both += covered && pixel.mismatch == Mismatch::None ? 1 : 0;
      c.missing += pixel.mismatch == Mismatch::Missing ? 1 : 0;
      c.extra += pixel.mismatch == Mismatch::Extra ? 1 : 0;
      c.wrongNode += pixel.mismatch == Mismatch::WrongNode ? 1 : 0;
      c.wrongLayer += pixel.mismatch == Mismatch::WrongLayer ? 1 : 0;
      if (pixel.mismatch == Mismatch::None) continue;
      wrong.push_back(k);
      c.farthestPx = std::max<double>(c.farthestPx, pixel.silhouettePx);
      c.beyond += pixel.silhouettePx > kSilhouettePx ? 1 : 0;
    }
    c.worst =
        worstOf(std::move(wrong), [&](std::size_t k) { return double(judged_.pixels[k].silhouettePx); });
    return c;
  }

  [[nodiscard]] ColorErrors colors() const {
    ColorErrors c;
    if (measured_.color.empty()) return c;
    c.difference = spreadOf(&JudgedPixel::color, 0, true);
    c.pixels = c.difference.pixels;
    double squares = 0, coded = 0;
    std::uint64_t covered = 0;
    for (std::size_t k = 0; k < judged_.pixels.size(); ++k) {
      const JudgedPixel& pixel = judged_.pixels[k];
      if (!pixel.compared) continue;
      covered += truth_.number[judged_.chosen[k]] != 0 ? 1 : 0;
      c.differing8 += pixel.differs8 ? 1 : 0;
      c.byShader += pixel.byShader ? 1 : 0;
      c.unjudged += pixel.light == reference::LightVerdict::Unjudged ? 1 : 0;
      if (!pixel.inside) continue;
      squares += pixel.squares;
      coded += pixel.codedSquares;
    }
    const auto psnr = [&](double sum) {
      return sum == 0 ? std::numeric_limits<double>::infinity()
                      : -10 * std::log10(sum / (3 * static_cast<double>(c.pixels)));
    };
    c.psnrLinear = psnr(squares);
    c.psnrSrgb = psnr(coded);
    c.differing8Part = covered == 0 ? 0 : static_cast<double>(c.differing8) / static_cast<double>(covered);
    if (options_.flip && options_.pixels.empty() && c.byShader == 0) {
      const Flip seen = flip(truth_.color, measured_.color);
      c.flipMean = seen.mean;
      c.flipP999 = seen.p999;
      c.flipMax = seen.max;
    }
    return c;
  }

  [[nodiscard]] Image positionMap() const {
    Image map(truth_.color.width(), truth_.color.height(), 1);
    std::ranges::fill(map.samples(), static_cast<float>(kUnset));
    for (std::size_t k = 0; k < judged_.pixels.size(); ++k)
      map.samples()[judged_.chosen[k]] = judged_.pixels[k].mismatch != Mismatch::None
                                             ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(judged_.pixels[k].position);
    return map;
  }

  [[nodiscard]] int width() const { return truth_.color.width(); }
  [[nodiscard]] Vec2 parametersAt(std::uint32_t i) const {
    const float* uv = measured_.uv.samples().data() + 3 * std::size_t{i};
    return {uv[0], uv[1]};
  }

  const JudgedPicture& judged_;
  const ReferencePicture& truth_;
  const MeasuredPicture& measured_;
  const VerificationOptions& options_;
};

}  // namespace

Verification verify(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
                    const VerificationOptions& options) {
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  const JudgedPicture judged =
      arena.execute([&] { return reference::judgePixels(snapshot, truth, measured, options); });
  return Sums(judged, truth, measured, options).all();
}

}  // namespace luxo
