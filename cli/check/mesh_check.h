// What is wrong with a mesh, and where.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom::cli {

// How many there are, and the first few of them.
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

// Vertices as given; of several at one place the first.
struct MeshEdge {
  uint32_t from;
  uint32_t to;
  uint32_t triangle;   // one that has it, from `from` to `to`
  uint32_t triangles;  // how many have it
};

// How far a vertex is in front of the plane of a triangle, beyond what rounding may do.
struct Dent {
  double height = 0;  // metres
  uint32_t triangle = 0;
  uint32_t vertex = 0;
  bool at_edge = false;  // both are at `edge`, which is bent inwards
  MeshEdge edge{};
};

struct MeshReport {
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t unused_vertices = 0;
  Findings<uint32_t> not_finite;                         // vertices
  Findings<std::array<uint32_t, 2>> duplicate_vertices;  // and the first at the same place
  Findings<uint32_t> repeated_index;                     // triangles with a corner twice
  Findings<uint32_t> without_area;                       // others that collision leaves out
  Findings<MeshEdge> open_edges;                         // of one triangle
  Findings<MeshEdge> crowded_edges;                      // of more than two
  Findings<MeshEdge> opposed_edges;  // of two that look to different sides of the surface
  bool inside_out = false;           // the fronts look inwards
  std::optional<Dent> dent;          // the worst, if the mesh is not convex

  bool has_faces() const {
    return triangles > repeated_index.count + without_area.count && not_finite.count == 0;
  }
  bool is_watertight() const {
    return has_faces() && open_edges.count + crowded_edges.count + opposed_edges.count == 0;
  }
  // Every vertex is behind the plane of every triangle, up to the rounding of float32.
  bool is_convex() const { return has_faces() && !dent; }
};

// Indices must lie inside the vertices. Corners at one place count as one, whatever their indices,
// except for repeated_index. With vertices that are not finite nothing is said about shape.
MeshReport check_mesh(std::span<const Eigen::Vector3f> vertices,
                      std::span<const std::array<uint32_t, 3>> triangles);

}  // namespace carom::cli
