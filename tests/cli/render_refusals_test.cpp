// SPDX-License-Identifier: Apache-2.0
// Every way in which `luxo render` refuses: exit code, what is wrong, what to do; and no trace in the folder.
#include <fmt/format.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>

#include "cli/program.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

class RenderRefusals : public RenderTest {};
class DeviceRefusals : public DeviceRenderTest {};

TEST_F(RenderRefusals, Sizes) {
  const std::string help = "from 1 to 16384, as in 1280x720";
  expectRefused({"--size", "0x0"}, 2, "--size '0x0': a picture with a width of 0", help);
  expectRefused({"--size", "7x0"}, 2, "height of 0", help);
  expectRefused({"--size", "100000x100000"}, 2, "a width of 100000 is more than", help);
  expectRefused({"--size", "-1x5"}, 2, "a width of -1", help);
  expectRefused({"--size", "1e3x5"}, 2, "the width '1e3'", help);
  expectRefused({"--size", "12 80x720"}, 2, "the width '12 80'", help);
  expectRefused({"--size", "12", "80x720"}, 2, "unexpected argument '80x720'", "luxo render --help");
  expectRefused({"--size"}, 2, "", "");
}

TEST_F(RenderRefusals, Outputs) {
  expectFailure(render({}), 2, "no output is given", "-o lamp.png");
  for (const char* name : {"a.jpg", "a", ".png", "png", "a.png.gz"})
    expectRefused({"-o", name}, 2, fmt::format("'{}'", name), ".png or .tga (8 bit, sRGB), .exr or .pfm");
  expectRefused({"-o", "a_%4d.png"}, 2, "'%4d' is not a place for the frame number", "%04d");
}

TEST_F(RenderRefusals, OptionsAndNames) {
  expectRefused({"--sise", "1x1"}, 2, "unknown option '--sise'", "did you mean '--size'?");
  expectRefused({"--camera", "nobody"}, 2, "no camera 'nobody'", "its cameras: orbit");
  expectRefused({"-P", "speed=2"}, 2, "no parameter 'speed'", "");
  expectRefused({"--sweep", "speed=1:3:1"}, 2, "no parameter 'speed'", "no parameters");
  expectRefused({"--time", "1", "--frames", "1-3"}, 2, "--time and --frames exclude", "(n-1)/fps");
  expectRefused({"--frames", "3-1"}, 2, "'3-1' ends before it begins", "1-250:2,300");
  expectRefused({"--fps", "0"}, 2, "--fps '0'", "--fps 24");
  expectRefused({"--shading", "phon"}, 2, "--shading 'phon'", "did you mean 'phong'?");
  expectRefused({"--aov", "normals"}, 2, "--aov 'normals'", "did you mean 'normal'?");
  expectRefused({"--skip", "frustrum"}, 2, "--skip 'frustrum'", "did you mean 'frustum'?");
  expectRefused({"--tolerance", "0"}, 2, "--tolerance '0'", "");
  expectRefused({"--require-error", "0"}, 2, "--require-error '0'", "");
  expectRefused({"--require-error", "nan"}, 2, "--require-error 'nan'", "");
  for (const char* samples : {"0", "-4", "257", "1000000000", "10000000000000000000000", "4.5"})
    expectRefused({"--samples", samples}, 2, fmt::format("--samples '{}': not a number of samples", samples),
                  "from 1 to 256");
  expectRefused({"-q", "-v"}, 2, "-q and -v", "keep one");
}

TEST_F(RenderRefusals, Scenes) {
  const auto refused = [&](const std::string& scene) {
    return run(folder, {"render", scene, "-o", "a.png"});
  };
  expectFailure(refused("luxo-granpa"), 3, "no scene 'luxo-granpa'", "did you mean 'luxo-grandpa'?");
  for (const char* model : {"castle.obj", "castle.glb"})
    expectFailure(refused(model), 3, "models are not supported yet", ".luxo.json");
  EXPECT_EQ(folder.entries(), 0u);
  expectFailure(run(folder, {"render", "-o", "a.png"}), 2, "no scene is given", "--list");
}

TEST_F(RenderRefusals, WhatComesLater) {
  expectRefused({"--shading", "overdraw"}, 3, "--shading 'overdraw' is not supported yet", "one of flat");
  expectRefused({"--shading", "lod"}, 3, "--shading 'lod' is not supported yet", "exact");
}

