// SPDX-License-Identifier: Apache-2.0
#include "bench_page.h"

#include <fmt/format.h>

#include <cmath>

#include "image/png.h"

namespace luxo {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; margin: 2em auto; max-width: 1250px; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; }
th, td { padding: .15em .7em; text-align: right; border-bottom: 1px solid #ddd; }
th { font-weight: 600; vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; }
figure { display: inline-block; margin: 0 .5em 1em 0; width: 31%; vertical-align: top; }
figure img, img.plot { width: 100%; }
figcaption { font-size: 13px; color: #555; }
)";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      safe += c;
  }
  return safe;
}

using Cells = std::vector<std::string>;

std::string rowOf(const Cells& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return html + "</tr>\n";
}

std::string tableOf(const Cells& head, const std::vector<Cells>& rows) {
  std::string html = "<table>\n" + rowOf(head, "th");
  for (const Cells& row : rows) html += rowOf(row, "td");
  return html + "</table>\n";
}

/// A dash for what does not apply.
std::string number(double value, const char* format = "{:.3g}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "\u2013";
}
std::string number(const std::optional<double>& value, const char* format) {
  return number(value.value_or(std::nan("")), format);
}

std::string imageOf(const char* type, std::span<const std::byte> bytes, const std::string& text,
                    const char* css = "") {
  return fmt::format("<img{} alt=\"{}\" src=\"data:{};base64,{}\"/>", css, escaped(text), type,
                     base64Of(bytes));
}

std::string figureOf(const Image& image, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                     imageOf("image/png", encodePng(image), caption), escaped(caption));
}

std::string plotOf(const std::string& svg, const std::string& text) {
  return fmt::format("<p>{}</p>\n",
                     imageOf("image/svg+xml", std::as_bytes(std::span(svg)), text, " class=\"plot\""));
}

std::string machineTable(const BenchResult& result) {
  std::vector<Cells> rows;
  for (const auto& [name, value] : result.machine) rows.push_back({name, value});
  rows.push_back({"picture", fmt::format("{} x {}", result.size.width, result.size.height)});
  rows.push_back(
      {"runs", fmt::format("{} of each, in turns; times are medians with p10 to p90", result.runs)});
  return tableOf({"measured on", ""}, rows);
}

std::string summaryTable(const BenchResult& result) {
  Cells head = {"scene", "shading"};
  for (const double error : kTargetErrorsPx) head.push_back(fmt::format("ms for {} px", error));
  for (const char* name :
       {"least error, px", "error ~ triangles ^", "error ~ ms ^", "exact over 0.5 px mesh, time"})
    head.emplace_back(name);
  std::vector<Cells> rows;
  for (const BenchScene& scene : result.scenes) {
    const BenchSummary summary = summaryOf(scene);
    for (const BenchShading& s : summary.shadings) {
      Cells cells = {scene.name, std::string(nameOf(s.shading))};
      for (const auto& ms : s.msOfError) cells.push_back(number(ms, "{:.1f}"));
      cells.push_back(number(s.leastErrorPx));
      cells.push_back(number(s.errorPerTriangles, "{:.2f}"));
      cells.push_back(number(s.errorPerMs, "{:.2f}"));
      cells.push_back(s.shading == Shading::Exact ? number(summary.exactOverMesh, "{:.2f}") : "");
      rows.push_back(std::move(cells));
    }
  }
  return tableOf(head, rows);
}

std::string nameOf(const BenchWay& way) {
  return fmt::format("{} {} px{}", nameOf(way.shading), way.tolerancePx,
                     way.shading == Shading::Exact ? " hull" : "");
}

std::string rowsTable(const BenchScene& scene) {
  std::vector<Cells> rows;
  for (const BenchRow& row : scene.rows) {
    const BenchError& e = row.error;
    const Typical& ms = row.cost.frameMs;
    rows.push_back({nameOf(row.way), fmt::format("{}", row.way.samples),
                    fmt::format("{}", row.cost.triangles), number(ms.median, "{:.2f}"),
                    number(ms.p10, "{:.2f}") + " \u2013 " + number(ms.p90, "{:.2f}"),
                    number(row.cost.coldMs, "{:.0f}"), number(e.positionMaxPx), number(e.positionP999Px),
                    number(e.silhouettePx), fmt::format("{}", e.beyond), number(e.normalP999Deg),
                    number(e.differing8Part), number(e.psnr, "{:.1f}")});
  }
  return tableOf(
      {"way", "samples", "triangles", "ms", "p10 \u2013 p90", "cold ms", "position max, px", "p99.9",
       "silhouette, px", "wrong beyond 0.01 px", "normal p99.9, deg", "8-bit differing", "PSNR, dB"},
      rows);
}

std::string sectionOf(const BenchScene& scene, const std::string& plot) {
  std::string html = fmt::format("<h2>{}</h2>\n<p>Truth: {} pixels covered, {} undecided, in {:.1f} s.</p>\n",
                                 escaped(scene.name), scene.covered, scene.undecided, scene.truthMs / 1e3);
  html += figureOf(scene.truth, "the truth");
  for (const BenchPicture& picture : scene.pictures) {
    html += figureOf(picture.picture, nameOf(picture.way));
    html += figureOf(picture.heat, "position error of " + nameOf(picture.way));
  }
  html += rowsTable(scene);
  return plot.empty() ? html : html + plotOf(plot, "time against error: " + scene.name);
}

constexpr const char* kExplanation =
    "<p>Times are of a frame whose meshes are there, up to the picture on the device; <i>cold</i> is the "
    "first "
    "frame, with everything that is made for it. Errors are distances to the truth, which is cast by rays in "
    "double "
    "precision. Meshes other than the pictured ones are judged in a part of the pixels only, which can but "
    "favour "
    "them. With one sample, colours are compared to the truth in the pixels' centres; with more, to its mean "
    "over "
    "their areas. Maps of errors: dark violet 1e-6 px and less, yellow 1 px and more; white on red is a "
    "pixel that "
    "shows another surface.</p>\n";

}  // namespace

std::string base64Of(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? std::to_integer<unsigned>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string benchPage(const BenchResult& result, const std::vector<std::string>& plots) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head><meta "
      "charset=\"utf-8\"/>"
      "<title>luxo: time against error</title><style>{}</style></head>\n<body>\n<h1>luxo: time against "
      "error</h1>\n",
      kStyle);
  html += kExplanation;
  if (!plots.empty()) html += plotOf(plots[0], "time against error of all scenes");
  html += summaryTable(result) + machineTable(result);
  for (std::size_t i = 0; i < result.scenes.size(); ++i)
    html += sectionOf(result.scenes[i], i + 1 < plots.size() ? plots[i + 1] : "");
  return html + "</body>\n</html>\n";
}

}  // namespace luxo
