// SPDX-License-Identifier: Apache-2.0
// The gallery's scenes and shaders by name from any folder, all of them on one sheet, and their page.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program.h"
#include "draw/device_cloth_simulation.h"
#include "draw/renderer.h"
#include "image/format.h"
#include "scene/scene_builder.h"
#include "scenes/gallery.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

constexpr int kCellWidth = 32, kCellHeight = 18, kGap = 8;

class Gallery : public DeviceRenderTest {
 protected:
  [[nodiscard]] std::filesystem::path fileOf(const EmbeddedScene& scene) const {
    return folder / (std::filesystem::path(scene.name).filename().string() + ".png");
  }
};

// The same pixels as the scene's own picture, drawn by itself, and paper between them. It is a second start,
// that compiles nothing of ours: not what is built in, and materials' shaders are kept on disk.
TEST_F(Gallery, ASheetHasEveryScenesOwnPicture) {
  const auto scenes = galleryScenes();
  gpu::Context context(gpu::ContextDesc{});
  for (const EmbeddedScene& embedded : scenes) {
    Scene scene = buildScene(galleryDescription(embedded));
    scene.set(std::make_shared<DeviceClothSimulation>(context));
    RenderSettings settings = scene.settings();
    settings.samples = 1;
    const Snapshot snapshot = takeSnapshot(scene, settings.time, {kCellWidth, kCellHeight});
    saveImage(Renderer(context).render(snapshot, drawOptions(settings)).image, fileOf(embedded));
  }
  const Outcome outcome = run(folder, {"gallery", "-o", "sheet.png", "--size", "32x18", "--samples", "1",
                                       "--columns", "3", "--validate", "--report", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;

  const Json report = Json::parse(outcome.out);
  const Image sheet = loadImage(folder / "sheet.png");
  const int rows = (static_cast<int>(scenes.size()) + 2) / 3;
  ASSERT_EQ(sheet.width(), 3 * kCellWidth + 2 * kGap);
  ASSERT_EQ(sheet.height(), rows * kCellHeight + (rows - 1) * kGap);
  EXPECT_EQ(report["size"], (Json{sheet.width(), sheet.height()}));
  ASSERT_EQ(report["frames"].size(), scenes.size());
  std::vector<bool> paper(static_cast<std::size_t>(sheet.width() * sheet.height()), true);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SCOPED_TRACE(scenes[i].name);
    const Json& frame = report["frames"][i];
    const int left = static_cast<int>(i % 3) * (kCellWidth + kGap),
              top = static_cast<int>(i / 3) * (kCellHeight + kGap);
    EXPECT_EQ(frame["scene"], scenes[i].name);
    EXPECT_EQ(frame["at"], (Json{left, top}));
    EXPECT_EQ(frame["count"]["shaders_compiled"], 0);
    const Image own = loadImage(fileOf(scenes[i]));
    for (int y = 0; y < kCellHeight; ++y)
      for (int x = 0; x < kCellWidth; ++x) {
        ASSERT_TRUE(std::ranges::equal(own.pixel(x, y), sheet.pixel(left + x, top + y))) << x << ", " << y;
        paper[static_cast<std::size_t>((top + y) * sheet.width() + left + x)] = false;
      }
  }
  for (int y = 0; y < sheet.height(); ++y)
    for (int x = 0; x < sheet.width(); ++x)
      if (paper[static_cast<std::size_t>(y * sheet.width() + x)]) {
        ASSERT_THAT(sheet.pixel(x, y), testing::Each(1.0F)) << x << ", " << y;
      }
}

TEST_F(Gallery, ScenesAndShadersAreKnownInAnyFolder) {
  const Outcome list = run(folder, {"render", "--list"});
  for (const EmbeddedScene& scene : galleryScenes())
    EXPECT_THAT("\n" + list.out, HasSubstr("\n" + std::string(scene.name) + " "));
  const Outcome shader = run(folder, {"inspect", "gallery/steel.frag"});
  EXPECT_THAT(shader.out, HasSubstr("roughness"));
  const Outcome drawn = run(folder, {"render", "gallery/marble.frag", "-o", "a.png", "--size", "16x9"});
  EXPECT_EQ(drawn.code, 0) << drawn.err;

  std::filesystem::create_directory(folder / "gallery");
  writeText(folder / "gallery/steel.frag", "vec4 material(Point p) { return vec4(p.none); }\n");
  expectFailure(run(folder, {"render", "gallery/steel.frag", "-o", "a.png"}), 3,
                "gallery/steel.frag:1:40: 'none'");
  EXPECT_EQ(run(folder, {"inspect", "gallery/steel"}).code, 0)
      << "the built-in scene has the built-in shader";
}

// Of a device that is asked for by name, too; and what takes too long is refused at once.
TEST_F(Gallery, ClothIsAsItIsThen) {
  const auto draw = [&](const std::string& file, const std::string& time,
                        std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"render", "gallery/cloth", "-o",    file,        "--time",
                                       time,     "--size",        "32x18", "--samples", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder, arguments);
  };
  ASSERT_EQ(draw("a.png", "0.2").code, 0);
  ASSERT_EQ(draw("b.png", "0.2", {"--device", "0", "-P", "stretch=60"}).code, 0);
  ASSERT_EQ(draw("c.png", "0.2", {"-P", "weight=1"}).code, 0);
  ASSERT_EQ(run(folder, {"render", "gallery/cloth", "-o", "film_#.png", "--frames", "1,5,3", "--fps", "10",
                         "--size", "32x18", "--samples", "1"})
                .code,
            0);
  EXPECT_EQ(textOf(folder / "a.png"), textOf(folder / "b.png"));
  EXPECT_EQ(textOf(folder / "a.png"), textOf(folder / "film_3.png"));
  EXPECT_NE(textOf(folder / "a.png"), textOf(folder / "c.png"));
  expectFailure(draw("d.png", "1e9"), 3,
                "node 'cloth' at time 1000000000: time 1000000000 s is step 500000000000 of a cloth",
                "ask for an earlier time");
}

