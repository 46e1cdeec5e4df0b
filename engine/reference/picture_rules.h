// SPDX-License-Identifier: Apache-2.0
// Numbers by which pictures are made and which the truth has to go by, too, as it judges them. Shaders have
// them from shaders/shared/truth.h, which is held against these.
#pragma once

namespace luxo::reference {

/// Where the cosine of a triangle's interpolated normal and a ray is no larger, the triangle itself tells
/// which of its sides is seen (seenFromFront in shaders/lib/scene.glsl). Of 70 degrees. Chosen, not measured.
inline constexpr double kTurningAway = 0.35;

/// Of drawings: the cosine of a light's angle from which the colour is full, the level below, and how wide
/// outlines are.
inline constexpr double kDrawnBright = 0.5, kDrawnShaded = 0.5, kDrawnOutlinePx = 2;

/// Of what casters let through, a part of 1: what products of some layers in single precision round away, and
/// patterns of theirs; a tenth of the least that 8 bits show.
inline constexpr double kTransmittanceRounding = 4e-4;

/// Of a patch: what interpolation may overshoot an edge by.
inline constexpr double kPatchSlack = 1e-3;

}  // namespace luxo::reference
