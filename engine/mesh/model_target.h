// SPDX-License-Identifier: Apache-2.0
// What the writers of model files share.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "mesh/model_writer.h"

namespace luxo {

/// Binary files are little-endian, all of them.
template <class T>
requires(std::is_trivially_copyable_v<T>) void append(std::vector<std::byte>& bytes, const T& value) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}
inline void appendText(std::vector<std::byte>& bytes, std::string_view text) {
  const std::size_t at = bytes.size();
  bytes.resize(at + text.size());
  std::memcpy(bytes.data() + at, text.data(), text.size());
}

/// A mesh where a node stands, in the units of the file.
class PlacedMesh {
 public:
  PlacedMesh(const Model& model, std::uint32_t node, const Transform& place, const LengthUnit& unit);

  [[nodiscard]] const ModelNode& node() const { return *node_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
  [[nodiscard]] Vec3 point(std::uint32_t vertex) const {
    return transformPoint(place_, mesh_->point(vertex)) / metres_;
  }
  [[nodiscard]] Vec3 normal(std::uint32_t vertex) const {
    return unit(normals_ * Vec3(mesh_->normals()[vertex]));
  }
  /// The three vertices of a triangle; counter-clockwise from outside where the node is mirrored, too.
  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const;

 private:
  const ModelNode* node_;
  const TriangleMesh* mesh_;
  Transform place_;
  Mat3 normals_;
  bool turned_;
  double metres_;
};

/// Of all nodes that have a mesh.
[[nodiscard]] std::vector<PlacedMesh> placedMeshes(const Model& model, const LengthUnit& unit);

/// Lines of at most 79 characters that say what the file is.
[[nodiscard]] std::vector<std::string> comments(const ModelClaim& claim, const LengthUnit& unit);

/// Writers of one format each.
[[nodiscard]] std::vector<ModelFile> writeObj(const Model& model, const std::filesystem::path& path,
                                              const ModelClaim& claim, const LengthUnit& unit);
[[nodiscard]] std::vector<std::byte> writePly(const Model& model, const ModelClaim& claim,
                                              const LengthUnit& unit);
[[nodiscard]] std::vector<std::byte> writeStl(const Model& model, const ModelClaim& claim,
                                              const LengthUnit& unit);
[[nodiscard]] std::vector<std::byte> writeGlb(const Model& model, const ModelClaim& claim);

}  // namespace luxo
