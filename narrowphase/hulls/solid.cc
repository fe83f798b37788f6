#include "narrowphase/hulls/solid.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/features/segment_scalar.h"

namespace carom {
namespace {

// Faces of small solids meet at right angles.
constexpr std::array<float, 16> kOfSquareEdges = [] {
  std::array<float, 16> cosines{};
  cosines.fill(0.707106781f);
  return cosines;
}();

}  // namespace

SolidHull::SolidHull(const scalar::HullShape<float>& hull) {
  const HullGeometry& geometry = *hull.geometry;
  view_.scale = static_cast<float>(hull.scale);
  if (const DopSolid* const dop = geometry.dop_solid()) {
    view_dop(geometry, *dop);
  } else if (const HullFeatures* const features = geometry.features()) {
    view_features(geometry, *features);
  }
}

void SolidHull::view_features(const HullGeometry& geometry, const HullFeatures& features) {
  const std::array<float, 4>& middle = geometry.records()[geometry.points().size()];
  view_.point_count = geometry.points().size();
  view_.face_count = features.face_count();
  for (size_t axis = 0; axis < 3; ++axis) view_.point[axis] = geometry.column(axis);
  for (size_t i = 0; i < 4; ++i) view_.plane[i] = features.column(i);
  view_.point_record = geometry.records().data();
  view_.plane_record = features.planes().data();
  view_.edge_count = features.edges().size();
  view_.edges = features.edges().data();
  view_.side = {features.sides(0), features.sides(1)};
  view_.end = {features.ends(0), features.ends(1)};
  view_.half_cosine = features.half_cosines();
  view_.middle = {middle[0], middle[1], middle[2]};
  view_.inner_radius = features.inner_radius();
}

void SolidHull::view_dop(const HullGeometry& geometry, const DopSolid& dop) {
  const DopDirections& directions = DopDirections::get();
  const std::array<float, 4>& middle = dop.middle();
  view_.point_count = geometry.points().size();
  view_.face_count = dop.plane_count();
  for (size_t axis = 0; axis < 3; ++axis) {
    view_.point[axis] = dop.column(axis);
    view_.plane[axis] = directions.column(axis);
  }
  view_.plane[3] = dop.heights();
  view_.plane_record = directions.records();
  view_.edge_count = dop.edge_count();
  view_.side = {dop.sides(0), dop.sides(1)};
  view_.middle = {middle[0], middle[1], middle[2]};
  view_.inner_radius = dop.inner_radius();
  view_.dop = &dop;
}

void DopEdges::put(const DopSolid& solid, std::span<const uint16_t> indices) {
  const DopDirections& directions = DopDirections::get();
  for (const uint16_t e : indices) {
    const auto [from, left, right] = solid.edge(e);
    edges[e] = {directions.edge(left, right), from, left, right};
    points[from] = {solid.column(0)[from], solid.column(1)[from], solid.column(2)[from], 0};
  }
}

SmallSolid::SmallSolid(const scalar::SphereShape<float>&) {
  put_point(Vector3f::Zero());
  view_.middle = Vector3f::Zero();
  view_.inner_radius = 0;
  view_.is_turned = false;
  close();
}

SmallSolid::SmallSolid(const scalar::CapsuleShape<float>& capsule) {
  put_segment(capsule.a, capsule.b);
}

SmallSolid::SmallSolid(const scalar::BoxShape<float>& box) { put_box(-box.half, box.half); }

SmallSolid::SmallSolid(const scalar::AabbShape<float>& box) {
  put_box(box.lower, box.upper);
  view_.is_turned = false;
}

SmallSolid::SmallSolid(const scalar::TriangleShape<float>& triangle) {
  if (triangle.is_special()) return;
  const auto corner = [&](size_t i) -> Eigen::Vector3d {
    return triangle.corners[i].cast<double>();
  };
  const Eigen::Vector3d u = corner(1) - corner(0), v = corner(2) - corner(0);
  const Eigen::Vector3d n = scalar::cross(u, v);
  const double nn = scalar::dot(n, n);
  // The edges of a flatter triangle give its plane no better than rounding.
  if (!(nn > kFlatTriangle * scalar::dot(u, u) * scalar::dot(v, v))) return;
  put_triangle(triangle.corners, (n * (1 / std::sqrt(nn))).cast<float>());
}

// Face 2k lies at the lower end of axis k, face 2k + 1 at the upper end.
void SmallSolid::put_box(const Vector3f& lower, const Vector3f& upper) {
  const std::array<Vector3f, 2> ends = {lower, upper};
  for (size_t i = 0; i < 8; ++i) {
    put_point({ends[i & 1].x(), ends[i >> 1 & 1].y(), ends[i >> 2].z()});
  }
  for (int axis = 0; axis < 3; ++axis) {
    put_face(-Vector3f::Unit(axis), -lower[axis]);
    put_face(Vector3f::Unit(axis), upper[axis]);
  }
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const auto next = static_cast<uint8_t>((axis + 1) % 3);
    const auto last = static_cast<uint8_t>((axis + 2) % 3);
    for (uint8_t ends_at = 0; ends_at < 4; ++ends_at) {
      const uint8_t one = ends_at & 1, other = ends_at >> 1;
      const auto face = static_cast<uint8_t>(2 * next + one);
      const auto other_face = static_cast<uint8_t>(2 * last + other);
      const auto from = uint32_t{one} << next | uint32_t{other} << last;
      const uint32_t to = from | 1u << axis;
      if (one == other) {
        put_edge(Vector3f::Unit(axis), from, to, face, other_face);
      } else {
        put_edge(Vector3f::Unit(axis), from, to, other_face, face);
      }
    }
  }
  view_.middle = (lower + upper) * 0.5f;
  view_.inner_radius = ((upper - lower) * 0.5f).minCoeff();
  close();
}

