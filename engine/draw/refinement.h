// SPDX-License-Identifier: Apache-2.0
// How a picture becomes right, and when it is: one protocol for files, for the samples of a mean, and for a
// window.
//
//   1. It is drawn. Where it finds what the last one has found (draw/found_alike.h), 4 is next.
//   2. Rays find what its searches have left in doubt (CertifiedRays), and their points are drawn.
//   3. Rays audit some of its pixels. Where they find one wrong, or something is still open, all that again:
//      with nothing skipped, then with finer shells as well, at last with rays for all pixels. What is left
//      then is counted as not converged.
//   4. Rays answer what shaders of materials ask of the scene, and it is lit again, until none asks more.
//
// The device's part and that of rays take turns, so that a window may do the latter beside itself.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/options.h"
#include "draw/ray_points.h"
#include "draw/render_view.h"
#include "draw/scene_painter.h"
#include "draw/secondary_rays.h"
#include "draw/statistics.h"
#include "gpu/frame.h"
#include "scene/snapshot.h"

namespace luxo {

class Refinement {
 public:
  /// All of which must outlive it.
  Refinement(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view)
      : frames_(&frames), painter_(&painter), view_(&view) {}
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  /// Another picture, of one sample in each pixel, or of the device's own four where nothing is searched for.
  /// `snapshot` must outlive its steps. `goesOn`: of CertifiedRays::begin().
  void begin(
      const Snapshot& snapshot, const DrawOptions& options,
      std::function<bool()> goesOn = [] { return true; });

  /// Which pixels of the picture a recording changes, by rows; nothing: perhaps all.
  using Changed = std::optional<std::span<const PixelPlace>>;
  /// Runs what a recording records, waits for it, and adds its cost.
  using Submit = std::function<void(const RenderView::Recording& record, const Changed& changed,
                                    FrameStatistics& statistics)>;
  /// On any thread, and to its end before the next step; again after begin() or advance() it means nothing.
  using Rays = std::function<void()>;
  /// Does the device's part of the next step. Nothing: the picture in the view is as right as it gets.
  /// Throws what ScenePainter::record() does.
  [[nodiscard]] std::optional<Rays> advance(const Submit& submit);

  // What follows is of the picture so far, and not to be asked while rays are at work.

  /// Of all steps; what they found, of the last trial.
  [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }
  /// What rays have found.
  [[nodiscard]] const RayPoints& points() const { return points_; }

 private:
  enum class Trial { Usual, WithoutSkips, WithFinerShells, ByRays };
  using Step = std::optional<Rays> (Refinement::*)(const Submit& submit);

  /// Draws what rays do not, and lets these find the rest.
  [[nodiscard]] std::optional<Rays> draw(const Submit& submit);
  /// Draws what rays have found, and lets them audit the picture.
  [[nodiscard]] std::optional<Rays> place(const Submit& submit);
  /// Begins the next trial, or leaves the picture to shaders' questions.
  [[nodiscard]] std::optional<Rays> judge(const Submit& submit);
  /// Lets rays answer the first questions, and, once they have answered some, lights it by them and asks on.
  [[nodiscard]] std::optional<Rays> trace(const Submit& submit);
  [[nodiscard]] std::optional<Rays> light(const Submit& submit);
  [[nodiscard]] Rays answering();

  /// Again where what is seen through had no room.
  void search(const Submit& submit);
  /// The picture without rays, once.
  [[nodiscard]] FrameStatistics paint(const Submit& submit);
  /// Into the picture that was drawn last; which is drawn again, where it has no room for them.
  void drawPoints(const Submit& submit);
  void timeRays(const std::function<void()>& work);

  gpu::FrameRing* frames_;
  ScenePainter* painter_;
  RenderView* view_;
  const Snapshot* snapshot_ = nullptr;
  DrawOptions options_;
  std::function<bool()> goesOn_;
  Step next_ = nullptr;
  Trial trial_ = Trial::Usual;
  bool complete_ = false;
  /// Of the picture before, which is as right as it gets, until it is known whether this one has found as
  /// much.
  std::optional<std::pair<RayPoints, FrameError>> before_;
  CertifiedRays rays_;
  RayPoints points_;
  AuditResult audit_;
  SecondaryRays traced_;
  bool asked_ = false;  ///< there were questions, and they have answers
  FrameStatistics statistics_;
};

}  // namespace luxo
