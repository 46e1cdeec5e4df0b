// SPDX-License-Identifier: Apache-2.0
#include "random/trial.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "reference/caster.h"
#include "reference/layers.h"
#include "reference/reference.h"

namespace luxo::random {
namespace {

// Of parameters: far more than floats leave of them, far less than sheets are apart.
constexpr double kSameSheet = 1e-3;
constexpr double kSameColor = 2e-3;  // linear: half an 8-bit step of dark colours, 20 times what float leaves

/// Adds the processors' time while it lives.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(processorSeconds()) {}
  ~Stopwatch() { sum_ += processorSeconds() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  double start_;
};

Vec3 colorAt(const Image& image, std::uint32_t pixel) {
  const auto s = image.samples().subspan(3U * pixel, 3);
  return {s[0], s[1], s[2]};
}

/// What samples show, each held against the truth at its place; and what the truth is there.
class Samples {
 public:
  Samples(Renderer& renderer, const Snapshot& snapshot, const TrialOptions& options, Trial& trial)
      : renderer_(renderer),
        snapshot_(snapshot),
        options_{.shading = Shading::Exact, .audit = options.audit, .skips = options.skips},
        goesOn_(options.goesOn),
        trial_(trial),
        layers_(snapshot) {
    anyShader_ = std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
      return snapshot.materials[node.material.index].shader != nullptr;
    });
    byPlace_ = std::ranges::any_of(snapshot.nodes,
                                   [](const SnapshotNode& node) { return !node.surface.isParametric(); });
    const auto count = static_cast<std::size_t>(snapshot.view.size.width) *
                       static_cast<std::size_t>(snapshot.view.size.height);
    mean_.assign(count, Vec3(0));
    right_.assign(count, 1);
  }

  /// One sample per pixel, `weight` of the mean.
  void judge(const Vec2& offsetPx, double weight) {
    Snapshot snapshot = snapshot_;
    snapshot.view = sampledAt(snapshot.view, offsetPx);
    MeasuredPicture measured;
    const Told told = draw(snapshot, measured);
    trial_.complete &= goesOn_();
    if (!trial_.complete) return;
    ReferencePicture truth;
    Verification v;
    {
      const Stopwatch watch(trial_.referenceSeconds);
      {
        const Stopwatch cast(trial_.castSeconds);
        truth = caster_.cast(snapshot, {.progress = [&](double) { return goesOn_(); }});
      }
      trial_.complete &= truth.complete;
      if (!trial_.complete) return;
      // Twice as far as matters: near enough to be told from what is away from outlines.
      v = verify(snapshot, truth, measured,
                 {.farthestPx = 2 * kSilhouettePx, .colors = false, .worst = 0, .flip = false});
    }
    trial_.pixels += v.coverage.compared + v.coverage.undecided;
    trial_.undecided += v.coverage.undecided;
    trial_.hits += v.coverage.covered;
    trial_.worstPx = std::max(trial_.worstPx, v.positionPx.max);
    add(v.wrong);
    trial_.silentlyWrong +=
        beyond(v.wrong.total() - v.wrong.light, told.found) + beyond(v.wrong.light, told.lit);
    for (std::uint32_t i = 0; i < mean_.size(); ++i) {
      mean_[i] += weight * trueColor(snapshot, measured, truth, i);
      // Infinite where another layer is shown, be it within the outline's width; negative where a layer is
      // that touches the true one, which may have another colour.
      const float off = v.positionMap.samples()[i];
      const bool sameLayer = truth.number[i] == 0 ? off < 0 : off >= 0;
      if (!truth.certified[i] || !sameLayer || !(off <= kPointPx) || hasNoTrueColor(truth.number[i]))
        right_[i] = 0;
    }
  }

  /// The resolved picture against the mean of the truth. Where they differ a shadow's border or a normal that
  /// turns fast may be the reason: then other colours are seen as near as a point may be off.
  [[nodiscard]] std::uint64_t wrongColors(const Image& shown) const {
    const reference::Caster caster(snapshot_);
    std::uint64_t wrong = 0;
    for (std::uint32_t i = 0; i < mean_.size(); ++i) {
      if (right_[i] == 0 || near(colorAt(shown, i), mean_[i], mean_[i])) continue;
      Vec3 least(0), most(0);
      bool certified = true;
      for (const Vec2& offset : samplePattern(4))
        certified &= addColorsAround(caster, i, offset, least, most);
      if (near(colorAt(shown, i), least, most)) continue;
      ++(certified ? wrong : trial_.undecided);
    }
    return wrong;
  }

  [[nodiscard]] static std::uint64_t beyond(std::uint64_t wrong, const FrameError& error) {
    const std::uint64_t told = error.unconvergedPx + error.uncertifiedPx;
    return wrong > told ? wrong - told : 0;
  }

 private:
  /// What the pictures say of themselves: each is found and audited anew, and what is left open in one may
  /// have been settled in another.
  struct Told {
    FrameError found, lit;  ///< the largest counts of those of points; those of that of colours
  };

  Told draw(const Snapshot& snapshot, MeasuredPicture& measured) {
    const Stopwatch watch(trial_.pictureSeconds);
    const auto show = [&](Output output) {
      DrawOptions options = options_;
      options.output = output;
      options.samples = 1;
      return renderer_.render(snapshot, options);
    };
    Told told;
    const auto compared = [&](Output output) {
      Picture picture = show(output);
      const FrameError& error = picture.statistics.error;
      told.found.unconvergedPx = std::max(told.found.unconvergedPx, error.unconvergedPx);
      told.found.uncertifiedPx = std::max(told.found.uncertifiedPx, error.uncertifiedPx);
      return std::move(picture.image);
    };
    Picture color;
    {
      const Stopwatch drawn(trial_.drawSeconds);
      color = show(Output::Color);
    }
    measured = {.color = std::move(color.image),
                .depth = {},
                .position = byPlace_ ? compared(Output::Position) : Image(),
                .normal = {},
                .uv = compared(Output::Uv),
                .id = compared(Output::Id)};
    const FrameError& error = told.lit = color.statistics.error;
    trial_.unconverged += error.unconvergedPx;
    trial_.uncertified += error.uncertifiedPx;
    trial_.resolvedByRays += error.resolvedByRaysPx;
    trial_.auditFailed += error.auditFailedPx;
    return told;
  }

