// SPDX-License-Identifier: Apache-2.0
#include "viewer/controls.h"

#include <algorithm>
#include <cmath>

#include "draw/renderer.h"
#include "scene/snapshot.h"
#include "scene/view.h"

namespace luxo {
namespace {

using window::Pose;

// The near plane of a camera that is moved by hand, relative to its distance: one may go as close as one
// likes. Reversed depth loses nothing by it.
constexpr double kNearPerDistance = 0.01;

constexpr KeyHelp kKeys[] = {
    {"Space", "pause and go on"},
    {"Left, Right", "one frame back or on; with Shift, one second"},
    {"Drag", "turn the camera"},
    {"Wheel", "zoom to the cursor"},
    {"Middle drag", "move the camera; or Shift and drag"},
    {"R", "back to the scene's camera"},
    {"1  2  3  4  5", "flat, gouraud, phong, normals, exact"},
    {"T", "toon: a drawing with outlines"},
    {"W", "wireframe"},
    {"L", "hidden lines of wireframes"},
    {"X", "shadows"},
    {"C", "back-face culling"},
    {"M", "4 samples per pixel, or 1"},
    {"A", "smooth edges while nothing moves"},
    {"P", "save a picture here"},
    {"I", "numbers"},
    {"S", "sliders"},
    {"U", "what is under the mouse"},
    {"Ctrl+click", "type a slider's value; of a colour, click on it: #ff8000"},
    {"0", "parameters as in the scene"},
    {"F, F11", "full screen"},
    {"H", "these keys"},
    {"Esc", "quit"},
};

Vec2 pixels(PixelSize size) { return {size.width, size.height}; }

}  // namespace

std::span<const KeyHelp> keyHelp() { return kKeys; }

Controls::Controls(const ViewedScene& viewed, const ViewerOptions& options, bool canMultisample, Time now)
    : moving_(viewed.scene.movesWithTime()),
      startsPlaying_(options.playing),
      fps_(viewed.settings.fps),
      canMultisample_(canMultisample),
      draw_(luxo::drawOptions(viewed.settings)),
      solidShading_(draw_.shading == Shading::Wireframe ? Shading::Exact : draw_.shading),
      playback_(viewed.settings.time, options.playing && moving_, now) {
  playback_.setLoop(viewed.loop);
  draw_.skips = options.skips;
  draw_.samples = samplesOfPass(draw_.samples);
  shade(draw_.shading);
}

void Controls::adopt(const ViewedScene& before, const ViewedScene& next, Time now) {
  const bool moves = next.scene.movesWithTime();
  if (moves != moving_) playback_.setPlaying(moves && startsPlaying_, now);
  moving_ = moves;
  playback_.setLoop(next.loop);
  fps_ = next.settings.fps;
  draw_.tolerancePx = next.settings.tolerance;
  if (next.settings.hiddenLines != before.settings.hiddenLines) draw_.hiddenLines = next.settings.hiddenLines;
  if (next.settings.samples != before.settings.samples) draw_.samples = samplesOfPass(next.settings.samples);
  if (next.settings.shading != before.settings.shading) shade(next.settings.shading);
}

Controls::Request Controls::press(const window::KeyPress& press, Time now) {
  // Held down, only stepping goes on.
  if (press.repeated && press.key != window::key::kLeft && press.key != window::key::kRight)
    return Request::None;
  switch (press.key) {
    case window::key::kEscape:
    case 'Q':
      return Request::Quit;
    case 'P':
      return Request::Photo;
    case 'F':
    case window::key::kF11:
      return Request::Fullscreen;
    case window::key::kSpace:
      if (moving_) playback_.setPlaying(!playback_.playing(), now);
      break;
    case window::key::kLeft:
      step(press, -1, now);
      break;
    case window::key::kRight:
      step(press, 1, now);
      break;
    case 'R':
      own_.reset();
      break;
    case '1':
      shade(Shading::Flat);
      break;
    case '2':
      shade(Shading::Gouraud);
      break;
    case '3':
      shade(Shading::Phong);
      break;
    case '4':
      shade(Shading::Normal);
      break;
    case '5':
      shade(Shading::Exact);
      break;
    case 'T':
      shade(Shading::Toon);
      break;
    case 'W':
      shade(draw_.shading == Shading::Wireframe ? solidShading_ : Shading::Wireframe);
      break;
    case 'L':
      draw_.hiddenLines = !draw_.hiddenLines;
      break;
    case 'X':
      wantsShadows_ = !wantsShadows_;
      shade(draw_.shading);
      break;
    case 'C':
      draw_.cullBackFaces = !draw_.cullBackFaces;
      break;
    case 'M':
      if (!canMultisample_) return Request::NoMultisampling;
      draw_.samples = draw_.samples == 1 ? 4 : 1;
      break;
    case 'A':
      refines_ = !refines_;
      break;
    case 'H':
      showsKeys_ = !showsKeys_;
      break;
    case 'I':
      showsNumbers_ = !showsNumbers_;
      break;
    case 'S':
      showsSliders_ = !showsSliders_;
      break;
    case 'U':
      probes_ = !probes_;
      break;
    case '0':
      return Request::ResetParameters;
    default:
      break;
  }
  return Request::None;
}

void Controls::shade(Shading shading) {
  draw_.shading = shading;
  draw_.shadows = wantsShadows_ ? ShadowKinds::All : ShadowKinds::None;
  if (shading != Shading::Wireframe) solidShading_ = shading;
}

void Controls::step(const window::KeyPress& press, int direction, Time now) {
  if (press.shift) {
    playback_.pauseAt(playback_.seconds(now) + direction, now);
  } else {
    playback_.stepFrames(direction, fps_, now);
  }
}

void Controls::move(const window::Drag& drag, const Camera& seen, const Moment& moment, PixelSize size) {
  window::OrbitCamera& orbit = takeCamera(seen, moment);
  drag.pans ? orbit.pan(drag.movedPx, pixels(size)) : orbit.turn(drag.movedPx, pixels(size));
}

void Controls::move(const window::Scroll& scroll, const Camera& seen, const Moment& moment, PixelSize size) {
  takeCamera(seen, moment).zoom(scroll.notches, scroll.cursorPx, pixels(size));
}

window::OrbitCamera& Controls::takeCamera(const Camera& seen, const Moment& moment) {
  if (own_) return own_->orbit;
  Camera camera = seen;
  const Pose pose{camera.eye.at(moment), camera.lookAt.at(moment), camera.up.at(moment)};
  const double fovY = camera.fovY.at(moment), near = camera.near.at(moment);
  const bool perspective = camera.projection == Projection::Perspective;
  const double heightPerDistance =
      perspective ? 2 * std::tan(fovY / 2) : camera.height.at(moment) / glm::length(pose.eye - pose.lookAt);
  camera.fovY = fovY;
  camera.near = near;
  own_ = OwnCamera{std::move(camera), window::OrbitCamera(pose, heightPerDistance), near};
  return own_->orbit;
}

std::optional<Camera> Controls::ownCamera() const {
  if (!own_) return std::nullopt;
  Camera camera = own_->from;
  const Pose pose = own_->orbit.pose();
  camera.eye = pose.eye;
  camera.lookAt = pose.lookAt;
  camera.up = pose.up;
  camera.height = own_->orbit.height();
  camera.near = std::min(own_->near, kNearPerDistance * own_->orbit.distance());
  return camera;
}

}  // namespace luxo
