// SPDX-License-Identifier: Apache-2.0
#include "mesh/mtl.h"

#include <algorithm>
#include <array>

#include "mesh/text_lines.h"

namespace luxo {
namespace {

class MtlReader {
 public:
  MtlReader(const ModelSource& source, std::string_view name, std::string_view text, Model& model)
      : source_(source), lines_(name, text, true), model_(model) {}

  void read(MtlLibrary& library) {
    while (lines_.nextLine()) {
      const std::string_view key = lines_.word();
      if (key == "newmtl") {
        finish(library);
        name_ = lines_.rest();
        material_ = {.name = printable(name_)};
        named_ = true;
      } else if (!named_) {
        lines_.refuse(fmt::format("'{}' before any newmtl", TextLines::shown(key)));
      } else {
        readKey(key);
      }
    }
    finish(library);
  }

 private:
  void readKey(std::string_view key) {
    if (key == "Kd")
      material_.diffuse = colour("Kd"), diffuseGiven_ = true;
    else if (key == "Ks")
      material_.specular = colour("Ks"), specularGiven_ = true;
    else if (key == "Ke")
      material_.glow = colour("Ke");
    else if (key == "Ns")
      material_.shininess = atLeast0(lines_.number("Ns"), "Ns");
    else if (key == "d")
      readOpacity(false);
    else if (key == "Tr")
      readOpacity(true);
    else if (key == "map_Kd")
      material_.map = map();
    else if (key == "map_Ks")
      material_.specularMap = map();
    else if (key == "map_Ke")
      material_.glowMap = map();
    else if (key == "norm")
      material_.normalMap = map();
    else if (key == "map_Bump" || key == "map_bump" || key == "bump")
      readBump();
    else if (key == "map_d")
      alphaMap_ = map(), alphaLine_ = lines_.line();
    else if (key.starts_with("map_") || key == "disp" || key == "decal" || key == "refl")
      ignore(key);
  }

  // Of words that are no maps nothing is said: most files have illum, Ni, Tf, Ka whatever the material is.
  void ignore(std::string_view key) {
    if (ignored_.size() >= 8 || std::find(ignored_.begin(), ignored_.end(), key) != ignored_.end()) return;
    ignored_.emplace_back(key);
    model_.warnings.push_back(
        fmt::format("{}:{}: '{}' is not read", lines_.name(), lines_.line(), TextLines::shown(key)));
  }

  double atLeast0(double value, std::string_view what) const {
    if (value < 0) lines_.refuse(fmt::format("{} is {}, which is below 0", what, value));
    return value;
  }

  Vec3 colour(std::string_view what) {
    Vec3 colour;
    colour.x = atLeast0(lines_.number(what), what);
    const std::string_view second = lines_.word();
    if (second.empty()) return Vec3(colour.x);
    colour.y = atLeast0(lines_.numberOf(second, what), what);
    colour.z = atLeast0(lines_.number(what), what);
    return colour;
  }

  void readOpacity(bool transparency) {
    std::string_view word = lines_.word();
    if (word == "-halo") word = lines_.word();
    const double value = std::clamp(lines_.numberOf(word, "an opacity"), 0.0, 1.0);
    material_.opacity = transparency ? 1 - value : value;
  }

  void readBump() {
    if (material_.normalMap.given()) return;
    material_.normalMap = map();
    if (material_.normalMap.given())
      model_.warnings.push_back(
          fmt::format("{}:{}: the bump map is taken for a normal map", lines_.name(), lines_.line()));
  }

  // One to three numbers.
  Vec2 numbers(Vec2 otherwise, std::string_view& word) {
    for (int i = 0; i < 3; ++i) {
      word = lines_.word();
      const auto value = TextLines::parsed(word);
      if (!value) return otherwise;
      if (i < 2) otherwise[i] = lines_.numberOf(word, "a number of a map");
    }
    word = lines_.word();
    return otherwise;
  }

  // Options, then a name that may have blanks.
  ModelMap map() {
    ModelMap map;
    Vec2 offset(0), scale(1);
    std::string_view word = lines_.word();
    while (word.size() > 1 && word.front() == '-') {
      if (word == "-o") {
        offset = numbers(offset, word);
      } else if (word == "-s") {
        scale = numbers(scale, word);
      } else if (word == "-t") {
        numbers(scale, word);
      } else {
        const bool two = word == "-mm", clamp = word == "-clamp", bump = word == "-bm";
        const std::string_view value = lines_.word();
        if (clamp && value == "on") map.wrapU = map.wrapV = ModelMap::Wrap::Clamp;
        if (bump) material_.normalScale = lines_.numberOf(value, "-bm");
        if (two) (void)lines_.word();
        word = lines_.word();
      }
    }
    if (word.empty()) lines_.refuse("a map without a file");
    const std::string_view rest = lines_.rest();
    const std::string_view name(
        word.data(), rest.empty() ? word.size() : std::size_t(rest.data() + rest.size() - word.data()));
    map.image = source_.image(model_, name, lines_.name(), lines_.line());
    // In a model v counts from the top.
    map.offset = Vec2(offset.x, 1 - scale.y - offset.y);
    map.scale = scale;
    return map;
  }

  void finish(MtlLibrary& library) {
    if (!named_) return;
    const auto unmapped = [](const ModelMap& map, Vec3& colour, bool given) {
      if (map.given() && (!given || colour == Vec3(0))) colour = Vec3(1);
    };
    unmapped(material_.map, material_.diffuse, diffuseGiven_);
    unmapped(material_.specularMap, material_.specular, specularGiven_);
    unmapped(material_.glowMap, material_.glow, true);  // it is black where it is not given
    diffuseGiven_ = specularGiven_ = false;
    if (alphaMap_.given() && alphaMap_.image == material_.map.image)
      material_.opacityFromMap = true;
    else if (alphaMap_.given())
      model_.warnings.push_back(
          fmt::format("{}:{}: map_d is not the image of map_Kd, and is not read", lines_.name(), alphaLine_));
    alphaMap_ = {};
    library.try_emplace(name_, std::move(material_));
  }

  const ModelSource& source_;
  TextLines lines_;
  Model& model_;
  std::string name_;
  ModelMaterial material_;
  bool diffuseGiven_ = false, specularGiven_ = false;
  ModelMap alphaMap_;
  std::size_t alphaLine_ = 0;
  std::vector<std::string> ignored_;
  bool named_ = false;
};

}  // namespace

void readMtl(const ModelSource& source, std::string_view name, std::string_view text, Model& model,
             MtlLibrary& library) {
  MtlReader(source, name, text, model).read(library);
}

}  // namespace luxo
