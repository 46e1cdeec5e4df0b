// SPDX-License-Identifier: Apache-2.0
// What the window tells of what has happened: for a while, or for as long as it is so.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/camera.h"
#include "viewer/panels.h"
#include "window/overlay.h"

namespace luxo {

/// Of an error: what, and what to do.
[[nodiscard]] std::string inWords(const Error& error);

class Notices {
 public:
  using Clock = std::chrono::steady_clock;

  /// Over the picture for some seconds, and in the log. An alert stays longer.
  void tell(const Message& message);
  /// Until something else is told.
  void tellWhile(const Message& message);
  void expire(Clock::time_point now);
  /// When a message goes: nothing where there is none.
  [[nodiscard]] std::optional<Clock::time_point> end() const;

  /// What is wrong: of the file as it was saved, with the moment, with what there is to draw, and with what
  /// shaders do. Empty: nothing.
  void file(const std::string& problem);
  /// The file has been wrong from the beginning.
  void neverRead(const std::string& problem) {
    file(problem);
    neverRead_ = true;
  }
  void shaders(const std::string& faults) { faults_ = faults; }
  [[nodiscard]] const std::string& shaders() const { return faults_; }

  /// The worst of what is wrong, and the message. `refused`: why what there is to draw cannot be drawn.
  void addPanels(std::vector<window::Panel>& panels, const std::string& impossible,
                 const std::string& refused, PixelSize size, double contentScale) const;

 private:
  std::optional<Message> message_;
  Clock::time_point end_;
  std::string problem_, faults_;
  bool neverRead_ = false;
};

}  // namespace luxo
