// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/os.h>
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/temporary_folder.h"
#include "benchmarks.h"
#include "knot.h"
#include "mesh/model.h"
#include "side_by_side.h"

#ifdef LUXO_BENCH_TINYOBJ
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#endif

namespace luxo::bench {
namespace {

/// What an OBJ says of a mesh.
enum class Says { Positions, Everything };

std::filesystem::path writeObj(const std::filesystem::path& folder, Says says) {
  const std::filesystem::path path = folder / "knot.obj";
  const MeshArrays arrays = knot();
  auto file = fmt::output_file(path.string());
  for (std::size_t i = 0; i < arrays.positions.size(); ++i) {
    const Vec3& p = arrays.positions[i];
    file.print("v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
    if (says == Says::Positions) continue;
    const Vec3f& n = arrays.normals[i];
    file.print("vn {:.6f} {:.6f} {:.6f}\nvt {:.6f} {:.6f}\n", n.x, n.y, n.z, 0.5 + 0.1 * p.x,
               0.5 + 0.1 * p.y);
  }
  for (std::size_t i = 0; i < arrays.indices.size(); i += 3) {
    file.print("f");
    for (std::size_t k = i; k < i + 3; ++k) {
      const std::uint32_t number = arrays.indices[k] + 1;
      says == Says::Positions ? file.print(" {}", number) : file.print(" {0}/{0}/{0}", number);
    }
    file.print("\n");
  }
  return path;
}

/// Of the process, in bytes: what is resident, or has been at most since the last reset.
double resident(std::string_view key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size()));
  return 0;
}
void resetMostResident() { std::ofstream("/proc/self/clear_refs") << "5"; }

void readKnot(benchmark::State& state, Says says) {
  const TemporaryFolder folder;
  const std::filesystem::path path = writeObj(folder.path(), says);
  // What is needed, not what malloc keeps: it gives large blocks back at once.
  constexpr int kLarge = 1 << 20, kUsuallyLarge = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  malloc_trim(0);
  resetMostResident();
  const double before = resident("VmRSS:");
  benchmark::DoNotOptimize(readModel(path, {}));
  // The file's text is the file's own; its arrays, in double and as it says them, are counted here.
  const double bytes = resident("VmHWM:") - before - double(std::filesystem::file_size(path));
  mallopt(M_MMAP_THRESHOLD, kUsuallyLarge);
  const auto ours = [&](int) { benchmark::DoNotOptimize(readModel(path, {})); };
#ifdef LUXO_BENCH_TINYOBJ
  sideBySide(state, ours, [&](int) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str()))
      state.SkipWithError(error.c_str());
  });
#else
  for ([[maybe_unused]] auto _ : state) ours(0);
#endif
  state.counters["bytes_per_triangle"] = bytes / kKnotTriangles;
}

}  // namespace

void registerModels() {
  for (const auto& [name, says] : {std::pair("model/obj_positions", Says::Positions),
                                   std::pair("model/obj_with_normals_and_uvs", Says::Everything)})
    benchmark::RegisterBenchmark(name, [says = says](benchmark::State& state) { readKnot(state, says); })
        ->Iterations(5)
#ifdef LUXO_BENCH_TINYOBJ
        ->UseManualTime()
#endif
        ->Unit(benchmark::kMillisecond);
}

}  // namespace luxo::bench