TEST(GalleryNames, AreSuggested) {
  const ScratchFolder folder;
  expectFailure(run(folder, {"render", "gallery/steal", "-o", "a.png"}), 3,
                "there is no scene 'gallery/steal'", "did you mean 'gallery/steel'?");
  expectFailure(run(folder, {"render", "gallery", "-o", "a.png"}), 3, "'gallery' is many scenes",
                "`luxo gallery` draws them all");
  expectFailure(run(folder, {"lab", "gallery/steel"}), 2, "'gallery/steel' is no shader file",
                "did you mean 'gallery/steel.frag'?");
  expectFailure(run(folder, {"view", "gallery/steel", "-P", "fine=1"}), 2,
                "outside its range from 0.02 to 0.5");
}

TEST(GallerySheet, SaysWhatIsWrong) {
  const ScratchFolder folder;
  const std::string most = std::to_string(galleryScenes().size());
  expectFailure(run(folder, {"gallery"}), 2, "no output is given", "-o gallery.png");
  expectFailure(run(folder, {"gallery", "-o", "a.jpg"}), 2, "a.jpg");
  expectFailure(run(folder, {"gallery", "-o", "a.png", "--columns", "0"}), 2,
                "--columns '0': not a number of columns", "give a number from 1 to " + most);
  expectFailure(run(folder, {"gallery", "-o", "a.png", "--size", "9"}), 2, "--size '9'");
  expectFailure(run(folder, {"gallery", "-o", "a.png", "--size", "9000x90"}), 2, "a sheet of " + most,
                "at most 16384 on each side: choose a smaller --size");
  expectFailure(run(folder, {"gallery", "-o", "a.png", "--samples", "0"}), 2, "--samples '0'");
  expectFailure(run(folder, {"gallery", "-o", "a.png", "--report", "a.png"}), 2, "a.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace luxo::test
