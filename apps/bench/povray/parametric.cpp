// SPDX-License-Identifier: Apache-2.0
// The exact picture of the torus against POV-Ray's `parametric` object at its default accuracy, same size and
// same machine: time per pixel, and error of the light against the ground truth. Ends with 0 when luxo is at
// least 5,000 times as fast at an error at most 1e-4 times as large, with 6 when it is not.
//
// POV-Ray renders bands of rows, evenly spread over the picture; all of it would take minutes. What is in
// doubt counts for POV-Ray: its start and its parsing are not timed, and pixels where it shows another
// surface are not part of its error. Its own torus, an analytic primitive, is rendered first: as it agrees
// with the truth, so does the scene that it is told.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench_statistics.h"
#include "draw/renderer.h"
#include "open_scene.h"
#include "povray/pov_picture.h"
#include "povray/pov_scene.h"
#include "reference/reference.h"

namespace luxo::povray {
namespace {

constexpr double kFaster = 5'000, kCloser = 1e4;
constexpr int kMissed = 6;  // as of luxo: a requirement is missed
constexpr int kFrames = 15;
constexpr int kBandRows = 16;
constexpr double kRadiance = 0.4;  // highlights stay below white

/// Root mean square over the pixels and channels where both show the torus.
struct LightError {
  double rms = 0, largest = 0;
  int mismatches = 0;  ///< pixels where one shows the torus and the other does not
};

LightError errorOf(std::span<const double> shown, const ReferencePicture& truth, const Vec3& background,
                   std::span<const Rows> bands) {
  LightError error;
  double squares = 0;
  std::size_t count = 0;
  const auto judge = [&](std::size_t pixel) {
    bool covers = false;
    double pixelSquares = 0, pixelLargest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = shown[3 * pixel + c];
      const double off = std::abs(value - static_cast<double>(truth.color.samples()[3 * pixel + c]));
      // A step of 16 bits away from the background is a surface.
      covers |= std::abs(value - background[static_cast<int>(c)]) > 1. / 65535;
      pixelSquares += off * off;
      pixelLargest = std::max(pixelLargest, off);
    }
    const bool covered = truth.number[pixel] != 0;
    error.mismatches += covers != covered ? 1 : 0;
    if (!covers || !covered) return;
    squares += pixelSquares;
    count += 3;
    error.largest = std::max(error.largest, pixelLargest);
  };
  const auto width = static_cast<std::size_t>(truth.color.width());
  for (const Rows& band : bands)
    for (std::size_t i = static_cast<std::size_t>(band.first) * width;
         i < static_cast<std::size_t>(band.end) * width; ++i)
      judge(i);
  error.rms = std::sqrt(squares / static_cast<double>(count));
  return error;
}

/// That many, each in the middle of its part of the picture; the picture when they would fill it.
std::vector<Rows> bandsOf(int height, int count) {
  if (count * kBandRows >= height) return {{0, height}};
  std::vector<Rows> bands;
  for (int i = 0; i < count; ++i) {
    const int first = (2 * i + 1) * height / (2 * count) - kBandRows / 2;
    bands.push_back({first, first + kBandRows});
  }
  return bands;
}

struct Drawn {
  std::vector<double> samples;
  double seconds = 0;
};

Drawn drawBands(const std::string& sceneText, PixelSize size, std::span<const Rows> bands) {
  Drawn drawn;
  for (const Rows& band : bands) {
    const PovPicture picture = render(sceneText, size, band);
    drawn.seconds += picture.seconds;
    drawn.samples.resize(picture.samples.size());
    std::ranges::transform(drawn.samples, picture.samples, drawn.samples.begin(),
                           std::plus());  // black elsewhere
  }
  return drawn;
}

/// The median of frames that are drawn anew, up to the image in memory.
Drawn drawExact(const Snapshot& snapshot) {
  gpu::Context context;
  Renderer renderer(context);
  const DrawOptions options{.shading = Shading::Exact, .skips = {.unchanged = false}};
  Picture picture = renderer.render(snapshot, options);
  std::vector<double> ms;
  for (int frame = 0; frame < kFrames; ++frame) {
    picture = renderer.render(snapshot, options);
    ms.push_back(picture.statistics.ms.total);
  }
  const auto samples = picture.image.samples();
  return {.samples = {samples.begin(), samples.end()}, .seconds = 1e-3 * percentile(ms, 0.5)};
}

int compare(PixelSize size, int bandCount) {
  const Snapshot snapshot = comparable(takeSnapshot(openScene("torus"), 0, size), kRadiance);
  const ReferencePicture truth = castPicture(snapshot);
  const std::vector<Rows> bands = bandsOf(size.height, bandCount), whole = {{0, size.height}};
  fmt::print("torus, {} x {}, of POV-Ray {} x {} rows\n{:<20} {:>14} {:>12} {:>12} {:>12}\n", size.width,
             size.height, bands.size(), bands[0].end - bands[0].first, "", "ns per pixel", "rms error",
             "max error", "mismatches");
  const auto print = [](const char* name, double nanoseconds, const LightError& error) {
    fmt::print("{:<20} {:>14.4g} {:>12.3g} {:>12.3g} {:>12}\n", name, nanoseconds, error.rms, error.largest,
               error.mismatches);
  };
  const auto nsPerPixel = [&](double seconds, std::span<const Rows> rows) {
    int height = 0;
    for (const Rows& band : rows) height += band.end - band.first;
    return 1e9 * seconds / (static_cast<double>(size.width) * height);
  };

  const Drawn exact = drawExact(snapshot);
  const LightError exactError = errorOf(exact.samples, truth, snapshot.background, whole);
  const double exactNs = nsPerPixel(exact.seconds, whole);
  print("luxo exact", exactNs, exactError);

  const Drawn primitive = drawBands(sceneText(snapshot), size, bands);
  print("POV-Ray torus", nsPerPixel(primitive.seconds, bands),
        errorOf(primitive.samples, truth, snapshot.background, bands));
  const Drawn parametric = drawBands(sceneText(snapshot, TorusAs::Parametric), size, bands);
  const LightError parametricError = errorOf(parametric.samples, truth, snapshot.background, bands);
  const double parametricNs = nsPerPixel(parametric.seconds - primitive.seconds, bands);
  print("POV-Ray parametric", parametricNs, parametricError);

  const double faster = parametricNs / exactNs, closer = parametricError.rms / exactError.rms;
  const bool reached = faster >= kFaster && closer >= kCloser;
  fmt::print("luxo is {:.0f} times as fast and {:.0f} times as close: the goal of {:.0f} and {:.0f} is {}\n",
             faster, closer, kFaster, kCloser, reached ? "reached" : "missed");
  return reached ? EXIT_SUCCESS : kMissed;
}

}  // namespace
}  // namespace luxo::povray

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 1024;
  const int bands = argc > 2 ? std::atoi(argv[2]) : 4;
  if (argc > 3 || side < 64 || side > 4096 || bands < 1) {
    fmt::print(
        stderr,
        "usage: luxo_povray_parametric [SIDE [BANDS]]   SIDE pixels, 64 to 4096 (1024); bands of rows (4)\n");
    return 2;
  }
  try {
    return luxo::povray::compare({side, side}, bands);
  } catch (const luxo::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
