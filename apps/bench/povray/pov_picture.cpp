// SPDX-License-Identifier: Apache-2.0
#include "povray/pov_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/temporary_folder.h"

namespace luxo::povray {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Of a PPM of 16 bits, as POV-Ray writes it: comments, if any, before the numbers.
std::vector<double> readPpm16(const fs::path& path, PixelSize size) {
  std::ifstream file(path, std::ios::binary);
  const auto word = [&] {
    std::string next;
    while (file >> next && next.front() == '#') std::getline(file, next);
    return next;
  };
  const std::string header[] = {word(), word(), word(), word()};
  file.get();
  std::string bytes(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 6, 0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file || header[0] != "P6" || header[1] != std::to_string(size.width) ||
      header[2] != std::to_string(size.height) || header[3] != "65535")
    throw Error(ErrorKind::Internal,
                fmt::format("POV-Ray wrote no 16-bit PPM of {} x {}", size.width, size.height));
  std::vector<double> samples;
  for (std::size_t i = 0; i < bytes.size(); i += 2)
    samples.push_back(
        (256 * static_cast<unsigned char>(bytes[i]) + static_cast<unsigned char>(bytes[i + 1])) / 65535.);
  return samples;
}

}  // namespace

bool isInstalled() { return std::system("command -v povray > /dev/null 2>&1") == 0; }

PovPicture render(const std::string& sceneText, PixelSize size, Rows rows) {
  const TemporaryFolder scratch;
  std::ofstream(scratch.path() / "scene.pov") << sceneText;
  const std::string command = fmt::format(
      "cd '{}' && povray +Iscene.pov +Oscene.ppm +W{} +H{} +SR{} +ER{} +FP16 -A -D -GA File_Gamma=1.0 > log "
      "2>&1",
      scratch.path().string(), size.width, size.height, rows.first + 1, rows.end);
  const Stopwatch watch;
  const int status = std::system(command.c_str());
  const double seconds = watch.seconds();
  if (status != 0) {
    const std::string log = contentOf(scratch.path() / "log");
    throw Error(
        ErrorKind::Internal,
        fmt::format("povray failed: {}", log.substr(log.size() - std::min<std::size_t>(log.size(), 1000))));
  }
  return {.samples = readPpm16(scratch.path() / "scene.ppm", size), .seconds = seconds};
}

}  // namespace luxo::povray
