#include "carom/shapes/mesh_geometry.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numeric>
#include <string>

#include "base/float_environment.h"
#include "base/outward.h"
#include "base/tolerances.h"
#include "geometries/inner_edges.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {
namespace {

using Eigen::Vector3f;
using Corners = std::array<uint32_t, 3>;

double length(const Double3& v) { return std::sqrt(dot(v, v)); }

// Numbers the places of the vertices: vertices at one place get the same number.
std::vector<uint32_t> places_of(std::span<const Vector3f> vertices) {
  const auto is_before = [&](uint32_t a, uint32_t b) {
    const Vector3f &u = vertices[a], &v = vertices[b];
    return std::lexicographical_compare(u.data(), u.data() + 3, v.data(), v.data() + 3);
  };
  std::vector<uint32_t> order(vertices.size()), places(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), is_before);
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || is_before(order[i - 1], order[i]);
    places[order[i]] = is_new ? static_cast<uint32_t>(i) : places[order[i - 1]];
  }
  return places;
}

// An edge of a triangle, by the numbers of the places of its ends.
struct Edge {
  uint32_t low, high;
  uint32_t triangle;
  uint8_t index;

  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
  friend bool operator<(const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle, a.index) <
           std::tie(b.low, b.high, b.triangle, b.index);
  }
};

}  // namespace

class MeshMaker {
 public:
  MeshMaker(std::span<const Vector3f> vertices, std::span<const Corners> triangles,
            const MeshRules& rules)
      : mesh_(new MeshGeometry()) {
    mesh_->vertices_.reserve(vertices.size() + 1);
    mesh_->vertices_.assign(vertices.begin(), vertices.end());
    mesh_->vertices_.push_back(Vector3f::Zero());
    mesh_->triangles_.assign(triangles.begin(), triangles.end());
    mesh_->rules_ = rules;
  }

  std::shared_ptr<const MeshGeometry> make() {
    find_degenerate();
    find_inner_edges();
    find_boxes();
    return mesh_;
  }

 private:
  std::array<Double3, 3> corners(size_t triangle) const {
    return {corner(*mesh_, triangle, 0), corner(*mesh_, triangle, 1), corner(*mesh_, triangle, 2)};
  }

  void find_degenerate() {
    mesh_->edges_.resize(mesh_->triangles_.size());
    for (size_t t = 0; t < mesh_->triangles_.size(); ++t) {
      const auto [a, b, c] = corners(t);
      const double area = length(cross(minus(b, a), minus(c, a)));
      const double sides = length(minus(b, a)) * length(minus(c, a));
      mesh_->edges_[t].is_degenerate = !(area > kWithoutArea * sides);
      mesh_->degenerate_count_ += mesh_->edges_[t].is_degenerate;
    }
  }

  void find_inner_edges() {
    const std::vector<uint32_t> places = places_of(mesh_->vertices_);
    std::vector<Edge> edges;
    for (uint32_t t = 0; t < mesh_->triangles_.size(); ++t) {
      if (mesh_->is_degenerate(t)) continue;
      for (uint8_t i = 0; i < 3; ++i) {
        const uint32_t a = places[mesh_->triangles_[t][i]];
        const uint32_t b = places[mesh_->triangles_[t][(i + 1) % 3]];
        edges.push_back({std::min(a, b), std::max(a, b), t, i});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t first = 0, end = 0; first < edges.size(); first = end) {
      while (end < edges.size() && edges[end].same_place(edges[first])) ++end;
      if (end - first != 2) continue;
      join(edges[first], edges[first + 1]);
      join(edges[first + 1], edges[first]);
    }
  }

  void join(const Edge& edge, const Edge& other) {
    const Double3 across = corner(*mesh_, other.triangle, (other.index + 2u) % 3);
    const InnerSides inner = inner_sides(corners(edge.triangle), edge.index, across);
    const auto bit = static_cast<uint8_t>(1u << edge.index);
    MeshGeometry::Edges& edges = mesh_->edges_[edge.triangle];
    if (inner.from_front) edges.inner_from_front |= bit;
    if (inner.from_back) edges.inner_from_back |= bit;
  }

  void find_boxes() {
    std::vector<TreeBox> boxes(mesh_->triangles_.size());
    for (size_t t = 0; t < boxes.size(); ++t) {
      const TreeBox box = box_of_triangle(t);
      for (int axis = 0; axis < 3; ++axis) {
        float& lower = mesh_->lower_[axis];
        float& upper = mesh_->upper_[axis];
        lower = t == 0 ? box.lower[axis] : std::min(lower, box.lower[axis]);
        upper = t == 0 ? box.upper[axis] : std::max(upper, box.upper[axis]);
      }
      boxes[t] = mesh_->is_degenerate(t) ? TreeBox{{1, 1, 1}, {-1, -1, -1}} : box;
    }
    mesh_->tree_ = std::make_unique<BoxTree>(boxes);
  }

  TreeBox box_of_triangle(size_t triangle) const {
    const auto all = corners(triangle);
    const double thickness = mesh_->rules_.thickness;
    const Double3 back = way_back(all[0], all[1], all[2], thickness);
    const double slack = thickness * (greatest(back) > 0 ? 0x1p-24 : 1);
    TreeBox box;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double lower = std::min({all[0][axis], all[1][axis], all[2][axis]});
      const double upper = std::max({all[0][axis], all[1][axis], all[2][axis]});
      box.lower[axis] = downwards(lower + std::min(back[axis], 0.0) - slack);
      box.upper[axis] = -downwards(-(upper + std::max(back[axis], 0.0) + slack));
    }
    return box;
  }

  static float downwards(double x) {
    return round_downwards(std::clamp(x, -double{FLT_MAX}, double{FLT_MAX}));
  }

  std::shared_ptr<MeshGeometry> mesh_;
};

MeshGeometry::MeshGeometry() = default;
MeshGeometry::~MeshGeometry() = default;

Result<std::shared_ptr<const MeshGeometry>> make_mesh(std::span<const Vector3f> vertices,
                                                      std::span<const Corners> triangles,
                                                      const MeshRules& rules) {
  const FloatEnvironment environment;
  if (triangles.empty()) return Error{"a mesh without triangles"};
  if (triangles.size() > BoxTree::kMostItems) return Error{"a mesh of too many triangles"};
  if (!(rules.thickness >= 0 && rules.thickness <= FLT_MAX)) {
    return Error{"the thickness of the mesh is negative or not finite"};
  }
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      return Error{"vertex " + std::to_string(i) + " of the mesh is not finite"};
    }
  }
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (*std::max_element(triangles[i].begin(), triangles[i].end()) >= vertices.size()) {
      return Error{"triangle " + std::to_string(i) +
                   " of the mesh has a vertex that does not exist"};
    }
  }
  return MeshMaker(vertices, triangles, rules).make();
}

}  // namespace carom
