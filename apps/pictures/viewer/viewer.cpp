// SPDX-License-Identifier: Apache-2.0
#include "viewer.h"
#include "base/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "draw/measured_pixels.h"
#include "draw/scene_painter.h"
#include "exit_code.h"
#include "gpu/context.h"
#include "gpu/frame.h"
#include "process_tuning.h"
#include "scene/snapshot.h"
#include "surface/cloth_simulation.h"
#include "validation.h"
#include "viewer/controls.h"
#include "viewer/file_watch.h"
#include "viewer/frame_meter.h"
#include "viewer/notices.h"
#include "viewer/panels.h"
#include "viewer/photographer.h"
#include "viewer/picture_mouse.h"
#include "viewer/presets.h"
#include "viewer/probe.h"
#include "viewer/progressive_mean.h"
#include "viewer/sliders.h"
#include "viewer/viewed_moment.h"
#include "window/presenter.h"
#include "window/swapchain.h"
#include "window/window.h"

namespace luxo {
namespace {

using window::SwapchainStatus;
using Clock = std::chrono::steady_clock;

constexpr double kForever = 3600;             // seconds between two looks at a window that nothing happens to
constexpr double kWhileWorking = 0.02;        // ... that waits for a file, or for rays
constexpr double kRest = 1;                   // ... or longer, is time for what need not be done at once
constexpr std::chrono::seconds kTidying{10};  // ... which is done as often all the same
constexpr std::chrono::milliseconds kPatience{250};  // input waits so long for shells to be made
constexpr double kQuickTolerancePx = 4;              // of the mesh that is seen until there is more

VkExtent2D extentOf(PixelSize size) {
  return {static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height)};
}

PixelSize sizeOf(VkExtent2D extent) {
  return {static_cast<int>(extent.width), static_cast<int>(extent.height)};
}

gpu::ContextDesc contextDesc(const window::Window& window, const ViewerOptions& options,
                             std::shared_ptr<gpu::ValidationLog> log) {
  return {.device = options.device,
          .validation = options.validate,
          .validationLog = std::move(log),
          .instanceExtensions = window.instanceExtensions(),
          .canPresent = window.canPresent()};
}

class Viewer {
 public:
  Viewer(ViewedScene viewed, const ViewerOptions& options, std::shared_ptr<gpu::ValidationLog> log)
      : viewed_(std::move(viewed)),
        options_(options),
        window_({.title = options.title, .size = extentOf(viewed_.settings.size)}),
        context_(contextDesc(window_, options, std::move(log))),
        swapchain_(context_, window_),
        frames_(context_),
        painter_(context_),
        view_(context_, Precision::Half),
        presenter_(context_, swapchain_.format()),
        photographer_(context_),
        mean_(context_, frames_, painter_, view_),
        probe_(context_),
        controls_(viewed_, options, context_.supportedSamples(4) == VK_SAMPLE_COUNT_4_BIT, Clock::now()),
        moment_(viewed_, controls_),
        presets_(options.shader),
        watch_([this] { window_.wake(); }) {
    status_.title = options.title;
    status_.tellsPasses = !options.shader.empty();
    status_.device = context_.deviceInfo().name;
    painter_.setInterruption([this] { return Clock::now() >= patienceEnd_ && window_.asked(); });
    look();
    endClothWithWindow(viewed_.scene);
    if (options.problem) notices_.neverRead(inWords(*options.problem));
    files_ = options.files;
    watch_.watch(files_, options.begun);
  }

  void run() {
    try {
      while (!quit_ && !window_.closing()) {
        react(window_.wait(patience()));
        noticeVisibility();
        const bool shows = visible_ && Clock::now() >= nextFrame_;
        if (shows) showNext();
        // What is about to take a while has been said.
        if (shows || !visible_) takePhotos();
        noteRest();
        tidy();
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Retry || !window_.closing()) throw;
      log(LogLevel::Debug, error.what());
    }
    log(LogLevel::Debug,
        fmt::format("made {} pipelines, read the scene again {} times", pipelines_, readings_));
    log(LogLevel::Debug, fmt::format("quit after {} pictures, {} submits", pictures_, submits()));
  }

