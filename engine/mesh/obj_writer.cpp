// SPDX-License-Identifier: Apache-2.0
// OBJ and its MTL. Positions and normals have numbers of their own, so a point is there once however many
// normals it has: the file is closed as it stands.
#include <fmt/format.h>

#include <iterator>
#include <set>
#include <utility>

#include "base/assert.h"
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

/// Those beside "a/ring.obj" are a/ring_map0.png, a/ring_map1.png, ...
std::filesystem::path imagePath(const std::filesystem::path& obj, std::uint32_t image) {
  return obj.parent_path() / fmt::format("{}_map{}.png", obj.stem().string(), image);
}

/// A file beside the text that names it. Of words a '#' would begin a comment, and a '-' an option.
std::string wordOf(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('#') || name.starts_with('-') ? "./" + name : name;
}

/// The materials, and the images that their maps name.
class MtlWriter {
 public:
  MtlWriter(const Model& model, const std::filesystem::path& obj) : model_(model), obj_(obj) {}

  fmt::memory_buffer text() {
    for (std::uint32_t i = 0; i < model_.materials.size(); ++i)
      add(model_.materials[i], materialName(model_, i));
    return std::move(text_);
  }
  [[nodiscard]] std::vector<ModelFile> images() const {
    std::vector<ModelFile> files;
    for (const std::uint32_t image : used_) {
      const FileBytes& bytes = model_.images[image].bytes;
      LUXO_REQUIRE(bytes != nullptr);
      files.push_back({imagePath(obj_, image), *bytes});
    }
    return files;
  }

 private:
  void add(const ModelMaterial& m, const std::string& name) {
    const Vec3 ambient = m.ambient.value_or(m.diffuse);
    const auto out = std::back_inserter(text_);
    fmt::format_to(out, "newmtl {}\n", name);
    fmt::format_to(out, "Ka {} {} {}\n", ambient.x, ambient.y, ambient.z);
    fmt::format_to(out, "Kd {} {} {}\n", m.diffuse.x, m.diffuse.y, m.diffuse.z);
    fmt::format_to(out, "Ks {} {} {}\n", m.specular.x, m.specular.y, m.specular.z);
    if (m.glow != Vec3(0)) fmt::format_to(out, "Ke {} {} {}\n", m.glow.x, m.glow.y, m.glow.z);
    fmt::format_to(out, "Ns {}\nd {}\nillum 2\n", m.shininess, m.opacity);
    // A black colour with a map is read as the map's own.
    if (m.diffuse != Vec3(0)) {
      add("map_Kd", m.map);
      if (m.opacityFromMap) add("map_d", m.map);
    }
    if (m.specular != Vec3(0) && !m.specularColors) add("map_Ks", m.specularMap);
    if (m.glow != Vec3(0)) add("map_Ke", m.glowMap);
    if (!m.objectNormals) add(fmt::format("norm -bm {}", m.normalScale), m.normalMap);
  }

  void add(std::string_view word, const ModelMap& map) {
    if (!map.given() || !saidByMtl(map)) return;
    used_.insert(map.image);
    // The bottom of the image is at v = 0 there.
    fmt::format_to(std::back_inserter(text_), "{} -o {} {} 0 -s {} {} 1{} {}\n", word, map.offset.x,
                   1 - map.scale.y - map.offset.y, map.scale.x, map.scale.y,
                   map.wrapU == ModelMap::Wrap::Clamp ? " -clamp on" : "",
                   wordOf(imagePath(obj_, map.image)));
  }

  const Model& model_;
  const std::filesystem::path& obj_;
  fmt::memory_buffer text_;
  std::set<std::uint32_t> used_;  ///< images
};

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
    const bool mapped = !mesh.uvs().empty();
    for (const Vec2f& uv : mesh.uvs()) fmt::format_to(out, "vt {} {}\n", uv.x, 1 - double(uv.y));
    for (const MeshGroup& group : mesh.groups()) {
      fmt::format_to(out, "usemtl {}\n", materialName(model_, group.material));
      for (std::uint32_t t = group.firstTriangle; t < group.firstTriangle + group.triangles; ++t) {
        text_.push_back('f');
        for (const std::uint32_t corner : placed.corners(t))
          fmt::format_to(out, " {}/{}/{}", points_ + number[corner],
                         mapped ? fmt::format_int(uvs_ + corner).str() : std::string(), normals_ + corner);
        text_.push_back('\n');
      }
    }
    points_ += points;
    normals_ += number.size();
    uvs_ += mesh.uvs().size();
  }

  fmt::memory_buffer& text() { return text_; }

 private:
  const Model& model_;
  fmt::memory_buffer text_;
  std::uint64_t points_ = 1, normals_ = 1, uvs_ = 1;  ///< OBJ counts from 1
};

}  // namespace

std::vector<ModelFile> writeObj(const Model& model, const std::filesystem::path& path,
                                const ModelClaim& claim, const LengthUnit& unit) {
  const std::vector<std::filesystem::path> names = namesOf(path);
  ObjWriter writer(model);
  addComments(writer.text(), claim, unit);
  fmt::format_to(std::back_inserter(writer.text()), "mtllib {}\n", wordOf(names[0]));
  for (const PlacedMesh& placed : placedMeshes(model, unit)) writer.add(placed);
  MtlWriter materials(model, path);
  const fmt::memory_buffer text = materials.text();
  std::vector<ModelFile> files = materials.images();
  files.push_back({names[0], bytesOf(text)});
  files.push_back({names[1], bytesOf(writer.text())});
  return files;
}

}  // namespace luxo
