// SPDX-License-Identifier: Apache-2.0
#include "draw/statistics.h"

#include <algorithm>
#include <iterator>

namespace luxo {
namespace {

/// What is counted: the scene, which is the same however often it is drawn; what the picture is drawn with,
/// of its last attempt alone; all the work that it takes.
enum class Of { Scene, Picture, Work };

struct Count {
  std::uint64_t FrameCounts::*member;
  Of of;
};

constexpr Count kCounts[] = {{&FrameCounts::nodes, Of::Scene},
                             {&FrameCounts::drawn, Of::Scene},
                             {&FrameCounts::culledFrustum, Of::Scene},
                             {&FrameCounts::culledSmall, Of::Scene},
                             {&FrameCounts::culledBackface, Of::Scene},
                             {&FrameCounts::culledLights, Of::Scene},
                             {&FrameCounts::culledHidden, Of::Scene},
                             {&FrameCounts::culledTrianglesFrustum, Of::Scene},
                             {&FrameCounts::culledTrianglesBackface, Of::Scene},
                             {&FrameCounts::drawCalls, Of::Picture},
                             {&FrameCounts::instances, Of::Picture},
                             {&FrameCounts::triangles, Of::Picture},
                             {&FrameCounts::vertices, Of::Picture},
                             {&FrameCounts::submits, Of::Work},
                             {&FrameCounts::uploadBytes, Of::Work},
                             {&FrameCounts::tessellated, Of::Work},
                             {&FrameCounts::pipelinesCreated, Of::Work},
                             {&FrameCounts::shadersCompiled, Of::Work},
                             {&FrameCounts::tooLarge, Of::Scene},
                             {&FrameCounts::passes, Of::Work},
                             {&FrameCounts::shadowPasses, Of::Picture},
                             {&FrameCounts::tracedRays, Of::Picture},
                             {&FrameCounts::layerPoints, Of::Picture},
                             {&FrameCounts::deferred, Of::Picture}};
static_assert(sizeof(FrameCounts) == std::size(kCounts) * sizeof(std::uint64_t));  // each of them

/// Of the drawing.
constexpr double FrameTimes::*kTimes[] = {&FrameTimes::tessellate, &FrameTimes::cull, &FrameTimes::upload,
                                          &FrameTimes::gpu,        &FrameTimes::rays, &FrameTimes::rayTrees};

/// Of a pass: those that are no numbers are counted where the picture is read.
constexpr std::uint64_t FrameError::*kPixelCounts[] = {
    &FrameError::unconvergedPx, &FrameError::uncertifiedPx,   &FrameError::resolvedByRaysPx,
    &FrameError::shadowRaysPx,  &FrameError::layersMissing,   &FrameError::auditedPx,
    &FrameError::auditFailedPx, &FrameError::auditUndecidedPx};

template <class Action>
void forEachCount(Of of, const Action& action) {
  for (const Count& count : kCounts)
    if (count.of == of) action(count.member);
}

void addTimes(FrameTimes& sum, const FrameTimes& times) {
  for (const auto time : kTimes) sum.*time += times.*time;
  addPassTimes(sum.passes, times.passes);
}

}  // namespace

void addPassTimes(std::vector<PassTime>& sums, std::span<const PassTime> times) {
  for (const PassTime& time : times) {
    const auto known = std::ranges::find(sums, time.name, &PassTime::name);
    if (known == sums.end())
      sums.push_back(time);
    else
      known->milliseconds += time.milliseconds;
  }
}

void addCost(FrameStatistics& picture, const FrameStatistics& other) {
  addTimes(picture.ms, other.ms);
  forEachCount(Of::Work, [&](auto count) { picture.count.*count += other.count.*count; });
}

void addPass(FrameStatistics& picture, const FrameStatistics& pass) {
  if (picture.count.passes == 0)
    forEachCount(Of::Scene, [&](auto count) { picture.count.*count = pass.count.*count; });
  addCost(picture, pass);
  forEachCount(Of::Picture, [&](auto count) { picture.count.*count += pass.count.*count; });

  FrameError& error = picture.error;
  error.tolerancePx = pass.error.tolerancePx;
  error.boundPx = std::max(error.boundPx, pass.error.boundPx);
  error.residualMaxPx = std::max(error.residualMaxPx, pass.error.residualMaxPx);  // nothing is the least
  for (const auto pixels : kPixelCounts) error.*pixels += pass.error.*pixels;
}

FrameStatistics shownAgain(const FrameStatistics& before) {
  FrameStatistics now{.error = before.error};
  forEachCount(Of::Scene, [&](auto count) { now.count.*count = before.count.*count; });
  return now;
}

}  // namespace luxo
