// Bodies of robot descriptions (URDF, MJCF), and the scene of one frame that they make.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "carom/shapes/body.h"
#include "carom/shapes/shape.h"
#include "io/scene.h"

namespace carom::io {

// Where something is in the frame of something else; metres. The quaternion is a unit one.
struct Placement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};
// First `inner`, then `outer`.
Placement operator*(const Placement& outer, const Placement& inner);

struct ModelMesh {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// The parameters and samples of a height field, as in files.
struct ModelHeights {
  std::array<float, 8> params{};
  std::vector<float> samples;
};

struct ModelShape {
  ShapeKind kind = ShapeKind::sphere;
  std::array<float, 8> params{};          // as in files
  std::shared_ptr<const ModelMesh> mesh;  // of a mesh or hull; shapes may share it
  std::shared_ptr<const ModelHeights> heights;
  Placement placement;  // in the body's frame
};

struct ModelBody {
  std::string name;
  Placement placement;  // in the world
  Motion motion = Motion::dynamic;
  uint32_t owner = 0;  // bodies of the same owner, not 0, never meet
  uint32_t layer = ~0u, mask = ~0u;
  std::vector<ModelShape> shapes;  // at least one; half-spaces alone
};

// A scene of one frame, with a name for each shape: that of the first body that has it.
struct Model {
  SceneInfo info;
  SceneFrame frame;
  std::vector<std::string> shape_names;
};

// A body of several shapes becomes a compound in its frame. A body of one stands where its shape
// does.
class ModelBuilder {
 public:
  // The index of the body.
  uint32_t add(const ModelBody& body);
  // The two never meet; any order, any number of times.
  void exclude(uint32_t a, uint32_t b);
  // To be called once.
  Model finish();

 private:
  uint32_t shape_index(const ModelShape& shape, const std::string& name);
  uint32_t compound_index(const ModelBody& body);
  uint32_t add_shape(ShapeKind kind, const std::string& name);
  void add_mesh(const ModelMesh& mesh, uint32_t shape);
  void add_heights(const ModelHeights& heights, uint32_t shape);

  Model model_;
  std::map<std::string, uint32_t> known_;            // by kind, parameters, mesh and heights
  std::vector<std::shared_ptr<const void>> shared_;  // keeps addresses in `known_` unique
};

}  // namespace carom::io
