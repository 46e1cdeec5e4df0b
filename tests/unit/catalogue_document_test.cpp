// SPDX-License-Identifier: Apache-2.0
// engine/surface/CATALOGUE.md shows the catalogue to people: a row per surface, made of the table's own
// words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "surface/catalogue.h"

namespace luxo {
namespace {

/// A bar would end a cell.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string initialOf(const CatalogueArgument& argument) {
  std::string values;
  for (const double value : argument.initial)
    values += fmt::format("{}{:.4g}", values.empty() ? "" : ", ", value);
  return argument.initial.size() == 1 ? values : "[" + values + "]";
}

std::string rowOf(const CatalogueEntry& entry) {
  std::string arguments;
  for (const CatalogueArgument& a : entry.arguments)
    arguments +=
        fmt::format("{}`{}` = {}: {}", arguments.empty() ? "" : "<br>", a.name, initialOf(a), a.meaning);
  if (!entry.requirement.empty()) arguments += fmt::format("<br>Needs {}.", entry.requirement);
  return fmt::format("| `{0}` | {1} | `{2}` | {3} | {4} | {5}{6}{7} | ![{0}](pictures/{0}.png) |", entry.name,
                     escaped(entry.summary), escaped(entry.equation), escaped(arguments),
                     escaped(entry.source), entry.eulerCharacteristic, entry.borderless ? ", no border" : "",
                     entry.orientable ? "" : ", one side");
}

TEST(CatalogueDocument, HasARowForEverySurfaceAndNoOther) {
  const std::filesystem::path file =
      std::filesystem::path(LUXO_SOURCE_DIR) / "engine/surface/CATALOGUE.md";
  std::ifstream text(file);
  ASSERT_TRUE(text) << file;
  std::vector<std::string> rows;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("| `")) rows.push_back(line);
  for (const CatalogueEntry& entry : catalogue()) {
    EXPECT_TRUE(std::ranges::count(rows, rowOf(entry)) == 1) << "the row should be\n" << rowOf(entry);
    EXPECT_TRUE(std::filesystem::exists(file.parent_path() / "pictures" / (std::string(entry.name) + ".png")))
        << entry.name;
  }
  EXPECT_EQ(rows.size(), catalogue().size());
}

}  // namespace
}  // namespace luxo
