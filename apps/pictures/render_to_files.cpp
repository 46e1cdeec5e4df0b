// SPDX-License-Identifier: Apache-2.0
#include "render_to_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <future>
#include <memory>
#include <utility>

#include "background.h"
#include "base/error.h"
#include "base/stopwatch.h"
#include "console.h"
#include "depth_picture.h"
#include "draw/accumulation.h"
#include "exit_code.h"
#include "frame_names.h"
#include "image/format.h"
#include "interruption.h"
#include "output_files.h"
#include "picture_engine.h"
#include "process_tuning.h"
#include "report.h"
#include "required_error.h"
#include "scene/fitted_camera.h"
#include "scene/light_view.h"
#include "scene_request.h"
#include "validation.h"

namespace luxo {
namespace {

struct Job {
  int frame;
  double time;
  std::filesystem::path file;
  std::optional<double> sweptValue = std::nullopt;
};

std::vector<Job> jobsOf(const RenderRequest& request, const RenderSettings& settings) {
  const std::size_t count = request.sweep ? request.sweep->values.size() : request.frames.size();
  const FrameNames names(request.output, count > 1);
  std::vector<Job> jobs;
  for (const int frame : request.frames) jobs.push_back({frame, (frame - 1) / settings.fps, names.of(frame)});
  for (std::size_t i = 0; request.sweep && i < count; ++i) {
    const int frame = static_cast<int>(i) + 1;
    jobs.push_back({frame, settings.time, names.of(frame), request.sweep->values[i]});
  }
  if (jobs.empty()) jobs.push_back({1, settings.time, names.of(1)});
  if (names.numberAdded() && request.verbosity != Verbosity::Quiet)
    printNote(fmt::format("several frames: writing {} and so on", jobs.front().file.string()));
  return jobs;
}

/// Before anything is drawn: no file is lost, and each can be written. Of a sequence, whose names differ in
/// their numbers, the first stands for all when it is about the folder.
void requireOutputsOf(const std::vector<Job>& jobs, const RenderRequest& request,
                      std::span<const NamedFile> inputs) {
  const NamedFile report{"--report", request.report && *request.report != "-" ? *request.report : ""};
  requireOutputs(std::vector{NamedFile{"-o", jobs.front().file}, report}, inputs);
  std::vector<NamedFile> others(inputs.begin(), inputs.end());
  others.push_back({"the report", report.path});
  for (std::size_t i = 1; i < jobs.size(); ++i)
    for (const NamedFile& other : others)
      if (!other.path.empty() && sameFile(jobs[i].file, other.path))
        throw Error(ErrorKind::Usage,
                    fmt::format("-o '{}' would overwrite {}", jobs[i].file.string(), other.what),
                    "choose another name");
}

/// Each stage's own time.
std::string stagesOf(const FrameTimes& ms) {
  const std::pair<const char*, double> stages[] = {
      {"animate", ms.animate}, {"cull", ms.cull},     {"tessellate", ms.tessellate},
      {"upload", ms.upload},   {"gpu", ms.gpu},       {"rays", ms.rays},
      {"cells", ms.rayTrees},  {"read", ms.readback}, {"encode", ms.encode}};
  std::string text;
  for (const auto& [name, milliseconds] : stages)
    if (milliseconds >= 0.05)
      text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", name, milliseconds);
  return text;
}

/// Encodes and writes; runs beside the drawing of the next frame. Gives the milliseconds it took.
double encodeToFile(const Image& image, const std::filesystem::path& file) {
  const Stopwatch watch;
  saveImage(image, file);
  return watch.milliseconds();
}

class Run {
 public:
  Run(Scene scene, const RenderRequest& request, std::span<const NamedFile> inputs)
      : scene_(std::move(scene)),
        request_(request),
        inputs_(inputs),
        settings_(settingsOf(scene_, request)),
        sampleOffset_(sampleOffsetOf(settings_, request)) {
    if (sampleOffset_) settings_.samples = 1;
  }