 private:
  [[nodiscard]] std::uint64_t submits() const { return context_.counters().submits; }
  [[nodiscard]] PixelSize size() const { return sizeOf(swapchain_.extent()); }

  // Seconds that may pass until something has to be done that no event tells of.
  [[nodiscard]] double patience() const {
    const auto until = [](Clock::time_point moment) {
      return std::max(0.0, std::chrono::duration<double>(moment - Clock::now()).count());
    };
    if (!visible_) return photographer_.secondsToRest().value_or(kForever);
    if (dirty_ || !wanted_.empty() || controls_.playback().playing()) return until(nextFrame_);
    double seconds = photographer_.busy() || mean_.casting() ? kWhileWorking : kForever;
    if (const auto end = notices_.end()) seconds = std::min(seconds, until(*end));
    return std::min(seconds, photographer_.secondsToRest().value_or(kForever));
  }

  // What is on the screen stays until something happens.
  void noteRest() {
    const bool rests = visible_ && !dirty_ && wanted_.empty() && !controls_.playback().playing() &&
                       !photographer_.busy() && !mean_.casting();
    if (!rests || submits() == restedSubmits_) return;
    restedSubmits_ = submits();
    log(LogLevel::Debug, fmt::format("rests after {} submits", restedSubmits_));
  }

  // Old pictures and other sizes of the window leave much behind. It goes when there is time, and now and
  // then while there is none.
  void tidy() {
    const bool due =
        submits() != tidiedSubmits_ && (patience() >= kRest || Clock::now() >= tidied_ + kTidying);
    if (!photographer_.rest() && !due) return;
    giveMemoryBack();
    tidied_ = Clock::now();
    tidiedSubmits_ = submits();
  }

  void noticeVisibility() {
    const bool visible = window_.framebufferSize().width > 0;
    if (visible != visible_)
      log(LogLevel::Debug, fmt::format("{} after {} submits", visible ? "seen again" : "hidden", submits()));
    visible_ = visible;
  }

  void react(const window::Events& events) {
    const auto now = Clock::now();
    const bool wasPlaying = controls_.playback().playing();
    for (const window::Input& input : events.inputs)
      std::visit([this](const auto& what) { obey(what); }, input);
    if (watch_.takeSaved()) readAgain();
    if (controls_.playback().playing() != wasPlaying)
      log(LogLevel::Debug, fmt::format("{} at {:.3f} s after {} submits", wasPlaying ? "paused" : "going on",
                                       controls_.playback().seconds(now), submits()));
    notices_.expire(now);
    if (const auto outcome = photographer_.poll()) tell(*outcome);
    damaged_ |= events.damaged;
    dirty_ = true;  // perhaps: showNext() finds out
  }

  void obey(const window::KeyPress& key) {
    if (sliders_.typing()) return type(key);
    switch (controls_.press(key, Clock::now())) {
      case Controls::Request::None:
        break;
      case Controls::Request::Quit:
        quit_ = true;
        break;
      case Controls::Request::Photo:
        if (pictures_ == 0) break;
        wanted_.push_back({refused_ ? shown_ : moment_.whole(size(), last()), photoOptions()});
        notices_.tellWhile({.text = "saving a picture"});
        break;
      case Controls::Request::Fullscreen:
        window_.toggleFullscreen();
        break;
      case Controls::Request::NoMultisampling:
        notices_.tell({.text = "this device has no 4 samples per pixel", .alert = true});
        break;
      case Controls::Request::ResetParameters:
        sliders_.reset(viewed_.scene);
        break;
    }
  }

  void type(const window::KeyPress& key) {
    try {
      if (sliders_.obey(key, viewed_.scene)) log(LogLevel::Debug, "a parameter is typed");
    } catch (const Error& error) {
      notices_.tell({.text = error.what(), .alert = true});
    }
  }

  void obey(const window::Typed& typed) { sliders_.obey(typed); }
  void obey(const window::Grab& grab) {
    try {
      if (const auto done = presets_.obey(grab, sliders_, viewed_.scene, viewed_.controls)) {
        notices_.tell({.text = *done});
        return;
      }
    } catch (const Error& error) {
      notices_.tell({.text = error.what(), .alert = true});
      return;
    }
    if (mouse_.obey(grab, size(), viewed_.scene)) return;
    const bool typed = sliders_.typing();
    if (sliders_.obey(grab, viewed_.scene)) log(LogLevel::Debug, "a parameter is turned");
    if (!typed && sliders_.typing()) log(LogLevel::Debug, "a value is being typed");
  }

