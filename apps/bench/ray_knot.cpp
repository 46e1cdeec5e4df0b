// SPDX-License-Identifier: Apache-2.0
#include "ray_knot.h"

#ifdef LUXO_BENCH_EMBREE
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstring>

#include "plain_knot.h"

namespace luxo::bench {
namespace {

constexpr float kDiffuse = 0.7f, kSpecular = 0.2f, kShininess = 30, kAmbient = 0.1f;
constexpr Vec3f kBackground{0.02f, 0.025f, 0.03f};

}  // namespace

RayKnot::RayKnot(const TriangleMesh& mesh)
    : mesh_(mesh), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3f), mesh.positions().size());
  std::memcpy(vertices, mesh.positions().data(), mesh.positions().size_bytes());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), mesh.triangleCount());
  std::memcpy(indices, mesh.indices().data(), mesh.indices().size_bytes());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

RayKnot::~RayKnot() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

Image RayKnot::picture(const View& view) const {
  Image image(view.size.width, view.size.height, 3);
  const Vec3f eye(view.eye - mesh_.origin()), light(kKnotLight);
  tbb::parallel_for(0, view.size.height, [&](int y) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int x = 0; x < view.size.width; ++x) {
      const double right = (x + 0.5 - 0.5 * view.size.width) / view.pixelsPerUnit,
                   up = (0.5 * view.size.height - y - 0.5) / view.pixelsPerUnit;
      const Vec3f way(unit(view.forward() + right * view.right() + up * view.up()));
      RTCRayHit ray{};
      ray.ray = {.org_x = eye.x, .org_y = eye.y, .org_z = eye.z, .tnear = 0};
      ray.ray.dir_x = way.x;
      ray.ray.dir_y = way.y;
      ray.ray.dir_z = way.z;
      ray.ray.tfar = 1e30f;
      ray.ray.mask = 0xffffffff;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      Vec3f color = kBackground;
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        const auto corners = mesh_.indices().subspan(3 * std::size_t(ray.hit.primID), 3);
        const auto normalOf = [&](std::size_t i) { return mesh_.normals()[corners[i]]; };
        const Vec3f normal = glm::normalize((1 - ray.hit.u - ray.hit.v) * normalOf(0) +
                                            ray.hit.u * normalOf(1) + ray.hit.v * normalOf(2));
        const float cosine = glm::dot(normal, light);
        float sum = kAmbient * kDiffuse;
        if (cosine > 0)
          sum +=
              kDiffuse * cosine +
              kSpecular * std::pow(std::max(glm::dot(normal, glm::normalize(light - way)), 0.0f), kShininess);
        color = Vec3f(sum);
      }
      std::memcpy(image.pixel(x, y).data(), &color, sizeof color);
    }
  });
  return image;
}

}  // namespace luxo::bench
#endif
