// SPDX-License-Identifier: Apache-2.0
// ST-39, 40: the same input is the same picture, whoever draws it and how; and pictures follow a slow camera.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/temporary_folder.h"
#include "image/format.h"
#include "image/srgb.h"
#include "luxo_grandpa/lamp.h"
#include "reference/reference.h"
#include "scenes/primitives.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

// ST-39 -----------------------------------------------------------------------------------------------------

/// This process's environment with a CPU device of that many threads.
std::vector<std::string> environmentWith(int threads) {
  constexpr std::string_view kName = "LP_NUM_THREADS=";
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry)
    if (!std::string_view(*entry).starts_with(kName)) all.emplace_back(*entry);
  all.push_back(std::string(kName) + std::to_string(threads));
  return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A picture of the lamp by the program itself, as another process: a CPU device reads its number of threads
/// once in the life of a process.
Image drawnByProgram(const StressContext& context, const TemporaryFolder& folder, int threads) {
  const std::string file = (folder / "picture.pfm").string();
  const std::string size = std::to_string(context.size().width);
  std::vector<std::string> arguments = {context.options().program,
                                        "render",
                                        "luxo-grandpa",
                                        "--size",
                                        size + "x" + size,
                                        "--time",
                                        "9.5",
                                        "--shading",
                                        std::string(nameOf(context.shading())),
                                        "--device",
                                        context.options().device,
                                        "-q",
                                        "-o",
                                        file};
  std::vector<std::string> environment = environmentWith(threads);
  pid_t child = 0;
  int status = 0;
  const int failure = posix_spawn(&child, arguments[0].c_str(), nullptr, nullptr,
                                  pointersTo(arguments).data(), pointersTo(environment).data());
  if (failure != 0 || waitpid(child, &status, 0) != child || status != 0)
    throw Error(
        ErrorKind::Internal,
        fmt::format("cannot draw with {}: {}", arguments[0],
                    failure != 0 ? std::strerror(failure) : fmt::format("it ended with status {}", status)));
  Image image = loadImage(file);
  std::filesystem::remove(file);
  return image;
}

std::vector<Measurement> threads(StressContext& context) {
  std::vector<Measurement> result;
  const TemporaryFolder folder;
  std::optional<Image> expected;
  for (const int count : {0, 1, 2, 16}) {
    std::int64_t differing = 0;
    for (int round = 0; round < 3; ++round) {
      Image image = drawnByProgram(context, folder, count);
      if (!expected)
        expected = std::move(image);
      else
        differing += differingPixels(image, *expected);
    }
    result.push_back(
        none(fmt::format("pixels that differ with {} threads, three runs", count), differing, "pixels"));
  }
  return result;
}

std::vector<Measurement> culling(StressContext& context) {
  std::int64_t withoutSkips = 0, withBackFaces = 0;
  for (const auto& [scene, time] : {std::pair(luxoGrandpa(), 21.0), std::pair(primitives(), 0.3)}) {
    const Snapshot snapshot = takeSnapshot(scene, time, context.size());
    const Image expected = context.draw(snapshot).image;
    withoutSkips += differingPixels(context.draw(snapshot, {.skips = Skips::none()}).image, expected);
    withBackFaces += differingPixels(context.draw(snapshot, {.cullBackFaces = false}).image, expected);
  }
  return {none("pixels that differ without any skip", withoutSkips, "pixels"),
          none("pixels that differ with back faces drawn", withBackFaces, "pixels")};
}

/// The same pictures from shells of 2, 4 and 8 pixels. Within 1e-3 px of an edge a pixel may show either
/// side.
std::vector<Measurement> shells(StressContext& context) {
  constexpr double kMaxPx = 1e-3;
  double farthest = 0;
  int codes = 0;
  std::int64_t moved = 0, compared = 0;
  for (const auto& [scene, time] : {std::pair(luxoGrandpa(), 21.0), std::pair(primitives(), 0.3)}) {
    const Snapshot snapshot = takeSnapshot(scene, time, context.size());
    const reference::Caster caster(snapshot);
    struct Drawn {
      Image color, position, id;
    };
    const auto draw = [&](double shellPx) {
      const auto output = [&](Output what) {
        return context.draw(snapshot, {.output = what, .shellTolerancePx = shellPx}).image;
      };
      return Drawn{output(Output::Color), output(Output::Position), output(Output::Id)};
    };
    const Drawn expected = draw(4);
    for (const double shellPx : {2.0, 8.0}) {
      const Drawn other = draw(shellPx);
      for (int y = 0; y < expected.id.height(); ++y)
        for (int x = 0; x < expected.id.width(); ++x) {
          const float id = expected.id.pixel(x, y)[0];
          const bool sameNode = other.id.pixel(x, y)[0] == id;
          const int difference = codeDifference(expected.color, other.color, x, y);
          if ((!sameNode || difference > 1) && nearEdge(caster, x, y, kMaxPx)) continue;
          moved += !sameNode;
          codes = std::max(codes, difference);
          if (id == 0 || !sameNode) continue;
          ++compared;
          farthest =
              std::max(farthest, glm::distance(pixelOf(snapshot.view, colorAt(expected.position, x, y)),
                                               pixelOf(snapshot.view, colorAt(other.position, x, y))));
        }
    }
  }
  return {atMost("distance between points from different shells", farthest, kMaxPx, "px"),
          atMost("difference of colours from different shells", codes, 1, "of 255"),
          none("pixels that show another node, farther than 1e-3 px from an edge", moved, "pixels"),
          atLeast("pixels compared", compared, context.of(2000000, 100000), "pixels")};
}