  void obey(const window::Drag& drag) { move(drag); }
  void obey(const window::Scroll& scroll) { move(scroll); }
  void move(const auto& gesture) {
    if (size().height > 0)
      controls_.move(gesture, moment_.sceneCamera(size()), {moment_.seconds(), moment_.parameters()}, size());
  }

  void takePhotos() {
    try {
      for (const Photo& photo : std::exchange(wanted_, {})) photographer_.take(photo.snapshot, photo.options);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Scene) throw;
      notices_.tell({.text = error.what(), .alert = true});
    }
  }

  // A picture that has become smooth is saved as smooth, unless it is no longer to be.
  [[nodiscard]] DrawOptions photoOptions() const {
    DrawOptions options = refused_ ? *drawn_ : controls_.drawOptions();
    if (controls_.refines()) options.samples = std::max(options.samples, mean_.samples());
    return options;
  }

  void tell(const Photographer::Outcome& outcome) {
    notices_.tell(outcome.error ? Message{.text = outcome.error->what(), .alert = true}
                                : Message{.text = fmt::format("saved {}", outcome.file.string())});
  }

  // Whose steps take their time.
  void endClothWithWindow(const Scene& scene) {
    scene.clothSimulation()->setInterruption([this] { return window_.asked() && window_.closing(); });
  }

  // A file of the scene was saved. What cannot be read leaves everything as it is.
  void readAgain() {
    ++readings_;
    const FileWatch::Clock::time_point begun = FileWatch::Clock::now();
    ViewerOptions::Files files;
    try {
      ViewedScene next = options_.readAgain(files);
      endClothWithWindow(next.scene);
      const double seconds = controls_.playback().seconds(Clock::now());
      painter_.check(takeSnapshot(next.scene, seconds, next.settings.size, next.camera), optionsOfNext());
      controls_.adopt(viewed_, next, Clock::now());
      viewed_ = std::move(next);
      files_.clear();
      notices_.file({});
      look();
      log(LogLevel::Debug, "shows the scene as it was saved");
    } catch (const Error& error) {
      notices_.file(inWords(error));
    }
    // Of what has errors the files that it names, and those that were good.
    files_.insert(files_.end(), files.begin(), files.end());
    std::ranges::sort(files_);
    files_.erase(std::unique(files_.begin(), files_.end()), files_.end());
    watch_.watch(files_, begun);
  }

  // A scene comes into view.
  void look() {
    refused_.reset();
    probe_.forget();
    moment_.look();
    sliders_.adopt(viewed_.scene, viewed_.controls);
    mouse_.adopt(viewed_.scene, viewed_.mouse);
  }

  /// What differs from what is seen, and so has to be done.
  struct Turn {
    Clock::time_point start;
    Snapshot snapshot;
    DrawOptions draw;
    bool repaint = false;     ///< another picture, or more of the same
    bool stale = false;       ///< the window, or what panels say
    bool refines = false;     ///< nothing of both: the mean gets one more sample
    double milliseconds = 0;  ///< to find that out, and to record it
  };

  // One turn at the screen's rate: draws and shows what differs from what is seen, if anything.
  void showNext() {
    const Stopwatch watch;
    const auto start = Clock::now();
    nextFrame_ = std::max(nextFrame_ + period(), start);
    dirty_ = false;
    if (swapchain_.update(window_.framebufferSize()) == SwapchainStatus::Hidden) return;
    measurePictures();
    Turn turn = nextTurn(start);
    if (softens(turn) || !(turn.repaint || turn.refines || turn.stale)) return;
    turn.milliseconds = watch.milliseconds();
    if (turn.repaint) mean_.reset();
    // The mean is worth showing once it has as many samples as the picture before it.
    if (turn.refines && (!preparesMean() || !catchesUp())) return;
    const VkCommandBuffer commands = frames_.begin();
    if (swapchain_.acquire(frames_.slot()) != SwapchainStatus::Ready) {
      dirty_ = true;
      return;
    }
    const Stopwatch recording;
    drawTurn(commands, turn);
    const bool asksColor = controls_.probes() && probe_.record(commands, shownPicture(), pictureVersion_);
    turn.milliseconds += recording.milliseconds();
    const std::uint64_t submission = frames_.submit(swapchain_.waits(), swapchain_.signals());
    dirty_ |= swapchain_.present() == SwapchainStatus::Resized;
    if (asksColor) readProbe(submission);
    noteShown(turn, submission);
  }

