// SPDX-License-Identifier: Apache-2.0
// Rays that materials' shaders send into the scene from the points they light (trace() in
// shaders/MATERIALS.md), cast in double as the ground truth casts the eye's.
//
// A picture is lit in rounds. In each a shader gets the answers that there are, and asks for one ray more,
// the first that has none; the picture is done when no pixel asks (shaders/lib/trace.glsl).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reference/caster.h"
#include "reference/shape.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

/// What has been asked in the pixels of one picture. Single-threaded; all cores work.
class SecondaryRays {
 public:
  /// A picture begins: nothing has been asked. `origin`: what positions in shaders are relative to
  /// (DrawList::origin). `goesOn` is asked before every ray, from any thread: once it says no, answers mean
  /// nothing. Light on what rays meet is without ambient occlusion, and by luxo's own materials.
  /// Cost: a copy of the snapshot.
  void begin(
      const Snapshot& snapshot, const Vec3& origin, std::function<bool()> goesOn = [] { return true; });

  /// Answers what the pixels ask, row by row. False when none asks, and the picture is done; or when they ask
  /// more often than their points can. Where a pixel asks again for a ray that was answered, as its point has
  /// become another, what it was told from there on is forgotten. Cost: some 10 us a ray and core, more where
  /// what it meets is in exact shadows; some 500 bytes an answer are kept until the picture's end.
  bool answer(std::span<const shared::TraceQuestion> questions);

  /// Of each pixel, the number of its first answer; and one more: how many there are.
  [[nodiscard]] const std::vector<std::uint32_t>& starts() const { return starts_; }
  [[nodiscard]] const std::vector<shared::TraceAnswer>& answers() const { return answers_; }
  /// Pixels that ask after the last answer: of a device that does not compute the same twice.
  [[nodiscard]] std::uint64_t openPx() const { return open_; }
  /// Pixels with a ray that proves nothing: within rounding of grazing something.
  [[nodiscard]] std::uint64_t undecidedPx() const { return undecided_; }

 private:
  /// An answer, and how rays go on from there.
  struct Cast {
    std::uint32_t pixel = 0;
    shared::TraceRay ray;
    std::optional<reference::Hit> hit;
    double travelled = 0;  ///< from the eye to there, metres
    Vec3 color{0};
    bool certified = true;
  };
  struct Start {
    reference::Hit hit;
    double travelled = 0;
    bool certified = true;
  };

  [[nodiscard]] reference::Ray rayOf(std::uint32_t pixel) const;  ///< the eye's
  [[nodiscard]] Start startOf(std::uint32_t pixel, const shared::TraceQuestion& question) const;
  void cast(std::span<const Start> starts, std::span<Cast> asked, std::span<const std::size_t> chosen) const;
  /// Forgets what pixels have been told from the numbers on that they ask for.
  void forget(std::span<const shared::TraceQuestion> questions);
  /// Keeps them behind those of the same pixel that are there.
  void keep(std::vector<Cast> asked);
  void findStarts();
  [[nodiscard]] shared::TraceAnswer answerOf(const Cast& cast) const;

  Snapshot snapshot_;
  Vec3 origin_{0};
  reference::ShapeCache shapes_;
  std::optional<reference::Caster> caster_;
  std::function<bool()> goesOn_;
  std::vector<std::uint32_t> opaque_, all_;  ///< nodes, ascending
  std::vector<Cast> casts_;                  ///< by pixel, in the order in which they were asked
  std::vector<std::uint32_t> starts_;
  std::vector<shared::TraceAnswer> answers_;
  std::uint32_t rounds_ = 0;
  std::uint64_t undecided_ = 0, open_ = 0;
};

}  // namespace luxo
