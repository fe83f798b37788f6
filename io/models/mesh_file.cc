#include "io/models/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <utility>

#include "io/files/file.h"
#include "io/models/vertex_places.h"

namespace carom::io {
namespace {

using Eigen::Vector3f;
using Matrix = Eigen::Matrix<double, 3, 4>;

Matrix matrix_of(const aiMatrix4x4& m) {
  Matrix matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return matrix;
}

// First b, then a.
Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result;
  result.leftCols<3>() = a.leftCols<3>() * b.leftCols<3>();
  result.col(3) = a.leftCols<3>() * b.col(3) + a.col(3);
  return result;
}

// Keeps the first of the vertices at each place; returns the new index of every vertex.
std::vector<uint32_t> weld(std::vector<Vector3f>& vertices) {
  const std::vector<uint32_t> first = first_at_place(vertices);
  std::vector<uint32_t> place(vertices.size());
  std::vector<Vector3f> distinct;
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    place[i] = first[i] == i ? static_cast<uint32_t>(distinct.size()) : place[first[i]];
    if (first[i] == i) distinct.push_back(vertices[i]);
  }
  vertices = std::move(distinct);
  return place;
}

MeshPart part_of(const aiMesh& mesh, const aiNode& node, const Matrix& pose) {
  MeshPart part;
  part.name = mesh.mName.length > 0 ? mesh.mName.C_Str() : node.mName.C_Str();
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    const Eigen::Vector3d p(v.x, v.y, v.z);
    part.vertices.push_back((pose.leftCols<3>() * p + pose.col(3)).cast<float>());
  }
  const std::vector<uint32_t> place = weld(part.vertices);
  const bool is_mirrored = pose.leftCols<3>().determinant() < 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    std::array<uint32_t, 3> corners = {place[face.mIndices[0]], place[face.mIndices[1]],
                                       place[face.mIndices[2]]};
    if (is_mirrored) std::swap(corners[1], corners[2]);
    part.triangles.push_back(corners);
  }
  return part;
}

std::vector<MeshPart> parts_of(const aiScene& scene) {
  std::vector<MeshPart> parts;
  std::vector<std::pair<const aiNode*, Matrix>> nodes = {
      {scene.mRootNode, Matrix(Matrix::Identity())}};
  while (!nodes.empty()) {
    const auto [node, parent] = nodes.back();
    nodes.pop_back();
    const Matrix pose = product(parent, matrix_of(node->mTransformation));
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      MeshPart part = part_of(*scene.mMeshes[node->mMeshes[i]], *node, pose);
      if (!part.triangles.empty()) parts.push_back(std::move(part));
    }
    for (unsigned i = node->mNumChildren; i > 0; --i)
      nodes.push_back({node->mChildren[i - 1], pose});
  }
  return parts;
}

}  // namespace

const char kMeshExtensions[] = ".obj, .stl, .gltf, .glb, .dae";

bool names_mesh(const std::string& path) {
  constexpr std::array kExtensions = {".obj", ".stl", ".gltf", ".glb", ".dae"};
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](const char* extension) { return has_extension(path, extension); });
}

Result<std::vector<MeshPart>> read_mesh_file(const std::string& path) {
  Result<File> file = File::open(path, "a mesh");
  if (!file) return file.error();
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string reason = importer.GetErrorString();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return file_error(path, "cannot be read as a mesh: " + reason);
  }
  std::vector<MeshPart> parts = parts_of(*scene);
  if (parts.empty()) return file_error(path, "holds no triangle");
  return parts;
}

}  // namespace carom::io
