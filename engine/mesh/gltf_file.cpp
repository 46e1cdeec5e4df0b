// SPDX-License-Identifier: Apache-2.0
#include "mesh/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/binary.h"

namespace luxo {
namespace {

const Json kNull;

// Accessors may share bytes; what reads each byte so often is an attack.
constexpr std::uint64_t kNumbersPerByte = 16;

constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

int sextetOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

GltfValue GltfValue::operator[](const char* key) const {
  return {*source_, has(key) ? (*json_)[key] : kNull, place_ == "the file" ? key : place_ + "." + key};
}
GltfValue GltfValue::operator[](std::size_t i) const {
  if (!json_->is_array() || i >= json_->size()) refuse(fmt::format("there is no element {}", i));
  return {*source_, (*json_)[i], fmt::format("{}[{}]", place_, i)};
}
std::size_t GltfValue::size() const {
  if (json_->is_null()) return 0;
  if (!json_->is_array()) refuse("it is no array");
  return json_->size();
}
double GltfValue::number() const {
  if (!json_->is_number()) refuse("it is no number");
  const double value = json_->get<double>();
  if (!(std::abs(value) <= kMaxCoordinate))
    refuse(fmt::format("{} is not within {:g}", value, kMaxCoordinate));
  return value;
}
std::uint64_t GltfValue::integer(std::uint64_t end) const {
  const double value = number();
  if (!(value >= 0 && value == std::floor(value) && value < double(end)))
    refuse(fmt::format("{} is not a whole number from 0 to {}", value, end == 0 ? 0 : end - 1));
  return std::uint64_t(value);
}
std::string GltfValue::text() const {
  if (!json_->is_string()) refuse("it is no text");
  return json_->get<std::string>();
}
bool GltfValue::flagOr(bool otherwise) const {
  if (!given()) return otherwise;
  if (!json_->is_boolean()) refuse("it is neither true nor false");
  return json_->get<bool>();
}
Vec3 GltfValue::colourOr(const Vec3& otherwise) const {
  const Vec3 colour = vectorOr(otherwise);
  if (std::min({colour.x, colour.y, colour.z}) < 0) refuse("a factor below 0");
  return colour;
}

GltfFile::GltfFile(const ModelSource& source, std::string_view bytes) : source_(source) {
  std::string_view text = bytes;
  const bool binary = bytes.size() >= 4 && readNumber<std::uint32_t>(bytes, 0, std::endian::little) == kMagic;
  if (binary) {
    if (bytes.size() < 20) refuseModel(source.name(), "it is shorter than a header; is it cut short?");
    const auto word = [&](std::size_t at) {
      return readNumber<std::uint32_t>(bytes, at, std::endian::little);
    };
    if (word(4) != 2)
      refuseModel(source.name(), fmt::format("version {} of GLB is not supported; 2 is", word(4)));
    if (word(8) > bytes.size())
      refuseModel(source.name(), fmt::format("its header promises {} bytes, and it has {}; is it cut short?",
                                             word(8), bytes.size()));
    for (std::size_t at = 12; bytes.size() - at >= 8;) {
      const std::size_t length = word(at), kind = word(at + 4);
      if (length > bytes.size() - at - 8)
        refuseModel(source.name(), fmt::format("byte {}: a chunk of {} bytes, and {} are left", at, length,
                                               bytes.size() - at - 8));
      const std::string_view chunk = bytes.substr(at + 8, length);
      if (at == 12 && kind != kJsonChunk) refuseModel(source.name(), "its first chunk is no JSON");
      if (at == 12) text = chunk;
      if (kind == kBinaryChunk && binary_.empty()) binary_ = chunk;
      at += 8 + length;
    }
  }
  try {
    json_ = Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const auto line =
        std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(std::min(error.byte, text.size())),
                               '\n')) +
        1;
    refuseModel(source.name(), fmt::format("it is no JSON at byte {}", error.byte), line);
  } catch (const Json::exception&) {
    refuseModel(source.name(), "it is no JSON: a number is too large");
  }
  if (!json_.is_object()) refuseModel(source.name(), "it is no glTF: its JSON is no object");
  if (const std::string version = root()["asset"]["version"].textOr(""); !version.starts_with("2."))
    refuseModel(source.name(), fmt::format("version '{}' of glTF is not supported; 2.0 is",
                                           printable(version.substr(0, 20))));
  if (const std::string needed = root()["asset"]["minVersion"].textOr("2.0");
      needed != "2.0" && !needed.starts_with("1."))
    refuseModel(source.name(), fmt::format("it needs version '{}' of glTF, which is not supported; 2.0 is",
                                           printable(needed.substr(0, 20))));

