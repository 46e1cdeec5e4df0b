// SPDX-License-Identifier: Apache-2.0
// What a watch tells of files that are saved: all of it, whenever that is.
#include "viewer/file_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>

#include "base/temporary_folder.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

class FileWatching : public testing::Test {
 protected:
  void save(const char* name) const { std::ofstream(at(name)) << name; }
  [[nodiscard]] fs::path at(const char* name) const { return folder_.path() / name; }

  /// Until it tells that a file was saved, and has told so.
  void awaitSave() {
    std::unique_lock lock(mutex_);
    told_.wait(lock, [&] { return watch_.takeSaved(); });
  }
  [[nodiscard]] static FileWatch::Clock::time_point later() {
    return FileWatch::Clock::now() + std::chrono::hours(1);
  }

  const TemporaryFolder folder_;
  std::mutex mutex_;
  std::condition_variable told_;
  FileWatch watch_{[this] {
    const std::lock_guard lock(mutex_);
    told_.notify_all();
  }};
};

TEST_F(FileWatching, TellsOfFilesThatAreWrittenRenamedOrNew) {
  save("a");
  watch_.watch({at("a"), at("new")}, later());
  EXPECT_FALSE(watch_.takeSaved());
  save("a");
  awaitSave();
  save("other");
  fs::rename(at("other"), at("a"));
  awaitSave();
  save("new");
  awaitSave();
}

/// Between its reading and its being watched: also where what is renamed is older than the reading.
TEST_F(FileWatching, WhatIsSavedBeforeItIsWatchedIsNotLost) {
  save("older");
  const FileWatch::Clock::time_point begun = FileWatch::Clock::now();
  save("a");
  watch_.watch({at("a")}, begun);
  EXPECT_TRUE(watch_.takeSaved());
  watch_.watch({at("a")}, begun);
  EXPECT_FALSE(watch_.takeSaved()) << "it was watched";
  fs::rename(at("older"), at("b"));
  watch_.watch({at("a"), at("b")}, begun);
  EXPECT_TRUE(watch_.takeSaved());
}

/// Whether it has been told by then or not.
TEST_F(FileWatching, WhatIsSavedWhileOthersBeginToBeWatchedIsNotLost) {
  save("a");
  save("b");
  watch_.watch({at("a")}, later());
  for (int i = 0; i < 20; ++i) {
    save("a");
    watch_.watch({at("b"), at("a")}, later());
    awaitSave();
    save("b");
    watch_.watch({at("a"), at("b")}, later());
    awaitSave();
  }
}

TEST_F(FileWatching, LooksBehindLinks) {
  fs::create_directory(at("there"));
  save("there/a");
  fs::create_symlink(at("there/a"), at("a"));
  watch_.watch({at("a")}, later());
  save("there/a");
  awaitSave();
}

TEST_F(FileWatching, OthersAreNotTold) {
  save("a");
  save("b");
  watch_.watch({at("a"), at("b")}, later());
  watch_.watch({at("b")}, later());
  save("a");
  save("b");
  awaitSave();
  watch_.watch({}, later());
  EXPECT_FALSE(watch_.takeSaved());
}

}  // namespace
}  // namespace luxo::test
