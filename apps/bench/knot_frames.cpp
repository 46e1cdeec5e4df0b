// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

#include "benchmarks.h"
#include "gpu/transfer.h"
#include "image/compare.h"
#include "knot.h"
#include "luxo_frames.h"
#include "plain_knot.h"
#include "ray_knot.h"
#include "side_by_side.h"

namespace luxo::bench {
namespace {

constexpr PixelSize kKnotSize{1280, 720};

struct KnotPlace {
  const char* name;
  Camera camera;
};

// All of it, a third of it as it is seen from near, and what is in front of an eye that stands within it.
const std::array<KnotPlace, 3> kKnotPlaces{{
    {"whole", {.eye = Vec3(0, 0, 10), .lookAt = Vec3(0), .fovY = radians(45)}},
    {"near", {.eye = Vec3(3, 1, 3.5), .lookAt = Vec3(2, 0.5, 0), .fovY = radians(45)}},
    {"within", {.eye = Vec3(0, 0, 0.5), .lookAt = Vec3(3, 0, 0), .fovY = radians(45)}},
}};

Scene sceneOf(const TriangleMesh& mesh, const Camera& camera) {
  Scene scene;
  scene.set(RenderSettings{.size = kKnotSize});
  scene.add(Node{.surface = Surface(mesh), .material = scene.add(luxo::Material{})});
  // It shines along its -Z.
  const Vec3 axis = glm::cross(Vec3(0, 0, 1), kKnotLight);
  scene.add(Node{.rotation = Rotation{axis, std::acos(kKnotLight.z)},
                 .light = Light{.type = Light::Type::Directional}});
  scene.add(camera);
  return scene;
}

/// The plain draw, with the same beginning and end as luxo's.
class PlainFrames {
 public:
  PlainFrames(gpu::Context& context, const TriangleMesh& mesh)
      : frames_(context),
        knot_(context, kKnotSize, mesh),
        readback_(context, knot_.target().extent(), knot_.target().format()) {}

  void draw(const View& view) {
    knot_.record(frames_.begin(), view);
    frames_.wait(frames_.submit());
  }
  Image picture(const View& view) {
    const VkCommandBuffer commands = frames_.begin();
    knot_.record(commands, view);
    readback_.record(commands, knot_.target());
    frames_.wait(frames_.submit());
    Image image(kKnotSize.width, kKnotSize.height, 3);
    for (int y = 0; y < kKnotSize.height; ++y) {
      const std::byte* texel = readback_.row(std::uint32_t(y)).data();
      for (int x = 0; x < kKnotSize.width; ++x, texel += sizeof(Vec4f))
        std::memcpy(image.pixel(x, y).data(), texel, sizeof(Vec3f));
    }
    return image;
  }

 private:
  gpu::FrameRing frames_;
  PlainKnot knot_;
  gpu::Readback readback_;
};

/// Whether all draw the same picture but for single pixels of edges: of sRGB codes / 255.
void requireSame(benchmark::State& state, const Image& ours, const Image& theirs) {
  constexpr double kMaxMean = 2e-4;
  const double mean = compare(ours, theirs, ComparisonSpace::Srgb8).mean;
  state.counters["mean_difference"] = mean;
  if (!(mean < kMaxMean)) state.SkipWithError("the two ways do not draw the same picture");
}

const TriangleMesh& knotMesh() {
  static const TriangleMesh mesh = triangleMesh(knot(), "knot");
  return mesh;
}

void besidePlain(benchmark::State& state, gpu::Context& context, const Camera& camera) {
  const Scene scene = sceneOf(knotMesh(), camera);
  const Snapshot snapshot = takeSnapshot(scene, 0, kKnotSize);
  const FrameDesc desc{.size = kKnotSize};
  LuxoFrames ours(context, scene, desc);
  PlainFrames theirs(context, knotMesh());
  requireSame(state, Renderer(context).render(snapshot, desc.options).image, theirs.picture(snapshot.view));
  sideBySide(
      state, [&](int) { ours.draw(0); }, [&](int) { theirs.draw(snapshot.view); });
}

#ifdef LUXO_BENCH_EMBREE
void besideRays(benchmark::State& state, gpu::Context& context, const Camera& camera, Shading shading) {
  const Scene scene = sceneOf(knotMesh(), camera);
  const Snapshot snapshot = takeSnapshot(scene, 0, kKnotSize);
  const FrameDesc desc{.size = kKnotSize, .options = {.shading = shading}};
  LuxoFrames ours(context, scene, desc);
  const RayKnot theirs(knotMesh());
  requireSame(state, Renderer(context).render(snapshot, desc.options).image, theirs.picture(snapshot.view));
  sideBySide(
      state, [&](int) { ours.draw(0); },
      [&](int) { benchmark::DoNotOptimize(theirs.picture(snapshot.view)); });
}
#endif

}  // namespace

void registerKnotFrames(gpu::Context& context) {
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(name.c_str(), body)
        ->UseManualTime()
        ->Iterations(16)
        ->Unit(benchmark::kMillisecond);
  };
  for (const KnotPlace& place : kKnotPlaces) {
    add(fmt::format("knot/plain/{}", place.name),
        [&context, camera = place.camera](benchmark::State& state) { besidePlain(state, context, camera); });
#ifdef LUXO_BENCH_EMBREE
    for (const Shading shading : {Shading::Phong, Shading::Exact})
      add(fmt::format("knot/embree_{}/{}", nameOf(shading), place.name),
          [&context, shading, camera = place.camera](benchmark::State& state) {
            besideRays(state, context, camera, shading);
          });
#endif
  }
}

}  // namespace luxo::bench
