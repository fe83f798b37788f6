// The report of `carom check` on a shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "carom/hulls/build_hull.h"
#include "carom/shapes/shape.h"
#include "cli/check/mesh_check.h"
#include "cli/support/json_output.h"

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
  std::optional<BuiltHull> hull;
};

// Where the reports of a file go, one after the other: into the JSON if that is wanted, to standard
// output as text otherwise.
class ReportSink {
 public:
  ReportSink(JsonOutput& output, const Console& console);
  ~ReportSink();

  void add(const ShapeReport& report);
  // To be called once, after the last report.
  Result<void> finish(const std::string& file);

 private:
  JsonOutput& output_;
  const Console& console_;
  std::unique_ptr<nlohmann::ordered_json> shapes_;  // null: reports are text
};

}  // namespace carom::cli
