// SPDX-License-Identifier: Apache-2.0
// Nothing that happens to the cache's file is an error.
#include "gpu/pipeline_cache.h"

#include "gpu/pipeline.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "luxo/shaders/test_descriptors_vert.h"

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;

class PipelineCacheTest : public test::GpuTest {
 protected:
  void SetUp() override {
    fs::create_directories(directory_);
    variable_.emplace("LUXO_CACHE_DIR", directory_.c_str());
    GpuTest::SetUp();
  }
  void TearDown() override {
    GpuTest::TearDown();
    fs::permissions(directory_, fs::perms::owner_all);
    fs::remove_all(directory_);
  }

  // A whole life of a program that makes a pipeline.
  static void useCache() {
    const auto log = std::make_shared<ValidationLog>();
    {
      Context context({.validation = true, .validationLog = log});
      const GraphicsPipeline pipeline(
          context, {.vertexShader = luxo_test_descriptors_vert, .depthFormat = VK_FORMAT_D32_SFLOAT});
      EXPECT_TRUE(pipeline);
    }
    EXPECT_EQ(log->messages(), std::vector<std::string>{});
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::directory_iterator(directory_)) result.push_back(entry.path());
    return result;
  }
  fs::path cacheFile() const {
    const std::vector<fs::path> all = files();
    EXPECT_EQ(all.size(), 1u) << "one file, no temporary ones";
    return all.empty() ? fs::path() : all.front();
  }
  static std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void overwrite(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
  }

  fs::path directory_ = fs::temp_directory_path() / ("luxo-cache-test-" + std::to_string(getpid()));

 private:
  std::optional<test::ScopedVariable> variable_;
};

TEST_F(PipelineCacheTest, IsWrittenOnceAndKeptWhileItDoesNotChange) {
  useCache();
  const fs::path file = cacheFile();
  const std::string first = contents(file);
  EXPECT_EQ(first.substr(0, 4), "luxo");
  const auto before = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, before);
  useCache();
  if (contents(file) == first) {
    EXPECT_EQ(fs::last_write_time(file), before) << "nothing new, nothing written";
  }
}

TEST_F(PipelineCacheTest, SurvivesDamageAndReplacesIt) {
  useCache();
  const fs::path file = cacheFile();
  const std::string good = contents(file);
  std::string flipped = good;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  for (const std::string& bad :
       {flipped, good.substr(0, good.size() / 2), std::string(), std::string(5000, 'x')}) {
    overwrite(file, bad);
    useCache();
    EXPECT_EQ(cacheFile(), file);
    EXPECT_EQ(contents(file).size(), good.size()) << "written anew";
    EXPECT_NE(contents(file), bad);
  }
  fs::remove(file);
  useCache();
  EXPECT_EQ(contents(cacheFile()).size(), good.size());
}

TEST_F(PipelineCacheTest, SurvivesADirectoryInItsPlace) {
  useCache();
  const fs::path file = cacheFile();
  fs::remove(file);
  fs::create_directories(file / "occupied");
  useCache();
  EXPECT_TRUE(fs::is_directory(file));
  EXPECT_EQ(files().size(), 1u) << "the temporary file is gone";
}

TEST_F(PipelineCacheTest, SurvivesAnUnwritablePlace) {
  const test::ScopedVariable underAFile("LUXO_CACHE_DIR", "/dev/null/cache");
  useCache();
  fs::permissions(directory_, fs::perms::owner_read | fs::perms::owner_exec);
  const test::ScopedVariable readOnly("LUXO_CACHE_DIR", directory_.c_str());
  useCache();
  if (geteuid() != 0) {
    EXPECT_TRUE(files().empty());
  }
}

TEST_F(PipelineCacheTest, NeedsNoPlaceAtAll) {
  const test::ScopedVariable own("LUXO_CACHE_DIR", nullptr);
  const test::ScopedVariable xdg("XDG_CACHE_HOME", nullptr);
  const test::ScopedVariable home("HOME", nullptr);
  useCache();
}

}  // namespace
}  // namespace luxo::gpu