  const auto readFile = [&](const GltfValue& uri, const std::string& address) {
    const std::filesystem::path file = source.besides(decodedName(address), source.name(), 0);
    try {
      return source.from().read(file);
    } catch (const Error& error) {
      uri.refuse(error.what());
    }
  };
  allowance_ = bytes.size();
  const GltfValue buffers = list("buffers");
  owned_.reserve(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const GltfValue uri = buffers[i]["uri"];
    std::string_view buffer = binary_;
    if (uri.given()) {
      const std::string address = uri.text();
      owned_.push_back(isData(address) ? std::make_shared<const std::vector<std::byte>>(decodedData(uri))
                                       : readFile(uri, address));
      buffer = {reinterpret_cast<const char*>(owned_.back()->data()), owned_.back()->size()};
      if (!isData(address)) allowance_ += buffer.size();
    } else if (i != 0 || !binary) {
      uri.refuse("a buffer without bytes");
    }
    const std::uint64_t length = buffers[i]["byteLength"].integer();
    if (length > buffer.size())
      buffers[i].refuse(
          fmt::format("it promises {} bytes, and has {}; is the file cut short?", length, buffer.size()));
    buffers_.push_back(buffer.substr(0, length));
  }
  copyable_ = allowance_;
  allowance_ *= kNumbersPerByte;
}

GltfValue GltfFile::list(const char* key) const {
  const GltfValue value = root()[key];
  (void)value.size();
  return value;
}

std::string_view GltfFile::view(std::uint64_t number) const {
  const GltfValue view = list("bufferViews")[number];
  const std::string_view buffer = buffers_[view["buffer"].integer(buffers_.size())];
  const std::uint64_t offset = view["byteOffset"].integerOr(0), length = view["byteLength"].integer();
  if (offset > buffer.size() || length > buffer.size() - offset)
    view.refuse(fmt::format("bytes {} to {} of a buffer of {}", offset, offset + length, buffer.size()));
  return buffer.substr(offset, length);
}

FileBytes GltfFile::copyOf(std::uint64_t number) {
  FileBytes& copy = copies_[number];
  if (copy) return copy;
  const auto bytes = std::as_bytes(std::span(view(number)));
  if (bytes.size() > copyable_)
    list("bufferViews")[number].refuse("so much is read of the same bytes that it cannot be meant");
  copyable_ -= bytes.size();
  return copy = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
}

/// What is seen of a view: `count` elements, `stride` bytes apart; without bytes all are 0.
struct GltfFile::Elements {
  std::string_view bytes;
  std::size_t count = 0, stride = 0, components = 0, size = 0;
  std::uint64_t kind = 0;
  bool normalized = false;
  std::string place;

  [[nodiscard]] double at(std::size_t element, std::size_t component) const {
    if (bytes.empty()) return 0;
    const std::size_t offset = element * stride + component * size;
    constexpr auto kLittle = std::endian::little;
    switch (kind) {
      case 5120: {
        const auto value = readNumber<std::int8_t>(bytes, offset, kLittle);
        return normalized ? std::max(value / 127.0, -1.0) : value;
      }
      case 5121: {
        const auto value = readNumber<std::uint8_t>(bytes, offset, kLittle);
        return normalized ? value / 255.0 : value;
      }
      case 5122: {
        const auto value = readNumber<std::int16_t>(bytes, offset, kLittle);
        return normalized ? std::max(value / 32767.0, -1.0) : value;
      }
      case 5123: {
        const auto value = readNumber<std::uint16_t>(bytes, offset, kLittle);
        return normalized ? value / 65535.0 : value;
      }
      case 5125:
        return readNumber<std::uint32_t>(bytes, offset, kLittle);
      default:
        return double(readNumber<float>(bytes, offset, kLittle));
    }
  }
};

/// Elements, some of which others replace.
struct GltfFile::Accessor {
  Elements elements;
  Elements places, replacements;  ///< as many of the one as of the other

  /// convert(value, element, component), element by element.
  template <class Convert>
  [[nodiscard]] auto numbers(const Convert& convert) const {
    std::vector<decltype(convert(0.0, std::size_t(0), std::size_t(0)))> numbers;
    numbers.reserve(elements.count * elements.components);
    for (std::size_t i = 0; i < elements.count; ++i)
      for (std::size_t c = 0; c < elements.components; ++c)
        numbers.push_back(convert(elements.at(i, c), i, c));
    for (std::size_t k = 0; k < places.count; ++k) {
      const auto i = static_cast<std::size_t>(places.at(k, 0));
      for (std::size_t c = 0; c < elements.components; ++c)
        numbers[i * elements.components + c] = convert(replacements.at(k, c), i, c);
    }
    return numbers;
  }
};

namespace {

std::size_t sizeOfComponent(const GltfValue& type) {
  switch (type.integer()) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      type.refuse(fmt::format("{} is no type of numbers", type.integer()));
  }
}

bool isUnsigned(std::uint64_t kind) { return kind == 5121 || kind == 5123 || kind == 5125; }

}  // namespace

