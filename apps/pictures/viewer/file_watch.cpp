// SPDX-License-Identifier: Apache-2.0
#include "viewer/file_watch.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "base/log.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;

// Written in place and closed, or renamed to it.
constexpr std::uint32_t kSaved = IN_CLOSE_WRITE | IN_MOVED_TO;

/// Of the system's clock that dates files: it stands still between two ticks, of which there are 100 a second
/// or more.
constexpr std::chrono::milliseconds kTick{10};

/// When the file was written, or got its name; the earliest time where there is none.
FileWatch::Clock::time_point savedAt(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return FileWatch::Clock::time_point::min();
  return FileWatch::Clock::time_point(std::chrono::duration_cast<FileWatch::Clock::duration>(
      std::chrono::seconds(status.st_ctim.tv_sec) + std::chrono::nanoseconds(status.st_ctim.tv_nsec)));
}

}  // namespace

FileWatch::Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

void FileWatch::watch(const std::vector<fs::path>& files, Clock::time_point begun) {
  if (!files.empty() && events_.number < 0) open();
  std::vector<fs::path> added;
  for (const fs::path& file : files)
    if (std::ranges::find(files_, file) == files_.end() && std::ranges::find(added, file) == added.end())
      added.push_back(file);
  std::vector<Place> places;
  for (const fs::path& file : files) {
    std::vector<Place> some = placesOf(file);
    if (some.empty() && std::ranges::find(added, file) != added.end())
      log(LogLevel::Warning,
          fmt::format("cannot watch '{}' for changes: {}", file.string(), std::strerror(errno)));
    for (Place& place : some)
      if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
  }
  files_ = files;
  {
    const std::lock_guard lock(mutex_);
    places_ = std::move(places);
  }
  // What is saved from here on is told.
  if (std::ranges::any_of(added, [&](const fs::path& file) { return savedAt(file) + kTick >= begun; })) {
    saved_ = true;
    notify_();
  }
}

void FileWatch::open() {
  events_.number = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  end_.number = eventfd(0, EFD_CLOEXEC);
  if (events_.number < 0 || end_.number < 0) return;
  try {
    listener_ = std::thread([this] { listen(); });
  } catch (const std::system_error& error) {
    log(LogLevel::Warning, fmt::format("cannot watch files for changes: {}", error.what()));
  }
}

std::vector<FileWatch::Place> FileWatch::placesOf(const fs::path& file) const {
  std::vector<Place> places;
  const auto add = [&](const fs::path& one) {
    const fs::path folder = one.has_parent_path() ? one.parent_path() : ".";
    const int watch = inotify_add_watch(events_.number, folder.c_str(), kSaved);
    if (watch >= 0) places.push_back({watch, one.filename().string()});
  };
  add(file);
  std::error_code unresolved;
  const fs::path target = fs::canonical(file, unresolved);
  if (!places.empty() && !unresolved && fs::is_symlink(file, unresolved)) add(target);
  return places;
}

FileWatch::~FileWatch() {
  if (!listener_.joinable()) return;
  const std::uint64_t one = 1;
  while (write(end_.number, &one, sizeof one) < 0 && errno == EINTR) {
  }
  listener_.join();
}

void FileWatch::listen() {
  pollfd sources[] = {{.fd = events_.number, .events = POLLIN, .revents = 0},
                      {.fd = end_.number, .events = POLLIN, .revents = 0}};
  for (;;) {
    if (poll(sources, 2, -1) < 0 && errno != EINTR) return;
    if (sources[1].revents != 0) return;
    alignas(inotify_event) char buffer[4096];
    const ssize_t size = read(events_.number, buffer, sizeof buffer);
    bool saved = false;
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      saved |= (event->mask & IN_Q_OVERFLOW) != 0;  // of which files nobody knows
      const std::lock_guard lock(mutex_);
      saved |= event->len > 0 && std::ranges::any_of(places_, [&](const Place& place) {
                 return place.watch == event->wd && place.name == event->name;
               });
    }
    if (!saved) continue;
    saved_ = true;
    notify_();
  }
}

}  // namespace luxo
