#include "midphase/composite_results.h"

#include <algorithm>
#include <cmath>

#include "midphase/body_pair.h"
#include "midphase/point_names.h"
#include "narrowphase/batch/world_point.h"

namespace carom {
namespace {

void set_row(const std::array<float*, 3>& columns, size_t row, const std::array<float, 3>& value) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (columns[axis]) columns[axis][row] = value[axis];
  }
}

template <class T>
void set_row(T* column, size_t row, const T& value) {
  if (column) column[row] = value;
}

float rounded_up(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, HUGE_VALF) : rounded;
}

// The true deepest pair of parts may be another one, deeper than the reported one by the rounding
// of its test.
float bound_of(const Outcome& o) {
  const double deeper = double{o.separation} - o.nearest;
  return rounded_up(std::isfinite(deeper) ? std::max(double{o.bound}, deeper) : o.bound);
}

uint32_t sub_shape(ShapeKind kind, uint64_t part) {
  return static_cast<uint32_t>(kind == ShapeKind::compound ? part >> 32 : part);
}

uint64_t name_of_point(const BodyPair& bodies, const std::array<uint64_t, 2>& parts,
                       const std::array<float, 3>& point, const std::array<float, 3>& normal,
                       float separation) {
  const PlacedPart a = part_at(bodies.a, parts[0]), b = part_at(bodies.b, parts[1]);
  const auto wide = [](const std::array<float, 3>& v) { return Double3{v[0], v[1], v[2]}; };
  return PartsInTouch{a, b}.name_of(wide(point), wide(normal), separation,
                                    minus(bodies.b.position, bodies.a.position));
}

}  // namespace

void CompositeResults::write(const TestedPair& tested) {
  const size_t row = tested.row;
  const Pair p = tested.pair;
  const Outcome& o = tested.outcome;
  const ResultColumns& out = block_.out;
  set_row(out.overlap, row, o.overlap);
  set_row(out.status, row, o.status);
  set_row(out.separation_bound, row, bound_of(o));
  if (!has_contacts(block_.detail)) return;
  set_row(out.separation, row, o.separation);
  set_row(out.normal, row, o.normal);
  set_row(out.point_a, row, in_frame(a_, p.a, o.arm_a));
  set_row(out.point_b, row, in_frame(b_, p.b, o.arm_b));
  set_row(out.sub_a, row, sub_shape(a_.kind(p.a), o.parts[0]));
  set_row(out.sub_b, row, sub_shape(b_.kind(p.b), o.parts[1]));
  if (has_manifolds(block_.detail)) {
    write_manifold(tested);
  } else if (out.point_names) {
    out.point_names[row] = {};
    if (tested.is_contact) {
      out.point_names[row].point[0] =
          name_of_point(BodyPair(a_, b_, p), o.parts, o.arm_a, o.normal, o.separation);
    }
  }
}

void CompositeResults::write_manifold(const TestedPair& tested) {
  const ResultColumns& out = block_.out;
  for (PartContact& contact : tested.contacts) {
    // The nearest contact of separate bodies counts in any case.
    if (contact.parts == tested.outcome.parts) contact.is_over_edge = false;
  }
  MergedManifold manifold =
      extra_.found ? first_region(tested) : merger_.first(tested.contacts, kSameManifold);
  if (out.point_names) out.point_names[tested.row] = names_of(tested.pair, manifold);
  for (size_t i = 0; i < manifold.count; ++i) {
    std::array<float, 3>& point = manifold.points.point[i];
    point = in_frame(a_, tested.pair.a, point);
  }
  set_row(out.manifold_count, tested.row, manifold.count);
  set_row(out.manifold, tested.row, manifold.points);
}

// Keeps the other regions.
MergedManifold CompositeResults::first_region(const TestedPair& tested) {
  if (tested.contacts.empty()) return {};
  uint32_t left_out;
  const std::span<const PartRegion> regions = merger_.all(
      tested.contacts, extra_.limits.cosine, std::clamp(extra_.limits.most, 1u, 0xffffu), left_out);
  left_out += tested.dropped;
  const size_t pair = block_.first + tested.row;
  extra_.found->begin(pair, static_cast<uint16_t>(std::min(left_out, 0xffffu)));
  for (const PartRegion& region : regions.subspan(1)) {
    extra_.found->add(pair, contact_of_region(tested.pair, region));
  }
  return regions[0].manifold;
}

ContactWithPoints CompositeResults::contact_of_region(Pair pair, const PartRegion& region) const {
  const PartContact& deepest = *region.deepest;
  const auto vector = [](const std::array<float, 3>& v) -> Eigen::Vector3f {
    return {v[0], v[1], v[2]};
  };
  return {{.a = pair.a,
           .b = pair.b,
           .sub_a = sub_shape(a_.kind(pair.a), deepest.parts[0]),
           .sub_b = sub_shape(b_.kind(pair.b), deepest.parts[1]),
           .normal = vector(deepest.normal),
           .separation = deepest.separation,
           .arm_a = vector(deepest.arm_a),
           .normal_velocity = 0,
           .arm_b = vector(deepest.arm_b),
           .status = static_cast<Status>(deepest.status),
           .manifold_count = region.manifold.count},
          region.manifold.points,
          block_.out.point_names ? names_of(pair, region.manifold) : PointNames{}};
}

PointNames CompositeResults::names_of(Pair pair, const MergedManifold& manifold) const {
  const BodyPair bodies(a_, b_, pair);
  PointNames names{};
  for (size_t i = 0; i < manifold.count; ++i) {
    const PartContact& from = *manifold.from[i];
    names.point[i] = name_of_point(bodies, from.parts, manifold.points.point[i], from.normal,
                                   manifold.points.separation[i]);
  }
  return names;
}

std::array<float, 3> CompositeResults::in_frame(const BodyReader& reader, size_t body,
                                                const std::array<float, 3>& arm) const {
  return block_.frame == WitnessFrame::body ? arm : world_point(reader, body, arm);
}

}  // namespace carom
