#include "io/models/mesh_library.h"

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/models/mesh_file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<ModelMesh> merged(const std::vector<MeshPart>& parts) {
  auto mesh = std::make_shared<ModelMesh>();
  for (const MeshPart& part : parts) {
    const auto first = static_cast<uint32_t>(mesh->vertices.size());
    for (const Eigen::Vector3f& v : part.vertices) mesh->vertices.push_back({v.x(), v.y(), v.z()});
    for (const auto& [a, b, c] : part.triangles) {
      mesh->triangles.push_back({first + a, first + b, first + c});
    }
  }
  return mesh;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// The file in the nearest folder of the package's name, upwards.
std::string file_of_package(const std::string& folder, const std::string& name) {
  const fs::path inside = fs::path(name).relative_path();
  std::error_code error;
  fs::path above = fs::absolute(folder, error).lexically_normal();
  if (error || inside.empty()) return "";
  while (true) {
    if (is_there(above / inside)) return (above / inside).string();
    if (!above.has_relative_path()) return "";
    above = above.parent_path();
  }
}

}  // namespace

void scale_mesh(ModelMesh& mesh, const Eigen::Vector3d& scale) {
  for (std::array<float, 3>& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<float>(v[axis] * scale[axis]);
  }
  if (scale.prod() > 0) return;
  for (std::array<uint32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
}

std::shared_ptr<const ModelMesh> MeshLibrary::read(const std::string& path,
                                                   const Eigen::Vector3d& scale, const Xml& element,
                                                   FirstError& errors) {
  const std::pair key(path, std::array{scale.x(), scale.y(), scale.z()});
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (!names_mesh(path)) {
    errors.add(element, "the mesh " + quoted_name(path) + " is of no known kind (" +
                            kMeshExtensions + " were expected)");
    return nullptr;
  }
  const Result<std::vector<MeshPart>> parts = read_mesh_file(path);
  if (!parts) {
    errors.add(element, parts.error().message);
    return nullptr;
  }
  std::shared_ptr<ModelMesh> mesh = merged(*parts);
  scale_mesh(*mesh, scale);
  known_.emplace(key, mesh);
  return mesh;
}

std::string resolve_file(const std::string& folder, const std::string& name) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (name.starts_with(scheme)) return file_of_package(folder, name.substr(scheme.size()));
  }
  constexpr std::string_view kFile = "file://";
  if (name.starts_with(kFile)) return name.substr(kFile.size());
  return (fs::path(folder) / name).string();
}

}  // namespace carom::io
