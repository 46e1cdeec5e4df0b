// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ (Appendix B1 of Wavefront's Advanced Visualizer manual): polygons, with positions, uvs,
// normals, smoothing groups and materials.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <unordered_map>

#include "image/file.h"
#include "mesh/mtl.h"
#include "mesh/polygon.h"
#include "mesh/text_lines.h"

namespace luxo {
namespace {

constexpr std::uint32_t kUnnumbered = 0xffffffff;

/// A corner of a face: which position, uv and normal.
struct Corner {
  std::uint32_t position = 0, uv = kUnnumbered, normal = kUnnumbered;
  friend bool operator==(const Corner&, const Corner&) = default;
};

class ObjReader {
 public:
  ObjReader(const ModelSource& source, std::string_view text)
      : source_(source), lines_(source.name(), text, true), bytes_(text.size()) {}

  Model read() {
    model_.name = printable(source_.path().stem().string());
    std::size_t told = 0;
    while (lines_.nextLine()) {
      readLine(lines_.word());
      if (lines_.offset() - told > kProgressBytes) {
        told = lines_.offset();
        source_.tellProgress(kReadingPart * double(told) / double(bytes_));
      }
    }
    if (triangles_.empty()) refuseModel(source_.name(), "it has no faces");
    finishMaterials();
    source_.tellProgress(kReadingPart);
    source_.addOnlyMesh(model_, arrays());
    return std::move(model_);
  }

 private:
  static constexpr std::size_t kProgressBytes = 1 << 20;
  static constexpr double kReadingPart = 0.4;  // of the time, measured with a million triangles

  void readLine(std::string_view key) {
    if (key == "v")
      readPosition();
    else if (key == "vn")
      normals_.push_back(three<Vec3f>("a normal's coordinate"));
    else if (key == "vt")
      readUv();
    else if (key == "f" || key == "fo")
      readFace();
    else if (key == "usemtl")
      useMaterial(lines_.rest());
    else if (key == "mtllib")
      readLibraries();
    else if (key == "s")
      readSmoothing();
    else if (key != "g" && key != "o" && key != "vp")
      ignore(key);
  }

  template <class V>
  V three(std::string_view what) {
    V v;
    for (int i = 0; i < 3; ++i) v[i] = typename V::value_type(lines_.number(what));
    return v;
  }

  void readPosition() {
    positions_.push_back(three<Vec3>("a coordinate"));
    lastVertices_.push_back(kUnnumbered);
    // A fourth number is a weight; three or four more are a colour.
    if (!coloured_ && !lines_.word().empty() && !lines_.word().empty()) {
      coloured_ = true;
      warn("colours of vertices are not read");
    }
  }

  // Its v counts from the bottom of the image; a model's from the top.
  void readUv() {
    const double u = lines_.number("u"), v = lines_.numberOr(0, "v");
    uvs_.emplace_back(float(u), float(1 - v));
  }

  void readSmoothing() {
    const std::string_view group = lines_.word();
    smoothing_ = 0;
    if (group != "off" && !group.empty())
      smoothing_ = std::uint32_t(std::clamp(lines_.numberOf(group, "a smoothing group"), 0.0, 4e9));
    if (!smoothingGiven_) smoothings_.resize(triangles_.size() / 3);  // until now they were off
    smoothingGiven_ = true;
  }

  // One of the numbers that slashes part: from 1, or back from the last one.
  std::uint32_t index(std::string_view word, std::size_t count, std::string_view what) const {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
      lines_.refuse(fmt::format("'{}' is no number of a {}", TextLines::shown(word), what));
    const std::int64_t from0 = number < 0 ? std::int64_t(count) + number : number - 1;
    if (number == 0 || from0 < 0 || from0 >= std::int64_t(count))
      lines_.refuse(fmt::format("there is no {} {}; {} so far", what, number,
                                count == 0 ? "there are none" : fmt::format("there are 1 to {}", count)));
    return std::uint32_t(from0);
  }

