// SPDX-License-Identifier: Apache-2.0
// PLY (Turk, The PLY polygon file format, 1994): as text, or binary of either order of bytes.
#include <array>
#include <optional>

#include "mesh/binary.h"
#include "mesh/polygon.h"
#include "mesh/text_lines.h"

namespace luxo {
namespace {

enum class Kind { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

std::optional<Kind> kindOf(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Kind>, 16> kNames = {{
      {"char", Kind::Int8},
      {"int8", Kind::Int8},
      {"uchar", Kind::Uint8},
      {"uint8", Kind::Uint8},
      {"short", Kind::Int16},
      {"int16", Kind::Int16},
      {"ushort", Kind::Uint16},
      {"uint16", Kind::Uint16},
      {"int", Kind::Int32},
      {"int32", Kind::Int32},
      {"uint", Kind::Uint32},
      {"uint32", Kind::Uint32},
      {"float", Kind::Float},
      {"float32", Kind::Float},
      {"double", Kind::Double},
      {"float64", Kind::Double},
  }};
  for (const auto& [name, kind] : kNames)
    if (name == word) return kind;
  return std::nullopt;
}

constexpr std::size_t bytesOf(Kind kind) {
  constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[std::size_t(kind)];
}

struct Property {
  std::string name;
  Kind kind = Kind::Float;
  std::optional<Kind> count = std::nullopt;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

/// Values one after the other, as text or as bytes.
class Values {
 public:
  Values(const ModelSource& source, std::string_view file, std::size_t begin, std::size_t headerLines,
         std::optional<std::endian> order)
      : source_(source),
        file_(file),
        at_(begin),
        order_(order),
        headerLines_(headerLines),
        lines_(source.name(), file.substr(begin)) {}

  double next(Kind kind) {
    if (!order_) {
      const std::string_view word = lines_.wordAnywhere();
      if (word.empty()) refuse("the file ends too early");
      const auto value = TextLines::parsed(word);
      if (!value) refuse(fmt::format("'{}' is no number", TextLines::shown(word)));
      return *value;
    }
    if (file_.size() - at_ < bytesOf(kind)) refuse("the file ends too early");
    const std::size_t at = at_;
    at_ += bytesOf(kind);
    switch (kind) {
      case Kind::Int8:
        return readNumber<std::int8_t>(file_, at, *order_);
      case Kind::Uint8:
        return readNumber<std::uint8_t>(file_, at, *order_);
      case Kind::Int16:
        return readNumber<std::int16_t>(file_, at, *order_);
      case Kind::Uint16:
        return readNumber<std::uint16_t>(file_, at, *order_);
      case Kind::Int32:
        return readNumber<std::int32_t>(file_, at, *order_);
      case Kind::Uint32:
        return readNumber<std::uint32_t>(file_, at, *order_);
      case Kind::Float:
        return readNumber<float>(file_, at, *order_);
      case Kind::Double:
        break;
    }
    return readNumber<double>(file_, at, *order_);
  }

  /// The least that is left for so many values.
  [[nodiscard]] std::size_t left() const { return file_.size() - (order_ ? at_ : 0); }
  [[nodiscard]] bool binary() const { return order_.has_value(); }
  [[noreturn]] void refuse(const std::string& why) const {
    if (order_) refuseModel(source_.name(), fmt::format("byte {}: {}", at_, why));
    refuseModel(source_.name(), why, headerLines_ + lines_.line());
  }

 private:
  const ModelSource& source_;
  std::string_view file_;
  std::size_t at_;
  std::optional<std::endian> order_;
  std::size_t headerLines_;
  TextLines lines_;
};

class PlyReader {
 public:
  PlyReader(const ModelSource& source, std::string_view bytes) : source_(source), bytes_(bytes) {}

  Model read() {
    readHeader();
    Values values(source_, bytes_, bodyBegin_, headerLines_, order_);
    for (const Element& element : elements_) {
      if (element.name == "vertex")
        readVertices(element, values);
      else if (isMadeOfVertices(element) && hasVertices_)
        readFaces(element, values);
      else {
        if (isMadeOfVertices(element)) facesBefore_.emplace_back(&element, values);
        skip(element, values);
      }
    }
    for (auto& [element, where] : facesBefore_) readFaces(*element, where);
    if (arrays_.indices.empty()) refuseModel(source_.name(), "it has no faces");
    source_.tellProgress(0.4);
    Model model{.name = printable(source_.path().stem().string())};
    model.materials.push_back({.name = "default"});
    if (coloured_)
      model.warnings.push_back(fmt::format("{}: colours of vertices are not read", source_.name()));
    source_.addOnlyMesh(model, std::move(arrays_));
    return model;
  }

