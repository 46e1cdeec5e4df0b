// SPDX-License-Identifier: Apache-2.0
// How long frames take, for people to read: means over half a second while frames follow each other, else the
// last one's.
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "draw/statistics.h"

namespace luxo {

class FrameMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Milliseconds, and frames per second where frames follow each other.
  struct Reading {
    double cpu = 0, gpu = 0;
    std::vector<PassTime> passes = {};  ///< of gpu
    std::optional<double> rate = std::nullopt;
  };

  /// A frame began: the host worked on it that long.
  void addFrame(double cpuMs, Time now) {
    if (frames_ == 0) since_ = now;
    ++frames_;
    cpuSum_ += cpuMs;
    if (!reading_.rate) reading_.cpu = cpuMs;
  }
  /// The device has finished one.
  void addDevice(double gpuMs, std::vector<PassTime> passes) {
    ++deviceFrames_;
    gpuSum_ += gpuMs;
    addPassTimes(passSums_, passes);
    lastGpu_ = gpuMs;
    lastPasses_ = std::move(passes);
    if (!reading_.rate) takeLast();
  }

  /// What to show now.
  [[nodiscard]] const Reading& read(bool playing, Time now) {
    const std::chrono::duration<double> window = now - since_;
    if (!playing) {
      if (reading_.rate) takeLast();
      reading_.rate.reset();
      restart();
    } else if (frames_ > 1 && window.count() >= kWindow) {
      reading_.cpu = cpuSum_ / frames_;
      if (deviceFrames_ > 0) {
        reading_.gpu = gpuSum_ / deviceFrames_;
        reading_.passes = passSums_;
        for (PassTime& pass : reading_.passes) pass.milliseconds /= deviceFrames_;
      }
      reading_.rate = (frames_ - 1) / window.count();
      restart();
    }
    return reading_;
  }

 private:
  static constexpr double kWindow = 0.5;  // seconds

  void restart() {
    frames_ = deviceFrames_ = 0;
    cpuSum_ = gpuSum_ = 0;
    passSums_.clear();
  }

  void takeLast() {
    reading_.gpu = lastGpu_;
    reading_.passes = lastPasses_;
  }

  Reading reading_;
  Time since_;
  int frames_ = 0, deviceFrames_ = 0;
  double cpuSum_ = 0, gpuSum_ = 0, lastGpu_ = 0;
  std::vector<PassTime> passSums_, lastPasses_;
};

}  // namespace luxo
