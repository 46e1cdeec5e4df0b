// SPDX-License-Identifier: Apache-2.0
#include "window/window.h"

#include "base/error.h"
#include "gpu/result.h"

// After gpu/vk.h, so that GLFW declares its Vulkan functions.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace luxo::window {
namespace {

constexpr double kDefaultRefreshRate = 60;
constexpr int kSmallestSide = 64;  // of the window that is asked for; users may make it smaller

std::string lastError() {
  const char* text = nullptr;
  return glfwGetError(&text) != GLFW_NO_ERROR && text != nullptr ? text : "no reason given";
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

[[noreturn]] void throwNoWindowSystem() {
  const std::string problem =
      isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")
          ? fmt::format("cannot open a window on display {}: {}",
                        isSet("DISPLAY") ? std::getenv("DISPLAY") : std::getenv("WAYLAND_DISPLAY"),
                        lastError())
          : "cannot open a window: DISPLAY is not set, so there is no screen to use";
  throw Error(ErrorKind::Device, problem, "use -o FILE to render without a window");
}

// The screen that shows most of the window: GLFW tells it only for full-screen windows.
GLFWmonitor* monitorOf(GLFWwindow* window) {
  if (GLFWmonitor* monitor = glfwGetWindowMonitor(window)) return monitor;
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  GLFWmonitor* best = nullptr;
  long bestArea = -1;
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    if (mode == nullptr) continue;
    const long overlapX = std::max(0, std::min(x + width, left + mode->width) - std::max(x, left));
    const long overlapY = std::max(0, std::min(y + height, top + mode->height) - std::max(y, top));
    if (overlapX * overlapY > bestArea) {
      bestArea = overlapX * overlapY;
      best = monitors[i];
    }
  }
  return best;
}

Key keyOf(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_LEFT:
      return key::kLeft;
    case GLFW_KEY_RIGHT:
      return key::kRight;
    case GLFW_KEY_F11:
      return key::kF11;
    case GLFW_KEY_ESCAPE:
      return key::kEscape;
    case GLFW_KEY_SPACE:
      return key::kSpace;
    case GLFW_KEY_BACKSPACE:
      return key::kBackspace;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return key::kEnter;
    default:
      break;
  }
  // Digits by their place, since some layouts want Shift for them; letters by what is printed on the key,
  // unless that is no Latin letter.
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return static_cast<Key>('0' + (key - GLFW_KEY_0));
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return static_cast<Key>('0' + (key - GLFW_KEY_KP_0));
  const char* name = glfwGetKeyName(key, scancode);
  if (name != nullptr && std::strlen(name) == 1 && std::isalpha(static_cast<unsigned char>(*name))) {
    return static_cast<Key>(std::toupper(static_cast<unsigned char>(*name)));
  }
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return static_cast<Key>('A' + (key - GLFW_KEY_A));
  return key::kNone;
}

Window& self(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Window::Terminate::Terminate() {
  if (glfwInit() != GLFW_TRUE) throwNoWindowSystem();
}

Window::Terminate::~Terminate() { glfwTerminate(); }

Window::Window(const WindowDesc& desc) {
  if (glfwVulkanSupported() != GLFW_TRUE) {
    throw Error(ErrorKind::Device, "cannot open a window: no Vulkan driver can draw to this window system",
                "apt install mesa-vulkan-drivers, or use -o FILE to render without a window");
  }
  int width = std::max(static_cast<int>(desc.size.width), kSmallestSide);
  int height = std::max(static_cast<int>(desc.size.height), kSmallestSide);
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, areaWidth = 0, areaHeight = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &areaWidth, &areaHeight);
    if (areaWidth > 0 && areaHeight > 0) {
      width = std::min(width, areaWidth);
      height = std::min(height, areaHeight);
    }
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "luxo");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "luxo");
  window_ = glfwCreateWindow(width, height, desc.title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) throwNoWindowSystem();
  // Where a unit of the window system is more than a pixel, the framebuffer came out larger than asked for.
  const Vec2 scale = pixelsPerUnit();
  if (scale != Vec2(1)) {
    glfwSetWindowSize(window_, static_cast<int>(width / scale.x), static_cast<int>(height / scale.y));
  }
  listen();
}

Window::~Window() { glfwDestroyWindow(window_); }

void Window::listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
    self(window).onKey(key, scancode, action, modifiers);
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int codepoint) {
    if (codepoint >= ' ' && codepoint <= '~')
      self(window).events_.inputs.emplace_back(Typed{static_cast<char>(codepoint)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
    self(window).onButton(button, action, modifiers);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    self(window).onCursor({x, y});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double y) {
    self(window).events_.inputs.emplace_back(Scroll{.notches = y, .cursorPx = self(window).cursorPx_});
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { self(window).events_.damaged = true; });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
    if (focused == GLFW_TRUE) return;
    self(window).release();
  });
}

std::vector<const char*> Window::instanceExtensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) {
    throw Error(ErrorKind::Device, fmt::format("cannot draw into a window with Vulkan: {}", lastError()),
                "use -o FILE to render without a window");
  }
  return {names, names + count};
}

