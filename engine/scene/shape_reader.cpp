// SPDX-License-Identifier: Apache-2.0
#include "scene/shape_reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/suggestion.h"
#include "scene/scene_members.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

constexpr std::size_t kPatchPoints = 16;

class ShapeReader {
 public:
  ShapeReader(SurfaceDesc& surface, SceneProblems& problems)
      : surface_(surface), problems_(problems), values_(problems) {}

  void readAny(const JsonValue& value);

 private:
  void readFormula(const JsonValue& value);
  void readRevolve(const JsonValue& value);
  void readTube(const JsonValue& value);
  void readBezier(const JsonValue& value);
  void readMesh(const JsonValue& value);
  void readCloth(const JsonValue& value);
  bool readPins(const JsonValue& value, std::vector<ClothPinDesc>& pins);
  bool readBall(const JsonValue& value, std::optional<ClothBallDesc>& ball);
  void readCatalogued(const JsonValue& value, const JsonValue& type, const CatalogueEntry& entry);

  bool readArgument(const JsonValue& value, const CatalogueArgument& argument, NamedShape& shape);
  bool readClosed(const JsonValue& value, FormulaShape& shape);
  bool readPoints(const JsonValue& value, std::vector<Quantity3>& points);
  bool readWholePatches(const JsonValue& value, BezierShape& shape);
  bool readPatches(const JsonValue& value, BezierShape& shape);
  bool readPatch(const JsonValue& value, BezierShape& shape);
  bool hasPatchPoints(const JsonValue& value);
  bool readSegments(const JsonValue& value) { return values_.read(value, surface_.segments); }

  SurfaceDesc& surface_;
  SceneProblems& problems_;
  SceneValues values_;
};

/// The member "type" of an object, if there is one.
JsonValue typeOf(const JsonValue& object) {
  for (JsonValue member = object.first(); member.exists(); member = member.next())
    if (object.kind() == JsonKind::Object && member.key() == "type") return member;
  return {};
}

void ShapeReader::readAny(const JsonValue& value) {
  if (value.kind() != JsonKind::Object) {
    values_.reject(value, "a surface: an object", R"(write { "type": "sphere", "radius": 1 })");
    return;
  }
  const JsonValue type = typeOf(value);
  const std::size_t begin = value.where().begin;
  if (!type.exists()) {
    problems_.add(SourceRange{begin, begin + 1}, "a surface needs \"type\"",
                  fmt::format("one of {}", listed(surfaceTypes())));
    return;
  }
  std::string name;
  if (!values_.read(type, name)) return;
  if (name == "formula") return readFormula(value);
  if (name == "revolve") return readRevolve(value);
  if (name == "tube") return readTube(value);
  if (name == "bezier") return readBezier(value);
  if (name == "mesh") return readMesh(value);
  if (name == "cloth") return readCloth(value);
  if (const CatalogueEntry* entry = findCatalogueEntry(name)) return readCatalogued(value, type, *entry);
  const std::vector<std::string> types = surfaceTypes();
  problems_.add(type.where(), fmt::format("unknown surface type '{}'", name),
                didYouMean(name, types, fmt::format("one of {}", listed(types))));
}

void ShapeReader::readFormula(const JsonValue& value) {
  const SceneMembers members(value, keys::kFormula, problems_);
  FormulaShape shape;
  bool good = members.complete();
  good = values_.read(members["u"], shape.u) && good;
  good = values_.read(members["v"], shape.v) && good;
  good = readClosed(members["closed"], shape) && good;
  good = values_.read(members["let"], shape.let) && good;
  good = values_.read(members["position"], shape.position) && good;
  good = readSegments(members["segments"]) && good;
  if (good) surface_.shape = std::move(shape);
}

void ShapeReader::readRevolve(const JsonValue& value) {
  const SceneMembers members(value, keys::kRevolve, problems_);
  RevolveShape shape;
  bool good = members.complete();
  good = values_.read(members["u"], shape.u) && good;
  good = values_.read(members["v"], shape.v) && good;
  good = values_.read(members["let"], shape.let) && good;
  good = values_.read(members["radius"], shape.radius) && good;
  good = values_.read(members["height"], shape.height) && good;
  good = readSegments(members["segments"]) && good;
  if (good) surface_.shape = std::move(shape);
}

