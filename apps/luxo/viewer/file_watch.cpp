// SPDX-License-Identifier: Apache-2.0
#include "viewer/file_watch.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>

#include "base/log.h"

namespace luxo {
namespace {

// Written in place and closed, or renamed to it.
constexpr std::uint32_t kSaved = IN_CLOSE_WRITE | IN_MOVED_TO;

}  // namespace

FileWatch::Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

FileWatch::FileWatch(const std::vector<std::filesystem::path>& files, std::function<void()> notify)
    : notify_(std::move(notify)) {
  if (files.empty()) return;
  events_.number = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  end_.number = eventfd(0, EFD_CLOEXEC);
  for (const std::filesystem::path& file : files) watch(file);
  if (places_.empty() || end_.number < 0) return;
  try {
    listener_ = std::thread([this] { listen(); });
  } catch (const std::system_error& error) {
    log(LogLevel::Warning,
        fmt::format("cannot watch '{}' for changes: {}", files.front().string(), error.what()));
  }
}

void FileWatch::watch(const std::filesystem::path& file) {
  const std::size_t before = places_.size();
  if (events_.number >= 0) add(file);
  if (places_.size() == before)
    log(LogLevel::Warning,
        fmt::format("cannot watch '{}' for changes: {}", file.string(), std::strerror(errno)));
  std::error_code unresolved;
  const std::filesystem::path target = std::filesystem::canonical(file, unresolved);
  if (events_.number >= 0 && !unresolved && std::filesystem::is_symlink(file, unresolved)) add(target);
}

FileWatch::~FileWatch() {
  if (!listener_.joinable()) return;
  const std::uint64_t one = 1;
  while (write(end_.number, &one, sizeof one) < 0 && errno == EINTR) {
  }
  listener_.join();
}

void FileWatch::add(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int watch = inotify_add_watch(events_.number, folder.c_str(), kSaved);
  if (watch >= 0) places_.push_back({watch, file.filename().string()});
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
