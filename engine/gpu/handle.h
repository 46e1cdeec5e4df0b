// SPDX-License-Identifier: Apache-2.0
// Owners of Vulkan objects: move-only, convertible to the raw handle, safe to drop while the device uses the
// object.
#pragma once

#include "gpu/context.h"
#include "gpu/object.h"
#include "gpu/vk.h"

#include <concepts>
#include <type_traits>
#include <utility>

namespace luxo::gpu {

/// Buffers and images are bound to memory, which must go right after them.
template <class T>
inline constexpr bool kHasMemory = std::same_as<T, VkBuffer> || std::same_as<T, VkImage>;

/// Owns one object of a context. Dropping it never waits: the object goes once every submission and every
/// open recording that could use it is complete, and objects go in the order they were dropped.
template <class T>
class Handle {
 public:
  Handle() = default;
  Handle(Context& context, T object) : context_(&context), object_(object) { count(context, 1); }
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept
      : context_(other.context_),
        object_(std::exchange(other.object_, T(VK_NULL_HANDLE))),
        memory_(std::exchange(other.memory_, {})) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      context_ = other.context_;
      object_ = std::exchange(other.object_, T(VK_NULL_HANDLE));
      memory_ = std::exchange(other.memory_, {});
    }
    return *this;
  }

  operator T() const noexcept { return object_; }
  explicit operator bool() const noexcept { return object_ != VK_NULL_HANDLE; }
  /// For the arrays that Vulkan takes by pointer.
  [[nodiscard]] const T* pointer() const noexcept { return &object_; }
  [[nodiscard]] Context* context() const noexcept { return context_; }

  /// Takes over the memory the object is bound to.
  void own(const Allocation& memory) noexcept requires kHasMemory<T> { memory_ = memory; }
  [[nodiscard]] const Allocation& memory() const noexcept requires kHasMemory<T> { return memory_; }

  void reset() noexcept {
    const T object = std::exchange(object_, T(VK_NULL_HANDLE));
    if (object == VK_NULL_HANDLE) return;
    context_->timeline().destruction().push(
        [&context = *context_, object, memory = std::exchange(memory_, {})]() noexcept {
          destroyObject(context.device(), object);
          if constexpr (kHasMemory<T>) context.memory().free(memory);
          count(context, -1);
        });
  }

 private:
  struct NoMemory {};

  static void count(Context& context, int change) noexcept {
    Counters& live = context.counted();
    live.objects += change;
    if constexpr (std::same_as<T, VkBuffer>) live.buffers += change;
    if constexpr (std::same_as<T, VkImage>) live.textures += change;
  }

  Context* context_ = nullptr;
  T object_ = VK_NULL_HANDLE;
  [[no_unique_address]] std::conditional_t<kHasMemory<T>, Allocation, NoMemory> memory_{};
};

}  // namespace luxo::gpu
