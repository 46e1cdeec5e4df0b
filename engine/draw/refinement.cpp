// SPDX-License-Identifier: Apache-2.0
#include "draw/refinement.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/stopwatch.h"

namespace luxo {
namespace {

/// What a list leaves to rays, and what their points are drawn with.
struct LeftToRays {
  explicit LeftToRays(const DrawList& list) : points(list.byRays), shadows(list.shadowsByRays) {
    for (const FoundNode& found : list.found) nodes.push_back(found.node);
    for (const FoundLayer& layer : list.layers.found) layers.push_back(layer.node);
  }

  std::vector<PixelRect> points, shadows;
  std::vector<std::uint32_t> nodes, layers;

  friend bool operator==(const LeftToRays&, const LeftToRays&) = default;
};

}  // namespace

void Refinement::begin(const Snapshot& snapshot, const DrawOptions& options, std::function<bool()> goesOn) {
  snapshot_ = &snapshot;
  options_ = options;
  options_.standIns = false;
  goesOn_ = std::move(goesOn);
  next_ = &Refinement::draw;
  trial_ = Trial::Usual;
  before_.reset();
  if (std::exchange(complete_, false)) before_.emplace(std::move(points_), statistics_.error);
  points_ = {};
  statistics_ = {};
}

auto Refinement::advance(const Submit& submit) -> std::optional<Rays> {
  while (next_) {
    if (std::optional<Rays> rays = (this->*std::exchange(next_, nullptr))(submit)) return rays;
    complete_ = !next_;
  }
  return std::nullopt;
}

auto Refinement::draw(const Submit& submit) -> std::optional<Rays> {
  if (trial_ != Trial::ByRays) search(submit);
  next_ = &Refinement::trace;
  if (auto before = std::exchange(before_, std::nullopt); before && view_->relit()) {
    // Loops over what is seen through may have been ended, which were not.
    const std::uint64_t missing = statistics_.error.layersMissing;
    std::tie(points_, statistics_.error) = std::move(*before);
    statistics_.error.layersMissing += missing;
    statistics_.error.unconvergedPx += missing;
    return std::nullopt;
  }
  if (!view_->searches() && !view_->list().findsShadows()) return std::nullopt;
  next_ = &Refinement::place;
  points_ = {};
  rays_.begin(*snapshot_, options_, goesOn_);
  std::vector<Doubt> doubts;
  timeRays([&] {
    doubts = view_->doubts([&](const RenderView::Recording& record) {
      submit(record, std::span<const PixelPlace>(), statistics_);
    });
    if (trial_ == Trial::ByRays) doubts = everywhere(snapshot_->view.size, std::move(doubts));
  });
  if (doubts.empty()) return std::nullopt;
  return [this, doubts = std::move(doubts), draws = RayDraws(view_->list()), shown = view_->shown()] {
    timeRays([&] { points_ = rays_.resolve(doubts, draws, shown); });
  };
}

auto Refinement::place(const Submit& submit) -> std::optional<Rays> {
  next_ = &Refinement::judge;
  FrameError& error = statistics_.error;
  error.resolvedByRaysPx = points_.resolved - points_.undecided + points_.shadowed + points_.layered -
                           std::min(points_.layered, points_.layersUndecided);
  error.shadowRaysPx = points_.shadowed;
  error.uncertifiedPx = points_.undecided + points_.shadowsUndecided + points_.layersUndecided;
  error.unconvergedPx = error.layersMissing + points_.unknown;
  if (!points_.empty()) drawPoints(submit);
  audit_ = {};
  std::vector<DepthProbe> probes = view_->probes();
  error.auditedPx = probes.size();
  if (probes.empty()) return std::nullopt;
  return [this, probes = std::move(probes), draws = RayDraws(view_->list()), shown = view_->shown()] {
    timeRays([&] { audit_ = rays_.audit(probes, draws, shown); });
  };
}

auto Refinement::judge(const Submit&) -> std::optional<Rays> {
  next_ = &Refinement::trace;
  statistics_.ms.rayTrees += rays_.treesMs();
  FrameError& error = statistics_.error;
  error.auditFailedPx += audit_.failed;
  error.auditUndecidedPx = audit_.undecided;
  const std::uint64_t wrong = audit_.failed + error.unconvergedPx;
  if (wrong == 0 || error.layersMissing > 0) return std::nullopt;
  if (trial_ == Trial::ByRays) {
    error.unconvergedPx = wrong;
    return std::nullopt;
  }
  trial_ = static_cast<Trial>(static_cast<int>(trial_) + 1);
  options_.skips = Skips::none();
  options_.finerShells = trial_ == Trial::WithFinerShells;
  next_ = &Refinement::draw;
  return std::nullopt;
}

auto Refinement::trace(const Submit&) -> std::optional<Rays> {
  if (!view_->list().traces) return std::nullopt;
  traced_.begin(*snapshot_, view_->list().origin, goesOn_);
  return answering();
}

auto Refinement::answering() -> Rays {
  next_ = &Refinement::light;
  return
      [this, questions = view_->traces().asked()] { timeRays([&] { asked_ = traced_.answer(questions); }); };
}

auto Refinement::light(const Submit& submit) -> std::optional<Rays> {
  if (asked_) {
    submit(
        [&](VkCommandBuffer commands) {
          painter_->recordAnswers(*frames_, commands, *view_, traced_, points_, statistics_);
        },
        std::nullopt, statistics_);
    return answering();
  }
  statistics_.error.unconvergedPx += traced_.openPx();
  statistics_.error.uncertifiedPx += traced_.undecidedPx();
  statistics_.count.tracedRays += traced_.answers().size();
  return std::nullopt;
}

void Refinement::search(const Submit& submit) {
  const std::uint64_t failed = statistics_.error.auditFailedPx;
  do {
    FrameStatistics attempt = paint(submit);
    addCost(attempt, statistics_);
    statistics_ = attempt;
  } while (view_->makeRoom());
  const LayerLists::Found layers = view_->layerPoints();
  statistics_.count.layerPoints = layers.points;
  statistics_.error.layersMissing = statistics_.error.unconvergedPx = layers.missing;
  statistics_.error.auditFailedPx = failed;
}

FrameStatistics Refinement::paint(const Submit& submit) {
  FrameStatistics painted;
  submit(
      [&](VkCommandBuffer commands) {
        painter_->record(*frames_, commands, *view_, *snapshot_, options_, painted);
      },
      {}, painted);
  return painted;
}

void Refinement::drawPoints(const Submit& submit) {
  const LeftToRays left(view_->list());
  const bool anew = view_->makeRoomFor(points_);
  if (anew) addCost(statistics_, paint(submit));
  // No ray was cast for what another list leaves to them.
  const bool cast = LeftToRays(view_->list()) == left;
  std::vector<PixelPlace> pixels = points_.pixels;
  std::ranges::sort(pixels, {}, [](const PixelPlace& pixel) { return std::pair(pixel.y, pixel.x); });
  submit(
      [&](VkCommandBuffer commands) {
        painter_->recordRays(*frames_, commands, *view_, points_, statistics_);
      },
      view_->list().onlyFound() && !anew ? Changed(pixels) : std::nullopt, statistics_);
  const std::uint64_t missing = view_->layerPoints().missing;
  const PixelSize size = snapshot_->view.size;
  statistics_.error.unconvergedPx =
      cast ? statistics_.error.unconvergedPx + missing : PixelRect{{0, 0}, {size.width, size.height}}.count();
  statistics_.error.layersMissing += missing;
}

void Refinement::timeRays(const std::function<void()>& work) {
  const Stopwatch watch;
  const double trees = rays_.treesMs(), drawing = statistics_.ms.gpu;
  work();
  statistics_.ms.rays += watch.milliseconds() - (rays_.treesMs() - trees) - (statistics_.ms.gpu - drawing);
}

}  // namespace luxo
