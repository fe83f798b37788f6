#include "cli/check/mesh_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "base/tolerances.h"
#include "cli/check/convexity.h"
#include "io/models/vertex_places.h"

namespace carom::cli {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Corners = std::array<uint32_t, 3>;

// A directed edge of a triangle, by the places of its ends.
struct HalfEdge {
  uint32_t low;
  uint32_t high;
  bool is_upwards;  // the triangle goes from low to high
  uint32_t triangle;

  bool is_at(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

bool operator<(const HalfEdge& a, const HalfEdge& b) {
  return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
}

class MeshChecker {
 public:
  MeshChecker(std::span<const Vector3f> vertices, std::span<const Corners> triangles)
      : vertices_(vertices), triangles_(triangles) {
    report_.vertices = vertices.size();
    report_.triangles = triangles.size();
  }

  MeshReport check() {
    check_vertices();
    if (report_.not_finite.count > 0) return std::move(report_);
    find_places();
    check_triangles();
    check_edges();
    if (report_.has_faces()) check_convexity();
    return std::move(report_);
  }

 private:
  void check_vertices() {
    std::vector<bool> is_used(vertices_.size(), false);
    for (const Corners& corners : triangles_) {
      for (const uint32_t corner : corners) is_used[corner] = true;
    }
    for (uint32_t i = 0; i < vertices_.size(); ++i) {
      report_.unused_vertices += !is_used[i];
      if (!vertices_[i].allFinite()) report_.not_finite.add(i);
    }
  }

  void find_places() {
    place_ = io::first_at_place(vertices_);
    for (uint32_t i = 0; i < place_.size(); ++i) {
      if (place_[i] != i) report_.duplicate_vertices.add({i, place_[i]});
    }
  }

  void check_triangles() {
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto [a, b, c] = triangles_[t];
      if (a == b || b == c || c == a) {
        report_.repeated_index.add(t);
      } else if (has_no_area(t)) {
        report_.without_area.add(t);
      } else {
        faces_.push_back(t);
      }
    }
  }

  Vector3d corner(uint32_t triangle, size_t index) const {
    return vertices_[triangles_[triangle][index]].cast<double>();
  }

  // Collision leaves these triangles out; the same test as in the library.
  bool has_no_area(uint32_t triangle) const {
    const Vector3d u = corner(triangle, 1) - corner(triangle, 0);
    const Vector3d v = corner(triangle, 2) - corner(triangle, 0);
    return !(u.cross(v).norm() > kWithoutArea * (u.norm() * v.norm()));
  }

  // Includes slivers without area, because their edges may close a surface.
  std::vector<HalfEdge> half_edges() const {
    std::vector<HalfEdge> edges;
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      const Corners& corners = triangles_[t];
      const Corners at = {place_[corners[0]], place_[corners[1]], place_[corners[2]]};
      if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = at[i];
        const uint32_t to = at[(i + 1) % 3];
        edges.push_back({std::min(from, to), std::max(from, to), from < to, t});
      }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  void check_edges() {
    const std::vector<HalfEdge> edges = half_edges();
    for (size_t first = 0, end; first < edges.size(); first = end) {
      end = first + 1;
      while (end < edges.size() && edges[end].is_at(edges[first])) ++end;
      check_edge(std::span(edges).subspan(first, end - first));
    }
  }

  static MeshEdge mesh_edge(std::span<const HalfEdge> sides) {
    const HalfEdge& side = sides.front();
    return {side.is_upwards ? side.low : side.high, side.is_upwards ? side.high : side.low,
            side.triangle, static_cast<uint32_t>(sides.size())};
  }

  void check_edge(std::span<const HalfEdge> sides) {
    if (sides.size() == 1) {
      report_.open_edges.add(mesh_edge(sides));
    } else if (sides.size() > 2) {
      report_.crowded_edges.add(mesh_edge(sides));
    } else if (sides[0].is_upwards == sides[1].is_upwards) {
      report_.opposed_edges.add(mesh_edge(sides));
    } else {
      bends_.push_back({mesh_edge(sides), apex(sides[1])});
    }
  }

  // The corner of the edge's triangle that is not on the edge.
  uint32_t apex(const HalfEdge& edge) const {
    for (const uint32_t vertex : triangles_[edge.triangle]) {
      if (place_[vertex] != edge.low && place_[vertex] != edge.high) return vertex;
    }
    return edge.low;
  }

  void check_convexity() {
    Convexity convexity(vertices_);
    double outwards = 0;
    for (const uint32_t t : faces_) {
      outwards += convexity.volume_below({corner(t, 0), corner(t, 1), corner(t, 2)});
    }
    report_.inside_out = outwards < 0;
    find_dented_edge(convexity);
    if (!report_.dent) find_dent(convexity);
  }

  // The plane of a triangle with its front outwards.
  ConvexPlane plane_of(const Convexity& convexity, uint32_t triangle) const {
    const size_t second = report_.inside_out ? 2 : 1;
    return convexity.plane(
        {corner(triangle, 0), corner(triangle, second), corner(triangle, 3 - second)});
  }

  void note(const Dent& dent) {
    if (dent.height > 0 && (!report_.dent || dent.height > report_.dent->height)) {
      report_.dent = dent;
    }
  }

  void find_dented_edge(const Convexity& convexity) {
    for (const Bend& bend : bends_) {
      if (has_no_area(bend.edge.triangle)) continue;
      const ConvexPlane plane = plane_of(convexity, bend.edge.triangle);
      note({plane.excess(vertices_[bend.apex].cast<double>()), bend.edge.triangle, bend.apex, true,
            bend.edge});
    }
  }

  void find_dent(const Convexity& convexity) {
    for (const uint32_t t : faces_) {
      const auto [vertex, height] = convexity.highest(plane_of(convexity, t));
      note({height, t, vertex, false, {}});
    }
  }

  // Two triangles at an edge: the edge names one, `apex` is the free corner of the other.
  struct Bend {
    MeshEdge edge;
    uint32_t apex;
  };

  std::span<const Vector3f> vertices_;
  std::span<const Corners> triangles_;
  std::vector<uint32_t> place_;  // for each vertex the first one at its place
  std::vector<uint32_t> faces_;  // triangles with an area
  std::vector<Bend> bends_;
  MeshReport report_;
};

}  // namespace

MeshReport check_mesh(std::span<const Vector3f> vertices, std::span<const Corners> triangles) {
  return MeshChecker(vertices, triangles).check();
}

}  // namespace carom::cli