  int toExitCode() {
    if (request_.sweep) swept_ = sweptParameter(scene_, *request_.sweep);
    const CameraId camera = cameraOf(scene_, request_);
    light_ = lightOf(scene_, request_);
    const std::vector<Job> jobs = jobsOf(request_, settings_);
    requireOutputsOf(jobs, request_, inputs_);
    warnAboutClampedValues();

    const auto validation = std::make_shared<gpu::ValidationLog>();
    {
      const std::unique_ptr<PictureEngine> engine = request_.engine == Engine::Reference
                                                        ? referenceEngine(request_, settings_)
                                                        : vulkanEngine(request_, settings_, validation);
      report_.device = engine->device();
      report_.scene = request_.scene;
      report_.size = settings_.size;
      report_.startupMs = processMilliseconds();
      for (const Job& job : jobs) {
        if (interruptingSignal() != 0) break;
        draw(*engine, job, camera, jobs.size() > 1);
        if (jobs.size() > 1 && interruptingSignal() == 0) showProgress(jobs.size());
      }
      finishPending();
    }
    if (request_.report) writeReport(report_, *request_.report);
    if (const int signal = interruptingSignal(); signal != 0) return exit_code::kSignal + signal;
    requireNoMessage(*validation);
    requireError();
    if (failed_ == 0) return exit_code::kDone;
    return failed_ == jobs.size() ? exitCodeOf(lastFailure_) : exit_code::kSomeFramesFailed;
  }

 private:
  /// A frame whose file is being written.
  struct Pending {
    std::size_t index;  ///< in the report
    std::future<double> encoded;
  };

  void draw(PictureEngine& engine, const Job& job, CameraId camera, bool oneOfMany) {
    report_.frames.push_back({.frame = job.frame,
                              .time = job.time,
                              .file = job.file,
                              .parameters = {},
                              .cutNumbers = 0,
                              .approximateShadows = 0,
                              .statistics = {},
                              .reference = {},
                              .error = {}});
    const std::size_t index = report_.frames.size() - 1;
    oneOfMany_ = oneOfMany;
    attempt(index, [&] {
      const Stopwatch watch;
      if (job.sweptValue) scene_.setParameter(swept_, *job.sweptValue);
      const std::vector<double> values = scene_.parametersAt(job.time);
      for (std::size_t i = 0; i < values.size(); ++i)
        report_.frames[index].parameters.emplace_back(scene_.parameters()[i].name, values[i]);
      Snapshot snapshot = takeSnapshot(scene_, job.time, settings_.size, cameraAt(camera));
      if (request_.fromLight)
        snapshot =
            seenFromLight(std::move(snapshot),
                          request_.size ? std::optional(std::min(settings_.size.width, settings_.size.height))
                                        : std::nullopt,
                          light_);
      if (sampleOffset_) snapshot.view = sampledAt(snapshot.view, *sampleOffset_);
      report_.frames[index].cutNumbers = snapshot.cutNumbers;
      if (request_.aov == Output::Color)
        report_.frames[index].approximateShadows = approximateShadowsOf(snapshot);
      const double animate = watch.milliseconds();
      std::optional<MadePicture> picture = engine.make(snapshot);
      if (!picture) return report_.frames.pop_back();
      if (index == 0) tellOfNoLight(snapshot);
      if (index == 0) tellOfNoOcclusion(snapshot);
      picture->statistics.ms.animate = animate;
      picture->statistics.ms.total += animate;
      report_.frames[index].statistics = picture->statistics;
      report_.frames[index].reference = picture->reference;
      finishPending();
      if (showsGreyDepths()) picture->image = greyDepths(std::move(picture->image), job.file);
      pending_ = Pending{index, inBackground([image = std::move(picture->image), file = job.file] {
                           return encodeToFile(image, file);
                         })};
    });
  }

  /// The one that is asked for, or the scene's; where it has none one that is fitted to it at its default
  /// time, and to each value that is swept over.
  const Camera& cameraAt(CameraId camera) {
    if (camera.valid()) return scene_[camera];
    if (!scene_.cameras().empty()) return scene_.cameras().front();
    if (!fitted_ || swept_.valid())
      fitted_ =
          fitCamera(takeSnapshot(scene_, scene_.settings().time, settings_.size, Camera{}), settings_.size);
    return *fitted_;
  }

  [[nodiscard]] bool showsGreyDepths() const {
    return request_.fromLight && storesSrgb8(requireImageFormat(request_.output));
  }

