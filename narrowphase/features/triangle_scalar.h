// Triangles as cores, and the nearest point of a triangle to a point, scalar form.
//
// Source of the regions: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5. Here signs
// relative to the vector to a feature decide its region. So, even close to the triangle, the
// direction belongs to a feature on whose far side the whole triangle lies.
#pragma once

#include <type_traits>
#include <utility>

#include "base/tolerances.h"
#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// Corners in the order of the triangle, starting with its longest edge; `edge[i]` leads from corner
// i to the next. A triangle without a face (no area) is its longest edge: its third corner is set
// to the first.
template <class Real>
struct TriangleCore {
  using Vector = Vector3<Real>;

  std::array<Vector, 3> corner;
  std::array<Vector, 3> edge;
  std::array<Real, 3> squared;  // of the edges
  Vector normal;                // not a unit vector
  bool has_face;

  explicit TriangleCore(const std::array<Vector, 3>& corners) : corner(corners) {
    start_with_longest();
    normal = cross(edge[1], edge[2]);
    // Rounding of a sliver's third corner may turn the normal about the longest edge; but the
    // normal must be perpendicular to that edge.
    if (squared[0] > 0) normal -= edge[0] * (dot(normal, edge[0]) / squared[0]);
    using Tolerance = CoreTolerance<Real>;
    has_face = dot(normal, normal) >
               max(Tolerance::kFlat * (squared[0] * squared[0]), Tolerance::kVanishing);
    if (has_face) return;
    corner[2] = corner[0];
    measure_edges();
  }

 private:
  void start_with_longest() {
    measure_edges();
    if (squared[1] > squared[0] && squared[1] >= squared[2]) {
      corner = {corner[1], corner[2], corner[0]};
    } else if (squared[2] > squared[0]) {
      corner = {corner[2], corner[0], corner[1]};
    }
    measure_edges();
  }

  void measure_edges() {
    for (size_t i = 0; i < 3; ++i) {
      edge[i] = corner[(i + 1) % 3] - corner[i];
      squared[i] = dot(edge[i], edge[i]);
    }
  }
};

// From a point to the nearest point of a triangle.
template <class Real>
struct ToTriangle {
  Vector3<Real> way;  // direction to that point, not a unit vector
  Real distance;
  bool is_face;
};

// One edge as a point sees it.
template <class Real>
struct EdgeView {
  Vector3<Real> way;  // to the nearest point of the edge's line
  bool is_before;     // projects before the first end, or on it
  bool is_past;       // projects past the second end, or on it
  bool is_outside;    // the triangle lies on the far side of the edge

  EdgeView(const Vector3<Real>& p, const TriangleCore<Real>& triangle, size_t i) {
    const Vector3<Real>& edge = triangle.edge[i];
    const Vector3<Real> from = p - triangle.corner[i];
    const Vector3<Real> past = p - triangle.corner[(i + 1) % 3];
    const Real along = dot(from, edge);
    is_before = along <= 0;
    is_past = dot(past, edge) >= 0;
    way = edge * (triangle.squared[i] > 0 ? along / triangle.squared[i] : 0) - from;
    is_outside = !triangle.has_face || dot(way, cross(triangle.normal, edge)) > 0;
  }
};

// Takes the face if p is in the region of no edge and no corner. In double precision also if the
// nearest edge or corner is too near to give a direction; float leaves such points to double.
template <class Real>
ToTriangle<Real> nearest_on_triangle(const Vector3<Real>& p, const TriangleCore<Real>& triangle) {
  using Vector = Vector3<Real>;
  const auto has_way = [&](const Vector& way) {
    return std::is_same_v<Real, float> || !triangle.has_face ||
           std::sqrt(dot(way, way)) > Real(kCoincident);
  };
  const EdgeView<Real> views[3] = {{p, triangle, 0}, {p, triangle, 1}, {p, triangle, 2}};
  for (size_t i = 0; i < 3; ++i) {
    const EdgeView<Real>& view = views[i];
    if (view.is_before || view.is_past || !view.is_outside) continue;
    const Vector& edge = triangle.edge[i];
    const Vector way = view.way - edge * (dot(view.way, edge) / triangle.squared[i]);
    if (has_way(way)) return {way, std::sqrt(dot(way, way)), false};
  }
  const bool is_outside = views[0].is_outside || views[1].is_outside || views[2].is_outside;
  for (size_t i = 0; is_outside && i < 3; ++i) {
    if (!views[i].is_before || !views[(i + 2) % 3].is_past) continue;
    const Vector way = -Vector(p - triangle.corner[i]);
    if (has_way(way)) return {way, std::sqrt(dot(way, way)), false};
  }
  const Real height = dot(Vector(p - triangle.corner[0]), triangle.normal);
  const Vector way = height >= 0 ? Vector(-triangle.normal) : triangle.normal;
  return {way, std::fabs(height) / std::sqrt(dot(way, way)), true};
}

}  // namespace carom::scalar
