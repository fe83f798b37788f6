// Meshes that differ in their scale alone share this.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "carom/shapes/mesh_geometry.h"
#include "trees/tree.h"

namespace carom {

struct MeshGeometry::Storage {
  static constexpr uint32_t kNoVertex = 0xffffffffu;

  std::vector<Eigen::Vector3f> vertices;  // and one more
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Edges> edges;
  Eigen::Vector3f lower = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper = Eigen::Vector3f::Zero();
  std::unique_ptr<const BoxTree> tree;

  // For each edge the third corner of the only other triangle there, or kNoVertex. Meshes with a
  // scale find their inner edges from it; the first of them has it made.
  std::vector<std::array<uint32_t, 3>> across;
  std::once_flag is_across_known;

  size_t bytes() const;
};

}  // namespace carom
