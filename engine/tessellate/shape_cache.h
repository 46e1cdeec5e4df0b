// SPDX-License-Identifier: Apache-2.0
// What is made of a surface at certain values of its parameters, kept within a budget.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "surface/surface.h"

namespace luxo {

/// A surface at certain values of its parameters. Whoever keeps one keeps the surface, too: another one might
/// get its identity.
struct Shape {
  const void* surface = nullptr;
  std::vector<double> parameters;

  Shape() = default;
  Shape(const Surface& of, std::span<const double> at)
      : surface(of.identity()), parameters(at.begin(), at.end()) {}

  friend auto operator<=>(const Shape&, const Shape&) = default;
};

template <class Entries>
auto leastRecentlyUsed(Entries& entries) {
  return std::min_element(entries.begin(), entries.end(),
                          [](const auto& a, const auto& b) { return a.second.lastUse < b.second.lastUse; });
}

/// Small things by shape: of so many the most recent. Not thread-safe.
template <class Value>
class ShapeTable {
 public:
  explicit ShapeTable(std::size_t most) : most_(most) {}

  /// What is there for the shape, or what `make` makes. Valid until the next call.
  template <class Make>
  [[nodiscard]] Value& get(const Surface& surface, std::span<const double> parameters, const Make& make) {
    Shape shape(surface, parameters);
    auto found = entries_.find(shape);
    if (found == entries_.end()) {
      // Of an animated surface every frame has its own.
      if (entries_.size() >= most_) entries_.erase(leastRecentlyUsed(entries_));
      found = entries_.emplace(std::move(shape), Entry{surface, make()}).first;
    }
    found->second.lastUse = ++uses_;
    return found->second.value;
  }

 private:
  struct Entry {
    Surface surface;
    Value value;
    std::uint64_t lastUse = 0;
  };

  std::map<Shape, Entry> entries_;
  std::size_t most_;
  std::uint64_t uses_ = 0;
};

/// Large things by a key with a shape: those that are in use elsewhere and, within a budget of bytes for all
/// (or a quarter more than those in use take), the others that were used most recently. Not thread-safe.
template <class Key, class Value>
class ShapeCache {
 public:
  explicit ShapeCache(std::size_t mostBytes) : mostBytes_(mostBytes) {}

  /// Null where there is none.
  [[nodiscard]] std::shared_ptr<const Value> find(const Key& key) {
    const auto entry = entries_.find(key);
    if (entry == entries_.end()) return nullptr;
    entry->second.lastUse = ++uses_;
    return entry->second.value;
  }

  /// Of that surface, of so many bytes beside what comes with any entry.
  std::shared_ptr<const Value> insert(Key key, const Surface& surface, Value value, std::size_t bytes) {
    bytes += kEntryBytes;
    makeRoom(bytes);
    bytes_ += bytes;
    ++made_;
    auto shared = std::make_shared<const Value>(std::move(value));
    entries_.emplace(std::move(key), Entry{surface, shared, bytes, ++uses_});
    return shared;
  }

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// How many were inserted so far.
  [[nodiscard]] std::uint64_t made() const { return made_; }
  /// How many entries were looked at so far for what may be forgotten: a few for each that was inserted.
  [[nodiscard]] std::uint64_t lookedAt() const { return lookedAt_; }

 private:
  /// What comes with any mesh: the surface with its compiled formulas, and what a device has of it. Measured:
  /// an edited formula of some ten operations left 100 KB behind, half of them its shell.
  static constexpr std::size_t kEntryBytes = std::size_t{64} << 10;

  struct Entry {
    Surface surface;
    std::shared_ptr<const Value> value;
    std::size_t bytes = 0;
    std::uint64_t lastUse = 0;
  };

  /// Forgets what is not in use, the oldest first, until so many more bytes fit.
  void makeRoom(std::size_t bytes) {
    if (bytes_ + bytes <= std::max(mostBytes_, crowd_)) return;
    lookedAt_ += entries_.size();
    crowd_ = 0;
    std::vector<typename std::map<Key, Entry>::iterator> idle;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
      if (entry->second.value.use_count() == 1) idle.push_back(entry);
    std::ranges::sort(idle, {}, [](const auto& entry) { return entry->second.lastUse; });
    for (const auto& entry : idle) {
      if (bytes_ + bytes <= mostBytes_) return;
      bytes_ -= entry->second.bytes;
      entries_.erase(entry);
    }
    if (bytes_ + bytes > mostBytes_) crowd_ = bytes_ + bytes_ / 4;
  }

  std::map<Key, Entry> entries_;
  std::size_t mostBytes_, bytes_ = 0;
  /// Where all is in use that is left, room is looked for again only after a quarter more: the look costs
  /// all.
  std::size_t crowd_ = 0;
  std::uint64_t uses_ = 0, made_ = 0, lookedAt_ = 0;
};

/// Bytes in vectors.
template <class... Vectors>
[[nodiscard]] std::size_t bytesIn(const Vectors&... vectors) {
  return (... + (vectors.size() * sizeof(typename Vectors::value_type)));
}

inline constexpr std::size_t kUsualCacheBytes = std::size_t{64} << 20;

}  // namespace luxo