void ShapeReader::readTube(const JsonValue& value) {
  const SceneMembers members(value, keys::kTube, problems_);
  TubeShape shape;
  bool good = members.complete();
  good = values_.read(members["u"], shape.u) && good;
  good = values_.read(members["let"], shape.let) && good;
  good = values_.read(members["curve"], shape.curve) && good;
  good = values_.read(members["radius"], shape.radius) && good;
  good = readSegments(members["segments"]) && good;
  if (good) surface_.shape = std::move(shape);
}

void ShapeReader::readBezier(const JsonValue& value) {
  const SceneMembers members(value, keys::kBezier, problems_);
  BezierShape shape;
  bool good = members.complete() && readSegments(members["segments"]);
  if (const JsonValue patches = members["patches"]; patches.exists())
    good = readPoints(members["control_points"], shape.points) && readPatches(patches, shape) && good;
  else
    good = readWholePatches(members["control_points"], shape) && good;
  if (good) surface_.shape = std::move(shape);
}

void ShapeReader::readMesh(const JsonValue& value) {
  const SceneMembers members(value, keys::kMesh, problems_);
  MeshShape shape;
  bool good = members.complete();
  good = values_.read(members["file"], shape.file) && good;
  good = values_.readWord(members["normals"], keys::kNormalRules, shape.normals) && good;
  good = values_.read(members["crease"], shape.crease) && good;
  if (good) surface_.shape = std::move(shape);
}

void ShapeReader::readCloth(const JsonValue& value) {
  const SceneMembers members(value, keys::kCloth, problems_);
  ClothShape shape;
  bool good = members.complete();
  good = values_.read(members["cells"], shape.cells) && good;
  good = values_.read(members["size"], shape.size) && good;
  good = values_.read(members["density"], shape.density) && good;
  good = values_.read(members["stretch"], shape.stretch) && good;
  good = values_.read(members["shear"], shape.shear) && good;
  good = values_.read(members["bend"], shape.bend) && good;
  good = values_.read(members["damping"], shape.damping) && good;
  good = values_.read(members["gravity"], shape.gravity) && good;
  good = values_.read(members["step"], shape.step) && good;
  good = readPins(members["pins"], shape.pins) && good;
  good = readBall(members["ball"], shape.ball) && good;
  if (good) surface_.shape = std::move(shape);
}

bool ShapeReader::readPins(const JsonValue& value, std::vector<ClothPinDesc>& pins) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Array)
    return values_.reject(value, "an array of corners, edges and points [u, v]",
                          R"(write "pins": ["back_left", "back_right", [0.5, 1]])");
  bool good = true;
  for (JsonValue element = value.first(); element.exists(); element = element.next()) {
    ClothPinDesc& pin = pins.emplace_back();
    if (element.kind() != JsonKind::String) {
      good = values_.read(element, pin.point) && good;
      continue;
    }
    std::size_t word = 0;
    good = values_.readWord(element, keys::kClothPins, word) && values_.read(element, pin.name) && good;
  }
  return good;
}

bool ShapeReader::readBall(const JsonValue& value, std::optional<ClothBallDesc>& ball) {
  if (!value.exists()) return true;
  const SceneMembers members(value, keys::kClothBall, problems_);
  ClothBallDesc& read = ball.emplace();
  bool good = members.complete();
  good = values_.read(members["radius"], read.radius) && good;
  good = values_.read(members["center"], read.center) && good;
  return values_.read(members["friction"], read.friction) && good;
}

void ShapeReader::readCatalogued(const JsonValue& value, const JsonValue& type, const CatalogueEntry& entry) {
  std::vector<std::string> names;
  for (const CatalogueArgument& argument : entry.arguments) names.emplace_back(argument.name);
  const std::string what = fmt::format("a surface of type {}", entry.name);
  const SceneKeys kind{what, {}, keys::kNamedNames, 1};
  const SceneMembers members(value, kind, problems_, names);
  NamedShape shape{.type = FileName(std::string(entry.name), placeOf(type.where()))};
  bool good = readSegments(members["segments"]);
  for (JsonValue member = value.first(); member.exists(); member = member.next())
    for (const CatalogueArgument& argument : entry.arguments)
      if (member.key() == argument.name) good = readArgument(member, argument, shape) && good;
  if (good) surface_.shape = std::move(shape);
}

