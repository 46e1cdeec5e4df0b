// SPDX-License-Identifier: Apache-2.0
// OBJ and its MTL. Positions and normals have numbers of their own, so a point is there once however many
// normals it has: the file is closed as it stands.
#include <fmt/format.h>

#include <iterator>

#include "mesh/mesh_topology.h"
#include "mesh/model_target.h"

namespace luxo {
namespace {

std::vector<std::byte> bytesOf(const fmt::memory_buffer& text) {
  std::vector<std::byte> bytes;
  appendText(bytes, std::string_view(text.data(), text.size()));
  return bytes;
}

/// Names end where a line does.
std::string nameOf(const std::string& name, const char* otherwise) {
  std::string word = name.empty() ? otherwise : name;
  for (char& c : word)
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') c = '_';
  return word;
}

std::string materialName(const Model& model, std::uint32_t number) {
  return fmt::format("{}_{}", nameOf(model.materials[number].name, "material"), number);
}

void addComments(fmt::memory_buffer& text, const ModelClaim& claim, const LengthUnit& unit) {
  for (const std::string& line : comments(claim, unit))
    fmt::format_to(std::back_inserter(text), "# {}\n", line);
}

fmt::memory_buffer materialText(const Model& model) {
  fmt::memory_buffer text;
  for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
    const ModelMaterial& m = model.materials[i];
    const Vec3 ambient = m.ambient.value_or(m.diffuse);
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "newmtl {}\n", materialName(model, i));
    fmt::format_to(out, "Ka {} {} {}\n", ambient.x, ambient.y, ambient.z);
    fmt::format_to(out, "Kd {} {} {}\n", m.diffuse.x, m.diffuse.y, m.diffuse.z);
    fmt::format_to(out, "Ks {} {} {}\n", m.specular.x, m.specular.y, m.specular.z);
    if (m.glow != Vec3(0)) fmt::format_to(out, "Ke {} {} {}\n", m.glow.x, m.glow.y, m.glow.z);
    fmt::format_to(out, "Ns {}\nd {}\nillum 2\n", m.shininess, m.opacity);
  }
  return text;
}

class ObjWriter {
 public:
  explicit ObjWriter(const Model& model) : model_(model) {}

  void add(const PlacedMesh& placed) {
    const TriangleMesh& mesh = placed.mesh();
    const auto out = std::back_inserter(text_);
    fmt::format_to(out, "o {}\n", nameOf(placed.node().name, "node"));
    const std::vector<std::uint32_t> firstWithPoint = pointNumbers(mesh.positions());
    std::vector<std::uint32_t> number(firstWithPoint.size());
    std::uint32_t points = 0;
    for (std::uint32_t i = 0; i < number.size(); ++i) {
      const std::uint32_t first = firstWithPoint[i];
      if (first != i) {
        number[i] = number[first];
        continue;
      }
      number[i] = points++;
      const Vec3 p = placed.point(i);
      fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);  // as many as tell floats apart
    }
    for (std::uint32_t i = 0; i < number.size(); ++i) {
      const Vec3 n = placed.normal(i);
      fmt::format_to(out, "vn {:.7g} {:.7g} {:.7g}\n", n.x, n.y, n.z);
    }
    for (const MeshGroup& group : mesh.groups()) {
      fmt::format_to(out, "usemtl {}\n", materialName(model_, group.material));
      for (std::uint32_t t = group.firstTriangle; t < group.firstTriangle + group.triangles; ++t) {
        text_.push_back('f');
        for (const std::uint32_t corner : placed.corners(t))
          fmt::format_to(out, " {}//{}", points_ + number[corner], normals_ + corner);
        text_.push_back('\n');
      }
    }
    points_ += points;
    normals_ += number.size();
  }

  fmt::memory_buffer& text() { return text_; }

 private:
  const Model& model_;
  fmt::memory_buffer text_;
  std::uint64_t points_ = 1, normals_ = 1;  ///< OBJ counts from 1
};

}  // namespace

std::vector<ModelFile> writeObj(const Model& model, const std::filesystem::path& path,
                                const ModelClaim& claim, const LengthUnit& unit) {
  const std::vector<std::filesystem::path> names = namesOf(path);
  ObjWriter writer(model);
  addComments(writer.text(), claim, unit);
  fmt::format_to(std::back_inserter(writer.text()), "mtllib {}\n", names[0].filename().string());
  for (const PlacedMesh& placed : placedMeshes(model, unit)) writer.add(placed);
  return {{names[0], bytesOf(materialText(model))}, {names[1], bytesOf(writer.text())}};
}

}  // namespace luxo
