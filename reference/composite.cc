#include "reference/composite.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "geometries/local_origin.h"
#include "narrowphase/manifolds/merge.h"
#include "reference/scalar.h"
#include "reference/simple_parts.h"

namespace carom::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// A triangle of a surface with its corners counted from a place near the other part.
Simple counted_near(const Simple& part, const Simple& other) {
  if (!part.surface || other.surface || !may_count_near(part.surface->rules(), std::nullopt) ||
      std::get<Triangle>(part.shape).inner_edges != 0) {
    return part;
  }
  const Turn turn = rotation_of(part.placed.orientation);
  const std::array<float, 3> origin =
      origin_near(turn, part.placed.position, other.placed, other.placed.position);
  if (origin == kMeshOrigin) return part;
  const auto& [x, y, z] = origin;
  const Double3 way = turned(turn, {x, y, z});
  Simple result = part;
  for (Vector3f& corner : std::get<Triangle>(result.shape).corners) corner -= Vector3f(x, y, z);
  result.placed.position = plus(part.placed.position, way);
  result.arm = plus(part.arm, way);
  return result;
}

// The inner edges of a triangle of a surface, if the other part is pushed out over one of them;
// else 0.
uint8_t edges_to_close(const Simple& part, const Simple& other, const Double3& way) {
  if (!part.surface || std::holds_alternative<Halfspace>(other.shape)) return 0;
  return part.placed_triangle().edges_to_close(way, [&] { return middle_of(other.placed); });
}

Simple with_inner_edges(Simple part, uint8_t edges) {
  if (edges != 0) std::get<Triangle>(part.shape).inner_edges = edges;
  return part;
}

std::array<float, 3> moved(const std::array<float, 3>& point, const Double3& arm) {
  std::array<float, 3> result;
  for (size_t i = 0; i < 3; ++i) result[i] = static_cast<float>(point[i] + arm[i]);
  return result;
}

Vector3f moved(const Vector3f& point, const Double3& arm) {
  const auto result = moved(std::array{point.x(), point.y(), point.z()}, arm);
  return {result[0], result[1], result[2]};
}

// Makes the result relative to the bodies.
PairResult from_parts(PairResult result, const Simple& a, const Simple& b) {
  result.arm_a = moved(result.arm_a, a.arm);
  result.arm_b = moved(result.arm_b, b.arm);
  for (size_t i = 0; i < result.manifold_count; ++i) {
    result.manifold.point[i] = moved(result.manifold.point[i], a.arm);
  }
  result.sub_a = a.sub;
  result.sub_b = b.sub;
  return result;
}

// The test of two parts, relative to the bodies.
PairResult test(const Simple& part_a, const Simple& part_b, float distance) {
  const Simple a = counted_near(part_a, part_b), b = counted_near(part_b, part_a);
  return from_parts(collide(a.shape, a.pose(), b.shape, b.pose(), PositionType::float64, distance),
                    a, b);
}

PairResult nothing() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Vector3f nan = Vector3f::Constant(kNan);
  return {false, Status::ok, std::numeric_limits<float>::infinity(), nan, nan, nan, 0, {}, 0, 0};
}

PartContact contact_of(const PairResult& result, const Simple& a, const Simple& b,
                       bool is_over_edge) {
  const auto array = [](const Vector3f& v) { return std::array{v.x(), v.y(), v.z()}; };
  return {.parts = {a.order, b.order},
          .normal = array(result.normal),
          .separation = result.separation,
          .arm_a = array(result.arm_a),
          .arm_b = array(result.arm_b),
          .status = static_cast<uint8_t>(result.status),
          .is_over_edge = is_over_edge,
          .count = result.manifold_count,
          .points = result.manifold};
}

// The sub-shape that results report for a part.
uint32_t sub_of(const std::vector<Simple>& parts, uint64_t order) {
  return std::find_if(parts.begin(), parts.end(),
                      [&](const Simple& part) { return part.order == order; })
      ->sub;
}

// Ranks overlapping pairs of parts before separate ones, and contacts over inner edges after
// others; then the deepest first, then by the order of parts.
using Rank = std::tuple<int, bool, float, uint64_t, uint64_t>;

struct Best {
  Rank rank{1, true, HUGE_VALF, UINT64_MAX, UINT64_MAX};
  PairResult result = nothing();
  const Simple* a = nullptr;
  const Simple* b = nullptr;
  std::array<uint8_t, 2> closed{};  // inner edges, by side

