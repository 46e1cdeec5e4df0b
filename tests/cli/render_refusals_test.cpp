// SPDX-License-Identifier: Apache-2.0
// Every way in which `luxo render` refuses: exit code, what is wrong, what to do; and no trace in the folder.
#include <fmt/format.h>
#include <sys/mount.h>
#include <sys/stat.h>

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
  expectRefused({"--fps", "5e-324"}, 2, "--fps '5e-324': frames per second are from 1e-06 to", "--fps 24");
  expectRefused({"--shading", "phon"}, 2, "--shading 'phon'", "did you mean 'phong'?");
  expectRefused({"--aov", "normals"}, 2, "--aov 'normals'", "did you mean 'normal'?");
  expectRefused({"--skip", "frustrum"}, 2, "--skip 'frustrum'", "did you mean 'frustum'?");
  expectRefused({"--tolerance", "0"}, 2, "--tolerance '0'", "");
  expectRefused({"--tolerance", "5e-324"}, 2, "--tolerance '5e-324': must be from 1e-06 to", "0.25");
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
  for (const char* model : {"castle.obj", "castle.GLB"}) expectFailure(refused(model), 3, model);
  EXPECT_EQ(folder.entries(), 0u);
  expectFailure(run(folder, {"render", "-o", "a.png"}), 2, "no scene is given", "--list");
}

TEST_F(RenderRefusals, WhatComesLater) {
  expectRefused({"--shading", "overdraw"}, 3, "--shading 'overdraw' is not supported yet", "one of flat");
  expectRefused({"--shading", "lod"}, 3, "--shading 'lod' is not supported yet", "exact");
}

TEST_F(RenderRefusals, ADriverFileOfGarbage) {
  writeText(folder / "garbage.json", "\x01\x02 no driver");
  const std::string garbage = (folder / "garbage.json").string();
  for (const std::string& file : {garbage, std::string("/dev/null"), std::string(LUXO_PROGRAM)}) {
    const ScopedVariable named("VK_DRIVER_FILES", file.c_str());
    expectFailure(render({"-o", "a.png"}), 4, "no Vulkan device found", "VK_DRIVER_FILES=" + file);
  }
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
  expectRefused({"-o", "missing/####.png", "--frames", "1-3"}, 5,
                "cannot write 'missing/0001.png': No such file or directory", "mkdir -p 'missing'");
  expectRefused({"-o", "missing/a.png"}, 5, "cannot write 'missing/a.png': No such file or directory",
                "mkdir -p 'missing'");
  expectRefused({"-o", "kept.png/a.png"}, 5, "cannot write 'kept.png/a.png': Not a directory",
                "'kept.png' is not a folder");
  expectRefused({"-o", std::string(300, 'a') + ".png"}, 5, "File name too long", "a shorter name");
  std::filesystem::create_directory(folder / "folder.png");
  expectRefused({"-o", "folder.png"}, 5, "cannot write 'folder.png': Is a directory", "add a file name");
  expectRefused({"-o", "/proc/a.png"}, 5, "cannot write '/proc/a.png'", "");
}

TEST_F(RenderRefusals, WhatCannotBeWrittenIsNoticedBeforeAnythingElse) {
  const ScopedVariable hidden("VK_DRIVER_FILES", "/nonexistent");  // drawing would fail, and say so
  expectRefused({"--report", "missing/report.json"}, 5, "cannot write 'missing/report.json'",
                "mkdir -p 'missing'");
  expectRefused({"-o", "missing/a.png"}, 5, "cannot write 'missing/a.png'", "mkdir -p 'missing'");
  std::filesystem::create_directory(folder / "folder");
  expectRefused({"--report", "folder"}, 5, "cannot write 'folder': Is a directory", "add a file name");
}

TEST_F(RenderRefusals, NoFileIsOverwrittenThatIsStillNeeded) {
  const ScopedVariable hidden("VK_DRIVER_FILES", "/nonexistent");
  const std::string help = "choose another name";
  expectRefused({"--report", "kept.png"}, 2, "--report 'kept.png' would overwrite -o", help);
  expectRefused({"-o", "new.png", "--report", "./new.png"}, 2, "--report './new.png' would overwrite -o",
                help);
  expectRefused({"-o", "f#.png", "--frames", "1-3", "--report", "f3.png"}, 2,
                "-o 'f3.png' would overwrite the report", help);

  const std::string scene = "{ \"luxo\": 1 }";
  writeText(folder / "s.png", scene);  // a scene may have any name
  std::filesystem::create_symlink("s.png", folder / "link");
  for (const Arguments& outputs : {Arguments{"-o", "s.png"}, Arguments{"-o", "a.png", "--report", "s.png"},
                                   Arguments{"-o", "a.png", "--report", "link"}}) {
    Arguments arguments = {"render", "./s.png"};
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    expectFailure(run(folder, arguments), 2, "would overwrite the scene", help);
    EXPECT_EQ(textOf(folder / "s.png"), scene);
  }
}

