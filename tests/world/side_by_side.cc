#include "tests/world/side_by_side.h"

namespace carom::test {

CrowdSpec varied_crowd(uint64_t seed, size_t count) {
  return {.count = count,
          .side = 1.2 * std::cbrt(static_cast<double>(count)),
          .oriented = seed % 4 != 3,
          .halfspaces = seed % 4 == 1 ? size_t{3} : size_t{0},
          .filters = seed % 3 == 0,
          .seed = seed + 1};
}

WorldSettings varied_settings(uint64_t seed) {
  WorldSettings settings;
  settings.positions = seed % 2 ? PositionType::float64 : PositionType::float32;
  settings.detail = seed % 5 == 0   ? Detail::overlap
                    : seed % 5 == 1 ? Detail::manifold
                                    : Detail::contact;
  return settings;
}

Shape plain(Shape shape) {
  if (auto* triangle = std::get_if<Triangle>(&shape)) {
    triangle->one_sided = false;
    triangle->inner_edges = 0;
  }
  return shape;
}

SideBySide::SideBySide(std::span<const WorldSettings> settings, const CrowdSpec& spec)
    : random_(spec.seed), spec_(spec), crowd_(make_crowd(spec)) {
  for (const WorldSettings& each : settings) worlds_.emplace_back(each);
  for (BodyDesc& body : crowd_) {
    body.shape = plain(body.shape);
    add(body);
  }
}

void SideBySide::creep(double distance) {
  for (const BodyId id : ids_) {
    if (random_.chance(0.3)) continue;
    const Eigen::Vector3d way = random_.uniform(0, distance) * random_.direction();
    const Eigen::Quaternionf q = turned(worlds_[0].orientation(id), distance / 2);
    each([&](World& world) {
      world.set_position(id, world.position(id) + way);
      world.set_orientation(id, q);
    });
  }
}

void SideBySide::set_tolerances(float metres) {
  for (size_t i = 0; i < ids_.size(); i += 3) {
    const float own = metres * static_cast<float>(i % 5);
    each([&](World& world) { world.set_tolerance(ids_[i], own); });
  }
}

void SideBySide::disturb() {
  for (size_t i = random_.below(3); i > 0; --i) remove();
  for (size_t i = random_.below(3); i > 0; --i) add(crowd_[random_.below(crowd_.size())]);
  const BodyId id = pick();
  const Eigen::Vector3d place = random_position(random_, spec_.side);
  const Shape shape = plain(random_shape(kAllKinds[random_.below(std::size(kAllKinds))], random_));
  const Eigen::Quaternionf q = random_orientation(random_);
  const float factor = static_cast<float>(random_.uniform(0.5, 1.5));
  const uint64_t what = random_.below(6);
  each([&](World& world) {
    if (what == 0) world.set_position(id, place);
    if (what == 1) world.set_shape(id, shape);
    if (what == 2) world.set_sensor(id, factor > 1);
    if (what == 3) world.set_orientation(id, q);
    if (what == 4) scale_in_arrays(world, id, factor);
    if (what == 5) world.set_filter(id, 7, 7, static_cast<uint32_t>(4 * factor));
  });
}

void SideBySide::step() {
  each([](World& world) { world.step(); });
}

void SideBySide::add(const BodyDesc& body) {
  const BodyId id = worlds_[0].add(body);
  for (size_t i = 1; i < worlds_.size(); ++i) EXPECT_EQ(worlds_[i].add(body), id);
  ids_.push_back(id);
}

void SideBySide::remove() {
  std::swap(ids_[random_.below(ids_.size())], ids_.back());
  each([&](World& world) { EXPECT_TRUE(world.remove(ids_.back())); });
  ids_.pop_back();
}

Eigen::Quaternionf SideBySide::turned(const Eigen::Quaternionf& q, double most) {
  const Eigen::AngleAxisd turn(random_.uniform(0, most), random_.direction());
  Eigen::Quaternionf result = (Eigen::Quaterniond(turn) * q.cast<double>()).cast<float>();
  const double length = random_.log_uniform(0.5, 2) * (random_.chance(0.5) ? 1 : -1);
  result.coeffs() *= static_cast<float>(length) / result.norm();
  return result;
}

void SideBySide::scale_in_arrays(World& world, BodyId id, float factor) {
  const ShapeKind kind = kind_of(world.shape(id));
  if (kind == ShapeKind::aabb) {
    world.boxes().upper(world.box_slot(id))[1] *= factor;
  } else if (kind == ShapeKind::sphere) {
    const BodyArrays arrays = world.arrays();
    if (arrays.record32) arrays.record32[4 * id.index + 3] *= factor;
    if (arrays.record64) arrays.record64[4 * id.index + 3] *= factor;
  } else if (kind != ShapeKind::dop) {
    world.shape_rows().rows[4 * world.first_row(id)] *= factor;
  }
}

}  // namespace carom::test
