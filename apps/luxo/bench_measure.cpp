// SPDX-License-Identifier: Apache-2.0
#include "bench_measure.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <numeric>
#include <span>

#include "image/srgb.h"
#include "reference/verification.h"

namespace luxo {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kUsualTolerancePx = DrawOptions{}.tolerancePx,
                 kUsualShellPx = DrawOptions{}.shellTolerancePx;

/// How the work is shared out in time, roughly: where each part ends.
constexpr double kTruthEnd = 0.3, kFirstEnd = 0.4, kTimedEnd = 0.7;

/// Frames that are drawn whenever they are asked for, though they show what they showed before.
DrawOptions optionsOf(const BenchWay& way) {
  DrawOptions options{.shading = way.shading,
                      .samples = way.samples,
                      .composition = way.deferred ? Composition::Deferred : Composition::Fused,
                      .skips = {.unchanged = false}};
  (way.shading == Shading::Exact ? options.shellTolerancePx : options.tolerancePx) = way.tolerancePx;
  return options;
}

/// A way with a renderer of its own, so that what others draw in between changes nothing in it.
struct Contestant {
  Contestant(gpu::Context& context, const BenchWay& way) : row{.way = way}, renderer(context) {}

  BenchRow row;
  Renderer renderer;
  std::vector<double> frameMs = {}, deviceMs = {}, readbackMs = {};
  Image picture = {};  ///< the last one, and how good it says it is
  FrameError error = {};

  void drawTimed(const Snapshot& snapshot) {
    Picture drawn = renderer.render(snapshot, optionsOf(row.way));
    const FrameTimes& ms = drawn.statistics.ms;
    frameMs.push_back(ms.total - ms.readback);
    deviceMs.push_back(ms.gpu);
    readbackMs.push_back(ms.readback);
    picture = std::move(drawn.image);
    error = drawn.statistics.error;
  }

  /// How much of its part in the race is run, 0..1.
  [[nodiscard]] double timedPart(const BenchPlan& plan) const {
    const double spentMs = std::accumulate(frameMs.begin(), frameMs.end(), 0.);
    const double runs = static_cast<double>(frameMs.size());
    return std::max(
        {runs / plan.runs, std::min(runs / plan.leastRuns, spentMs / plan.enoughMs), spentMs / plan.muchMs});
  }
};

class SceneBench {
 public:
  SceneBench(gpu::Context& context, const Snapshot& snapshot, const BenchPlan& plan,
             const std::function<bool(double)>& goesOn)
      : context_(context), snapshot_(snapshot), plan_(plan), goesOn_(goesOn) {}

  std::optional<BenchScene> measure(const std::string& name) {
    result_.name = name;
    if (!castTruth() || !drawFirst() || !timeInTurns() || !judgeAll()) return std::nullopt;
    return std::move(result_);
  }

 private:
  bool castTruth() {
    const Stopwatch watch;
    ReferenceOptions options;
    options.progress = [&](double done) { return goesOn_(0.9 * kTruthEnd * done); };
    truth_ = castPicture(snapshot_, options);
    if (!truth_.complete) return false;
    result_.truthMs = watch.milliseconds();
    result_.truth = truth_.color;
    result_.covered = truth_.hits;
    result_.undecided = truth_.undecided;
    areaPixels_ = spreadPixels(snapshot_.view.size, plan_.areaPixels);
    options = {.samples = plan_.areaSamples, .pixels = areaPixels_};
    options.progress = [&](double done) { return goesOn_(kTruthEnd * (0.9 + 0.1 * done)); };
    area_ = castPicture(snapshot_, options);
    return area_.complete;
  }

  bool drawFirst() {
    for (std::size_t i = 0; i < plan_.ways.size(); ++i) {
      const BenchWay& way = plan_.ways[i];
      if (!goesOn_(std::lerp(kTruthEnd, kFirstEnd, partOf(i)))) return false;
      if (expectedTriangles(way) > static_cast<double>(plan_.mostTriangles)) continue;
      Contestant& contestant = contestants_.emplace_back(context_, way);
      const FrameStatistics first = contestant.renderer.render(snapshot_, optionsOf(way)).statistics;
      contestant.row.cost.coldMs = first.ms.total;
      contestant.row.cost.triangles = first.count.triangles;
    }
    return true;
  }

