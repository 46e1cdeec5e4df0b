// SPDX-License-Identifier: Apache-2.0
// Compilers follow what they read by recursion: as deep as shaders of others are nested.
#pragma once

#include <cstddef>
#include <functional>

namespace luxo::gpu {

/// 2 MiB are enough for all that scene/shader_macros.h lets through, measured shape by shape.
inline constexpr std::size_t kDeepStackBytes = std::size_t{64} << 20;

/// Waits for a thread with such a stack to do it, and throws what that throws. Error(Retry): there is no room
/// for one.
void onDeepStack(const std::function<void()>& action);

}  // namespace luxo::gpu
