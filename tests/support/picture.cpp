// SPDX-License-Identifier: Apache-2.0
#include "support/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace luxo::test {

CameraModel::CameraModel(const Camera& camera, PixelSize size, double time)
    : eye_(camera.eye.at(time)),
      center_(size.width / 2.0, size.height / 2.0),
      orthographic_(camera.projection == Projection::Orthographic) {
  forward_ = glm::normalize(camera.lookAt.at(time) - eye_);
  right_ = glm::normalize(glm::cross(forward_, camera.up.at(time)));
  up_ = glm::cross(right_, forward_);
  pixelsPerUnit_ =
      orthographic_ ? size.height / camera.height.at(time) : center_.y / std::tan(camera.fovY.at(time) / 2);
}

Ray CameraModel::through(const Vec2& pixel) const {
  const Vec2 fromCenter = (pixel - center_) / pixelsPerUnit_;
  const Vec3 sideways = fromCenter.x * right_ - fromCenter.y * up_;
  return orthographic_ ? Ray{eye_ + sideways, forward_} : Ray{eye_, forward_ + sideways};
}

double CameraModel::depthOf(const Vec3& pointWorld) const { return glm::dot(pointWorld - eye_, forward_); }

Vec2 CameraModel::pixelOf(const Vec3& pointWorld) const {
  const Vec3 q = pointWorld - eye_;
  const double scale = pixelsPerUnit_ / (orthographic_ ? 1 : depthOf(pointWorld));
  return center_ + scale * Vec2(glm::dot(q, right_), -glm::dot(q, up_));
}

Vec3 CameraModel::towardViewer(const Vec3& pointWorld) const {
  return orthographic_ ? -forward_ : glm::normalize(eye_ - pointWorld);
}

std::optional<double> hitPlane(const Ray& ray, const Vec3& point, const Vec3& normal) {
  const double slope = glm::dot(ray.direction, normal);
  if (slope == 0) return std::nullopt;
  return glm::dot(point - ray.origin, normal) / slope;
}

std::optional<std::pair<double, double>> hitSphere(const Ray& ray, const Vec3& center, double radius) {
  const Vec3 q = ray.origin - center;
  const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(q, ray.direction);
  const double discriminant = b * b - a * (glm::dot(q, q) - radius * radius);
  if (discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return std::pair((-b - root) / a, (-b + root) / a);
}

Vec3 blinnPhong(const Material& material, const Vec3& ambient, std::span<const Shine> lights,
                const Vec3& point, const Vec3& n, const Vec3& v) {
  Vec3 sum = material.ambientOrDiffuse() * ambient;
  for (const Shine& light : lights) {
    const Vec3 toLight = Vec3(light.position) - point * light.position.w;
    const Vec3 l = glm::normalize(toLight), h = glm::normalize(l + v);
    const double cosine = glm::dot(n, l);
    if (cosine <= 0 && !material.lectureSpecular) continue;
    const Vec3 reflectance = material.diffuse * std::max(cosine, 0.0) +
                             material.specular * std::pow(std::max(glm::dot(n, h), 0.0), material.shininess);
    sum += reflectance * light.radiance / (light.inverseSquare ? glm::dot(toLight, toLight) : 1.0);
  }
  return sum;
}

Rotation turning(const Vec3& from, const Vec3& to) {
  const Vec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  // Opposite or equal: any axis across them will do.
  if (sine < 1e-12)
    return {std::abs(from.x) < 0.9 ? glm::cross(from, Vec3(1, 0, 0)) : Vec3(0, 1, 0), cosine > 0 ? 0 : kPi};
  return {axis, std::atan2(sine, cosine)};
}

NodeId addLight(Scene& scene, const Shine& shine) {
  const bool directional = shine.position.w == 0;
  const Vec3 place(shine.position);
  Node node{.light = Light{.type = directional ? Light::Type::Directional : Light::Type::Point,
                           .color = shine.radiance,
                           .attenuation = shine.inverseSquare ? Light::Attenuation::InverseSquare
                                                              : Light::Attenuation::None}};
  // It shines along -Z, so the direction toward it is +Z.
  if (directional)
    node.rotation = turning({0, 0, 1}, glm::normalize(place));
  else
    node.translation = place;
  return scene.add(std::move(node));
}

Material glowing(const Vec3& color, double opacity) {
  return {.diffuse = Vec3(0), .ambient = color, .specular = Vec3(0), .opacity = opacity};
}

MaterialShaderPtr shaderOf(const std::string& text) {
  return std::make_shared<const MaterialShader>(MaterialShader{{{"test.frag", text}}});
}

Node plate(const Vec3& center, const Vec2& size, MaterialId material) {
  return {.translation = center,
          .rotation = Rotation{{1, 0, 0}, kPi / 2},
          .surface = rectangle(size.x, size.y),
          .material = material};
}

RenderSettings plainSettings(const Vec3& background) {
  return {.background = background, .ambient = Vec3(1)};
}

Vec3 colorAt(const Image& image, int x, int y) {
  const auto pixel = image.pixel(x, y);
  return image.channels() == 1 ? Vec3(pixel[0]) : Vec3(pixel[0], pixel[1], pixel[2]);
}

::testing::AssertionResult near(const Vec3& a, const Vec3& b, double tolerance) {
  const Vec3 difference = glm::abs(a - b);
  // Written so that NaN fails.
  if (difference.x <= tolerance && difference.y <= tolerance && difference.z <= tolerance)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "(" << a.x << ", " << a.y << ", " << a.z << ") is not (" << b.x
                                       << ", " << b.y << ", " << b.z << ") to " << tolerance;
}

bool showsSomething(const Image& image) {
  const auto first = image.pixel(0, 0);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (std::memcmp(image.pixel(x, y).data(), first.data(), first.size_bytes()) != 0) return true;
  return false;
}

namespace {

void requireShown(const Image& a, const Image& b) {
  EXPECT_TRUE(showsSomething(a) || showsSomething(b)) << "nothing is shown that could be compared";
}

}  // namespace

::testing::AssertionResult sameBytes(const Image& a, const Image& b, Shown shown) {
  if (shown == Shown::Something) requireShown(a, b);
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels())
    return ::testing::AssertionFailure() << "different shapes";
  if (std::memcmp(a.samples().data(), b.samples().data(), a.samples().size_bytes()) == 0)
    return ::testing::AssertionSuccess();
  int differing = 0, firstX = 0, firstY = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const auto p = a.pixel(x, y), q = b.pixel(x, y);
      if (std::memcmp(p.data(), q.data(), p.size_bytes()) == 0) continue;
      if (differing++ == 0) firstX = x, firstY = y;
    }
  const Vec3 p = colorAt(a, firstX, firstY), q = colorAt(b, firstX, firstY);
  return ::testing::AssertionFailure()
         << differing << " pixels differ, the first at (" << firstX << ", " << firstY << "): (" << p.x << ", "
         << p.y << ", " << p.z << ") and (" << q.x << ", " << q.y << ", " << q.z << ")";
}

