// What `carom check` says of a shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "carom/shapes/shape.h"
#include "cli/check/mesh_check.h"
#include "io/build_hull.h"

namespace carom::cli {

struct ShapeReport {
  size_t index = 0;
  std::string name;  // of files that name their meshes
  ShapeKind kind = ShapeKind::mesh;
  std::string problem;                    // why it is no valid shape; empty if it is one
  std::vector<Eigen::Vector3f> vertices;  // hulls, meshes
  std::vector<std::array<uint32_t, 3>> triangles;
  size_t children = 0;  // compounds
  std::optional<MeshReport> mesh;
  std::optional<io::BuiltHull> hull;
};

nlohmann::ordered_json to_json(const ShapeReport& report);
void print(const ShapeReport& report, std::ostream& out);

}  // namespace carom::cli