  /// From the next coarser way: the finest mesh costs as many triangles as its tolerance is small.
  [[nodiscard]] double expectedTriangles(const BenchWay& way) const {
    for (auto other = contestants_.rbegin(); other != contestants_.rend(); ++other)
      if (const BenchWay& coarser = other->row.way;
          coarser.shading == way.shading && coarser.samples == way.samples)
        return static_cast<double>(other->row.cost.triangles) * coarser.tolerancePx / way.tolerancePx;
    return 0;
  }

  bool timeInTurns() {
    for (int run = 0; run < plan_.runs; ++run)
      for (Contestant& contestant : contestants_) {
        if (!goesOn_(std::lerp(kFirstEnd, kTimedEnd, timedPart()))) return false;
        if (contestant.timedPart(plan_) < 1) contestant.drawTimed(snapshot_);
      }
    return true;
  }

  /// Weighted by what a frame took the first time.
  [[nodiscard]] double timedPart() const {
    double all = 0, done = 0;
    for (const Contestant& contestant : contestants_) {
      all += contestant.row.cost.coldMs;
      done += contestant.row.cost.coldMs * std::min(1., contestant.timedPart(plan_));
    }
    return done / all;
  }

  bool judgeAll() {
    std::size_t done = 0;
    for (Contestant& contestant : contestants_) {
      if (!goesOn_(std::lerp(kTimedEnd, 1., partOf(done++)))) return false;
      BenchRow& row = contestant.row;
      row.cost.runs = static_cast<int>(contestant.frameMs.size());
      row.cost.frameMs = typicalOf(contestant.frameMs);
      row.cost.deviceMs = typicalOf(contestant.deviceMs);
      row.cost.readbackMs = percentile(contestant.readbackMs, 0.5);
      if (row.way.samples == 1)
        judgeCentres(contestant);
      else
        judgeAreas(contestant);
      result_.rows.push_back(row);
    }
    return true;
  }

  void judgeCentres(Contestant& contestant) {
    BenchRow& row = contestant.row;
    const auto draw = [&](Output output) {
      DrawOptions options = optionsOf(row.way);
      options.output = output;
      return contestant.renderer.render(snapshot_, options).image;
    };
    const MeasuredPicture picture = {.color = std::move(contestant.picture),
                                     .normal = draw(Output::Normal),
                                     .uv = draw(Output::Uv),
                                     .id = draw(Output::Id)};
    const auto judged = [&](VerificationOptions options) {
      options.worst = 1;
      options.flip = false;
      return verify(snapshot_, truth_, picture, options);
    };
    const bool exact = row.way.shading == Shading::Exact;
    const Verification v = judged({.pixels = exact ? std::vector<std::uint32_t>()
                                                   : spreadPixels(snapshot_.view.size, plan_.meshPixels)});
    row.error = errorOf(v, contestant.error);
    if (isPictured(row.way))
      result_.pictures.push_back(
          {row.way, picture.color,
           errorHeat(exact ? v.positionMap : judged({.silhouettes = false}).positionMap)});
  }

  static BenchError errorOf(const Verification& v, const FrameError& said) {
    const bool exact = said.residualMaxPx.has_value();
    const auto compared = [](const ErrorSpread& spread, double value) {
      return spread.pixels > 0 ? value : kNotMeasured;
    };
    return {.judged = v.coverage.compared,
            .covered = v.coverage.covered,
            .boundPx = said.boundPx,
            .residualPx = said.residualMaxPx.value_or(kNotMeasured),
            .unconvergedPx = exact ? static_cast<double>(said.unconvergedPx) : kNotMeasured,
            .uncertifiedPx = exact ? static_cast<double>(said.uncertifiedPx) : kNotMeasured,
            .positionMaxPx = compared(v.positionPx, v.positionPx.max),
            .positionP999Px = compared(v.positionPx, v.positionPx.p999),
            .normalMaxDeg = compared(v.normalDegrees, v.normalDegrees.max),
            .normalP999Deg = compared(v.normalDegrees, v.normalDegrees.p999),
            .silhouettePx = v.coverage.farthestPx,
            .mismatches = v.coverage.mismatches(),
            .beyond = v.coverage.beyond,
            .differing8Part = v.color.differing8Part,
            .psnr = v.color.psnrLinear};
  }