  Corner corner(std::string_view word) const {
    const auto part = [&] {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view first = word.substr(0, slash);
      word.remove_prefix(std::min(slash + 1, word.size()));
      return first;
    };
    Corner corner{.position = index(part(), positions_.size(), "vertex")};
    if (const auto uv = part(); !uv.empty()) corner.uv = index(uv, uvs_.size(), "vt");
    if (const auto normal = part(); !normal.empty()) corner.normal = index(normal, normals_.size(), "vn");
    return corner;
  }

  // Faces around a position mostly agree on its uv and normal. Where they do not, a vertex may come twice,
  // until the mesh is welded.
  std::uint32_t vertexOf(const Corner& corner) {
    std::uint32_t& last = lastVertices_[corner.position];
    if (last == kUnnumbered || vertices_[last] != corner) {
      last = std::uint32_t(vertices_.size());
      vertices_.push_back(corner);
    }
    return last;
  }

  void readFace() {
    face_.clear();
    facePoints_.clear();
    bool withoutUv = false;
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
      const Corner read = corner(word);
      face_.push_back(vertexOf(read));
      facePoints_.push_back(positions_[read.position]);
      withoutUv = withoutUv || read.uv == kUnnumbered;
    }
    if (face_.size() < 3) lines_.refuse(fmt::format("a face of {} vertices", face_.size()));
    faceCorners_.clear();
    if (!addTriangles(facePoints_, faceCorners_))
      lines_.refuse(fmt::format("a face of {} vertices that is not convex; luxo takes {}", face_.size(),
                                kMaxConcaveCorners));
    if (material_ == kUnnumbered) {
      material_ = 0;
      model_.materials.push_back({.name = "default"});
    }
    if (withoutUv) withoutUvs_.try_emplace(material_, lines_.line());
    if (material_ != 0 && materials_.empty()) materials_.resize(triangles_.size() / 3);  // until now all 0
    for (const std::uint32_t i : faceCorners_) triangles_.push_back(face_[i]);
    const std::size_t count = triangles_.size() / 3;
    if (material_ != 0) materials_.resize(count, material_);
    if (material_ == 0 && !materials_.empty()) materials_.resize(count);
    if (smoothingGiven_) smoothings_.resize(count, smoothing_);
  }

  void useMaterial(std::string_view name) {
    const std::string key(name);
    const auto [found, fresh] = materialNumbers_.try_emplace(key, std::uint32_t(model_.materials.size()));
    material_ = found->second;
    if (fresh) {
      model_.materials.push_back({.name = printable(key)});
      materialLines_.emplace_back(key, lines_.line());
    }
  }

  void readLibraries() {
    // Names may have blanks: all of the line is one file, if there is such a file.
    const std::string_view all = lines_.rest();
    const auto exists = [&](std::string_view name) {
      return source_.from().has(source_.besides(name, source_.name(), lines_.line()));
    };
    std::vector<std::string_view> names;
    if (exists(all)) {
      names = {all};
    } else {
      TextLines words(source_.name(), all);
      if (words.nextLine())
        for (std::string_view word = words.word(); !word.empty(); word = words.word()) names.push_back(word);
    }
    for (const std::string_view name : names) {
      const std::filesystem::path file = source_.besides(name, source_.name(), lines_.line());
      if (!exists(name)) {
        warn(fmt::format("there is no material file '{}'; its materials are plain", printable(name)));
        continue;
      }
      if (std::find(libraries_.begin(), libraries_.end(), file) != libraries_.end()) continue;
      libraries_.push_back(file);
      const FileBytes bytes = source_.from().read(file);
      const std::size_t named = source_.files().size();
      readMtl(source_, printable(file.string()),
              {reinterpret_cast<const char*>(bytes->data()), bytes->size()}, model_, library_);
      namesMaps_ |= source_.files().size() > named;
    }
  }

  void ignore(std::string_view key) {
    if (ignored_.size() < 8 && std::find(ignored_.begin(), ignored_.end(), key) == ignored_.end()) {
      ignored_.emplace_back(key);
      warn(fmt::format("'{}' is not read: luxo takes polygons", TextLines::shown(key)));
    }
  }

  void warn(std::string_view what) { warn(lines_.line(), what); }
  void warn(std::size_t line, std::string_view what) {
    model_.warnings.push_back(fmt::format("{}:{}: {}", source_.name(), line, what));
  }

