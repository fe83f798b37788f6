// The meshes of a model's files, each read once for every scale.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>

#include "io/models/model.h"
#include "io/models/xml_file.h"

namespace carom::io {

class MeshLibrary {
 public:
  // All meshes of a file as one, in the poses of its scene, times a factor for each axis. Factors
  // that mirror leave fronts in front. On failure reports it for `element` and returns nullptr.
  std::shared_ptr<const ModelMesh> read(const std::string& path, const Eigen::Vector3d& scale,
                                        const Xml& element, FirstError& errors);

 private:
  std::map<std::pair<std::string, std::array<double, 3>>, std::shared_ptr<const ModelMesh>> known_;
};

// Multiplies the vertices, and turns the triangles round if that mirrors them.
void scale_mesh(ModelMesh& mesh, const Eigen::Vector3d& scale);

// The file that a description in `folder` ("folder/") names: "file://PATH", "package://NAME/PATH"
// or "model://NAME/PATH", or a path, relative to the folder. A package is looked for in the folder
// and all above it; "" if there is none.
std::string resolve_file(const std::string& folder, const std::string& name);

}  // namespace carom::io
