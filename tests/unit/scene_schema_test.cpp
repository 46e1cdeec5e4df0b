// SPDX-License-Identifier: Apache-2.0
// The published JSON Schema says what the reader does: the same keys, the same words, the same surfaces; what
// luxo writes and comes with is valid by it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scene/json.h"
#include "scene/json_writer.h"
#include "scene/scene_keys.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/shape_reader.h"
#include "scene_examples.h"
#include "scenes/embedded_scenes.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

JsonDocument readDocument(std::string text) {
  return JsonDocument(std::make_shared<const std::string>(std::move(text)));
}

JsonValue member(const JsonValue& object, std::string_view name) {
  for (JsonValue m = object.first(); m.exists(); m = m.next())
    if (object.kind() == JsonKind::Object && m.key() == name) return m;
  return {};
}

std::set<std::string> keysOf(const JsonValue& object) {
  std::set<std::string> keys;
  for (JsonValue m = object.first(); m.exists(); m = m.next()) keys.insert(m.key());
  return keys;
}

/// The texts of an array.
std::vector<std::string> textsOf(const JsonValue& array) {
  std::vector<std::string> texts;
  for (JsonValue e = array.first(); e.exists(); e = e.next()) texts.push_back(e.string());
  return texts;
}

JsonText copied(const JsonValue& value) {
  JsonText copy = value.kind() == JsonKind::Object ? JsonText::object() : JsonText::array();
  switch (value.kind()) {
    case JsonKind::Object:
      for (JsonValue m = value.first(); m.exists(); m = m.next()) copy.add(m.key(), copied(m));
      return copy;
    case JsonKind::Array:
      for (JsonValue e = value.first(); e.exists(); e = e.next()) copy.add(copied(e));
      return copy;
    case JsonKind::Number:
      return JsonText::number(value.number());
    case JsonKind::String:
      return JsonText::string(value.string());
    default:
      return JsonText::boolean(value.kind() == JsonKind::True);
  }
}

std::string textOf(const JsonValue& value) { return copied(value).text(); }

/// The part of JSON Schema 2020-12 that the schema uses; any other keyword fails the test.
class Validator {
 public:
  explicit Validator(const JsonValue& root) : root_(root) {}

  /// What is wrong, or nothing.
  std::string check(const JsonValue& value, const JsonValue& schema) const {
    if (schema.kind() == JsonKind::True) return {};
    if (schema.kind() == JsonKind::False) return "nothing is allowed here: " + textOf(value);
    for (JsonValue keyword = schema.first(); keyword.exists(); keyword = keyword.next()) {
      const std::string problem = checkKeyword(value, keyword, schema);
      if (!problem.empty()) return problem;
    }
    return {};
  }

 private:
  std::string checkKeyword(const JsonValue& value, const JsonValue& keyword, const JsonValue& schema) const {
    const std::string name = keyword.key();
    const auto failed = [&](bool good) {
      return good ? std::string() : fmt::format("{} is not {} {}", textOf(value), name, textOf(keyword));
    };
    const bool array = value.kind() == JsonKind::Array, object = value.kind() == JsonKind::Object;
    if (name == "$ref") return check(value, definition(keyword.string()));
    if (name == "const") return failed(textOf(value) == textOf(keyword));
    if (name == "enum") {
      for (JsonValue e = keyword.first(); e.exists(); e = e.next())
        if (textOf(e) == textOf(value)) return {};
      return failed(false);
    }
    if (name == "type") {
      for (JsonValue e = keyword.first(); e.exists(); e = e.next())
        if (hasType(value, e.string())) return {};
      return failed(keyword.kind() == JsonKind::String && hasType(value, keyword.string()));
    }
    if (name == "anyOf") {
      for (JsonValue e = keyword.first(); e.exists(); e = e.next())
        if (check(value, e).empty()) return {};
      return failed(false);
    }
    if (name == "items") {
      for (JsonValue e = value.first(); array && e.exists(); e = e.next())
        if (const std::string problem = check(e, keyword); !problem.empty()) return problem;
      return {};
    }
    if (name == "minItems") return failed(!array || double(value.size()) >= keyword.number());
    if (name == "maxItems") return failed(!array || double(value.size()) <= keyword.number());
    if (name == "minLength")
      return failed(value.kind() != JsonKind::String || double(value.string().size()) >= keyword.number());
    if (name == "minimum")
      return failed(value.kind() != JsonKind::Number || value.number() >= keyword.number());
    if (name == "required") {
      const std::set<std::string> keys = keysOf(value);
      for (const std::string& key : textsOf(keyword))
        if (object && !keys.contains(key)) return fmt::format("{} is missing in {}", key, textOf(value));
      return {};
    }
    if (name == "additionalProperties") return object ? checkMembers(value, schema) : std::string();
    const std::set<std::string> silent = {
        "$schema", "$id", "$defs", "title", "description", "properties", "patternProperties"};
    return silent.contains(name) ? "" : "unknown keyword " + name;
  }

