#include "geometries/shared_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace carom {
namespace {

using Eigen::Vector3f;

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
  TriangleEdge side;

  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
  friend bool operator<(const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.side.triangle, a.side.index) <
           std::tie(b.low, b.high, b.side.triangle, b.side.index);
  }
};

}  // namespace

void for_each_shared_edge(
    const MeshGeometry& mesh,
    FunctionRef<void(const TriangleEdge& own, const TriangleEdge& other)> use) {
  const std::vector<uint32_t> places = places_of(mesh.vertices());
  std::vector<Edge> edges;
  for (uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    if (mesh.is_degenerate(t)) continue;
    for (uint8_t i = 0; i < 3; ++i) {
      const uint32_t a = places[mesh.triangles()[t][i]];
      const uint32_t b = places[mesh.triangles()[t][(i + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b), {t, i}});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].same_place(edges[first])) ++end;
    if (end - first != 2) continue;
    use(edges[first].side, edges[first + 1].side);
    use(edges[first + 1].side, edges[first].side);
  }
}

}  // namespace carom