  void finishMaterials() {
    for (const auto& [name, line] : materialLines_) {
      const auto found = library_.find(name);
      ModelMaterial& material = model_.materials[materialNumbers_.at(name)];
      if (found != library_.end())
        material = found->second;
      else if (!libraries_.empty())
        warn(line, fmt::format("no file has the material '{}'; it is plain", material.name));
    }
    if (!namesMaps_ && model_.materials.size() == 1) findLessonMaps();
    for (const auto& [number, line] : withoutUvs_)
      if (const ModelMaterial& material = model_.materials[number]; material.hasMaps())
        warn(line,
             fmt::format("this face has no uvs, which the maps of its material '{}' need", material.name));
  }

  // A lesson's model names no maps: they lie beside it, by their names. Its formula takes the map as it is,
  // whatever a material file says of colours.
  void findLessonMaps() {
    const auto map = [&](const char* suffix) {
      const std::filesystem::path file = source_.path().stem().string() + suffix + ".tga";
      ModelMap found;
      if (source_.from().has(source_.path().parent_path() / file))
        found.image = source_.image(model_, file.string(), source_.name(), 1);
      found.nearest = true;
      return found;
    };
    ModelMaterial& material = model_.materials.front();
    if (const ModelMap diffuse = map("_diffuse"); diffuse.given())
      material = {.name = material.name, .diffuse = Vec3(1), .lesson = true, .map = diffuse};
    material.normalMap = map("_nm_tangent");
    if (!material.normalMap.given()) {
      material.normalMap = map("_nm");
      material.objectNormals = material.normalMap.given();
    }
    material.specularMap = map("_spec");
    if (material.glowMap = map("_glow"); material.glowMap.given()) material.glow = Vec3(1);
  }

  MeshArrays arrays() {
    // What is done with goes at once: the mesh needs the room.
    lastVertices_ = std::vector<std::uint32_t>();
    const std::vector<Corner> corners = std::move(vertices_);
    const std::vector<Vec3> positions = std::move(positions_);
    const std::vector<Vec3f> normals = std::move(normals_);
    const std::vector<Vec2f> uvs = std::move(uvs_);
    MeshArrays arrays;
    arrays.positions.reserve(corners.size());
    for (const Corner& corner : corners) arrays.positions.push_back(positions[corner.position]);
    if (!normals.empty()) {
      arrays.normals.reserve(corners.size());
      for (const Corner& corner : corners)
        arrays.normals.push_back(corner.normal == kUnnumbered ? Vec3f(0) : normals[corner.normal]);
    }
    if (!uvs.empty()) {
      arrays.uvs.reserve(corners.size());
      for (const Corner& corner : corners)
        arrays.uvs.push_back(corner.uv == kUnnumbered ? Vec2f(0) : uvs[corner.uv]);
    }
    arrays.indices = std::move(triangles_);
    arrays.materials = std::move(materials_);
    arrays.smoothing = std::move(smoothings_);
    return arrays;
  }

  const ModelSource& source_;
  TextLines lines_;
  std::size_t bytes_;
  Model model_;
  std::vector<Vec3> positions_;
  std::vector<Vec2f> uvs_;
  std::vector<Vec3f> normals_;
  std::vector<Corner> vertices_;
  std::vector<std::uint32_t> lastVertices_;  ///< at each position, the last that came
  std::vector<std::uint32_t> face_, faceCorners_, triangles_;
  std::vector<Vec3> facePoints_;
  std::vector<std::uint32_t> materials_, smoothings_;
  std::uint32_t material_ = kUnnumbered, smoothing_ = 0;
  bool smoothingGiven_ = false, coloured_ = false;
  std::map<std::uint32_t, std::size_t> withoutUvs_;  ///< of materials, the line of the first face without uvs
  std::unordered_map<std::string, std::uint32_t> materialNumbers_;
  std::vector<std::pair<std::string, std::size_t>> materialLines_;
  MtlLibrary library_;
  std::vector<std::filesystem::path> libraries_;
  bool namesMaps_ = false;  ///< one of them, whether they are there or not
  std::vector<std::string> ignored_;
};

}  // namespace

Model readObj(const ModelSource& source, std::string_view text) { return ObjReader(source, text).read(); }

}  // namespace luxo