  [[nodiscard]] Turn nextTurn(Clock::time_point start) {
    Turn turn{.start = start, .snapshot = moment_.next(size(), last()), .draw = optionsOfNext()};
    if (refused_ && (refused_->snapshot != turn.snapshot || refused_->options != turn.draw)) refused_.reset();
    if (refused_) {
      turn.snapshot = lastShown();
      turn.draw = *drawn_;
    }
    const bool coarser = mean_.begun() && !controls_.refines();
    turn.repaint = interrupted_ || !turn.draw.skips.unchanged || turn.draw != drawn_ ||
                   turn.snapshot != shown_ || coarser || lackedRoom_;
    // What is said is said at once: a sample may take its time.
    turn.stale =
        damaged_ || swapchain_.generation() != shownGeneration_ || (!turn.repaint && panels() != panels_);
    // What is not complete, or may turn out not to be, is not worth a mean.
    turn.refines = rests(turn) && controls_.refines() && !mean_.complete() && !refused_;
    return turn;
  }

  [[nodiscard]] bool rests(const Turn& turn) const {
    return !turn.repaint && !turn.stale && unmeasured_.empty();
  }

  // Soft shadows of what rests get more samples with the next turn.
  [[nodiscard]] bool softens(const Turn& turn) {
    if (!rests(turn) || !moment_.soften()) return false;
    log(LogLevel::Debug, fmt::format("softer, of {} points of a light at most", moment_.shadowSamples()));
    dirty_ = true;
    return true;
  }

  void drawTurn(VkCommandBuffer commands, Turn& turn) {
    if (turn.repaint)
      repaint(commands, turn);
    else if (turn.refines)
      mean_.join(commands);
    status_.samples = mean_.samples() > 0 ? mean_.samples() : turn.draw.samples;
    status_.audit = mean_.audit();
    status_.shading = drawn_->shading;
    status_.size = size();
    panels_ = panels();
    showPanels(commands);
    if (turn.repaint || turn.refines) ++pictureVersion_;
  }

  void repaint(VkCommandBuffer commands, Turn& turn) {
    patienceEnd_ = turn.start + kPatience;
    recordOrLast(commands, turn.snapshot, turn.draw);
    interrupted_ = painter_.interrupted();
    if (interrupted_) log(LogLevel::Debug, "interrupted while it made shells");
    status_.statistics.error.found = view_.searches();
    lackedRoom_ = false;
    pipelines_ += status_.statistics.count.pipelinesCreated;
    shown_ = std::move(turn.snapshot);
    drawn_ = turn.draw;
    ++pictures_;
  }

  void readProbe(std::uint64_t submission) {
    frames_.wait(submission);
    probe_.read();
    log(LogLevel::Debug, fmt::format("under the mouse: {}", probe_.text()));
    dirty_ = true;
  }

  void noteShown(const Turn& turn, std::uint64_t submission) {
    if (shownGeneration_ == 0) log(LogLevel::Debug, "shows the first picture");
    shownGeneration_ = swapchain_.generation();
    damaged_ = false;
    if (turn.repaint) {
      meter_.addFrame(turn.milliseconds, turn.start);
      noteMouse();
      unmeasured_.push_back(submission);
      dirty_ = true;  // how long it took will be known, and shown, and what it had no room for
    }
    dirty_ |= turn.stale;  // what it kept from being done is next
    if (!turn.refines) return;
    dirty_ |= !mean_.complete();
    if (mean_.complete()) tellSmooth();
  }

  void tellSmooth() const {
    const ProgressiveMean::Audit& audit = status_.audit;
    log(LogLevel::Debug, fmt::format("smooth after {} submits", submits()));
    log(LogLevel::Debug,
        fmt::format("audited {} px, {} wrong, {} by rays", audit.pixels, audit.wrong, audit.byRays));
  }

