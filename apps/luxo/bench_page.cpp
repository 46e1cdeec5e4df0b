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

/// A dash for what does not apply.
std::string pageNumber(double value, const char* format = "{:.3g}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "\u2013";
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

std::string machineTable(const BenchResult& result) {
  TextTable table{.head = {"measured on", ""}, .rows = {}};
  for (const auto& [name, value] : result.machine) table.rows.push_back({name, value});
  table.rows.push_back({"picture", fmt::format("{} x {}", result.size.width, result.size.height)});
  table.rows.push_back({"runs", fmt::format("at most {} of each way, in turns", result.runs)});
  return tableOf(table);
}

std::string nameOf(const BenchWay& way) {
  return fmt::format("{} {} px{}{}", nameOf(way.shading), way.tolerancePx,
                     way.shading == Shading::Exact ? " shell" : "", way.deferred ? ", deferred" : "");
}

std::string rowsTable(const BenchScene& scene) {
  TextTable table{.head = {"way", "samples", "triangles", "ms", "p10 \u2013 p90", "runs", "cold ms",
                           "position max, px", "p99.9", "silhouette, px", "wrong beyond 0.01 px",
                           "normal p99.9, deg", "8-bit differing", "PSNR, dB"},
                  .rows = {}};
  for (const BenchRow& row : scene.rows) {
    const BenchError& e = row.error;
    const Typical& ms = row.cost.frameMs;
    table.rows.push_back(
        {nameOf(row.way), fmt::format("{}", row.way.samples), fmt::format("{}", row.cost.triangles),
         pageNumber(ms.median, "{:.2f}"),
         pageNumber(ms.p10, "{:.2f}") + " \u2013 " + pageNumber(ms.p90, "{:.2f}"),
         fmt::format("{}", row.cost.runs), pageNumber(row.cost.coldMs, "{:.0f}"), pageNumber(e.positionMaxPx),
         pageNumber(e.positionP999Px), pageNumber(e.silhouettePx), fmt::format("{}", e.beyond),
         pageNumber(e.normalP999Deg), pageNumber(e.differing8Part), pageNumber(e.psnr, "{:.1f}")});
  }
  return tableOf(table);
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
    R"(<p>Times are medians with p10 to p90, of frames whose meshes are there, up
to the picture on the device; <i>cold</i> is the first frame, with everything that is made for it. Errors are
distances to the truth, which is cast by rays in double precision and proven: <i>position</i> is how far on the
screen the point that a pixel shows is from where it belongs, <i>silhouette</i> how far a pixel that shows another
surface is from where it would be right. Meshes are judged in a part of the pixels
only, which can but favour them. With one sample, colours are compared to the truth in the pixels' centres; with
more, to its mean over their areas, and the geometry is that of one sample.</p>
<p>Maps of errors: dark violet 1e-6 px and less, yellow 1 px and more; white on red is a pixel that shows another
surface.</p>
)";

constexpr const char* kUsualExplanation = R"(<h2>The exact picture against the half-pixel mesh</h2>
<p>One sample; <i>error</i> is the largest of all pixels, silhouettes included, <i>8 bit</i> the part of the covered
pixels with another 8-bit colour, <i>time ratio</i> the exact picture's time over the mesh's.</p>
)";

constexpr const char* kTimeToErrorExplanation = R"(<h2>What an error costs</h2>
<p>The fastest picture of each shading whose largest error is at most that; a dash where none is. Slopes are of
least-squares fits, in logarithms, of the error that 99.9 % of the pixels do not exceed.</p>
)";

}  // namespace

std::string tableOf(const TextTable& table) {
  std::string html = "<table>\n" + rowOf(table.head, "th");
  for (const Cells& row : table.rows) html += rowOf(row, "td");
  return html + "</table>\n";
}

std::string plotOf(const std::string& svg, const std::string& text) {
  return fmt::format("<p>{}</p>\n",
                     imageOf("image/svg+xml", std::as_bytes(std::span(svg)), text, " class=\"plot\""));
}

std::string pageOf(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head><meta "
      "charset=\"utf-8\"/>"
      "<title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
      escaped(title), kStyle, body);
}

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
  std::string html = kExplanation;
  if (!plots.empty()) html += plotOf(plots[0], "time against error of all scenes");
  html += kUsualExplanation + tableOf(usualTable(result));
  html += kTimeToErrorExplanation + tableOf(timeToErrorTable(result));
  html += machineTable(result);
  for (std::size_t i = 0; i < result.scenes.size(); ++i)
    html += sectionOf(result.scenes[i], i + 1 < plots.size() ? plots[i + 1] : "");
  return pageOf("luxo: time against error", html);
}

}  // namespace luxo
