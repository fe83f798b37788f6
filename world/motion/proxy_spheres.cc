#include "world/motion/proxy_spheres.h"

#include "base/parallel.h"
#include "shapes/body_reader.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

template <class T>
void write_radii(const Collidables& bodies, std::span<const float> radii, Parallelism parallelism,
                 LargeVector<T>& records) {
  const BodyReader reader{bodies};
  for_each_block(records.size() / 4, kRowsPerBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) {
                     const ShapeKind kind = reader.kind(i);
                     if (kind == ShapeKind::sphere || kind == ShapeKind::halfspace) continue;
                     records[4 * i + 3] = radii[i];
                   }
                 });
}

}  // namespace

void ProxySpheres::update(BodyStore& bodies, std::span<const float> radii,
                          Parallelism parallelism) {
  const Collidables view = bodies.view();
  write_radii(view, radii, parallelism, bodies.records32());
  write_radii(view, radii, parallelism, bodies.records64());
  const bool is_mixed = !bodies.halfspaces().empty() && view.kind;
  kind_.assign(is_mixed ? bodies.rows() : 0, ShapeKind::sphere);
  if (!is_mixed) return;
  for (const uint32_t index : bodies.halfspaces()) kind_[index] = ShapeKind::halfspace;
}

Collidables ProxySpheres::view(const BodyStore& bodies) const {
  Collidables view = bodies.view();
  view.kind = data_or_null(kind_);
  if (view.uniform_kind != ShapeKind::halfspace) view.uniform_kind = ShapeKind::sphere;
  return view;
}

}  // namespace carom