  bool is_over_edge() const { return a != nullptr && (closed[0] != 0 || closed[1] != 0); }
};

// Tests again with directions over inner edges forbidden. The pair still counts as overlapping. If
// this test finds no overlap, the old contact stays.
void close_edges(Best& best, float distance) {
  const PairResult again = test(with_inner_edges(*best.a, best.closed[0]),
                                with_inner_edges(*best.b, best.closed[1]), distance);
  if (again.overlap) {
    best.result = again;
    return;
  }
  const Vector3f& p = best.result.arm_a;
  best.result.manifold_count = 1;
  best.result.manifold = {};
  best.result.manifold.point[0] = {p.x(), p.y(), p.z()};
  best.result.manifold.separation[0] = best.result.separation;
}

// Divides the contacts of parts into regions. `first`: the result without its manifold.
PairContacts with_regions(const PairResult& first, std::span<PartContact> contacts,
                          const std::vector<Simple>& parts_a, const std::vector<Simple>& parts_b,
                          const RegionLimits& limits) {
  PairContacts result{first, {}};
  result.first.manifold_count = 0;
  result.first.manifold = {};
  if (contacts.empty()) return result;
  RegionMerger merger;
  uint32_t left_out;
  const std::span<const PartRegion> regions =
      merger.all(contacts, limits.cosine, std::clamp(limits.most, 1u, 0xffffu), left_out);
  result.left_out = static_cast<uint16_t>(std::min(left_out, 0xffffu));
  result.first.manifold_count = regions[0].manifold.count;
  result.first.manifold = regions[0].manifold.points;
  const auto vector = [](const std::array<float, 3>& v) { return Vector3f(v[0], v[1], v[2]); };
  for (const PartRegion& region : regions.subspan(1)) {
    const PartContact& deepest = *region.deepest;
    result.others.push_back({deepest.separation <= 0, static_cast<Status>(deepest.status),
                             deepest.separation, vector(deepest.normal), vector(deepest.arm_a),
                             vector(deepest.arm_b), region.manifold.count, region.manifold.points,
                             sub_of(parts_a, deepest.parts[0]), sub_of(parts_b, deepest.parts[1])});
  }
  return result;
}

Double3 stored(const Vector3d& position, PositionType positions) {
  const Vector3d p =
      positions == PositionType::float32 ? position.cast<float>().cast<double>() : position;
  return {p.x(), p.y(), p.z()};
}

}  // namespace

PairContacts collide_parts(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                           const Pose& pose_b, PositionType positions, float contact_distance,
                           const RegionLimits& limits) {
  const Double3 position_a = stored(pose_a.position, positions);
  const Double3 position_b = stored(pose_b.position, positions);
  // Parts are placed in double precision, so the pair is moved near the origin.
  const std::vector<Simple> parts_a = parts_of(shape_a, {}, pose_a.orientation);
  const std::vector<Simple> parts_b =
      parts_of(shape_b, minus(position_b, position_a), pose_b.orientation);

  Best best;
  std::vector<PartContact> contacts;
  for (const Simple& a : parts_a) {
    for (const Simple& b : parts_b) {
      const PairResult result = test(a, b, contact_distance);
      const Double3 way = {result.normal.x(), result.normal.y(), result.normal.z()};
      const bool touches = has_contact(result.overlap, result.separation, contact_distance);
      std::array<uint8_t, 2> closed{};
      if (touches) closed = {edges_to_close(a, b, way), edges_to_close(b, a, minus({}, way))};
      const bool is_over_edge = closed[0] != 0 || closed[1] != 0;
      if (touches) contacts.push_back(contact_of(result, a, b, is_over_edge));
      if (!result.overlap) closed = {};
      const Rank rank(result.overlap ? 0 : 1, closed[0] != 0 || closed[1] != 0, result.separation,
                      a.order, b.order);
      if (rank < best.rank) best = {rank, result, &a, &b, closed};
    }
  }
  if (best.is_over_edge()) {
    close_edges(best, contact_distance);
    const PartContact closed = contact_of(best.result, *best.a, *best.b, false);
    for (PartContact& contact : contacts) {
      if (contact.parts == closed.parts) contact = closed;
    }
  }
  for (PartContact& contact : contacts) {
    // The nearest contact of separate bodies counts in any case.
    if (best.a && contact.parts == std::array{best.a->order, best.b->order}) {
      contact.is_over_edge = false;
    }
  }
  return with_regions(best.result, contacts, parts_a, parts_b, limits);
}

}  // namespace carom::reference
