// SPDX-License-Identifier: Apache-2.0
// STL, as 3D Systems defined it: triangles, as text or as 50 bytes each. Coordinates are taken for metres;
// the normals of facets are made anew. Facets give each corner its own point: equal ones are welded as they
// are read, since a point has some six corners.
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "mesh/binary.h"
#include "mesh/text_lines.h"
#include "mesh/welding.h"

namespace luxo {
namespace {

constexpr std::size_t kHeaderBytes = 80, kFacetBytes = 50;

MeshArrays readBinary(const ModelSource& source, std::string_view bytes) {
  MeshArrays arrays;
  WeldedPoints points;
  const auto facets = readNumber<std::uint32_t>(bytes, kHeaderBytes, std::endian::little);
  arrays.indices.reserve(3 * std::size_t(facets));
  for (std::size_t i = 0; i < facets; ++i)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3 point;
      for (int k = 0; k < 3; ++k)
        point[k] = readNumber<float>(
            bytes, kHeaderBytes + 4 + i * kFacetBytes + 12 + 12 * corner + 4 * std::size_t(k),
            std::endian::little);
      if (!(glm::length(point) <= kMaxCoordinate))
        refuseModel(source.name(),
                    fmt::format("facet {} has a corner at ({}, {}, {})", i, point.x, point.y, point.z));
      arrays.indices.push_back(points.numberOf(point));
    }
  arrays.positions = points.take();
  return arrays;
}

/// Some programs write STL's words in capitals.
std::string lowered(std::string_view word) {
  std::string low(word);
  std::transform(low.begin(), low.end(), low.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return low;
}

bool beginsWithSolid(std::string_view bytes) {
  if (bytes.starts_with(TextLines::kByteOrderMark)) bytes.remove_prefix(TextLines::kByteOrderMark.size());
  return lowered(bytes.substr(0, 5)) == "solid";
}

MeshArrays readText(const ModelSource& source, std::string_view text) {
  MeshArrays arrays;
  WeldedPoints points;
  TextLines lines(source.name(), text);
  std::size_t corners = 0;
  while (lines.nextLine()) {
    const std::string key = lowered(lines.word());
    if (key == "vertex") {
      if (++corners > 3) lines.refuse("a facet of more than three vertices");
      Vec3 point;
      for (int k = 0; k < 3; ++k) point[k] = lines.number("a coordinate");
      arrays.indices.push_back(points.numberOf(point));
    } else if (key == "endloop") {
      if (corners != 3) lines.refuse(fmt::format("a facet of {} vertices", corners));
      corners = 0;
    } else if (key != "solid" && key != "facet" && key != "outer" && key != "endfacet" && key != "endsolid" &&
               key != "color") {
      lines.refuse(fmt::format("'{}' is no word of STL", TextLines::shown(key)));
    }
  }
  if (corners != 0) lines.refuse("the file ends within a facet");
  arrays.positions = points.take();
  return arrays;
}

}  // namespace

Model readStl(const ModelSource& source, FileBytes file) {
  const std::string_view bytes(reinterpret_cast<const char*>(file->data()), file->size());
  const bool counted = bytes.size() >= kHeaderBytes + 4;
  const std::size_t told = counted ? readNumber<std::uint32_t>(bytes, kHeaderBytes, std::endian::little) : 0,
                    whole = kHeaderBytes + 4 + kFacetBytes * told;
  // Binary headers may begin with "solid", too: the length decides. Four characters of a text are a count of
  // at least 0x09090909 facets, which no text is as long as (7 GB); some programs write more than the facets.
  const bool text = beginsWithSolid(bytes) && !(told > 0 && bytes.size() >= whole);
  if (!text && !counted) refuseModel(source.name(), "it is no STL: neither 'solid' nor a header of 84 bytes");
  if (!text && bytes.size() < whole)
    refuseModel(source.name(), fmt::format("{} facets need {} bytes, and it has {}; is it cut short?", told,
                                           whole, bytes.size()));
  Model model{.name = printable(source.path().stem().string())};
  model.materials.push_back({.name = "default"});
  MeshArrays arrays = text ? readText(source, bytes) : readBinary(source, bytes);
  if (arrays.indices.empty()) refuseModel(source.name(), "it has no facets");
  file.reset();  // the mesh needs the room
  source.tellProgress(0.4);
  source.addOnlyMesh(model, std::move(arrays), NormalRule::Flat);
  return model;
}

}  // namespace luxo
