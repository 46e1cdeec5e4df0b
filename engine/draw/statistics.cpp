// SPDX-License-Identifier: Apache-2.0
#include "draw/statistics.h"

#include <algorithm>

namespace luxo {

void addPassTimes(std::vector<PassTime>& sums, std::span<const PassTime> times) {
  for (const PassTime& time : times) {
    const auto known = std::ranges::find(sums, time.name, &PassTime::name);
    if (known == sums.end())
      sums.push_back(time);
    else
      known->milliseconds += time.milliseconds;
  }
}

void addTimes(FrameTimes& sum, const FrameTimes& times) {
  for (const auto time : {&FrameTimes::tessellate, &FrameTimes::cull, &FrameTimes::upload, &FrameTimes::gpu,
                          &FrameTimes::rays, &FrameTimes::rayTrees})
    sum.*time += times.*time;
  addPassTimes(sum.passes, times.passes);
}

void addCost(FrameStatistics& picture, const FrameStatistics& other) {
  addTimes(picture.ms, other.ms);
  for (const auto count :
       {&FrameCounts::submits, &FrameCounts::uploadBytes, &FrameCounts::tessellated,
        &FrameCounts::pipelinesCreated, &FrameCounts::shadersCompiled, &FrameCounts::passes})
    picture.count.*count += other.count.*count;
}

}  // namespace luxo