  /// Of what a material's own shader lights there is no truth, be it seen through something.
  [[nodiscard]] bool hasNoTrueColor(std::uint32_t number) const {
    const auto node = layers_.nodeOf(number);
    if (!anyShader_ || !node) return false;
    const Material& material = snapshot_.materials[snapshot_.nodes[*node].material.index];
    return material.shader || material.transparent();
  }

  void add(const WrongPixels& wrong) {
    trial_.wrong.hitMiss += wrong.hitMiss;
    trial_.wrong.layer += wrong.layer;
    trial_.wrong.point += wrong.point;
    trial_.wrong.light += wrong.light;
    trial_.wrong.pixels.insert(trial_.wrong.pixels.end(), wrong.pixels.begin(), wrong.pixels.end());
  }

  /// The truth's colour; where a sample shows, of sheets that touch, another than the truth, as it may, that
  /// sheet's.
  Vec3 trueColor(const Snapshot& snapshot, const MeasuredPicture& measured, const ReferencePicture& truth,
                 std::uint32_t i) const {
    const Vec2 shown(colorAt(measured.uv, i)), &seen = truth.parameters[i];
    const auto node = layers_.nodeOf(truth.number[i]);
    if (!node || glm::distance(shown, seen) <= kSameSheet * (1 + glm::length(seen)))
      return colorAt(truth.color, i);
    const reference::Caster caster(snapshot);
    const auto width = static_cast<std::uint32_t>(snapshot.view.size.width);
    const reference::Ray ray = caster.rayThrough(i % width + 0.5, i / width + 0.5);
    reference::Caster::Sight sight = caster.look(ray);
    const auto other = caster.pointAt(*node, shown, ray);
    if (!other || sight.hits.empty()) return colorAt(truth.color, i);
    sight.hits.front() = *other;
    bool certified = true;
    return caster.color(ray, sight, certified);
  }

  static bool near(const Vec3& color, const Vec3& least, const Vec3& most) {
    for (int c = 0; c < 3; ++c)
      if (!(color[c] >= least[c] - kSameColor && color[c] <= most[c] + kSameColor)) return false;
    return true;
  }

  /// Adds a quarter of the least and the most of the colours within kSilhouettePx of a sample, and with
  /// lights in the plane of what is seen on either side of it. Whether all of them are decided: a shadow of
  /// what the light is in the plane of may not be.
  [[nodiscard]] bool addColorsAround(const reference::Caster& caster, std::uint32_t i, const Vec2& offset,
                                     Vec3& least, Vec3& most) const {
    const auto width = static_cast<std::uint32_t>(snapshot_.view.size.width);
    const Vec2 at = Vec2(i % width, i / width) + 0.5 + offset;
    Vec3 lo(0), hi(0);
    bool certified = true;
    for (int k = 0; k < 9; ++k) {
      const double angle = kTau * k / 8, radius = k == 8 ? 0 : kSilhouettePx;
      const reference::Ray ray =
          caster.rayThrough(at.x + radius * std::cos(angle), at.y + radius * std::sin(angle));
      const reference::Caster::Sight sight = caster.look(ray);
      certified &= sight.certified;
      for (const double tilt : {-kCosineRounding, kCosineRounding}) {
        const Vec3 color = caster.color(ray, sight, certified, tilt);
        const bool isFirst = k == 0 && tilt < 0;
        lo = isFirst ? color : glm::min(lo, color);
        hi = isFirst ? color : glm::max(hi, color);
      }
    }
    least += lo / 4.0;
    most += hi / 4.0;
    return certified;
  }

  Renderer& renderer_;
  const Snapshot& snapshot_;
  DrawOptions options_;
  const std::function<bool()>& goesOn_;
  Trial& trial_;
  reference::Layers layers_;
  bool anyShader_ = false;  ///< of a material
  bool byPlace_ = false;    ///< points of a surface are judged by where they are
  ReferenceCaster caster_;
  std::vector<Vec3> mean_;
  std::vector<std::uint8_t> right_;
};

}  // namespace

double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Trial tryScene(Renderer& renderer, const Snapshot& snapshot, const TrialOptions& options) {
  Trial trial{.size = snapshot.view.size, .samples = options.samples};
  Samples samples(renderer, snapshot, options, trial);
  if (options.samples == 1) {
    samples.judge(Vec2(0), 1);
    return trial;
  }
  for (const Vec2& offset : samplePattern(4)) {
    samples.judge(offset, 0.25);
    if (!trial.complete) return trial;
  }
  Picture resolved;
  {
    const Stopwatch watch(trial.pictureSeconds);
    resolved = renderer.render(
        snapshot, {.shading = Shading::Exact, .audit = options.audit, .samples = 4, .skips = options.skips});
  }
  trial.complete &= options.goesOn();
  if (!trial.complete) return trial;
  const Stopwatch watch(trial.referenceSeconds);
  trial.wrongColors = samples.wrongColors(resolved.image);
  trial.silentlyWrong += Samples::beyond(trial.wrongColors, resolved.statistics.error);
  return trial;
}

}  // namespace luxo::random