void SmallSolid::put_triangle(const std::array<Vector3f, 3>& corners, const Vector3f& normal) {
  for (const Vector3f& corner : corners) put_point(corner);
  const float height = scalar::dot(normal, corners[0]);
  put_face(normal, height);
  put_face(-normal, -height);
  for (uint8_t i = 0; i < 3; ++i) {
    const uint32_t from = i, to = (i + 1u) % 3;
    const Vector3f along = corners[to] - corners[from];
    const Vector3f direction = along * (1 / std::sqrt(scalar::dot(along, along)));
    const Vector3f outwards = scalar::cross(direction, normal);
    const auto side = static_cast<uint8_t>(2 + i);
    put_face(outwards,
             std::max(scalar::dot(outwards, corners[from]), scalar::dot(outwards, corners[to])));
    put_edge(direction, from, to, 0, side);
    put_edge(-direction, to, from, 1, side);
  }
  view_.middle = (corners[0] + corners[1] + corners[2]) * (1.0f / 3);
  view_.inner_radius = 0;
  close();
}

void SmallSolid::put_segment(const Vector3f& from, const Vector3f& to) {
  put_point(from);
  const Vector3f along = to - from;
  const float squared = scalar::dot(along, along);
  if (squared > kShortestSegment * kShortestSegment) {
    put_point(to);
    const Vector3f direction = along * (1 / std::sqrt(squared));
    const Vector3f u = scalar::any_perpendicular(direction), v = scalar::cross(direction, u);
    for (const Vector3f& normal : {u, v, Vector3f(-u), Vector3f(-v)}) {
      put_face(normal, std::max(scalar::dot(normal, from), scalar::dot(normal, to)));
    }
    for (uint8_t side = 0; side < 4; ++side) {
      put_edge(direction, 0, 1, side, static_cast<uint8_t>((side + 1) % 4));
    }
  }
  view_.middle = (from + to) * 0.5f;
  view_.inner_radius = 0;
  close();
}

void SmallSolid::put_point(const Vector3f& point) {
  for (size_t axis = 0; axis < 3; ++axis) point_[axis][view_.point_count] = point[int(axis)];
  point_records_.push_back({point.x(), point.y(), point.z(), 0});
  ++view_.point_count;
}

void SmallSolid::put_face(const Vector3f& normal, float height) {
  for (size_t axis = 0; axis < 3; ++axis) plane_[axis][view_.face_count] = normal[int(axis)];
  plane_[3][view_.face_count++] = height;
  plane_records_.push_back({normal.x(), normal.y(), normal.z(), height});
}

void SmallSolid::put_edge(const Vector3f& direction, uint32_t from, uint32_t to, uint8_t left,
                          uint8_t right) {
  end_[0][edges_.size()] = static_cast<uint8_t>(from);
  end_[1][edges_.size()] = static_cast<uint8_t>(to);
  side_[0][edges_.size()] = left;
  side_[1][edges_.size()] = right;
  edges_.push_back({{direction.x(), direction.y(), direction.z(), 0}, from, left, right});
}

void SmallSolid::close() {
  for (size_t axis = 0; axis < 3; ++axis) {
    std::fill(point_[axis].begin() + view_.point_count, point_[axis].end(), point_[axis][0]);
    std::fill(plane_[axis].begin() + view_.face_count, plane_[axis].end(), 0.0f);
    view_.point[axis] = point_[axis].data();
    view_.plane[axis] = plane_[axis].data();
  }
  std::fill(plane_[3].begin() + view_.face_count, plane_[3].end(), HUGE_VALF);
  view_.plane[3] = plane_[3].data();
  view_.point_record = point_records_.begin();
  view_.plane_record = plane_records_.begin();
  view_.edge_count = edges_.size();
  view_.edges = edges_.begin();
  view_.side = {side_[0].data(), side_[1].data()};
  view_.end = {end_[0].data(), end_[1].data()};
  view_.half_cosine = kOfSquareEdges.data();
}

}  // namespace carom