TEST_F(RenderRefusals, NoDriver) {
  {
    const ScopedVariable hidden("VK_DRIVER_FILES", "/nonexistent");
    expectRefused({}, 4, "no Vulkan device found",
                  "VK_DRIVER_FILES names /nonexistent, which does not exist");
  }
  const ScopedVariable none("VK_DRIVER_FILES", nullptr), legacy("VK_ICD_FILENAMES", nullptr),
      disabled("VK_LOADER_DRIVERS_DISABLE", "*");  // as if no driver were installed
  expectRefused({}, 4, "no Vulkan device found", "apt install mesa-vulkan-drivers");
}

TEST_F(DeviceRefusals, WrongDevice) {
  expectRefused({"--device", "no such card"}, 4, "'no such card'; this machine has:\n  0: ", "by its number");
  expectRefused({"--device", "99"}, 4, "'99'; this machine has:\n  0: ", "let luxo choose: auto");
  const ScopedVariable chosen("LUXO_DEVICE", "no such card");
  expectRefused({}, 4, "'no such card'; this machine has:\n  0: ", "by its number");
  EXPECT_EQ(render({"--device", "0", "-o", "a.png"}).code, 0) << "the command line comes before the variable";
}

TEST_F(DeviceRefusals, PathsThatCannotBeWritten) {
  expectRefused({"-o", "missing/####.png", "--frames", "1-3"}, 5, "'missing' is not a folder",
                "mkdir -p 'missing'");
  expectRefused({"-o", "missing/a.png"}, 5, "cannot write 'missing/a.png': No such file or directory",
                "mkdir -p 'missing'");
  expectRefused({"-o", "kept.png/a.png"}, 5, "cannot write 'kept.png/a.png': Not a directory",
                "'kept.png' is not a folder");
  expectRefused({"-o", std::string(300, 'a') + ".png"}, 5, "File name too long", "a shorter name");
  std::filesystem::create_directory(folder / "folder.png");
  expectRefused({"-o", "folder.png"}, 5, "cannot write 'folder.png': Is a directory", "add a file name");
  expectRefused({"-o", "/proc/a.png"}, 5, "cannot write '/proc/a.png'", "");
}

TEST_F(DeviceRefusals, AReportThatCannotBeWrittenIsAFailureToo) {
  const Outcome outcome = render({"-o", "a.png", "-q", "--report", "missing/report.json"});
  expectFailure(outcome, 5, "cannot write 'missing/report.json'", "mkdir -p 'missing'");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(DeviceRefusals, AFileSizeLimitIsAnErrorNotASignal) {
  // Cold caches, so that the driver too runs into the limit, in threads of its own.
  const ScratchFolder caches;
  const ScopedVariable mesa("MESA_SHADER_CACHE_DIR", (caches / "mesa").c_str()),
      own("LUXO_CACHE_DIR", (caches / "luxo").c_str());
  writeText(folder / "kept.pfm", "what was here before");
  Launch launch = rendering({"-o", "kept.pfm", "--size", "200x100"});
  launch.fileSizeLimitBytes = 4096;  // 200 * 100 * 12 bytes are more
  expectFailure(run(launch), 5, "kept.pfm': File too large", "ulimit -f");
  EXPECT_EQ(textOf(folder / "kept.pfm"), "what was here before");
  EXPECT_EQ(folder.entries(), 1u);
}

/// A file system of 256 KiB in memory; empty where this process may not mount one.
class SmallDisk {
 public:
  explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {
    mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=256k") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  [[nodiscard]] bool mounted() const { return mounted_; }

 private:
  std::filesystem::path folder_;
  bool mounted_;
};

TEST_F(DeviceRefusals, AFullDisk) {
  const SmallDisk disk(folder.path());
  if (!disk.mounted()) GTEST_SKIP() << "may not mount a small disk: " << std::strerror(errno);
  // One picture of 200 * 100 * 12 = 240,000 bytes fits.
  const Outcome frames = render({"-o", "f#.pfm", "--frames", "1-3", "--size", "200x100"});
  expectFailure(frames, 7, "frame 2: cannot write 'f2.pfm': No space left on device", "free some space");
  EXPECT_TRUE(contains(frames.err, "frame 3: ")) << frames.err;
  EXPECT_EQ(std::filesystem::file_size(folder / "f1.pfm"), 240000 + std::strlen("PF\n200 100\n-1.0\n"));
  EXPECT_EQ(folder.entries(), 1u);

  const std::string before = textOf(folder / "f1.pfm");
  expectFailure(render({"-o", "f1.pfm", "--size", "200x100", "--time", "3"}), 5,
                "f1.pfm': No space left on device", "free some space");
  EXPECT_TRUE(textOf(folder / "f1.pfm") == before);
  EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace luxo::test