double largestDifference(const Image& a, const Image& b) {
  requireShown(a, b);
  double largest = 0;
  if (a.samples().size() != b.samples().size()) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.samples().size(); ++i) {
    const double difference = std::abs(double(a.samples()[i]) - double(b.samples()[i]));
    largest =
        std::max(largest, std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference);
  }
  return largest;
}

::testing::AssertionResult nearEverywhere(const Image& a, const Image& b, double most) {
  const double largest = largestDifference(a, b);
  if (largest <= most) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "differs by " << largest << ", more than " << most;
}

int differingPixels(const Image& a, const Image& b, double tolerance) {
  requireShown(a, b);
  EXPECT_EQ(a.samples().size(), b.samples().size());
  int differing = 0;
  if (a.samples().size() != b.samples().size()) return a.width() * a.height();
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) differing += !near(colorAt(a, x, y), colorAt(b, x, y), tolerance);
  return differing;
}

::testing::AssertionResult allFinite(const Image& image) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (const float sample : image.pixel(x, y))
        if (!std::isfinite(sample))
          return ::testing::AssertionFailure() << sample << " at (" << x << ", " << y << ")";
  return ::testing::AssertionSuccess();
}

Image flippedLeftRight(const Image& image) {
  Image flipped(image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto from = image.pixel(image.width() - 1 - x, y);
      std::copy(from.begin(), from.end(), flipped.pixel(x, y).begin());
    }
  return flipped;
}

void PictureTest::TearDown() {
  renderer_.reset();
  GpuTest::TearDown();
}

Renderer& PictureTest::renderer() {
  if (!renderer_) renderer_.emplace(context());
  return *renderer_;
}

Picture PictureTest::draw(const Scene& scene, PixelSize size, const DrawOptions& options, double time) {
  return renderer().render(takeSnapshot(scene, time, size), options);
}

Picture PictureTest::draw(const Scene& scene, const Camera& camera, PixelSize size,
                          const DrawOptions& options, double time) {
  return renderer().render(takeSnapshot(scene, time, size, camera), options);
}

}  // namespace luxo::test