std::vector<Measurement> determinism(StressContext& context) {
  std::vector<Measurement> result = threads(context);
  for (const auto& part : {culling(context), shells(context)})
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

// ST-40 -----------------------------------------------------------------------------------------------------

constexpr int kPanFrames = 10000;
constexpr double kPanPx = 1e-4;  // a frame
constexpr double kEdgePx = 0.01;

/// A ball and a ring whose contours cross the picture, which is a crop: its pixels are as large as those of a
/// picture of 1024.
Scene panScene(int side, double framesPanned) {
  Scene scene;
  scene.set(RenderSettings{.background = {0.02, 0.05, 0.1}, .ambient = Vec3(0.1)});
  scene.add(Node{.translation = Vec3(-0.62, 0.5, 0), .surface = sphere(0.6)});
  scene.add(Node{.translation = Vec3(0.5, -0.6, 0.1),
                 .rotation = Rotation{{1, 0.3, 0}, 1.1},
                 .surface = torus(0.6, 0.25)});
  scene.add(Node{.translation = Vec3(-2, 4, 5), .light = Light{.intensity = 0.9}});
  const double pixelsPerUnit = 1024 / (2 * std::tan(radians(20))), distance = 4;
  const Vec3 moved(framesPanned * kPanPx * distance / pixelsPerUnit, 0, 0);
  scene.add(Camera{.eye = Vec3(0, 0, distance) + moved, .lookAt = moved, .fovY = fovOf(side, pixelsPerUnit)});
  return scene;
}

Vec3 codesOf(const Vec3& color) {
  Vec3 codes;
  for (int c = 0; c < 3; ++c) codes[c] = encodeSrgb8(static_cast<float>(color[c]));
  return codes;
}

std::vector<Measurement> slowPan(StressContext& context) {
  const int side = context.of(64, 32), compared = context.of(100, 20);
  const auto snapshotAt = [&](int frame) { return takeSnapshot(panScene(side, frame), 0, {side, side}); };
  const Image firstDrawn = context.draw(snapshotAt(0)).image;
  const Image firstTrue = castPicture(snapshotAt(0)).color;
  int worst = 0;
  std::int64_t wrongEdges = 0, changes = 0;
  for (int k = 1; k <= compared; ++k) {
    const int frame = kPanFrames * k / compared;
    const Snapshot snapshot = snapshotAt(frame);
    const Image drawn = context.draw(snapshot).image, truth = castPicture(snapshot).color;
    const reference::Caster caster(snapshot);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Vec3 step = codesOf(colorAt(drawn, x, y)) - codesOf(colorAt(firstDrawn, x, y));
        const Vec3 trueStep = codesOf(colorAt(truth, x, y)) - codesOf(colorAt(firstTrue, x, y));
        changes += trueStep != Vec3(0);
        const Vec3 difference = glm::abs(step - trueStep);
        const int most = static_cast<int>(std::max({difference.x, difference.y, difference.z}));
        if (most > 1 && nearEdge(caster, x, y, kEdgePx)) continue;
        wrongEdges += most > 1;
        worst = std::max(worst, most);
      }
  }
  return {atMost("step of a pixel less the true step, farther than 0.01 px from edges", worst, 1, "of 255"),
          none("pixels whose step is wrong", wrongEdges, "pixels"),
          atLeast("true steps", changes, 1000, "pixels")};
}

/// Every frame of the pan: a pixel that shows the same surface must not flicker between neighbouring frames.
std::vector<Measurement> everyFrame(StressContext& context) {
  const int side = context.of(64, 32), frames = context.of(kPanFrames, 500);
  Image last;
  std::int64_t jumps = 0;
  for (int frame = 0; frame <= frames; ++frame) {
    const Snapshot snapshot = takeSnapshot(panScene(side, frame), 0, {side, side});
    Image image = context.draw(snapshot).image;
    std::optional<reference::Caster> caster;  // seldom needed
    for (int y = 0; frame > 0 && y < side; ++y)
      for (int x = 0; x < side; ++x) {
        if (codeDifference(image, last, x, y) <= 1) continue;
        if (!caster) caster.emplace(snapshot);
        jumps += !nearEdge(*caster, x, y, kEdgePx);
      }
    last = std::move(image);
  }
  return {none("pixels that jump between frames, farther than 0.01 px from edges", jumps, "pixels")};
}

std::vector<Measurement> standstill(StressContext& context) {
  constexpr int kStillFrames = 1000;
  const PixelSize size{64, 64};
  const Snapshot snapshot = takeSnapshot(luxoGrandpa(), 9.5, size);
  const Image first = context.draw(snapshot).image;
  std::uint64_t submits = 0;
  std::int64_t differing = 0;
  for (int frame = 1; frame < kStillFrames; ++frame) {
    const Picture picture = context.draw(snapshot);
    submits += picture.statistics.count.submits;
    differing += differingPixels(picture.image, first);
  }
  return {none("submits of 999 frames in which nothing moves", static_cast<double>(submits), "submits"),
          none("pixels of theirs that differ", differing, "pixels")};
}

std::vector<Measurement> temporal(StressContext& context) {
  std::vector<Measurement> result = slowPan(context);
  for (const auto& part : {everyFrame(context), standstill(context)})
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

}  // namespace

std::vector<StressCase> systemCases() {
  return {{.id = "ST-39", .title = "the same input is the same picture", .run = determinism},
          {.id = "ST-40", .title = "a slow camera, and a still one", .run = temporal}};
}

}  // namespace luxo