 private:
  void readHeader() {
    TextLines lines(source_.name(), bytes_);
    if (!lines.nextLine() || lines.word() != "ply")
      refuseModel(source_.name(), "it does not begin with 'ply'", 1);
    bool formatGiven = false;
    for (;;) {
      if (!lines.nextLine()) refuseModel(source_.name(), "its header has no end_header");
      const std::string_view key = lines.word();
      if (key == "format") {
        const std::string_view format = lines.word();
        if (format == "binary_little_endian")
          order_ = std::endian::little;
        else if (format == "binary_big_endian")
          order_ = std::endian::big;
        else if (format != "ascii")
          lines.refuse(fmt::format("the format '{}' is none of PLY", TextLines::shown(format)));
        formatGiven = true;
      } else if (key == "element") {
        const std::string_view name = lines.word();
        const double count = lines.number("an element's count");
        if (!(count >= 0 && count < double(kMaxCorners) && count == std::floor(count)))
          lines.refuse(fmt::format("{} elements", count));
        elements_.push_back({.name = std::string(name), .count = std::size_t(count)});
      } else if (key == "property") {
        readProperty(lines);
      } else if (key == "end_header") {
        break;
      } else if (key != "comment" && key != "obj_info") {
        lines.refuse(fmt::format("'{}' is no word of PLY", TextLines::shown(key)));
      }
    }
    if (!formatGiven) refuseModel(source_.name(), "its header has no format");
    // What ends the first line ends the header, too: bytes after it may be those of a line's end.
    const std::size_t first = bytes_.find_first_of("\r\n");
    const char end = bytes_[first] == '\r' && !bytes_.substr(first + 1).starts_with('\n') ? '\r' : '\n';
    bodyBegin_ = std::min(bytes_.find(end, lines.offset()), bytes_.size() - 1) + 1;
    headerLines_ = lines.line();
    requireRoom();
  }

  void readProperty(TextLines& lines) {
    if (elements_.empty()) lines.refuse("a property of no element");
    Property property;
    std::string_view word = lines.word();
    const auto kind = [&] {
      const auto found = kindOf(word);
      if (!found) lines.refuse(fmt::format("'{}' is no type of PLY", TextLines::shown(word)));
      return *found;
    };
    if (word == "list") {
      word = lines.word();
      property.count = kind();
      word = lines.word();
    }
    property.kind = kind();
    property.name = lines.word();
    elements_.back().properties.push_back(property);
  }

  // Counts that no honest file of this length can hold are refused before anything is made of them.
  void requireRoom() const {
    double least = 0;
    for (const Element& element : elements_) {
      double bytes = 0;
      for (const Property& property : element.properties)
        bytes += order_ ? double(bytesOf(property.count.value_or(property.kind))) : 2;
      if (element.count > 0 && bytes == 0)
        refuseModel(source_.name(), fmt::format("its {} elements '{}' have no properties", element.count,
                                                printable(element.name)));
      least += double(element.count) * bytes;
    }
    if (least > double(bytes_.size() - bodyBegin_) + 2)
      refuseModel(source_.name(),
                  fmt::format("its header promises {:.0f} bytes or more, and {} follow; is it cut short?",
                              least, bytes_.size() - bodyBegin_));
  }

  // Of the longest list: less than the bytes that are left.
  std::size_t listLength(const Property& property, Values& values) const {
    const double length = values.next(*property.count);
    if (!(length >= 0 && length <= double(values.left()) && length == std::floor(length)))
      values.refuse(fmt::format("a list of {} values", length));
    return std::size_t(length);
  }

  void skip(const Property& property, Values& values) const {
    const std::size_t count = property.count ? listLength(property, values) : 1;
    for (std::size_t i = 0; i < count; ++i) (void)values.next(property.kind);
  }

  void skip(const Element& element, Values& values) const {
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Property& property : element.properties) skip(property, values);
  }

  static bool isMadeOfVertices(const Element& element) {
    return element.name == "face" || element.name == "tristrips";
  }