gpu::CanPresent Window::canPresent() const {
  return [](VkInstance instance, VkPhysicalDevice device, std::uint32_t family) {
    return glfwGetPhysicalDevicePresentationSupport(instance, device, family) == GLFW_TRUE;
  };
}

VkSurfaceKHR Window::createSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  gpu::check(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "draw into the window");
  return surface;
}

Events Window::wait(double seconds) {
  // What asked() has taken from the window system is not waited for: that knows of it no more.
  const bool isKnown = woken_.exchange(false) || !events_.inputs.empty() || events_.damaged;
  if (seconds > 0 && !isKnown) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  return std::exchange(events_, {});
}

bool Window::asked() {
  glfwPollEvents();
  return !events_.inputs.empty() || closing();
}

void Window::wake() {
  woken_ = true;
  glfwPostEmptyEvent();
}

VkExtent2D Window::framebufferSize() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return {0, 0};
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (width <= 0 || height <= 0) return {0, 0};
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

double Window::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp<double>(std::max(x, y), 0.5, 8);
}

double Window::refreshRate() const {
  GLFWmonitor* monitor = monitorOf(window_);
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  return mode != nullptr && mode->refreshRate > 0 ? mode->refreshRate : kDefaultRefreshRate;
}

bool Window::closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::toggleFullscreen() {
  if (glfwGetWindowMonitor(window_) != nullptr) {
    glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.width, windowed_.height, 0);
    return;
  }
  GLFWmonitor* monitor = monitorOf(window_);
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(window_, &windowed_.x, &windowed_.y);
  glfwGetWindowSize(window_, &windowed_.width, &windowed_.height);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::onKey(int key, int scancode, int action, int modifiers) {
  if (action == GLFW_RELEASE) return;
  const Key meant = keyOf(key, scancode);
  constexpr int kCommands = GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;  // the window manager's
  if (meant == key::kNone || (modifiers & kCommands) != 0) return;
  events_.inputs.emplace_back(
      KeyPress{.key = meant, .shift = (modifiers & GLFW_MOD_SHIFT) != 0, .repeated = action == GLFW_REPEAT});
}

void Window::onButton(int button, int action, int modifiers) {
  if (action == GLFW_PRESS && dragButton_ == -1 && button <= GLFW_MOUSE_BUTTON_MIDDLE) {
    dragButton_ = button;
    panning_ = button != GLFW_MOUSE_BUTTON_LEFT || (modifiers & GLFW_MOD_SHIFT) != 0;
    const auto area = std::ranges::find_if(grabAreas_, [&](const GrabArea& a) {
      return cursorPx_.x >= a.minPx.x && cursorPx_.y >= a.minPx.y && cursorPx_.x < a.maxPx.x &&
             cursorPx_.y < a.maxPx.y;
    });
    if (button != GLFW_MOUSE_BUTTON_LEFT || area == grabAreas_.end()) return;
    if ((modifiers & GLFW_MOD_CONTROL) != 0) {
      dragButton_ = -1;
      Grab grab = grabOf(*area);
      grab.pressed = grab.types = true;
      events_.inputs.emplace_back(grab);
      return;
    }
    held_ = *area;
    hold(*area, true);
  } else if (action == GLFW_RELEASE && button == dragButton_) {
    release();
  }
}

void Window::release() {
  dragButton_ = -1;
  if (!held_) return;
  Grab grab = grabOf(*held_);
  grab.released = true;
  events_.inputs.emplace_back(grab);
  held_.reset();
}

Grab Window::grabOf(const GrabArea& area) const {
  const double width = std::max(area.maxPx.x - area.minPx.x, 1.0);
  return {.key = area.key,
          .fraction = std::clamp((cursorPx_.x - area.minPx.x) / width, 0.0, 1.0),
          .cursorPx = cursorPx_};
}

void Window::hold(const GrabArea& area, bool pressed) {
  Grab grab = grabOf(area);
  grab.pressed = pressed;
  events_.inputs.emplace_back(grab);
}

void Window::drag(const Vec2& movedPx) {
  std::vector<Input>& inputs = events_.inputs;
  if (Drag* last = inputs.empty() ? nullptr : std::get_if<Drag>(&inputs.back());
      last && last->pans == panning_) {
    last->movedPx += movedPx;
  } else {
    inputs.emplace_back(Drag{.movedPx = movedPx, .pans = panning_});
  }
}

void Window::onCursor(Vec2 position) {
  const Vec2 cursorPx = position * pixelsPerUnit();
  const Vec2 moved = cursorPx - cursorPx_;
  cursorPx_ = cursorPx;
  if (held_) {
    hold(*held_, false);
  } else if (dragButton_ != -1 && moved != Vec2(0)) {
    drag(moved);
  }
}

Vec2 Window::pixelsPerUnit() const {
  int width = 0, height = 0, pixelsX = 0, pixelsY = 0;
  glfwGetWindowSize(window_, &width, &height);
  glfwGetFramebufferSize(window_, &pixelsX, &pixelsY);
  if (width <= 0 || height <= 0 || pixelsX <= 0 || pixelsY <= 0) return Vec2(1);
  return {static_cast<double>(pixelsX) / width, static_cast<double>(pixelsY) / height};
}

}  // namespace luxo::window
