// The report of `carom check` on a shape.
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
  std::string name;  // if the file names its meshes
  ShapeKind kind = ShapeKind::mesh;
  std::string problem;                    // why the shape is invalid; empty if it is valid
  std::vector<Eigen::Vector3f> vertices;  // hulls, meshes
  std::vector<std::array<uint32_t, 3>> triangles;
  size_t children = 0;  // compounds
  std::optional<MeshReport> mesh;
  std::optional<io::BuiltHull> hull;
};

nlohmann::ordered_json to_json(const ShapeReport& report);
void print(const ShapeReport& report, std::ostream& out);

}  // namespace carom::cli
