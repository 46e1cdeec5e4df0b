// SPDX-License-Identifier: Apache-2.0
// Models as files that readModel() and other programs read: OBJ with its MTL, GLB (glTF 2.0), PLY and STL,
// both binary.
//
//     for (const ModelFile& file : filesOf(model, "ring.obj")) writeFileAtomically(file.path, file.bytes);
//
// GLB has all of a model but its movements: nodes, materials, cameras, lights, the scene that it carries. The
// others have what stands in the world at time 0: OBJ an object a node, with materials; PLY one list of
// vertices with their colours; STL triangles. A GLB embeds the images of maps, which are PNGs; an OBJ has
// them beside it (ring_map0.png), for the maps that an MTL can say (saidByMtl()). What was one point of a
// mesh is one point of the file, bit for bit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "mesh/model.h"

namespace luxo {

/// What a file says of itself: in comments, in the header of an STL, in the extras of a GLB.
struct ModelClaim {
  /// Metres: how far its triangles may be from the surfaces that they stand for. Infinite: not known.
  double deviation = std::numeric_limits<double>::infinity();
  bool closed = false;   ///< its triangles bound solids
  double thickness = 0;  ///< metres, that open surfaces were given; their middles are what `deviation` is of
};

/// What one of the coordinates in a file means. GLB is in metres.
struct LengthUnit {
  std::string name = "m";
  double metres = 1;
};

/// "0.0101 mm": with so many digits, and read again no less than it is. Required: 0 or more, finite.
[[nodiscard]] std::string shownUpward(double metres, const LengthUnit& unit, int digits);

struct ModelFile {
  std::filesystem::path path;
  std::vector<std::byte> bytes;
};

/// Whether the suffix is one of .obj, .glb, .ply, .stl, in either case.
[[nodiscard]] bool namesWrittenModel(const std::filesystem::path& path);

/// Whether it is .glb, in either case.
[[nodiscard]] bool namesGlb(const std::filesystem::path& path);

/// What a format keeps of a model beside its triangles; each keeps what those before it do.
enum class Kept {
  Triangles,  ///< STL
  Colours,    ///< PLY: the diffuse ones
  Materials,  ///< OBJ
  All,        ///< GLB: cameras and lights, too
};
/// Required: namesWrittenModel().
[[nodiscard]] Kept keptBy(const std::filesystem::path& path);

/// Whether an MTL has words for the way in which a map is read: it repeats or ends in both directions, and is
/// not turned.
[[nodiscard]] bool saidByMtl(const ModelMap& map);

/// The names of the files that a model without maps becomes; the one that names the others is the last:
/// scene.mtl, scene.obj. Required: namesWrittenModel().
[[nodiscard]] std::vector<std::filesystem::path> namesOf(const std::filesystem::path& path);

/// Those files, images first. OBJ, PLY and STL round every coordinate to single precision, 2^-24 of itself,
/// or nearer. Error(Usage): the suffix names none; a GLB in another unit. Error(Scene): nothing to write,
/// more than the format has room for (4 GiB).
[[nodiscard]] std::vector<ModelFile> filesOf(const Model& model, const std::filesystem::path& path,
                                             const ModelClaim& claim = {}, const LengthUnit& unit = {});

}  // namespace luxo
