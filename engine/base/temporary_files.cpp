// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>

namespace luxo {
namespace {

// Without locks and without memory that comes and goes, as a handler may neither wait nor allocate.
struct Place {
  enum State { Free, Taken, Named };
  std::atomic<int> state = Free;
  std::array<char, 4096> path{};
};
std::array<Place, 64> places;
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

TemporaryName::TemporaryName(const std::string& path) noexcept {
  if (path.size() >= places[0].path.size()) return;
  for (std::size_t i = 0; i < places.size(); ++i) {
    int expected = Place::Free;
    if (!places[i].state.compare_exchange_strong(expected, Place::Taken)) continue;
    std::memcpy(places[i].path.data(), path.c_str(), path.size() + 1);
    places[i].state = Place::Named;
    place_ = static_cast<int>(i);
    return;
  }
}

TemporaryName::~TemporaryName() {
  if (place_ >= 0) places[static_cast<std::size_t>(place_)].state = Place::Free;
}

void removeTemporaryFiles() noexcept {
  for (const Place& place : places)
    if (place.state == Place::Named) ::unlink(place.path.data());
}

}  // namespace luxo
