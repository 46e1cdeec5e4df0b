// SPDX-License-Identifier: Apache-2.0
// Random numbers that are the same everywhere: SplitMix64 (Steele, Lea, Flood 2014) and plain arithmetic, no
// distribution of a standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace luxo::random {

class Numbers {
 public:
  /// The stream of one scene: neighbouring indices have nothing in common.
  Numbers(std::uint64_t seed, std::uint64_t index) : state_(mixed(seed) ^ mixed(~index)) {}

  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15U); }

  /// Evenly from [low, high).
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11U) * 0x1p-53);
  }
  /// Its logarithm evenly; 0 < low.
  double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  /// Of either sign, its size evenly.
  double signedBetween(double low, double high) {
    const bool negative = chance(0.5);
    const double size = between(low, high);
    return negative ? -size : size;
  }
  /// Evenly from low, low + 1, ..., high.
  int whole(int low, int high) {
    return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return between(0, 1) < probability; }

  template <class T, std::size_t n>
  const T& oneOf(const T (&choices)[n]) {
    return choices[static_cast<std::size_t>(whole(0, static_cast<int>(n) - 1))];
  }
  template <class T>
  const T& oneOf(std::span<const T> choices) {
    return choices[static_cast<std::size_t>(whole(0, static_cast<int>(choices.size()) - 1))];
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

/// To `digits` significant decimal digits: short in a file, and free of what libraries round differently in
/// the last place.
[[nodiscard]] inline double rounded(double value, int digits = 4) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
  return std::round(value * unit) / unit;
}

}  // namespace luxo::random