  // What turns out to be none once its shaders are joined with luxo's, or once all of it is listed, keeps the
  // last picture on the screen.
  void recordOrLast(VkCommandBuffer commands, Snapshot& snapshot, DrawOptions& draw) {
    status_.statistics = {};
    try {
      painter_.record(frames_, commands, view_, snapshot, draw, status_.statistics);
    } catch (const Error& error) {
      if (pictures_ == 0 || error.kind() != ErrorKind::Scene) throw;
      refuse(error, std::exchange(snapshot, lastShown()), std::exchange(draw, *drawn_));
      status_.statistics = {};
      painter_.record(frames_, commands, view_, snapshot, draw, status_.statistics);
    }
  }

  // A picture with one sample may ask for more than the one that is shown.
  [[nodiscard]] bool preparesMean() {
    try {
      const bool prepared = mean_.prepare(shown_, *drawn_);
      if (const std::string faults = faultsOfShaders(); !faults.empty()) noteFaults(faults);
      return prepared;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Scene) throw;
      refuse(error, shown_, *drawn_);
      return false;
    }
  }

  void refuse(const Error& error, Snapshot snapshot, const DrawOptions& options) {
    refused_ = {std::move(snapshot), options, inWords(error)};
    log(LogLevel::Debug, refused_->why);
    dirty_ = true;
  }

  // Of pictures that are complete: what their shaders must not do.
  [[nodiscard]] std::string faultsOfShaders() {
    if (context_.timeline().completed() < context_.timeline().submitted()) return notices_.shaders();
    try {
      refuseShaders(shown_, view_.shaderFaults());
      return {};
    } catch (const Error& error) {
      return inWords(error);
    }
  }

  void noteFaults(const std::string& faults) {
    if (faults == notices_.shaders()) return;
    notices_.shaders(faults);
    if (!faults.empty()) log(LogLevel::Debug, faults);
    dirty_ = true;
  }

  void noteMouse() {
    if (!mouse_.isRead()) return;
    log(LogLevel::Debug, fmt::format("iMouse {}", fmt::join(mouse_.numbers(), ",")));
    dirty_ |= mouse_.wasDrawn(viewed_.scene);
  }

  // Nothing stays black while it waits for rays; and the first picture is one of coarse meshes, while shells
  // and shaders of an exact one may take seconds to make.
  [[nodiscard]] DrawOptions optionsOfNext() const {
    DrawOptions options = controls_.drawOptions();
    options.standIns = true;
    if (pictures_ > 0 || options.shading != Shading::Exact) return options;
    options.shading = Shading::Phong;
    options.tolerancePx = std::max(options.tolerancePx, kQuickTolerancePx);
    return options;
  }

  // Where the mean lacks more samples than this one, that joins it unseen.
  [[nodiscard]] bool catchesUp() {
    if (mean_.samples() + 1 >= drawn_->samples) return true;
    mean_.join(frames_.begin());
    frames_.submit();
    dirty_ = true;
    return false;
  }

  [[nodiscard]] Snapshot lastShown() const { return resized(shown_, size()); }
  [[nodiscard]] const Snapshot* last() const { return pictures_ > 0 ? &shown_ : nullptr; }

  [[nodiscard]] gpu::Texture& shownPicture() {
    return mean_.samples() > 0 ? mean_.picture() : view_.picture();
  }

  void showPanels(VkCommandBuffer commands) {
    frames_.mark("window");
    std::vector<window::GrabArea> areas =
        presenter_.record(frames_, commands, shownPicture(), swapchain_, window_.contentScale(), panels_);
    if (mouse_.isRead()) areas.push_back({PictureMouse::kKey, Vec2(0), Vec2(size().width, size().height)});
    if (areas == areas_) return;
    for (const window::GrabArea& area : areas)
      log(LogLevel::Debug, fmt::format("grab {} from {},{} to {},{}", area.key, area.minPx.x, area.minPx.y,
                                       area.maxPx.x, area.maxPx.y));
    areas_ = areas;
    window_.setGrabAreas(std::move(areas));
  }

  [[nodiscard]] Clock::duration period() const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1 / window_.refreshRate()));
  }

  // Of pictures that are complete by now: how long they took, and whether the last one had room for what is
  // seen through.
  void measurePictures() {
    if (unmeasured_.empty()) return;
    while (!unmeasured_.empty() && unmeasured_.front() <= context_.timeline().completed()) {
      const auto milliseconds = frames_.milliseconds(unmeasured_.front());
      if (milliseconds) meter_.addDevice(*milliseconds, frames_.parts(unmeasured_.front()));
      unmeasured_.pop_front();
    }
    if (unmeasured_.empty()) {
      lackedRoom_ = view_.makeRoom();
      noteFaults(faultsOfShaders());
    }
    dirty_ |= lackedRoom_ || !unmeasured_.empty();
  }

  [[nodiscard]] std::vector<window::Panel> panels() {
    std::vector<window::Panel> panels;
    const double scale = window_.contentScale();
    status_.seconds = moment_.seconds();
    status_.reading = meter_.read(controls_.playback().playing(), Clock::now());
    if (controls_.showsNumbers()) panels.push_back(numbersPanel(status_, controls_));
    if (controls_.showsSliders())
      if (auto sliders = sliders_.panel(viewed_.scene, moment_.parameters())) {
        presets_.addRows(*sliders);
        panels.push_back(std::move(*sliders));
      }
    if (controls_.probes() && pictures_ > 0) {
      probe_.look(viewed_.scene, shown_, window_.cursorPx());
      if (auto told = probe_.panel()) panels.push_back(std::move(*told));
    }
    if (controls_.showsKeys()) panels.push_back(keysPanel());
    notices_.addPanels(panels, moment_.impossible(), refused_ ? refused_->why : "", size(), scale);
    return panels;
  }

  ViewedScene viewed_;
  const ViewerOptions& options_;
  // Destroyed from the last to the first.
  window::Window window_;
  gpu::Context context_;
  window::Swapchain swapchain_;
  gpu::FrameRing frames_;
  ScenePainter painter_;
  RenderView view_;
  window::Presenter presenter_;
  Photographer photographer_;
  ProgressiveMean mean_;  // is seen, while nothing moves, instead of the painter's picture
  Probe probe_;

  Controls controls_;
  ViewedMoment moment_;
  Sliders sliders_;
  Presets presets_;
  PictureMouse mouse_;
  struct Refused {
    Snapshot snapshot;
    DrawOptions options;
    std::string why;
  };
  std::optional<Refused> refused_;  // what could not be drawn, as long as it is what there is to draw
  struct Photo {
    Snapshot snapshot;
    DrawOptions options;
  };
  std::vector<Photo> wanted_;  // pictures to save, once that has been said
  Notices notices_;
  FrameMeter meter_;
  Status status_;
  bool quit_ = false;
  bool visible_ = true;
  bool dirty_ = true;     // something may differ from what is shown
  bool damaged_ = false;  // the window system asks for the picture again
  Clock::time_point nextFrame_;
  Clock::time_point tidied_ = Clock::now();
  std::uint64_t restedSubmits_ = 0;  ///< when it was told last that nothing is left to do
  std::uint64_t tidiedSubmits_ = 0;
  std::uint64_t pictureVersion_ = 0;  // of what is shown, for the probe
  std::uint64_t pictures_ = 0, readings_ = 0, pipelines_ = 0;
  std::deque<std::uint64_t> unmeasured_;  // submissions whose time is still to come
  bool lackedRoom_ = false;               // the last picture lacks some of what is seen through
  bool interrupted_ = false;              // ... or shells that input kept from being made
  Clock::time_point patienceEnd_;         // from here on input does so

  Snapshot shown_;
  std::optional<DrawOptions> drawn_;
  std::vector<window::Panel> panels_;
  std::vector<window::GrabArea> areas_;
  std::uint64_t shownGeneration_ = 0;

  ViewerOptions::Files files_;
  FileWatch watch_;  // ends before what it wakes
};

}  // namespace

int runViewer(ViewedScene viewed, const ViewerOptions& options) {
  const auto validation = std::make_shared<gpu::ValidationLog>();
  Viewer(std::move(viewed), options, validation).run();
  requireNoMessage(*validation);
  return exit_code::kDone;
}

}  // namespace luxo
