#include "reference/composite.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "narrowphase/manifolds/merge.h"
#include "reference/scalar.h"
#include "reference/simple_parts.h"

namespace carom::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

PairResult test(const Simple& a, const Simple& b) {
  return collide(a.shape, a.pose(), b.shape, b.pose(), PositionType::float64);
}

// The inner edges of a triangle of a mesh, if the other part is pushed out over one of them; else
// 0.
uint8_t edges_to_close(const Simple& part, const Simple& other, const Double3& way) {
  if (!part.mesh || std::holds_alternative<Halfspace>(other.shape)) return 0;
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

PairResult nothing() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Vector3f nan = Vector3f::Constant(kNan);
  return {false, Status::ok, std::numeric_limits<float>::infinity(), nan, nan, nan, 0, {}, 0, 0};
}

PartContact contact_of(const PairResult& result, const Simple& a, const Simple& b,
                       bool is_over_edge) {
  const Vector3f& n = result.normal;
  return {{a.order, b.order},    {n.x(), n.y(), n.z()}, result.separation,
          result.manifold_count, result.manifold,       is_over_edge};
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
void close_edges(Best& best) {
  const PairResult again =
      test(with_inner_edges(*best.a, best.closed[0]), with_inner_edges(*best.b, best.closed[1]));
  if (again.overlap) {
    best.result = from_parts(again, *best.a, *best.b);
    return;
  }
  const Vector3f& p = best.result.arm_a;
  best.result.manifold_count = 1;
  best.result.manifold = {};
  best.result.manifold.point[0] = {p.x(), p.y(), p.z()};
  best.result.manifold.separation[0] = best.result.separation;
}

Double3 stored(const Vector3d& position, PositionType positions) {
  const Vector3d p =
      positions == PositionType::float32 ? position.cast<float>().cast<double>() : position;
  return {p.x(), p.y(), p.z()};
}

}  // namespace

PairResult collide_parts(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                         const Pose& pose_b, PositionType positions) {
  Double3 position_a = stored(pose_a.position, positions);
  Double3 position_b = stored(pose_b.position, positions);
  // Children are placed in double precision, so the pair is moved near the origin.
  if (kind_of(shape_a) == ShapeKind::compound || kind_of(shape_b) == ShapeKind::compound) {
    position_b = minus(position_b, position_a);
    position_a = {};
  }
  const std::vector<Simple> parts_a = parts_of(shape_a, position_a, pose_a.orientation);
  const std::vector<Simple> parts_b = parts_of(shape_b, position_b, pose_b.orientation);

  Best best;
  std::vector<PartContact> contacts;
  for (const Simple& a : parts_a) {
    for (const Simple& b : parts_b) {
      const PairResult result = from_parts(test(a, b), a, b);
      const Double3 way = {result.normal.x(), result.normal.y(), result.normal.z()};
      std::array<uint8_t, 2> closed{};
      if (result.overlap) {
        closed = {edges_to_close(a, b, way), edges_to_close(b, a, minus({}, way))};
      }
      const bool is_over_edge = closed[0] != 0 || closed[1] != 0;
      const Rank rank(result.overlap ? 0 : 1, is_over_edge, result.separation, a.order, b.order);
      if (rank < best.rank) best = {rank, result, &a, &b, closed};
      if (result.overlap) contacts.push_back(contact_of(result, a, b, is_over_edge));
    }
  }
  if (best.is_over_edge()) {
    close_edges(best);
    const PartContact closed = contact_of(best.result, *best.a, *best.b, false);
    for (PartContact& contact : contacts) {
      if (contact.parts == closed.parts) contact = closed;
    }
  }
  std::vector<merging::SeenPoint> seen;
  const MergedManifold manifold = merged_manifold(contacts, seen);
  best.result.manifold_count = manifold.count;
  best.result.manifold = manifold.points;
  return best.result;
}

}  // namespace carom::reference
