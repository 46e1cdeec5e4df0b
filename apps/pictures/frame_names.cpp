// SPDX-License-Identifier: Apache-2.0
#include "frame_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace luxo {
namespace {

struct Placeholder {
  std::size_t length;
  int digits;
};

[[noreturn]] void refuse(std::string_view placeholder) {
  throw Error(ErrorKind::Usage, fmt::format("'{}' is not a place for the frame number", placeholder),
              "use ####, %04d or {frame:04}");
}

// "" or "04": at least that many digits, padded with zeros.
int digitsOf(std::string_view width, std::string_view placeholder) {
  if (width.empty()) return 1;
  int digits = 0;
  const auto [end, error] = std::from_chars(width.data(), width.data() + width.size(), digits);
  if (width[0] != '0' || error != std::errc{} || end != width.data() + width.size() || digits < 1 ||
      digits > 12)
    refuse(placeholder);
  return digits;
}

std::optional<Placeholder> placeholderAt(std::string_view rest) {
  if (rest[0] == '#') {
    const std::size_t length = std::min(rest.find_first_not_of('#'), rest.size());
    return Placeholder{length, int(length)};
  }
  if (rest[0] == '%') {
    const std::size_t end = rest.find_first_not_of("0123456789", 1);
    if (end == std::string_view::npos || rest[end] != 'd') return std::nullopt;
    return Placeholder{end + 1, digitsOf(rest.substr(1, end - 1), rest.substr(0, end + 1))};
  }
  if (rest.starts_with("{frame")) {
    const std::size_t end = rest.find('}');
    if (end == std::string_view::npos) refuse(rest);
    const std::string_view whole = rest.substr(0, end + 1);
    const std::string_view format = whole.substr(6, end - 6);
    if (format.empty()) return Placeholder{whole.size(), 1};
    if (format[0] != ':' || format.size() == 1) refuse(whole);
    return Placeholder{whole.size(), digitsOf(format.substr(1), whole)};
  }
  return std::nullopt;
}

}  // namespace

FrameNames::FrameNames(const std::filesystem::path& pattern, bool severalFrames)
    : folder_(pattern.parent_path()) {
  const std::string name = pattern.filename().string();
  Piece piece;
  for (std::size_t at = 0; at < name.size();) {
    const auto placeholder = placeholderAt(std::string_view(name).substr(at));
    if (!placeholder) {
      piece.text += name[at++];
      continue;
    }
    piece.digits = placeholder->digits;
    pieces_.push_back(std::exchange(piece, {}));
    at += placeholder->length;
  }
  if (pieces_.empty() && severalFrames) {
    numberAdded_ = true;
    pieces_.push_back({pattern.stem().string() + ".", 4});
    piece.text = pattern.extension().string();
  }
  pieces_.push_back(std::move(piece));
}

std::filesystem::path FrameNames::of(int frame) const {
  std::string name;
  for (const Piece& piece : pieces_) {
    name += piece.text;
    if (piece.digits >= 0) name += fmt::format("{:0{}}", frame, piece.digits);
  }
  return folder_ / name;
}

}  // namespace luxo