  std::string checkMembers(const JsonValue& value, const JsonValue& schema) const {
    const JsonValue properties = member(schema, "properties"),
                    others = member(schema, "additionalProperties");
    // Of what has names of its own, as uniforms, all are.
    const JsonValue free = member(schema, "patternProperties");
    if (free.exists() || others.kind() != JsonKind::Object) {
      EXPECT_EQ(textOf(free), R"({ "^x-": true })");
    }
    for (JsonValue m = value.first(); m.exists(); m = m.next()) {
      if (m.key().starts_with("x-")) continue;
      const JsonValue property = properties.exists() ? member(properties, m.key()) : JsonValue();
      const std::string problem = check(m, property.exists() ? property : others);
      if (!problem.empty()) return m.key() + ": " + problem;
    }
    return {};
  }

  [[nodiscard]] JsonValue definition(const std::string& reference) const {
    const std::string prefix = "#/$defs/";
    const JsonValue found = member(member(root_, "$defs"), reference.substr(prefix.size()));
    EXPECT_TRUE(reference.starts_with(prefix) && found.exists()) << reference;
    return found;
  }

  static bool hasType(const JsonValue& value, const std::string& type) {
    switch (value.kind()) {
      case JsonKind::Number:
        return type == "number" || (type == "integer" && value.number() == std::floor(value.number()));
      case JsonKind::String:
        return type == "string";
      case JsonKind::Array:
        return type == "array";
      case JsonKind::Object:
        return type == "object";
      case JsonKind::Null:
        return type == "null";
      default:
        return type == "boolean";
    }
  }

  JsonValue root_;
};

class SceneSchema : public testing::Test {
 protected:
  SceneSchema() {
    EXPECT_TRUE(document_.complete());
    EXPECT_TRUE(document_.diagnostics().empty());
  }

  [[nodiscard]] JsonValue root() const { return document_.root(); }
  [[nodiscard]] JsonValue definition(std::string_view name) const {
    return name.empty() ? root() : member(member(root(), "$defs"), name);
  }
  [[nodiscard]] std::string check(const std::string& text) const {
    const JsonDocument scene = readDocument(text);
    EXPECT_TRUE(scene.complete());
    return Validator(root()).check(scene.root(), root());
  }

  JsonDocument document_ = readDocument(test::sourceText("engine/scene/luxo-scene-1.schema.json"));
};

TEST_F(SceneSchema, HasTheKeysOfTheReader) {
  for (const SceneKeys& kind : keys::kAll) {
    const JsonValue schema = definition(kind.definition);
    ASSERT_TRUE(schema.exists()) << kind.definition;
    const std::vector<std::string> names(kind.keys.begin(), kind.keys.end());
    EXPECT_EQ(keysOf(member(schema, "properties")), std::set<std::string>(names.begin(), names.end()))
        << kind.definition;
    const JsonValue required = member(schema, "required");
    EXPECT_EQ(required.exists() ? textsOf(required) : std::vector<std::string>(),
              std::vector<std::string>(names.begin(), names.begin() + std::ptrdiff_t(kind.required)))
        << kind.definition;
    EXPECT_EQ(textOf(member(schema, "additionalProperties")), "false") << kind.definition;
    EXPECT_EQ(textOf(member(schema, "patternProperties")), R"({ "^x-": true })") << kind.definition;
  }
}

TEST_F(SceneSchema, HasTheWordsOfTheReader) {
  const auto words = [&](const char* kind, const char* key) {
    return textsOf(member(member(member(definition(kind), "properties"), key), "enum"));
  };
  const auto strings = [](auto names) { return std::vector<std::string>(names.begin(), names.end()); };
  EXPECT_EQ(words("light", "type"), strings(keys::kLightTypes));
  EXPECT_EQ(words("light", "attenuation"), strings(keys::kAttenuations));
  EXPECT_EQ(words("light", "shadow"), strings(keys::kShadows));
  EXPECT_EQ(words("camera", "type"), strings(keys::kProjections));
  EXPECT_EQ(textsOf(member(definition("shading"), "enum")), strings(kShadingNames));
  EXPECT_EQ(words("normal_map", "space"), strings(keys::kNormalSpaces));
  std::vector<std::string> ofMaterials = strings(keys::kMaterialShadings);
  std::erase(ofMaterials, "residual");
  EXPECT_EQ(words("material", "shading"), ofMaterials);
}