  void judgeAreas(Contestant& contestant) {
    const BenchWay& way = contestant.row.way;
    BenchError& error = contestant.row.error;
    for (const BenchRow& other : result_.rows)
      if (other.way.shading == way.shading && other.way.tolerancePx == way.tolerancePx) error = other.error;
    const Image& picture = contestant.picture;
    const auto width = static_cast<std::uint32_t>(picture.width());
    double covered = 0, differing = 0, squares = 0;
    for (const std::uint32_t pixel : areaPixels_) {
      const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
      const std::span<const float> shown = picture.pixel(x, y), meant = area_.color.pixel(x, y);
      bool differs = false;
      for (std::size_t c = 0; c < 3; ++c) {
        const double difference = static_cast<double>(shown[c]) - static_cast<double>(meant[c]);
        squares += difference * difference;
        differs |= encodeSrgb8(shown[c]) != encodeSrgb8(meant[c]);
      }
      differing += differs ? 1 : 0;
      covered += truth_.number[pixel] != 0 ? 1 : 0;
    }
    error.differing8Part = covered == 0 ? kNotMeasured : differing / covered;
    error.psnr = -10 * std::log10(squares / (3 * static_cast<double>(areaPixels_.size())));
  }

  [[nodiscard]] double partOf(std::size_t way) const {
    return static_cast<double>(way) / static_cast<double>(plan_.ways.size());
  }

  gpu::Context& context_;
  const Snapshot& snapshot_;
  const BenchPlan& plan_;
  const std::function<bool(double)>& goesOn_;
  BenchScene result_;
  ReferencePicture truth_, area_;
  std::vector<std::uint32_t> areaPixels_;
  std::list<Contestant> contestants_;
};

using Tolerances = std::vector<std::pair<Shading, std::vector<double>>>;

BenchPlan planOf(const Tolerances& ofOneSample, const Tolerances& ofFour) {
  BenchPlan plan;
  const auto add = [&](const Tolerances& tolerances, int samples) {
    for (const auto& [shading, list] : tolerances)
      for (const double tolerance : list) plan.ways.push_back({shading, tolerance, samples});
  };
  add(ofOneSample, 1);
  plan.ways.push_back({Shading::Exact, kUsualShellPx, 1, true});
  add(ofFour, 4);
  return plan;
}

}  // namespace

BenchPlan fullPlan() {
  return planOf({{Shading::Flat, {0.5, 0.05}},
                 {Shading::Gouraud, {0.5, 0.05}},
                 {Shading::Phong, {2, 1, 0.5, 0.25, 0.1, 0.05, 0.02, 0.01}},
                 {Shading::Exact, {kUsualShellPx, 0.5 * kUsualShellPx}}},
                {{Shading::Flat, {0.5}},
                 {Shading::Gouraud, {0.5}},
                 {Shading::Phong, {2, 0.5, 0.1}},
                 {Shading::Exact, {kUsualShellPx}}});
}

BenchPlan quickPlan() {
  const Tolerances few = {{Shading::Phong, {1, 0.5, 0.1}}, {Shading::Exact, {kUsualShellPx}}};
  BenchPlan plan = planOf(few, few);
  plan.runs = 5;
  plan.enoughMs = 400;
  plan.meshPixels = 20'000;
  plan.areaPixels = 3'000;
  return plan;
}

bool isPictured(const BenchWay& way) {
  return way.samples == 1 && !way.deferred &&
         ((way.shading == Shading::Exact && way.tolerancePx == kUsualShellPx) ||
          (way.shading == Shading::Phong && way.tolerancePx == kUsualTolerancePx));
}

std::optional<BenchScene> measureScene(gpu::Context& context, const std::string& name,
                                       const Snapshot& snapshot, const BenchPlan& plan,
                                       const std::function<bool(double)>& goesOn) {
  return SceneBench(context, snapshot, plan, goesOn).measure(name);
}

}  // namespace luxo