bool ShapeReader::readArgument(const JsonValue& value, const CatalogueArgument& argument, NamedShape& shape) {
  NamedShape::Argument& read = shape.arguments.emplace_back();
  read.name = FileName(std::string(argument.name), placeOf(value.keyWhere()));
  read.values.resize(argument.initial.size());
  if (read.values.size() == 1) return values_.read(value, read.values[0]);
  return values_.readArray(value, read.values);
}

bool ShapeReader::readClosed(const JsonValue& value, FormulaShape& shape) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Array || value.size() != 2)
    return values_.reject(value, "two of true and false, for u and v");
  std::array<bool, 2>& closed = shape.closed.emplace();
  shape.closedPlace = placeOf(value.where());
  const JsonValue first = value.first();
  return values_.read(first, closed[0]) && values_.read(first.next(), closed[1]);
}

bool ShapeReader::readPoints(const JsonValue& value, std::vector<Quantity3>& points) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Array) return values_.reject(value, "an array of points [x, y, z]");
  bool good = true;
  for (JsonValue point = value.first(); point.exists(); point = point.next())
    good = values_.read(point, points.emplace_back()) && good;
  return good;
}

bool ShapeReader::hasPatchPoints(const JsonValue& value) {
  if (value.kind() != JsonKind::Array) return values_.reject(value, "an array of 16 control points");
  if (value.size() == kPatchPoints) return true;
  problems_.add(value.where(), fmt::format("a patch has 16 control points, this one {}", value.size()));
  return false;
}

bool ShapeReader::readWholePatches(const JsonValue& value, BezierShape& shape) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Array) return values_.reject(value, "an array of patches of 16 points");
  bool good = true;
  for (JsonValue patch = value.first(); patch.exists(); patch = patch.next()) {
    std::array<std::uint32_t, kPatchPoints>& indices = shape.patches.emplace_back();
    std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(shape.points.size()));
    good = hasPatchPoints(patch) && readPoints(patch, shape.points) && good;
  }
  return good;
}

bool ShapeReader::readPatches(const JsonValue& value, BezierShape& shape) {
  if (value.kind() != JsonKind::Array) return values_.reject(value, "an array of patches of 16 indices");
  bool good = true;
  for (JsonValue patch = value.first(); patch.exists(); patch = patch.next())
    good = hasPatchPoints(patch) && readPatch(patch, shape) && good;
  return good;
}

bool ShapeReader::readPatch(const JsonValue& value, BezierShape& shape) {
  std::array<std::uint32_t, kPatchPoints>& indices = shape.patches.emplace_back();
  std::size_t i = 0;
  for (JsonValue element = value.first(); element.exists(); element = element.next()) {
    if (element.kind() != JsonKind::Number) return values_.reject(element, "the index of a control point");
    const double index = element.number();
    if (!(index >= 0 && index < static_cast<double>(shape.points.size()) && index == std::floor(index))) {
      problems_.add(element.where(), fmt::format("there is no control point {}", index),
                    fmt::format("they count from 0 to {}", shape.points.size() - 1));
      return false;
    }
    indices[i++] = static_cast<std::uint32_t>(index);
  }
  return true;
}

}  // namespace

std::vector<std::string> surfaceTypes() {
  std::vector<std::string> types = strings(keys::kShapeTypes);
  for (const CatalogueEntry& entry : catalogue()) types.emplace_back(entry.name);
  return types;
}

SurfaceDesc readSurface(const JsonValue& value, FileName name, SceneProblems& problems) {
  SurfaceDesc surface{.name = std::move(name), .shape = {}};
  ShapeReader(surface, problems).readAny(value);
  return surface;
}

}  // namespace luxo
