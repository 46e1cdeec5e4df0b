// SPDX-License-Identifier: Apache-2.0
// What the exact shaders know of a node: its pixels as linear functions of its points, and its patches.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cull/cull.h"
#include "draw/pixel_rows.h"
#include "formula/glsl.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"
#include "shell/shell.h"
#include "surface/surface_code.h"

namespace luxo {

/// Largest residual of a point that is drawn, pixels, where single precision allows: what it rounds away of
/// the picture's distances and of the object's size may be more.
inline constexpr double kExactTolerancePx = 1e-4;
/// The same of a search in double, where a thousandth of what bends sharply turns the normal.
inline constexpr double kDoubleTolerancePx = 1e-5;

/// Whether float would round away more of a point's place on the screen than a picture may lack, or so much
/// that the normal there is another: of what bends sharply, most of it, and is not small.
[[nodiscard]] bool needsDouble(const View& view, const SnapshotNode& node, const VisibleNode& visible,
                               const Shell& shell);

/// Whether float may move the shell's vertices by so much that pixels of the surface are beside it.
[[nodiscard]] bool losesEdges(const View& view, const SnapshotNode& node, const VisibleNode& visible,
                              const Shell& shell);

/// Where points of the node's object are in the picture, as PixelTriangle has them.
[[nodiscard]] std::vector<Vec3> inPicture(const View& view, const SnapshotNode& node,
                                          std::span<const Vec3> points);

/// All of the instance but firstPatch, for a search in those numbers. `origin`: shadingOrigin().
[[nodiscard]] shared::ExactInstance exactInstance(const View& view, const Vec3& origin,
                                                  const SnapshotNode& node, const VisibleNode& visible,
                                                  const Shell& shell, GlslNumber number);

/// Adds to the tolerance of a search in single precision what its formula loses in that, and no residual
/// tells. Where that is too much (kMaxTolerancePx) nothing it finds is certified: for devices without
/// doubles.
void addFormulaRounding(const View& view, const SnapshotNode& node, const Shell& shell,
                        shared::ExactInstance& instance);

/// Where pixels are on the plane that a shell is around; nothing of a shell of anything else.
[[nodiscard]] std::optional<PlaneRows> planeIn(const View& view, const SnapshotNode& node,
                                               const Shell& shell);

/// The same as above of such a plane, which is found in double.
[[nodiscard]] shared::ExactInstance exactInstance(const View& view, const Vec3& origin,
                                                  const SnapshotNode& node, const VisibleNode& visible,
                                                  const Shell& shell, const PlaneRows& plane);

/// What finds a patch of a shell's surface: its equation, or its formula of so many parameters.
[[nodiscard]] SurfaceCodePtr codeOf(SurfaceCodes& codes, const Surface& surface, const Shell& shell,
                                    std::uint32_t patch, std::size_t parameters, GlslNumber number);

/// Whether some formula of the surface is too large for a shader (surface_code.h).
[[nodiscard]] bool isTooLarge(SurfaceCodes& codes, const Surface& surface, const Shell& shell,
                              std::size_t parameters, GlslNumber number);

/// Appends the patches of a shell, and the numbers that their codes read: of equations, or what formulas read
/// beyond u and v.
void appendPatches(SurfaceCodes& codes, const Surface& surface, std::span<const double> parameters,
                   const Shell& shell, std::vector<shared::ExactPatch>& patches,
                   std::vector<double>& numbers);

/// Whether the eye may be inside the shell, or so near that the near plane may be. A shell reaches 2 offsets
/// from its surface: its mesh is one away, and its faces are one from that.
[[nodiscard]] bool mayHoldEye(const View& view, const SnapshotNode& node, const VisibleNode& visible,
                              const Shell& shell);

}  // namespace luxo
