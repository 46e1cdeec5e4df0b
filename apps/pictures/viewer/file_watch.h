// SPDX-License-Identifier: Apache-2.0
// Tells when one of some files has been saved.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace luxo {

/// Watches their folders, since editors save by renaming: a file itself may be another one each time, and one
/// that is not there yet may come. Looks at nothing while nothing happens there. Behind a symbolic link, the
/// folder of its target is watched, too. No save is lost, whenever it is: between the reading of a file and
/// its being watched, while others begin to be, while nobody asks.
class FileWatch {
 public:
  using Clock = std::chrono::system_clock;

  /// `notify` is called from another thread after a file was saved.
  explicit FileWatch(std::function<void()> notify) : notify_(std::move(notify)) {}
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches these from now on, and no others. `begun`: before they were read. One that was not watched until
  /// now and has been saved since then counts as saved. Where the system cannot watch one a warning is
  /// logged.
  void watch(const std::vector<std::filesystem::path>& files, Clock::time_point begun);

  /// Whether one was saved since the last time.
  [[nodiscard]] bool takeSaved() { return saved_.exchange(false); }

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor();
  };
  /// A file, by the watch of its folder and its name there.
  struct Place {
    int watch = -1;
    std::string name;

    friend bool operator==(const Place&, const Place&) = default;
  };

  void open();
  [[nodiscard]] std::vector<Place> placesOf(const std::filesystem::path& file) const;
  void listen();

  std::function<void()> notify_;
  Descriptor events_, end_;
  std::vector<std::filesystem::path> files_;
  std::mutex mutex_;
  std::vector<Place> places_;  ///< of the files, guarded
  std::atomic<bool> saved_ = false;
  std::thread listener_;
};

}  // namespace luxo