/// What the schema says about a surface of the catalogue.
JsonText expectedDefinition(const CatalogueEntry& entry) {
  const auto reference = [](const std::string& name, std::string_view description = {}) {
    JsonText object = JsonText::object();
    if (!description.empty()) object.add("description", JsonText::string(description));
    object.add("$ref", JsonText::string("#/$defs/" + name));
    return object;
  };
  JsonText type = JsonText::object(), properties = JsonText::object(), required = JsonText::array(),
           free = JsonText::object(), schema = JsonText::object();
  type.add("const", JsonText::string(entry.name));
  properties.add("type", type);
  for (const CatalogueArgument& argument : entry.arguments) {
    const std::vector<std::string> kinds = {"number", "pair", "vector"};
    properties.add(argument.name, reference(kinds.at(argument.initial.size() - 1), argument.meaning));
  }
  properties.add("segments", reference("segments"));
  required.add(JsonText::string("type"));
  free.add("^x-", JsonText::boolean(true));
  schema.add("description", JsonText::string(entry.summary));
  schema.add("type", JsonText::string("object"));
  schema.add("properties", properties);
  schema.add("required", required);
  schema.add("patternProperties", free);
  schema.add("additionalProperties", JsonText::boolean(false));
  return schema;
}

TEST_F(SceneSchema, HasTheSurfacesOfTheCatalogue) {
  for (const CatalogueEntry& entry : catalogue()) {
    const std::string name = "surface_" + std::string(entry.name);
    const JsonValue schema = definition(name);
    const std::string expected = expectedDefinition(entry).text();
    EXPECT_TRUE(schema.exists() && textOf(schema) == expected)
        << "the schema needs\n\"" << name << "\": " << expected;
  }
  std::vector<std::string> references;
  for (const std::string& type : surfaceTypes()) references.push_back("#/$defs/surface_" + type);
  std::vector<std::string> found;
  for (JsonValue e = member(definition("surface"), "anyOf").first(); e.exists(); e = e.next())
    found.push_back(member(e, "$ref").string());
  EXPECT_EQ(found, references);
  for (const std::string& name : keysOf(member(root(), "$defs")))
    EXPECT_EQ(std::ranges::count(references, "#/$defs/" + name), name.starts_with("surface_") ? 1 : 0)
        << name;
}

TEST_F(SceneSchema, TakesTheExamplesAndWhatIsWritten) {
  for (const std::filesystem::path& path : test::exampleScenes()) {
    const std::string text = test::sourceText("apps/scenes/" + path.filename().string());
    EXPECT_EQ(check(text), "") << path;
    EXPECT_EQ(check(writeScene(parseScene(text, "s"))), "") << path;
  }
  for (const EmbeddedScene& scene : galleryScenes())
    EXPECT_EQ(check(std::string(scene.text)), "") << scene.name;
}

// A schema that takes everything would pass the above.
TEST_F(SceneSchema, RefusesWhatTheReaderRefuses) {
  for (const char* const text :
       {"{}", R"({ "luxo": 2 })", R"({ "luxo": 1, "node": [] })", R"({ "luxo": 1, "nodes": {} })",
        R"({ "luxo": 1, "nodes": [ { "translate": [1, 2] } ] })",
        R"({ "luxo": 1, "nodes": [ { "name": "" } ] })",
        R"({ "luxo": 1, "nodes": [ { "children": [ { "x": 1 } ] } ] })",
        R"({ "luxo": 1, "nodes": [ { "light": { "type": "spot" } } ] })",
        R"({ "luxo": 1, "nodes": [ { "rotate": { "angle": 1 } } ] })",
        R"({ "luxo": 1, "params": { "k": { "range": [0, 1] } } })",
        R"({ "luxo": 1, "materials": { "m": { "two_sided": "yes" } } })",
        R"({ "luxo": 1, "surfaces": { "s": { "type": "shpere" } } })",
        R"({ "luxo": 1, "surfaces": { "s": { "type": "sphere", "radios": 1 } } })",
        R"({ "luxo": 1, "surfaces": { "s": { "type": "formula" } } })",
        R"({ "luxo": 1, "camera": { "fov": 1 } })"}) {
    EXPECT_NE(check(text), "") << text;
    EXPECT_ANY_THROW(static_cast<void>(parseScene(text, "s"))) << text;
  }
}

}  // namespace
}  // namespace luxo
