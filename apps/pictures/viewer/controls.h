// SPDX-License-Identifier: Apache-2.0
// What the viewer's user has chosen so far: moment, camera, options. Keys and gestures change it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "draw/options.h"
#include "scene/scene.h"
#include "viewer.h"
#include "window/orbit_camera.h"
#include "window/playback.h"
#include "window/window.h"

namespace luxo {

/// One line of the help.
struct KeyHelp {
  const char* keys;
  const char* meaning;
};

[[nodiscard]] std::span<const KeyHelp> keyHelp();

class Controls {
 public:
  using Time = window::Playback::Clock::time_point;

  /// What a key asks of the viewer beyond this state.
  enum class Request { None, Quit, Photo, Fullscreen, NoMultisampling, ResetParameters };

  /// `canMultisample`: the device has 4 samples per pixel.
  Controls(const ViewedScene& viewed, const ViewerOptions& options, bool canMultisample, Time now);

  /// Another scene takes the place of `before`. Moment, camera and what the user chose stay; what only the
  /// scene said becomes what the new one says.
  void adopt(const ViewedScene& before, const ViewedScene& next, Time now);

  Request press(const window::KeyPress& press, Time now);
  /// Drags and scrolls take the camera over from the scene, which looks through `seen`; `size` is the
  /// window's.
  void move(const window::Drag& drag, const Camera& seen, const Moment& moment, PixelSize size);
  void move(const window::Scroll& scroll, const Camera& seen, const Moment& moment, PixelSize size);

  [[nodiscard]] const DrawOptions& drawOptions() const { return draw_; }
  [[nodiscard]] const window::Playback& playback() const { return playback_; }
  /// Whether edges become smooth while nothing moves.
  [[nodiscard]] bool refines() const { return refines_; }
  [[nodiscard]] bool showsKeys() const { return showsKeys_; }
  [[nodiscard]] bool showsNumbers() const { return showsNumbers_; }
  [[nodiscard]] bool showsSliders() const { return showsSliders_; }
  /// Whether what is under the mouse is told.
  [[nodiscard]] bool probes() const { return probes_; }
  /// The camera the user has taken over, if any; else the scene's is meant.
  [[nodiscard]] std::optional<Camera> ownCamera() const;

 private:
  struct OwnCamera {
    Camera from;  ///< the scene's, at the moment of taking over
    window::OrbitCamera orbit;
    double near = 0;  ///< of `from`
  };

  /// From the scene, unless it is the user's already.
  window::OrbitCamera& takeCamera(const Camera& seen, const Moment& moment);
  void shade(Shading shading);
  /// Scenes may ask for more samples than a pass takes; these come while nothing moves.
  [[nodiscard]] int samplesOfPass(int wanted) const { return wanted > 1 && canMultisample_ ? 4 : 1; }
  void step(const window::KeyPress& press, int direction, Time now);

  bool moving_, startsPlaying_;  // the scene moves; a moving scene plays
  double fps_;
  bool canMultisample_;
  DrawOptions draw_;
  Shading solidShading_;  // what to go back to from wireframe
  window::Playback playback_;
  std::optional<OwnCamera> own_;
  bool refines_ = true, wantsShadows_ = true;
  bool showsKeys_ = false, showsNumbers_ = true, showsSliders_ = true, probes_ = false;
};

}  // namespace luxo