  /// By the depths of the first picture that has any, so that in a sequence what stands still keeps its grey;
  /// says which these are.
  [[nodiscard]] Image greyDepths(Image depths, const std::filesystem::path& file) {
    if (!greys_) {
      greys_ = depthsIn(depths);
      if (request_.verbosity != Verbosity::Quiet)
        printNote(
            greys_ ? fmt::format("{}: depths from {:.6g} m (white) to {:.6g} m (dark grey); black: nothing "
                                 "that casts a shadow; write .exr or .pfm for metres",
                                 file.string(), greys_->lo, greys_->hi)
                   : fmt::format("{}: black, as the light sees nothing that casts a shadow", file.string()));
    }
    return luxo::greyDepths(std::move(depths), greys_.value_or(Interval{0, 0}));
  }

  void tellOfNoOcclusion(const Snapshot& snapshot) const {
    const auto isLeftOut = [&](const SnapshotNode& node) {
      const Shading shading = snapshot.materials[node.material.index].shadingIn(settings_.shading);
      return shading == Shading::Gouraud || shading == Shading::Toon || shading == Shading::Wireframe;
    };
    if (snapshot.ambientOcclusion.any() && !showsData(settings_.shading) && request_.aov == Output::Color &&
        request_.verbosity != Verbosity::Quiet && std::ranges::any_of(snapshot.nodes, isLeftOut))
      printWarning(
          "ambient occlusion is of exact, Phong and flat shading: what is drawn in another one gets all "
          "ambient light, and keeps it from nothing");
  }

  void tellOfNoLight(const Snapshot& snapshot) const {
    if (snapshot.lights.empty() && !showsData(settings_.shading) && request_.aov == Output::Color &&
        request_.verbosity != Verbosity::Quiet)
      printNote("the scene has no light: all there is to see is its ambient light");
  }

  void finishPending() {
    if (!pending_) return;
    Pending pending = std::move(*pending_);
    pending_.reset();
    attempt(pending.index, [&] {
      FrameReport& frame = report_.frames[pending.index];
      frame.statistics.ms.encode = pending.encoded.get();
      frame.statistics.ms.total += frame.statistics.ms.encode;
      announce(frame);
    });
  }

  /// Of several frames a bad scene moment or a file that cannot be written spoils only its own.
  template <class F>
  void attempt(std::size_t index, const F& work) {
    try {
      work();
    } catch (const Error& error) {
      const bool ownToTheFrame = error.kind() == ErrorKind::Scene || error.kind() == ErrorKind::Write;
      if (!oneOfMany_ || !ownToTheFrame) throw;
      ++failed_;
      lastFailure_ = error.kind();
      report_.frames[index].error = error.what();
      printError(Error(error.kind(), fmt::format("frame {}: {}", report_.frames[index].frame, error.what()),
                       error.hint()));
    }
  }

  /// The reference casts the exact ones that maps estimate.
  [[nodiscard]] std::uint64_t approximateShadowsOf(const Snapshot& snapshot) const {
    return request_.engine == Engine::Reference ? approximateShadows(withoutShadowMaps(snapshot))
                                                : approximateShadows(snapshot);
  }

  void announce(const FrameReport& frame) const {
    if (request_.verbosity == Verbosity::Quiet || (oneOfMany_ && request_.verbosity != Verbosity::Verbose))
      return;
    // Of one picture all that its user has waited for; of several what each has taken.
    const double milliseconds = oneOfMany_ ? frame.statistics.ms.total : processMilliseconds();
    printNote(fmt::format("{}  {}x{}  {:.0f} ms  {}  on {}", frame.file.string(), settings_.size.width,
                          settings_.size.height, milliseconds, qualityOf(frame), report_.device.name));
    if (request_.verbosity == Verbosity::Verbose)
      printNote(fmt::format("  ms: {}{}",
                            oneOfMany_ ? "" : fmt::format("startup {:.1f}, ", report_.startupMs),
                            stagesOf(frame.statistics.ms)));
    if (frame.approximateShadows > 0)
      printNote(fmt::format(
          "{} not exact, nor certified: luxo verify says what is wrong",
          frame.approximateShadows == 1 ? "the shadow of a light is" : "the shadows of some lights are"));
    if (frame.cutNumbers > 0)
      printNote(
          fmt::format("{} colours or lights are above their range at time {}, and are cut off at its end",
                      frame.cutNumbers, frame.time));
    const FrameError& error = frame.statistics.error;
    if (!frame.reference && error.boundPx > error.tolerancePx && std::isfinite(error.boundPx))
      printNote(
          fmt::format("the proven error is more than the {:.3g} px asked for: a surface bends too much for "
                      "the most triangles "
                      "it may have, or is kinked or cut off; look at `luxo inspect`",
                      error.tolerancePx));
    if (const std::uint64_t nodes = frame.statistics.count.tooLarge; nodes > 0)
      printNote(fmt::format("{} too large for a shader: the processor finds {} points by rays",
                            nodes == 1 ? "a formula is" : fmt::format("the formulas of {} nodes are", nodes),
                            nodes == 1 ? "its" : "their"));
    if (error.unconvergedPx > 0)
      printNote(unconvergedText(error.unconvergedPx));
  }