  void readVertices(const Element& element, Values& values) {
    hasVertices_ = true;
    // Where each property goes: x y z, nx ny nz, u v.
    constexpr std::array<std::array<std::string_view, 4>, 8> kNames = {
        {{"x"},
         {"y"},
         {"z"},
         {"nx"},
         {"ny"},
         {"nz"},
         {"u", "s", "texture_u", "texture_s"},
         {"v", "t", "texture_v", "texture_t"}}};
    constexpr std::size_t kOther = kNames.size();
    std::vector<std::size_t> places;
    std::array<bool, kNames.size() + 1> has{};
    for (const Property& property : element.properties) {
      std::size_t place = kOther;
      for (std::size_t i = 0; i < kNames.size(); ++i)
        for (const std::string_view name : kNames[i])
          if (!name.empty() && property.name == name && !property.count) place = i;
      places.push_back(place);
      has[place] = true;
      coloured_ = coloured_ || property.name == "red";
    }
    if (element.count > 0 && !(has[0] && has[1] && has[2]))
      refuseModel(source_.name(), "its vertices have no x, y and z");
    const bool normals = has[3] && has[4] && has[5], uvs = has[6] && has[7];
    for (std::size_t i = 0; i < element.count; ++i) {
      std::array<double, kNames.size() + 1> read{};
      for (std::size_t k = 0; k < places.size(); ++k) {
        if (places[k] == kOther) {
          skip(element.properties[k], values);
          continue;
        }
        const double value = values.next(element.properties[k].kind);
        if (!(std::abs(value) <= kMaxCoordinate))
          values.refuse(fmt::format("{} of vertex {} is {}", element.properties[k].name, i, value));
        read[places[k]] = value;
      }
      arrays_.positions.emplace_back(read[0], read[1], read[2]);
      if (normals) arrays_.normals.emplace_back(float(read[3]), float(read[4]), float(read[5]));
      if (uvs) arrays_.uvs.emplace_back(float(read[6]), float(1 - read[7]));
    }
  }

  /// Polygons, or strips of triangles, once the vertices are known.
  void readFaces(const Element& element, Values& values) {
    const bool strips = element.name == "tristrips";
    std::vector<std::uint32_t> vertices;
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Property& property : element.properties) {
        if (!property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) {
          skip(property, values);
          continue;
        }
        vertices.clear();
        const std::size_t length = listLength(property, values);
        for (std::size_t k = 0; k < length; ++k) {
          const double index = values.next(property.kind);
          if (strips && index == -1) {  // the next strip
            addStrip(vertices);
            vertices.clear();
            continue;
          }
          if (!(index >= 0 && index < double(arrays_.positions.size()) && index == std::floor(index)))
            values.refuse(fmt::format("{} {} has vertex {} of {}", strips ? "strip" : "face", i, index,
                                      arrays_.positions.size()));
          vertices.push_back(std::uint32_t(index));
        }
        if (strips)
          addStrip(vertices);
        else
          addFace(vertices, i, values);
      }
  }

  void addFace(const std::vector<std::uint32_t>& face, std::size_t number, const Values& values) {
    if (face.size() < 3) values.refuse(fmt::format("face {} has {} vertices", number, face.size()));
    points_.clear();
    corners_.clear();
    for (const std::uint32_t vertex : face) points_.push_back(arrays_.positions[vertex]);
    if (!addTriangles(points_, corners_))
      values.refuse(fmt::format("face {} of {} vertices is not convex; luxo takes {}", number, face.size(),
                                kMaxConcaveCorners));
    for (const std::uint32_t corner : corners_) arrays_.indices.push_back(face[corner]);
  }

  /// Every other triangle is turned, so that all have one front.
  void addStrip(const std::vector<std::uint32_t>& strip) {
    for (std::size_t i = 0; i + 3 <= strip.size(); ++i)
      for (const std::size_t corner : {i, i + 1 + i % 2, i + 2 - i % 2})
        arrays_.indices.push_back(strip[corner]);
  }

  const ModelSource& source_;
  std::string_view bytes_;
  std::vector<Element> elements_;
  std::optional<std::endian> order_;  ///< none: text
  std::size_t bodyBegin_ = 0, headerLines_ = 0;
  MeshArrays arrays_;
  bool coloured_ = false, hasVertices_ = false;
  std::vector<std::pair<const Element*, Values>> facesBefore_;  ///< of what comes before its vertices
  std::vector<Vec3> points_;                                    ///< of a face
  std::vector<std::uint32_t> corners_;                          ///< of the triangles that it becomes
};

}  // namespace

Model readPly(const ModelSource& source, std::string_view bytes) { return PlyReader(source, bytes).read(); }

}  // namespace luxo
