#include <cmath>

#include "io/scene.h"

namespace carom::io {
namespace {

// A per-body array has one element a body, or none if it is optional; its values are at most
// `limit`.
template <class T>
Result<void> check_body_array(const std::string& path, const std::string& name,
                              const std::vector<T>& values, uint64_t bodies, uint64_t limit) {
  if (values.empty()) return {};
  if (values.size() != bodies) {
    return member_error(path, name,
                        "holds " + std::to_string(values.size()) + " elements (one for each of " +
                            std::to_string(bodies) + " bodies was expected)");
  }
  for (size_t i = 0; i < values.size(); ++i) {
    if (values[i] <= limit) continue;
    return member_error(path, name,
                        "element " + std::to_string(i) + " is " + std::to_string(values[i]) +
                            " (at most " + std::to_string(limit) + " was expected)");
  }
  return {};
}

Result<void> check_contact_distances(const SceneInfo& info, const std::string& path) {
  const std::vector<float>& distances = info.contact_distance;
  if (!distances.empty() && distances.size() != info.bodies) {
    return member_error(path, "body_contact_distance",
                        "holds " + std::to_string(distances.size()) +
                            " elements (one for each of " + std::to_string(info.bodies) +
                            " bodies was expected)");
  }
  for (size_t i = 0; i < distances.size(); ++i) {
    if (std::isfinite(distances[i]) && distances[i] >= 0) continue;
    return member_error(path, "body_contact_distance",
                        "element " + std::to_string(i) + " is " + std::to_string(distances[i]) +
                            " (a finite distance >= 0 was expected)");
  }
  return {};
}

Result<void> check_excluded_pairs(const SceneInfo& info, const std::string& path) {
  for (size_t i = 0; i < info.excluded_pairs.size(); ++i) {
    const auto& [a, b] = info.excluded_pairs[i];
    if (a < b && b < info.bodies) continue;
    return member_error(path, "excluded_pairs",
                        "row " + std::to_string(i) + " is (" + std::to_string(a) + ", " +
                            std::to_string(b) + ") (two bodies a < b of " +
                            std::to_string(info.bodies) + " were expected)");
  }
  return {};
}

Result<void> check_body_shapes(const SceneInfo& info, const std::string& path) {
  if (info.bodies > 0 && info.body_shape.empty()) {
    return member_error(path, "body_shape", "is missing (one element a body was expected)");
  }
  if (info.bodies > 0 && info.shapes.kind.empty()) {
    return member_error(path, "shape_kind", "holds no shape, but there are bodies");
  }
  return check_body_array(path, "body_shape", info.body_shape, info.bodies,
                          info.shapes.kind.empty() ? 0 : info.shapes.kind.size() - 1);
}

}  // namespace

Result<void> check_scene(const SceneInfo& info, const std::string& path) {
  constexpr uint64_t kMaxBodies = UINT32_MAX;  // indices of bodies are uint32
  if (info.bodies > kMaxBodies) {
    return file_error(path, "holds " + std::to_string(info.bodies) + " bodies (at most " +
                                std::to_string(kMaxBodies) + " were expected)");
  }
  if (!std::isfinite(info.dt) || info.dt <= 0) {
    return member_error(path, "dt",
                        "is " + std::to_string(info.dt) + " (a finite time above 0 was expected)");
  }
  Result<void> result = check_shapes(info.shapes, path);
  if (result) result = check_body_shapes(info, path);
  if (result) result = check_body_array(path, "body_motion", info.body_motion, info.bodies, 2);
  if (result) result = check_body_array(path, "body_layer", info.layer, info.bodies, UINT32_MAX);
  if (result) result = check_body_array(path, "body_mask", info.mask, info.bodies, UINT32_MAX);
  if (result) result = check_body_array(path, "body_owner", info.owner, info.bodies, UINT32_MAX);
  if (result) result = check_body_array(path, "body_space", info.space, info.bodies, UINT32_MAX);
  if (result) result = check_body_array(path, "body_sensor", info.sensor, info.bodies, 1);
  if (result) result = check_contact_distances(info, path);
  if (result) result = check_excluded_pairs(info, path);
  return result;
}

}  // namespace carom::io
