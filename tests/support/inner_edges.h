// For the oracle: which contacts of a mesh are over inner edges. It is found from the corners
// alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "carom/shapes/mesh_geometry.h"
#include "oracle/convex_shape.h"

namespace carom::test {

// Bit i stands for the edge from corner i to the next. Edges that rounding decides are in `maybe`
// only.
struct InnerBits {
  uint8_t surely = 0;
  uint8_t maybe = 0;
};

struct FlapEdges {
  InnerBits from_front, from_back;
};

// Finds the edges that exactly two triangles share and where the surface is flat or bent inwards.
class InnerEdges {
 public:
  using Number = long double;
  using Vec = oracle::Vec3<Number>;

  explicit InnerEdges(const Mesh& mesh);

  const FlapEdges& of(uint32_t triangle) const { return edges_[triangle]; }

 private:
  using Place = std::array<float, 3>;
  struct Edge {
    uint32_t triangle;
    uint8_t index;
  };

  // A bend of less than a twentieth of a degree counts as flat.
  static constexpr Number kFlat = 0x1p-10L;

  Place place(uint32_t triangle, size_t i) const;
  Vec corner(uint32_t triangle, size_t i) const;

  void join(const Edge& edge, const Edge& other);

  const MeshGeometry& mesh_;
  std::vector<FlapEdges> edges_;
};

enum class OverEdge : uint8_t { no, maybe, yes };

// A placed triangle of a mesh.
class ExactFlap {
 public:
  using Number = long double;
  using Vec = oracle::Vec3<Number>;

  // The first three points of the shape are the corners of the triangle.
  ExactFlap(const oracle::ConvexShape<Number>& triangle, const FlapEdges& edges);

  // Whether the triangle may have inner edges, as seen from a body with this middle.
  bool may_be_left_over_inner_edges(const Vec& middle) const;

  // Whether a body with this middle meets the triangle over an inner edge, or over a corner between
  // two, if the triangle's furthest points along `way` (a unit vector) are the contact.
  OverEdge over_inner_edge(const Vec& middle, const Vec& way) const;

 private:
  InnerBits edges_towards(const Vec& middle) const;

  // The corners that are furthest along `way`, as bits. False if rounding decides.
  bool corners_towards(const Vec& way, unsigned& corners) const;

  static bool is_over(unsigned corners, unsigned inner);

  std::array<Vec, 3> corners_;
  Vec front_;
  Number size_;
  FlapEdges edges_;
};

}  // namespace carom::test
