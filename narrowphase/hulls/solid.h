// Solids for the separating-axis search: points, faces and edges, in the solid's own frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/scalar/shapes.h"
#include "shapes/dop_solid.h"
#include "shapes/hull_features.h"

namespace carom {

using Eigen::Vector3f;

// Edges of a k-DOP, and the points that they start at. A search needs few of them.
struct DopEdges {
  std::array<HullFeatures::Edge, DopSolid::kMostEdges> edges;
  std::array<std::array<float, 4>, DopSolid::kMostPoints> points;

  // Writes these edges and their points; the others keep what they held.
  void put(const DopSolid& solid, std::span<const uint16_t> indices);
};

// Points in columns. Whole vectors are filled: the places after the last point repeat the first.
struct PointView {
  std::array<const float*, 3> column;
  size_t count, padded;

  Vector3f operator[](size_t i) const { return {column[0][i], column[1][i], column[2][i]}; }
};

// A view of columns. Multiply lengths by `scale` to get those of the pair. Columns are padded to a
// multiple of sixteen.
struct Solid {
  static constexpr size_t kMostFaces = 2 * kMostLanePoints;
  static constexpr size_t kMostEdges = 3 * kMostLanePoints;
  using Edge = HullFeatures::Edge;

  size_t point_count = 0;  // 0: the features are unknown
  size_t face_count = 0;
  std::array<const float*, 3> point;  // padded with the first point
  std::array<const float*, 4> plane;  // normal, height; padded with faces out of reach
  // The same as records, for what needs few of them: coordinates, then anything; normal, height.
  const std::array<float, 4>* point_record;  // not of k-DOPs
  const std::array<float, 4>* plane_record;
  size_t edge_count = 0;
  const Edge* edges;                   // not of k-DOPs
  std::array<const uint8_t*, 2> side;  // left and right face of each edge; padded to 64 edges
  // Each edge has a first and a last point, and the cosine of half the angle between its faces'
  // normals. k-DOPs do not have them here.
  std::array<const uint8_t*, 2> end;
  const float* half_cosine;
  Vector3f middle;     // inside
  float inner_radius;  // of a ball around `middle` inside the solid
  float scale = 1;
  bool is_turned = true;
  const DopSolid* dop = nullptr;  // of k-DOPs alone: their edges and points

  bool is_known() const {
    return point_count > 0 && point_count <= kMostLanePoints && face_count <= kMostFaces &&
           edge_count <= kMostEdges;
  }
  Vector3f corner(size_t i) const {
    return Vector3f(point[0][i], point[1][i], point[2][i]) * scale;
  }
  PointView points() const { return {point, point_count, padded_count(point_count)}; }
  Vector3f normal(size_t face) const { return {plane[0][face], plane[1][face], plane[2][face]}; }
  float height(size_t face) const { return plane[3][face] * scale; }
};

// Features of a shape with few, made for one pair. A triangle counts as a solid without height: it
// has two faces, and one more face along each edge. The segment of a capsule has four faces along
// it, and the centre of a sphere none.
class SmallSolid {
 public:
  explicit SmallSolid(const scalar::SphereShape<float>& sphere);
  explicit SmallSolid(const scalar::CapsuleShape<float>& capsule);
  explicit SmallSolid(const scalar::BoxShape<float>& box);
  explicit SmallSolid(const scalar::AabbShape<float>& box);
  // Unknown for special triangles and triangles without area.
  explicit SmallSolid(const scalar::TriangleShape<float>& triangle);

  SmallSolid(const SmallSolid&) = delete;
  SmallSolid& operator=(const SmallSolid&) = delete;

  const Solid& view() const { return view_; }

 private:
  static constexpr size_t kMost = 16;
  static constexpr size_t kMostSides = 64;

  void put_box(const Vector3f& lower, const Vector3f& upper);
  void put_triangle(const std::array<Vector3f, 3>& corners, const Vector3f& normal);
  void put_segment(const Vector3f& from, const Vector3f& to);
  void put_point(const Vector3f& point);
  void put_face(const Vector3f& normal, float height);
  void put_edge(const Vector3f& direction, uint32_t from, uint32_t to, uint8_t left, uint8_t right);
  void close();

  Solid view_;
  std::array<std::array<float, kMost>, 3> point_;
  std::array<std::array<float, kMost>, 4> plane_;
  FewOf<std::array<float, 4>, kMost> point_records_, plane_records_;
  FewOf<Solid::Edge, 12> edges_;
  std::array<std::array<uint8_t, kMostSides>, 2> side_{};
  std::array<std::array<uint8_t, kMost>, 2> end_{};
};

// A hull stores its features; this only views them.
class SolidHull {
 public:
  explicit SolidHull(const scalar::HullShape<float>& hull);

  const Solid& view() const { return view_; }

 private:
  void view_features(const HullGeometry& geometry, const HullFeatures& features);
  void view_dop(const HullGeometry& geometry, const DopSolid& dop);

  Solid view_;
};

// Whether the core of a shape is a solid; its depth is then found in float32.
template <class S>
inline constexpr bool kIsSolid = false;
template <>
inline constexpr bool kIsSolid<scalar::SphereShape<float>> = true;
template <>
inline constexpr bool kIsSolid<scalar::CapsuleShape<float>> = true;
template <>
inline constexpr bool kIsSolid<scalar::HullShape<float>> = true;
template <>
inline constexpr bool kIsSolid<scalar::BoxShape<float>> = true;
template <>
inline constexpr bool kIsSolid<scalar::AabbShape<float>> = true;
template <>
inline constexpr bool kIsSolid<scalar::TriangleShape<float>> = true;

// The solid of the core of a shape.
template <class S>
using SolidOf =
    std::conditional_t<std::is_same_v<S, scalar::HullShape<float>>, SolidHull, SmallSolid>;

}  // namespace carom