TEST_F(RenderRefusals, FilesThatAModelNamesAreNotOverwritten) {
  const ScopedVariable hidden("VK_DRIVER_FILES", "/nonexistent");
  writeText(folder / "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  writeText(folder / "m.mtl", "newmtl a\nmap_Kd wood.png\n");
  const Outcome wood =
      run(folder, {"render", "sphere", "--engine", "reference", "--size", "2x2", "-q", "-o", "wood.png"});
  ASSERT_EQ(wood.code, 0) << wood.err;
  writeText(
      folder / "s.luxo.json",
      R"({ "luxo": 1, "surfaces": { "m": { "type": "mesh", "file": "m.obj" } }, "nodes": [ { "surface": "m" } ] })");
  for (const char* scene : {"m.obj", "s.luxo.json"})
    for (const Arguments& outputs :
         {Arguments{"-o", "wood.png"}, Arguments{"-o", "a.png", "--report", "m.mtl"},
          Arguments{"-o", "a.png", "--report", "m.obj"}}) {
      Arguments arguments = {"render", scene, "-q"};
      arguments.insert(arguments.end(), outputs.begin(), outputs.end());
      expectFailure(run(folder, arguments), 2, "would overwrite", "choose another name");
    }
  expectFailure(run(folder, {"verify", "s.luxo.json", "--report", "m.mtl"}), 2, "would overwrite",
                "another name");
  writeText(
      folder / "t.luxo.json",
      R"({ "luxo": 1, "textures": { "w": { "file": "wood.png" } }, "materials": { "w": { "map": "w" } }, "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s", "material": "w" } ] })");
  expectFailure(run(folder, {"render", "t.luxo.json", "-q", "-o", "wood.png"}), 2, "would overwrite",
                "choose another name");
}

TEST_F(RenderRefusals, ScenesAreFilesOrStandardInput) {
  ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
  for (const char* scene : {"/dev/zero", "/dev/full", "/dev/urandom", "./fifo"})
    expectFailure(run(folder, {"render", scene, "-o", "a.png"}), 3,
                  fmt::format("cannot read the scene file '{}': it is no regular file", scene),
                  "write - to read a scene from standard input");
  std::filesystem::create_symlink("fifo", folder / "a.png");  // pictures, too
  expectFailure(run(folder, {"diff", "a.png", "a.png"}), 3, "cannot read 'a.png': it is no regular file");
}

TEST_F(DeviceRefusals, LittleMemoryIsAnErrorNotACrashAndNoWait) {
#ifdef LUXO_SANITIZED
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  constexpr std::uint64_t kMiB = 1 << 20;
  // From too little for the program itself to enough for all.
  int drawn = 0;
  for (const std::uint64_t limit : {300, 350, 380, 430, 600}) {
    Launch launch = rendering({"-o", "a.png"});
    launch.addressSpaceLimitBytes = limit * kMiB;
    const Outcome outcome = run(launch);
    SCOPED_TRACE(fmt::format("{} MiB: {}", limit, outcome.err));
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4 || outcome.code == 75) << outcome.code;
    EXPECT_TRUE(outcome.code == 0 || contains(outcome.err, "error: "));
    drawn += outcome.code == 0;
  }
  EXPECT_GE(drawn, 1);
  Launch large = rendering({"--size", "8192x8192", "-o", "b.png"});
  large.addressSpaceLimitBytes = 800 * kMiB;
  expectFailure(run(large), 2, "a picture of 8192x8192 pixels is more than", "pixels fit");
}

// Shaders that are compiled while much is drawn took what was left, and the driver's compiler ended the
// program.
TEST_F(DeviceRefusals, LittleMemoryForManyShadersIsAnErrorNotACrash) {
#ifdef LUXO_SANITIZED
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  for (const char* scene : {"catalogue", "glass"})
    for (const std::uint64_t limit : {480, 520, 560}) {
      Launch launch{.arguments = {"render", scene, "--size", "320x200", "-o", "a.png"},
                    .folder = folder.path()};
      launch.addressSpaceLimitBytes = limit << 20;
      const Outcome outcome = run(launch);
      SCOPED_TRACE(fmt::format("{} in {} MiB: {}", scene, limit, outcome.err));
      EXPECT_TRUE(outcome.code == 0 || outcome.code == 75) << outcome.code;
      EXPECT_TRUE(outcome.code == 0 || contains(outcome.err, "error: "));
    }
}

// A thread that cannot start means fewer threads, down to where the driver has none: that is noticed in 10 s.
TEST_F(DeviceRefusals, FewProcessesAreAnErrorNotACrashAndNoWait) {
#ifdef LUXO_SANITIZED
  GTEST_SKIP() << "the search for leaks needs a process of its own";
#endif
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path(), perms::all);
  int drawn = 0;
  for (const std::uint64_t limit : {1, 3, 4, 6, 64}) {
    Launch launch = rendering({"-o", "a.png"});
    launch.processLimit = limit;
    const Outcome outcome = run(launch);
    if (outcome.code == 98) GTEST_SKIP() << "the program is not there for other users";
    SCOPED_TRACE(fmt::format("{} processes: {}", limit, outcome.err));
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4 || outcome.code == 75) << outcome.code;
    EXPECT_TRUE(outcome.code == 0 || contains(outcome.err, "error: "));
    drawn += outcome.code == 0;
  }
  EXPECT_GE(drawn, 1);
}

TEST_F(DeviceRefusals, APictureThatFitsNowhereIsRefusedBeforeWork) {
  expectRefused({"--size", "16384x16384", "--samples", "4"}, 2,
                "a picture of 16384x16384 pixels with 4 samples",
                "pixels fit, or fewer samples; or draw it with --engine reference");
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
