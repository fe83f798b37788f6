#include "reference/composite.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "carom/kernel/compound_geometry.h"
#include "carom/kernel/mesh_geometry.h"
#include "kernel/part.h"
#include "narrowphase/merge_ref.h"

namespace carom::reference {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;

// A shape that has no parts.
struct Simple {
  Shape shape;
  Part placed;                         // the same, as numbers
  Double3 arm{};                       // from the body's position
  uint64_t order = 0;                  // the child, and the triangle of a mesh
  uint32_t sub = 0;                    // what it is called
  const MeshGeometry* mesh = nullptr;  // of which it is this triangle
  size_t triangle = 0;

  Pose pose() const {
    const Row& q = placed.orientation;
    return {Vector3d(placed.position[0], placed.position[1], placed.position[2]),
            Quaternionf(q[3], q[0], q[1], q[2])};
  }
  PlacedTriangle placed_triangle() const {
    return {*mesh, triangle, placed.position, rotation_of(placed.orientation)};
  }
};

Part part_of(const Shape& shape, const Double3& position, const Row& orientation) {
  Part part;
  part.kind = kind_of(shape);
  part.position = position;
  part.rows = shape_rows(shape);
  part.orientation = orientation;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) part.radius = sphere->radius;
  if (const auto* box = std::get_if<Aabb>(&shape)) {
    std::copy_n(box->lower.data(), 3, part.lower.begin());
    std::copy_n(box->upper.data(), 3, part.upper.begin());
  }
  return part;
}

Triangle triangle_of(const MeshGeometry& mesh, size_t i) {
  Triangle triangle;
  for (size_t k = 0; k < 3; ++k) triangle.corners[k] = mesh.vertices()[mesh.triangles()[i][k]];
  triangle.thickness = mesh.rules().thickness;
  triangle.one_sided = mesh.rules().one_sided;
  return triangle;
}

// What a body, or a child of one, is made of. `whole` is the shape in its place.
void add_parts(const Simple& whole, std::vector<Simple>& parts) {
  if (const auto* mesh = std::get_if<Mesh>(&whole.shape)) {
    for (size_t i = 0; i < mesh->geometry->triangles().size(); ++i) {
      if (mesh->geometry->is_degenerate(i)) continue;
      Simple part = whole;
      part.shape = triangle_of(*mesh->geometry, i);
      part.placed = part_of(part.shape, whole.placed.position, whole.placed.orientation);
      part.order += i;
      part.mesh = mesh->geometry.get();
      part.triangle = i;
      parts.push_back(part);
    }
  } else if (const auto* compound = std::get_if<Compound>(&whole.shape)) {
    const Part& body = whole.placed;
    for (uint32_t i = 0; i < compound->geometry->parts().size(); ++i) {
      const Part& child = compound->geometry->parts()[i];
      const PlacedChild pose =
          placed(child, body.position, rotation_of(body.orientation), body.orientation);
      Simple part;
      part.shape = child.kind == ShapeKind::sphere ? Shape(Sphere{child.radius})
                                                   : shape_from_rows(child.kind, child.rows.data());
      part.placed = part_of(part.shape, pose.position, pose.orientation);
      part.arm = pose.arm;
      part.order = uint64_t{i} << 32;
      add_parts(part, parts);
    }
  } else {
    parts.push_back(whole);
  }
}

std::vector<Simple> parts_of(const Shape& shape, const Double3& position,
                             const Quaternionf& orientation) {
  const Eigen::Vector4f& q = orientation.coeffs();
  Simple whole;
  whole.shape = shape;
  whole.placed = part_of(shape, position, {q.x(), q.y(), q.z(), q.w()});
  std::vector<Simple> parts;
  add_parts(whole, parts);
  const bool by_child = kind_of(shape) == ShapeKind::compound;
  for (Simple& part : parts) {
    part.sub = static_cast<uint32_t>(by_child ? part.order >> 32 : part.order);
  }
  return parts;
}

PairResult test(const Simple& a, const Simple& b) {
  return collide(a.shape, a.pose(), b.shape, b.pose(), PositionType::float64);
}

// The inner edges of a triangle of a mesh, if the other one leaves over one of them.
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

// Relative to the bodies.
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

// Overlapping pairs of parts before separate ones, those that meet over inner edges after others;
// the deepest, and the first of those.
using Rank = std::tuple<int, bool, float, uint64_t, uint64_t>;

struct Best {
  Rank rank{1, true, HUGE_VALF, UINT64_MAX, UINT64_MAX};
  PairResult result = nothing();
  const Simple* a = nullptr;
  const Simple* b = nullptr;
  std::array<uint8_t, 2> closed{};  // edges, of either side

  bool is_over_edge() const { return closed[0] != 0 || closed[1] != 0; }
};

// Again with no way over inner edges. That the two overlap stays as it was: where this test finds
// that they do not, the contact is the one before.
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
  // Children are placed in double precision, near the pair.
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
