// The hulls of k-DOPs, in few bytes: all k-DOPs have the same directions, so a face is a height,
// and an edge a corner and two faces.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "carom/shapes/dop.h"
#include "carom/shapes/hull.h"

namespace carom {

// The planes of the largest k-DOP: plane 2 i is the upper one of slab i, plane 2 i + 1 its lower
// one. Other k-DOPs have some of them.
inline constexpr size_t kDopPlanes = 2 * kMostSlabs;

// The plane of the largest k-DOP that is plane `plane` of a k-DOP of this kind.
uint8_t common_plane(DopKind kind, size_t plane);

// The directions that all k-DOPs share, in float32.
class DopDirections {
 public:
  static const DopDirections& get();

  // x, y or z of the unit normals; sixteen entries a vector, zeros behind the last plane.
  const float* column(size_t axis) const { return columns_[axis].data(); }
  // The same as records; then 0.
  const std::array<float, 4>* records() const { return records_.data(); }
  // Unit, along left normal x right normal, then 0; zero if the planes are parallel.
  const Eigen::Vector4f& edge(size_t left, size_t right) const {
    return edges_[left * kDopPlanes + right];
  }

 private:
  DopDirections();

  alignas(64) std::array<std::array<float, 32>, 3> columns_{};
  std::array<std::array<float, 4>, kDopPlanes> records_;
  std::array<Eigen::Vector4f, kDopPlanes * kDopPlanes> edges_;
};

Eigen::Vector3d normal_of_dop_plane(size_t plane);

// All that a search for depths reads of one k-DOP: one run of memory, which can be asked for at
// once.
class alignas(64) DopSolid {
 public:
  // 26 faces have at most 72 edges and 48 corners (Euler).
  static constexpr size_t kMostPoints = 48;
  static constexpr size_t kMostEdges = 72;
  // The points and their middle come first.
  static constexpr size_t kBytesOfPoints = (3 * kMostPoints + 4) * sizeof(float);

  struct Edge {
    uint32_t from;         // point
    uint32_t left, right;  // planes
  };

  // At most kMostPoints points and kMostEdges edges. Planes without a face have infinite height;
  // one has a face.
  DopSolid(const HullGeometry& hull, float inner_radius,
           const std::array<float, kDopPlanes>& heights, std::span<const Edge> edges);

  float inner_radius() const { return inner_radius_; }
  // The mean of the points, then 0.
  const std::array<float, 4>& middle() const { return middle_; }
  size_t edge_count() const { return edge_count_; }
  Edge edge(size_t e) const { return {ends_[2 * kMostEdges + e], sides(0)[e], sides(1)[e]}; }
  // The left planes (0) or the right planes (1) of all edges. 64 bytes may be read from any edge
  // on.
  const uint8_t* sides(size_t side) const { return &ends_[side * kMostEdges]; }
  // The planes up to the last one that has a face.
  size_t plane_count() const { return plane_count_; }
  // The heights of all planes over the origin, padded to a multiple of sixteen.
  const float* heights() const { return heights_.data(); }
  // x, y or z of all points, padded to kMostPoints with the first one.
  const float* column(size_t axis) const { return points_[axis].data(); }

 private:
  std::array<std::array<float, kMostPoints>, 3> points_;
  std::array<float, 4> middle_;
  float inner_radius_;
  uint16_t edge_count_;
  uint16_t plane_count_;
  std::array<uint8_t, 3 * kMostEdges> ends_{};  // left planes, right planes, points
  alignas(64) std::array<float, 32> heights_;
};
static_assert(sizeof(DopSolid) == 15 * 64);

// A k-DOP as a hull, which refers to the solid. Neither may move.
struct DopHull {
  HullGeometry geometry;
  std::optional<DopSolid> solid;  // if the faces close one

  DopHull() = default;
  DopHull(const DopHull&) = delete;
  DopHull& operator=(const DopHull&) = delete;

  // `planes` has the plane of each face, by common_plane(); normals are those of the planes. Points
  // and faces are as in make_hull(), and fit.
  void make(std::span<const Eigen::Vector3f> points, std::span<const std::vector<uint32_t>> faces,
            std::span<const uint8_t> planes);
};

}  // namespace carom