GltfFile::Elements GltfFile::elementsOf(const GltfValue& array, Elements elements) const {
  elements.bytes = view(array["bufferView"].integer());
  const std::size_t bytes = elements.components * elements.size;
  const GltfValue stride = list("bufferViews")[array["bufferView"].integer()]["byteStride"];
  elements.stride = stride.integerOr(bytes);
  if (elements.stride < bytes)
    stride.refuse(fmt::format("{} bytes between elements of {}", elements.stride, bytes));
  const std::uint64_t offset = array["byteOffset"].integerOr(0);
  if (elements.count > 0 && (offset > elements.bytes.size() || bytes > elements.bytes.size() - offset ||
                             elements.count - 1 > (elements.bytes.size() - offset - bytes) / elements.stride))
    array.refuse(fmt::format("{} elements of {} bytes do not fit the {} of its view", elements.count, bytes,
                             elements.bytes.size()));
  if (elements.count > 0) elements.bytes.remove_prefix(offset);
  return elements;
}

GltfFile::Accessor GltfFile::accessor(std::uint64_t number, std::size_t components) {
  const GltfValue value = list("accessors")[number];
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kTypes = {
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const std::string type = value["type"].text();
  const auto known =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == type; });
  if (known == kTypes.end() || known->second != components)
    value.refuse(fmt::format("its type is '{}', and {} numbers are wanted", printable(type.substr(0, 20)),
                             components));
  Accessor accessor{.elements = {.count = value["count"].integer(kMaxCorners),
                                 .components = components,
                                 .size = sizeOfComponent(value["componentType"]),
                                 .kind = value["componentType"].integer(),
                                 .normalized = value["normalized"].flagOr(false),
                                 .place = value.place()}};
  if (value.has("bufferView")) accessor.elements = elementsOf(value, accessor.elements);
  if (accessor.elements.count * components > allowance_)
    value.refuse("so much is read of the same bytes that it cannot be meant");
  allowance_ -= accessor.elements.count * components;
  if (value.has("sparse")) readSparse(value["sparse"], accessor);
  return accessor;
}

void GltfFile::readSparse(const GltfValue& sparse, Accessor& accessor) const {
  const std::size_t count = sparse["count"].integer(accessor.elements.count + 1);
  const GltfValue indices = sparse["indices"], type = indices["componentType"];
  accessor.places = elementsOf(
      indices, {.count = count, .components = 1, .size = sizeOfComponent(type), .kind = type.integer()});
  if (!isUnsigned(accessor.places.kind)) type.refuse("indices are unsigned");
  for (std::size_t k = 0; k < count; ++k) {
    const double place = accessor.places.at(k, 0);
    if (!(place < double(accessor.elements.count)))
      indices.refuse(fmt::format("there is element {} of {}", place, accessor.elements.count));
    if (k > 0 && !(accessor.places.at(k - 1, 0) < place))
      indices.refuse(fmt::format("element {} does not come after {}", place, accessor.places.at(k - 1, 0)));
  }
  accessor.replacements = accessor.elements;
  accessor.replacements.count = count;
  accessor.replacements = elementsOf(sparse["values"], accessor.replacements);
}

std::vector<float> GltfFile::floats(std::uint64_t number, std::size_t components) {
  const Accessor accessor = this->accessor(number, components);
  return accessor.numbers([&](double value, std::size_t i, std::size_t c) {
    if (!(std::abs(value) <= kMaxCoordinate))
      refuseModel(source_.name(),
                  fmt::format("{}: number {} of element {} is {}", accessor.elements.place, c, i, value));
    return float(value);
  });
}

std::vector<std::uint32_t> GltfFile::integers(std::uint64_t number) {
  const Accessor accessor = this->accessor(number, 1);
  if (!isUnsigned(accessor.elements.kind))
    refuseModel(source_.name(), accessor.elements.place + ": indices are unsigned");
  return accessor.numbers([](double value, std::size_t, std::size_t) { return std::uint32_t(value); });
}

std::vector<std::byte> GltfFile::decodedData(const GltfValue& uri) {
  const std::string address = uri.text();
  const std::size_t comma = address.find(',');
  if (comma == std::string::npos || !std::string_view(address).substr(0, comma).ends_with(";base64"))
    uri.refuse("data that is not base64");
  std::vector<std::byte> bytes;
  bytes.reserve((address.size() - comma) / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = comma + 1; i < address.size() && address[i] != '='; ++i) {
    const int sextet = sextetOf(address[i]);
    if (sextet < 0) uri.refuse(fmt::format("character {} is none of base64", i));
    bits = bits << 6 | std::uint32_t(sextet);
    if (count += 6; count >= 8) bytes.push_back(std::byte(bits >> (count -= 8) & 0xff));
  }
  return bytes;
}

std::string GltfFile::decodedName(std::string_view uri) {
  const auto hex = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0) {
      name.push_back(char(16 * hex(uri[i + 1]) + hex(uri[i + 2])));
      i += 2;
    } else {
      name.push_back(uri[i]);
    }
  }
  return name;
}

}  // namespace luxo
