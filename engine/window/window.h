// SPDX-License-Identifier: Apache-2.0
// A window on the screen, its input as plain data, and what Vulkan needs to draw into it. Main thread only,
// but for wake().
//
// All positions and sizes are pixels of the framebuffer (not the window system's units, which differ on HiDPI
// screens): x right, y down from the top left of the window's inside.
#pragma once

#include "gpu/context.h"
#include "gpu/vk.h"
#include "math/vec.h"

#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

struct GLFWwindow;

namespace luxo::window {

/// A key is the character printed on it on this keyboard, letters in upper case, or one of these.
using Key = char;
namespace key {
inline constexpr Key kNone = 0, kLeft = 1, kRight = 2, kF11 = 3, kBackspace = 8, kEnter = 13, kEscape = 27,
                     kSpace = ' ';
}

struct KeyPress {
  Key key = window::key::kNone;
  bool shift = false;
  bool repeated = false;  ///< held down
};

/// A character was typed, after the key press that typed it.
struct Typed {
  char character = 0;  ///< printable, ASCII
};

/// The cursor moved with a button down, outside of grab areas.
struct Drag {
  Vec2 movedPx{0};
  bool pans = false;  ///< with the middle or right button, or the left one and Shift; else it turns
};

struct Scroll {
  double notches = 0;  ///< up is positive; touchpads send fractions
  Vec2 cursorPx{0};
};

/// A part of the window where the left button takes hold of something other than the camera.
struct GrabArea {
  int key = 0;  ///< whose it is
  Vec2 minPx{0}, maxPx{0};

  friend bool operator==(const GrabArea&, const GrabArea&) = default;
};

/// Where a grab area is held: once when the button goes down, then whenever the cursor moves, and once when
/// it is released.
struct Grab {
  int key = 0;
  double fraction = 0;    ///< 0 at the left side of the area, 1 at the right one, and no more beyond
  Vec2 cursorPx{0};       ///< in the window, and beyond
  bool pressed = false;   ///< the button just went down
  bool released = false;  ///< ... or up; or the window is no longer the one that is used
  bool types = false;     ///< with Ctrl: its value is to be typed. It is not held.
};

using Input = std::variant<KeyPress, Typed, Drag, Scroll, Grab>;

/// What happened since the last time.
struct Events {
  std::vector<Input> inputs;  ///< in order; what one drag moved in a row is one
  bool damaged = false;       ///< the window system lost (a part of) the picture: show it again
};

struct WindowDesc {
  std::string title = "luxo";
  VkExtent2D size{1280, 720};  ///< of the framebuffer, if the screen is large enough
};

/// There may be one at a time.
class Window {
 public:
  /// Throws Error(Device) when there is no window system, or none that Vulkan can draw to.
  explicit Window(const WindowDesc& desc);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// For ContextDesc; both are valid as long as the window.
  [[nodiscard]] std::vector<const char*> instanceExtensions() const;
  [[nodiscard]] gpu::CanPresent canPresent() const;
  /// The caller destroys it, before the window.
  [[nodiscard]] VkSurfaceKHR createSurface(VkInstance instance) const;

  /// Waits for input, at most that many seconds; not at all for 0.
  [[nodiscard]] Events wait(double seconds);
  /// Whether there is input that nobody has waited for yet, or the user wants the window gone. Does not wait.
  [[nodiscard]] bool asked();
  /// Ends the waiting, or the next one, at once. From any thread, while the window exists.
  void wake();

  /// Replaces the grab areas, of which the first ones are above the others. What is being held stays held.
  void setGrabAreas(std::vector<GrabArea> areas) { grabAreas_ = std::move(areas); }

  /// From the top left of the framebuffer, where it was seen last.
  [[nodiscard]] Vec2 cursorPx() const { return cursorPx_; }
  [[nodiscard]] VkExtent2D framebufferSize() const;  ///< 0x0 while there is nothing to be seen
  [[nodiscard]] double contentScale() const;         ///< 1 at about 96 dots per inch, 2 on a HiDPI screen
  [[nodiscard]] double refreshRate() const;          ///< of the screen it is on, Hz; 60 when unknown
  [[nodiscard]] bool closing() const;                ///< the user wants it gone

  /// To the whole of the screen it is on, and back to where it was.
  void toggleFullscreen();

 private:
  struct Terminate {
    Terminate();
    ~Terminate();
  };
  struct Placement {  // in the window system's units
    int x = 0, y = 0, width = 0, height = 0;
  };

  void listen();
  void onKey(int key, int scancode, int action, int modifiers);
  void onButton(int button, int action, int modifiers);
  void onCursor(Vec2 position);
  void hold(const GrabArea& area, bool pressed);
  void release();
  [[nodiscard]] Grab grabOf(const GrabArea& area) const;
  void drag(const Vec2& movedPx);
  [[nodiscard]] Vec2 pixelsPerUnit() const;

  Terminate glfw_;
  GLFWwindow* window_ = nullptr;
  Events events_;
  std::atomic<bool> woken_ = false;  ///< since wait() returned
  Vec2 cursorPx_{0};
  int dragButton_ = -1;  // -1 = none
  bool panning_ = false;
  std::vector<GrabArea> grabAreas_;
  std::optional<GrabArea> held_;
  Placement windowed_;  // where it was before it went full screen
};

}  // namespace luxo::window
