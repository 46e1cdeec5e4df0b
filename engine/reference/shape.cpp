// SPDX-License-Identifier: Apache-2.0
#include "reference/shape.h"

#include <tbb/task_arena.h>

#include <algorithm>

#include "base/assert.h"

namespace luxo::reference {
namespace {

// Measured on the teapot: 16,384 cells take 140 ms of two cores, 1,024 take 10, and a ray of a quarter that
// takes 7 us with the many takes 40 with the few.
constexpr std::size_t kManyCells = 1U << 14, kFewCells = 1U << 10, kFewRays = 512;
// Of waves that a ray passes by in dozens, [u, sin(10*u*v), -v] on +-3, a ray takes 35 us with 2^14 cells, 12
// with 2^17, which take half a second and 40 MB, and 9 with 2^19.
constexpr std::size_t kMaxCells = 1U << 17, kManyRays = 1U << 16;

std::size_t cellsWorth(std::size_t rays) {
  return rays <= kFewRays ? kFewCells : rays <= kManyRays ? kManyCells : kMaxCells;
}

std::vector<ClosedForm> closedFormsOf(const Surface& surface, std::span<const double> parameters) {
  std::vector<ClosedForm> forms;
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const std::optional<ClosedForm> form = ClosedForm::of(surface, patch, parameters);
    if (!form) return {};
    forms.push_back(*form);
  }
  return forms;
}

}  // namespace

Shape::Shape(const Surface& surface, std::span<const double> parameters)
    : surface_(surface),
      parameters_(parameters.begin(), parameters.end()),
      forms_(closedFormsOf(surface, parameters)) {}

const CellTree& Shape::cells() const {
  LUXO_REQUIRE(surface_.isParametric());
  std::call_once(building_, [this] {
    if (!cells_) buildCells(kManyCells);
  });
  return *cells_;
}

const TriangleTree* Shape::triangles() const {
  if (!surface_.triangles()) return nullptr;
  std::call_once(building_,
                 [this] { triangles_ = std::make_unique<const TriangleTree>(*surface_.triangles()); });
  return triangles_.get();
}

void Shape::build() const {
  if (!triangles() && !hasClosedForm()) static_cast<void>(cells());
}

void Shape::prepareFor(std::size_t rays) const {
  if (triangles() || hasClosedForm()) return;
  const std::size_t before = cells_ ? cellsWorth(rays_) : 0;
  rays_ = std::max(rays_, rays_ + rays);  // there may be no end of them
  if (cellsWorth(rays_) > before) buildCells(cellsWorth(rays_));
}

void Shape::buildCells(std::size_t mostCells) const {
  // Isolated: a thread that waits for its part of this must not begin a ray that waits for this.
  tbb::this_task_arena::isolate(
      [&] { cells_ = std::make_unique<const CellTree>(surface_, parameters_, mostCells); });
}

PlacedShape::PlacedShape(std::shared_ptr<const Shape> shape, const Transform& worldFromObject)
    : shape_(std::move(shape)), worldFromObject_(worldFromObject) {
  if (!shape_->hasClosedForm()) return;
  objectFromWorld_ = ObjectFromWorld::of(worldFromObject);
  for (const ClosedForm& form : shape_->closedForms()) radius_ = std::max(radius_, form.radius());
  radius_ *= largestStretch(worldFromObject.linear);
}

bool PlacedShape::passesBy(const Ray& ray) const {
  // The slack is far above what rounding makes of the distance.
  const Vec3 toMiddle = worldFromObject_.translation - ray.origin;
  const double along = glm::dot(toMiddle, ray.direction), distance = glm::dot(toMiddle, toMiddle);
  return distance - along * along > radius_ * radius_ * (1 + 1e-9) + 1e-14 * distance;
}

std::optional<Roots> PlacedShape::withoutCells(const Ray& ray, const RootQuery& query) const {
  if (const TriangleTree* triangles = shape_->triangles())
    return reference::nearestRoot(*triangles, {ray, worldFromObject_}, query);
  if (objectFromWorld_) {
    if (passesBy(ray)) return Roots{};
    const ObjectRay objectRay = (*objectFromWorld_)(ray);
    RootQuery before = query;  // what lies beyond a root that was found does not matter
    Roots roots;
    for (const ClosedForm& form : shape_->closedForms()) {
      const ClosedForm::Answer answer = form.nearestRoot(objectRay, before);
      roots.certified &= answer.decided;
      if (!answer.decided || !answer.nearest) continue;
      roots.nearest = answer.nearest;
      before.farthest = answer.nearest->t;
    }
    if (roots.certified) return roots;
  }
  return std::nullopt;
}

Roots PlacedShape::nearestRoot(const Ray& ray, const RootQuery& query) const {
  if (const std::optional<Roots> roots = withoutCells(ray, query)) return *roots;
  return reference::nearestRoot(shape_->cells(), {ray, worldFromObject_}, query);
}

Roots RootWalk::from(double nearest) {
  query_.nearest = nearest;
  if (const std::optional<Roots> roots = shape_.withoutCells(ray_, query_)) return *roots;
  if (!ofCells_)
    ofCells_.emplace(shape_.shape().cells(), RayFunctions(ray_, shape_.worldFromObject()), query_);
  return ofCells_->from(nearest);
}

std::vector<std::shared_ptr<const Shape>> ShapeCache::shapes(std::span<const Request> requests) {
  std::map<Key, std::shared_ptr<const Shape>> asked;
  std::vector<const Request*> missing;
  for (const Request& request : requests) {
    const Key key{request.first.identity(), request.second};
    const auto [place, isNew] = asked.try_emplace(key);
    if (!isNew) continue;
    if (const auto known = shapes_.find(key); known != shapes_.end())
      place->second = known->second;
    else
      missing.push_back(&request);
  }
  for (const Request* request : missing)
    asked[{request->first.identity(), request->second}] =
        std::make_shared<const Shape>(request->first, request->second);
  shapes_ = std::move(asked);

  std::vector<std::shared_ptr<const Shape>> shapes;
  for (const Request& request : requests)
    shapes.push_back(shapes_[{request.first.identity(), request.second}]);
  return shapes;
}

}  // namespace luxo::reference
