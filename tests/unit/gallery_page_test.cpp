// SPDX-License-Identifier: Apache-2.0
// The gallery's page: it has every scene, in the order of the sheet, with its parameters, and shows them all.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "image/format.h"
#include "scene_examples.h"
#include "scenes/gallery.h"

namespace luxo::test {
namespace {

/// From each heading of the second level to the next, without its marks.
std::vector<std::string> sectionsOf(const std::string& page) {
  constexpr std::string_view kMark = "\n## ";
  std::vector<std::string> sections;
  for (std::size_t at = page.find(kMark); at != page.npos;) {
    const std::size_t next = page.find(kMark, at + 1);
    sections.push_back(page.substr(at + kMark.size(), next - at - kMark.size()));
    at = next;
  }
  return sections;
}

TEST(GalleryPage, TellsOfEveryScene) {
  const std::vector<std::string> sections = sectionsOf(sourceText("apps/scenes/gallery/README.md"));
  const auto scenes = galleryScenes();
  ASSERT_EQ(sections.size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::string name(scenes[i].name), &section = sections[i];
    std::string words = section;
    std::ranges::replace(words, '\n', ' ');
    SCOPED_TRACE(name);
    EXPECT_TRUE(("gallery/" + section).starts_with(name + "\n"))
        << "the heading is " << section.substr(0, 30);
    EXPECT_NE(section.find("    luxo render " + name + " "), section.npos) << "its command";
    int turned = 0;
    for (const ParameterDesc& parameter : galleryDescription(scenes[i]).parameters) {
      if (!parameter.range) continue;
      ++turned;
      const std::string told = fmt::format("`{}` ({} to {})", parameter.name.text,
                                           (*parameter.range)[0].number(), (*parameter.range)[1].number());
      EXPECT_NE(words.find(told), words.npos) << told;
    }
    EXPECT_GT(turned, 0) << "a parameter with a range";
  }
}

TEST(GalleryPage, ShowsEveryScene) {
  const Image sheet = loadImage(std::filesystem::path(LUXO_SOURCE_DIR) / "apps/scenes/gallery/gallery.png");
  const int count = static_cast<int>(galleryScenes().size());
  int columns = 1;
  while (columns * columns < count) ++columns;
  const char* const anew = "draw it anew: luxo gallery --size 240x135 -o apps/scenes/gallery/gallery.png";
  EXPECT_EQ(sheet.width(), columns * 248 - 8) << anew;
  EXPECT_EQ(sheet.height(), (count + columns - 1) / columns * 143 - 8) << anew;
}

}  // namespace
}  // namespace luxo::test
