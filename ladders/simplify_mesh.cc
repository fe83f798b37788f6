#include "ladders/simplify_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "carom/shapes/scaled.h"
#include "ladders/surface_distance.h"

namespace carom::ladders {
namespace {

constexpr int kTrials = 6;
constexpr double kWorthwhile = 0.8;  // of the triangles: with more, it is no rung

// The triangles with an area, and their vertices; those at one place are one.
struct Surface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<uint32_t> corners;  // three a triangle

  explicit Surface(const MeshGeometry& mesh) {
    for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
      if (mesh.is_degenerate(i)) continue;
      corners.insert(corners.end(), mesh.triangles()[i].begin(), mesh.triangles()[i].end());
    }
    if (corners.empty()) return;
    const auto given = mesh.vertices();
    std::vector<uint32_t> place(given.size());
    const size_t count = meshopt_generateVertexRemap(place.data(), corners.data(), corners.size(),
                                                     given.data(), given.size(), sizeof(given[0]));
    vertices.resize(count);
    meshopt_remapVertexBuffer(vertices.data(), given.data(), given.size(), sizeof(given[0]),
                              place.data());
    for (uint32_t& corner : corners) corner = place[corner];
  }

  const float* numbers() const { return vertices.front().data(); }
  static constexpr size_t kStride = sizeof(Eigen::Vector3f);
};

// Collapses edges up to an error, a share of the extents.
std::shared_ptr<const MeshGeometry> collapse(const Surface& surface, float error) {
  std::vector<uint32_t> corners(surface.corners.size());
  const size_t count = meshopt_simplify(
      corners.data(), surface.corners.data(), surface.corners.size(), surface.numbers(),
      surface.vertices.size(), Surface::kStride, 0, error, 0, nullptr);
  if (count == 0) return nullptr;
  corners.resize(count);
  std::vector<Eigen::Vector3f> vertices(surface.vertices.size());
  const size_t used =
      meshopt_optimizeVertexFetch(vertices.data(), corners.data(), count, surface.vertices.data(),
                                  surface.vertices.size(), Surface::kStride);
  vertices.resize(used);
  std::vector<std::array<uint32_t, 3>> triangles(count / 3);
  for (size_t i = 0; i < triangles.size(); ++i) {
    triangles[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  }
  auto mesh = make_mesh(vertices, triangles);
  return mesh ? *mesh : nullptr;
}

}  // namespace

std::optional<SimplerMesh> simplify_mesh(const MeshGeometry& mesh, double most) {
  if (mesh.is_scaled()) {
    const auto own = unshared(mesh);
    return own ? simplify_mesh(**own, most) : std::nullopt;
  }
  const Surface surface(mesh);
  if (surface.corners.empty() || !(most > 0)) return std::nullopt;
  const double extent =
      meshopt_simplifyScale(surface.numbers(), surface.vertices.size(), Surface::kStride);
  const double enough = kWorthwhile * static_cast<double>(surface.corners.size() / 3);
  std::optional<SimplerMesh> best;
  // Between a limit that was good and one that was too much.
  double good = 0, bad = 0, limit = most / 2;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto simpler = collapse(surface, static_cast<float>(limit / extent));
    double error = simpler ? furthest(*simpler, mesh, most) : most * 2;
    if (error <= most) error = std::max(error, furthest(mesh, *simpler, most));
    if (error <= most) {
      good = limit;
      const auto triangles = static_cast<double>(simpler->triangles().size());
      const bool is_better =
          !best || triangles < static_cast<double>(best->geometry->triangles().size());
      if (triangles <= enough && is_better) best = SimplerMesh{simpler, error};
    } else {
      bad = limit;
    }
    if (bad > 0 && good > 0 && bad < 1.15 * good) break;
    limit = bad == 0 ? 2 * good : good == 0 ? bad / 3 : (good + bad) / 2;
  }
  return best;
}

}  // namespace carom::ladders
