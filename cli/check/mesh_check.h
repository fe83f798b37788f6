// Finds the faults of a mesh and where they are.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom::cli {

// The number of findings and the first few of them.
template <class T>
struct Findings {
  static constexpr size_t kKept = 8;

  uint64_t count = 0;
  std::vector<T> first;

  void add(T finding) {
    ++count;
    if (first.size() < kKept) first.push_back(std::move(finding));
  }
};

// Indices of vertices as given; the first of several at one place.
struct MeshEdge {
  uint32_t from;
  uint32_t to;
  uint32_t triangle;   // one that has the edge, from `from` to `to`
  uint32_t triangles;  // how many triangles have it
};

// A vertex in front of the plane of a triangle, by more than rounding explains.
struct Dent {
  double height = 0;  // metres
  uint32_t triangle = 0;
  uint32_t vertex = 0;
  bool at_edge = false;  // both are at `edge`, a concave edge
  MeshEdge edge{};
};

struct MeshReport {
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t unused_vertices = 0;
  Findings<uint32_t> not_finite;                         // vertices
  Findings<std::array<uint32_t, 2>> duplicate_vertices;  // each with the first at the same place
  Findings<uint32_t> repeated_index;                     // triangles with a corner twice
  Findings<uint32_t> without_area;   // other triangles that collision leaves out
  Findings<MeshEdge> open_edges;     // edges of one triangle
  Findings<MeshEdge> crowded_edges;  // edges of more than two
  Findings<MeshEdge> opposed_edges;  // edges of two that face different sides
  bool inside_out = false;           // the fronts face inwards
  std::optional<Dent> dent;          // the worst, if the mesh is not convex

  bool has_faces() const {
    return triangles > repeated_index.count + without_area.count && not_finite.count == 0;
  }
  bool is_watertight() const {
    return has_faces() && open_edges.count + crowded_edges.count + opposed_edges.count == 0;
  }
  // Whether every vertex is behind the plane of every triangle, up to the rounding of float32.
  bool is_convex() const { return has_faces() && !dent; }
};

// Indices must be valid. Corners at one place count as one, whatever their indices, except for
// repeated_index. If vertices are not finite, the report does not describe the surface.
MeshReport check_mesh(std::span<const Eigen::Vector3f> vertices,
                      std::span<const std::array<uint32_t, 3>> triangles);

}  // namespace carom::cli