  [[nodiscard]] static std::string qualityOf(const FrameReport& frame) {
    if (const auto& reference = frame.reference)
      return fmt::format("{} of {} pixels undecided, standard error {:.2g}", reference->undecided,
                         reference->hits + reference->misses + reference->undecided,
                         reference->standardErrorRms);
    const FrameError& error = frame.statistics.error;
    std::string quality = fmt::format("{} triangles", frame.statistics.count.triangles);
    if (error.residualMaxPx) quality += fmt::format("  residual {:.2g} px", *error.residualMaxPx);
    if (!error.residualMaxPx || error.boundPx > 0) quality += fmt::format("  bound {:.2g} px", error.boundPx);
    return quality;
  }

  /// A line in place on a terminal; elsewhere one every five seconds.
  void showProgress(std::size_t total) {
    if (request_.verbosity != Verbosity::Normal) return;
    const bool onTerminal = isatty(STDERR_FILENO) == 1;
    if (!onTerminal && told_.seconds() < 5) return;
    told_ = {};
    const std::size_t done = report_.frames.size();
    const double left = (processMilliseconds() - report_.startupMs) / 1e3 / static_cast<double>(done) *
                        static_cast<double>(total - done);
    fmt::print(stderr, "{}frame {} of {}, {:.0f} s left {}", onTerminal ? "\r" : "", done, total, left,
               !onTerminal     ? "\n"
               : done == total ? "\x1b[K\n"
                               : "\x1b[K");
  }

  void warnAboutClampedValues() const {
    if (request_.aov != Output::Color && !request_.fromLight &&
        storesSrgb8(requireImageFormat(request_.output)) && request_.verbosity != Verbosity::Quiet)
      printNote(
          "8-bit files clamp values to 0..1; write .exr or .pfm for numbers, or use --shading for a view");
  }

  void requireError() const {
    if (!request_.requireErrorPx) return;
    for (const FrameReport& frame : report_.frames) {
      if (frame.error) continue;
      if (const auto miss = requirementMiss(frame, *request_.requireErrorPx))
        throw Error(ErrorKind::Requirement, fmt::format("frame {}: {}", frame.frame, miss->what), miss->hint);
    }
  }

  Scene scene_;
  const RenderRequest& request_;
  std::span<const NamedFile> inputs_;
  RenderSettings settings_;
  std::optional<Vec2> sampleOffset_;  ///< of the one sample that is drawn
  Stopwatch told_;                    ///< of progress
  ParameterId swept_;
  NodeId light_;                   ///< whose depths are shown; none: the first's
  std::optional<Camera> fitted_;   ///< to a scene without a camera
  std::optional<Interval> greys_;  ///< depths of a light that greys are of
  RunReport report_;
  std::optional<Pending> pending_;
  bool oneOfMany_ = false;
  std::size_t failed_ = 0;
  ErrorKind lastFailure_ = ErrorKind::Internal;
};

}  // namespace

int renderToFiles(Scene scene, const RenderRequest& request, std::span<const NamedFile> inputs) {
  showLog(request.verbosity);
  rememberInterruptions();
  moveByDevice(scene, request.device);
  return Run(std::move(scene), request, inputs).toExitCode();
}

}  // namespace luxo
