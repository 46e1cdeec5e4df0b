// SPDX-License-Identifier: Apache-2.0
// What is measured. Every function registers one group; they run in the order of registration.
#pragma once

#include "gpu/context.h"
#include "scene/scene.h"

namespace luxo::bench {

/// Whether malloc keeps freed pages in the process, as the applications do. Once on, it stays on.
enum class Tuning { Off, On };

/// Meshes and points of every named surface; points of a torus beside code written by hand.
void registerSurfaces();

/// Scene files up to a million nodes: reading, building, memory; formulas to surfaces.
void registerScenes();

/// What the CPU does for a frame of the lamp and for a file, stage by stage.
void registerStages(const Scene& lamp);

/// Frames of the lamp beside the straightforward path's, until the pixels are finished; first of all whether
/// both draw the same picture. All arguments must outlive the run.
void registerFrames(gpu::Context& context, const Scene& lamp, Tuning tuning);

/// An OBJ of a million triangles: reading it beside the parse alone of tinyobjloader, where that is
/// installed, and what memory it takes.
void registerModels();

/// Frames of a mesh of a million triangles beside one plain draw of the same buffers, and beside Embree's
/// rays, where that is installed.
void registerKnotFrames(gpu::Context& context);

/// Frames of eight sheets that are seen through beside one of them, and beside an opaque one.
void registerLayerFrames(gpu::Context& context);

/// From the start of `luxo_grandpa -o` to a PNG on disk, with empty caches beside full ones.
void registerStart();

/// From a shader that is saved to its new picture, without the driver's own compiling (luxo/bench_reload.h).
/// From its first run on this process keeps in no cache what it compiles: it comes last.
void registerShaders();

}  // namespace luxo::bench
