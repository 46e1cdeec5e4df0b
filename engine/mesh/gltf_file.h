// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 file (Khronos, glTF 2.0 specification): its JSON, its buffers, and what its accessors see of
// them. All that a file says is checked here before it is used.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/model_source.h"

namespace luxo {

using Json = nlohmann::json;

/// A value of the JSON and where it is, for messages: "nodes[3].mesh".
class GltfValue {
 public:
  GltfValue(const ModelSource& source, const Json& json, std::string place)
      : source_(&source), json_(&json), place_(std::move(place)) {}

  [[nodiscard]] bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  /// A member; null where there is none.
  [[nodiscard]] GltfValue operator[](const char* key) const;
  /// An element of an array, which must have it.
  [[nodiscard]] GltfValue operator[](std::size_t i) const;
  /// Of an array; 0 of null. Error(Scene): something else.
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool given() const { return !json_->is_null(); }

  /// Each checks what it is; `otherwise` stands for null.
  [[nodiscard]] double number() const;
  [[nodiscard]] double numberOr(double otherwise) const { return given() ? number() : otherwise; }
  /// From 0 to below `end`.
  [[nodiscard]] std::uint64_t integer(std::uint64_t end = std::uint64_t(1) << 53) const;
  [[nodiscard]] std::uint64_t integerOr(std::uint64_t otherwise) const {
    return given() ? integer() : otherwise;
  }
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string textOr(const char* otherwise) const { return given() ? text() : otherwise; }
  [[nodiscard]] bool flagOr(bool otherwise) const;
  template <class V>
  [[nodiscard]] V vectorOr(const V& otherwise) const {
    if (!given()) return otherwise;
    if (size() != std::size_t(V::length())) refuse(fmt::format("{} numbers, not {}", size(), V::length()));
    V v;
    for (int i = 0; i < V::length(); ++i) v[i] = (*this)[std::size_t(i)].number();
    return v;
  }
  /// A colour or another factor: none is below 0.
  [[nodiscard]] Vec3 colourOr(const Vec3& otherwise) const;

  [[noreturn]] void refuse(const std::string& why) const {
    refuseModel(source_->name(), place_ + ": " + why);
  }
  [[nodiscard]] const std::string& place() const { return place_; }

 private:
  const ModelSource* source_;
  const Json* json_;
  std::string place_;
};

class GltfFile {
 public:
  /// Reads JSON and buffers. The bytes must outlive it.
  GltfFile(const ModelSource& source, std::string_view bytes);

  [[nodiscard]] GltfValue root() const { return {source_, json_, "the file"}; }
  /// root()[key], whose place is its name alone.
  [[nodiscard]] GltfValue list(const char* key) const;

  /// Of a bufferView.
  [[nodiscard]] std::string_view view(std::uint64_t number) const;
  /// Its bytes, to be kept: one copy a view. Error(Scene): all copies together have more bytes than the file,
  /// as its views are of the same bytes.
  [[nodiscard]] FileBytes copyOf(std::uint64_t view);
  /// The numbers of an accessor, `components` an element; normalised ones are. Error(Scene): it has another
  /// number of them, sees beyond its buffer, or holds what is not finite.
  [[nodiscard]] std::vector<float> floats(std::uint64_t accessor, std::size_t components);
  [[nodiscard]] std::vector<std::uint32_t> integers(std::uint64_t accessor);
  /// The bytes of an address: "data:...;base64,...", or of a file beside the model.
  [[nodiscard]] static std::vector<std::byte> decodedData(const GltfValue& uri);
  [[nodiscard]] static bool isData(std::string_view uri) { return uri.starts_with("data:"); }
  /// With its %20s as blanks.
  [[nodiscard]] static std::string decodedName(std::string_view uri);

 private:
  struct Elements;
  struct Accessor;
  [[nodiscard]] Accessor accessor(std::uint64_t number, std::size_t components);
  void readSparse(const GltfValue& sparse, Accessor& accessor) const;
  /// Of an object with a bufferView and an offset; what they are, and how many, is known.
  [[nodiscard]] Elements elementsOf(const GltfValue& array, Elements elements) const;

  const ModelSource& source_;
  Json json_;
  std::string_view binary_;  ///< GLB's own
  std::vector<FileBytes> owned_;
  std::vector<std::string_view> buffers_;
  std::uint64_t allowance_ = 0;  ///< numbers that may still be read
  std::map<std::uint64_t, FileBytes> copies_;
  std::uint64_t copyable_ = 0;  ///< bytes that may still be copied
};

}  // namespace luxo
