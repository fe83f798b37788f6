#include "tests/support/inner_edges.h"

namespace carom::test {

InnerEdges::InnerEdges(const Mesh& mesh) : mesh_(*mesh.geometry), edges_(mesh_.triangles().size()) {
  std::map<std::pair<Place, Place>, std::vector<Edge>> sharing;
  for (uint32_t t = 0; t < edges_.size(); ++t) {
    for (uint8_t i = 0; i < 3; ++i) {
      sharing[std::minmax(place(t, i), place(t, i + 1u))].push_back({t, i});
    }
  }
  for (const auto& [ends, triangles] : sharing) {
    if (triangles.size() != 2) continue;
    join(triangles[0], triangles[1]);
    join(triangles[1], triangles[0]);
  }
}

std::array<float, 3> InnerEdges::place(uint32_t triangle, size_t i) const {
  const Eigen::Vector3f v = mesh_.corners(triangle)[i % 3];
  return {v.x() + 0.0f, v.y() + 0.0f, v.z() + 0.0f};
}

oracle::Vec3<long double> InnerEdges::corner(uint32_t triangle, size_t i) const {
  return oracle::vec3_as<long double>(place(triangle, i));
}

void InnerEdges::join(const Edge& edge, const Edge& other) {
  const Vec start = corner(edge.triangle, edge.index);
  const Vec along = corner(edge.triangle, edge.index + 1u) - start;
  const Vec normal = normalized(cross(along, corner(edge.triangle, edge.index + 2u) - start));
  const Vec way = corner(other.triangle, other.index + 2u) - start;
  const Number height = dot(normal, way);
  const Number bend = kFlat * length(across(way, normalized(along)));
  const Number rounding = 1e-6L * (length(start) + length(way));
  const auto bit = static_cast<uint8_t>(1u << edge.index);
  FlapEdges& edges = edges_[edge.triangle];
  const bool is_flat = std::fabs(height) < bend / 2;
  if (height > -2 * bend - rounding) edges.from_front.maybe |= bit;
  if (height < 2 * bend + rounding) edges.from_back.maybe |= bit;
  if (height > 2 * bend + rounding || is_flat) edges.from_front.surely |= bit;
  if (height < -2 * bend - rounding || is_flat) edges.from_back.surely |= bit;
}

ExactFlap::ExactFlap(const oracle::ConvexShape<long double>& triangle, const FlapEdges& edges)
    : edges_(edges) {
  for (size_t i = 0; i < 3; ++i) corners_[i] = triangle.points[i];
  const Vec u = corners_[1] - corners_[0], v = corners_[2] - corners_[0];
  front_ = normalized(cross(u, v));
  size_ = std::max(length(u), length(v));
}

bool ExactFlap::may_be_left_over_inner_edges(const Vec& middle) const {
  return edges_towards(middle).maybe != 0;
}

OverEdge ExactFlap::over_inner_edge(const Vec& middle, const Vec& way) const {
  const InnerBits edges = edges_towards(middle);
  if (edges.maybe == 0) return OverEdge::no;
  unsigned corners = 0;
  if (!corners_towards(way, corners)) return OverEdge::maybe;
  if (is_over(corners, edges.surely)) return OverEdge::yes;
  return is_over(corners, edges.maybe) ? OverEdge::maybe : OverEdge::no;
}

InnerBits ExactFlap::edges_towards(const Vec& middle) const {
  const Number height = dot(front_, middle - corners_[0]);
  const InnerBits &front = edges_.from_front, &back = edges_.from_back;
  if (height > 1e-6L * size_) return front;
  if (height < -1e-6L * size_) return back;
  return {static_cast<uint8_t>(front.surely & back.surely),
          static_cast<uint8_t>(front.maybe | back.maybe)};
}

bool ExactFlap::corners_towards(const Vec& way, unsigned& corners) const {
  std::array<Number, 3> heights;
  for (size_t i = 0; i < 3; ++i) heights[i] = dot(corners_[i], way);
  const Number most = *std::max_element(heights.begin(), heights.end());
  for (unsigned i = 0; i < 3; ++i) {
    const Number below = most - heights[i];
    if (below < 1e-5L * size_) {
      corners |= 1u << i;
    } else if (below < 2e-4L * size_) {
      return false;
    }
  }
  return true;
}

bool ExactFlap::is_over(unsigned corners, unsigned inner) {
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned start = 1u << i, end = 1u << (i + 1) % 3, before = 1u << (i + 2) % 3;
    if (corners == (start | end) && (inner & start) != 0) return true;
    if (corners == start && (inner & start) != 0 && (inner & before) != 0) return true;
  }
  return false;
}

}  // namespace carom::test
