#include "io/models/model.h"

#include <algorithm>

namespace carom::io {
namespace {

std::array<float, 3> floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::array<float, 4> floats(const Eigen::Quaterniond& q) {
  return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()),
          static_cast<float>(q.w())};
}

template <class T>
void clear_if_all(std::vector<T>& values, T value) {
  if (std::all_of(values.begin(), values.end(), [&](T v) { return v == value; })) values.clear();
}

// Takes the owner from bodies that have theirs for themselves.
void drop_lone_owners(std::vector<uint32_t>& owners) {
  std::map<uint32_t, size_t> bodies;
  for (const uint32_t owner : owners) ++bodies[owner];
  for (uint32_t& owner : owners) {
    if (bodies[owner] == 1) owner = 0;
  }
}

}  // namespace

Placement operator*(const Placement& outer, const Placement& inner) {
  return {outer.position + outer.orientation * inner.position,
          (outer.orientation * inner.orientation).normalized()};
}

uint32_t ModelBuilder::add_shape(ShapeKind kind, const std::string& name) {
  SceneShapes& shapes = model_.info.shapes;
  shapes.kind.push_back(static_cast<uint8_t>(kind));
  shapes.params.emplace_back();
  shapes.vertex_range.emplace_back();
  shapes.triangle_range.emplace_back();
  shapes.child_range.emplace_back();
  shapes.height_range.emplace_back();
  model_.shape_names.push_back(name);
  return static_cast<uint32_t>(shapes.kind.size() - 1);
}

void ModelBuilder::add_mesh(const ModelMesh& mesh, uint32_t shape) {
  SceneShapes& shapes = model_.info.shapes;
  shapes.vertex_range[shape] = {static_cast<uint32_t>(shapes.vertices.size()),
                                static_cast<uint32_t>(mesh.vertices.size())};
  shapes.vertices.insert(shapes.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  if (shapes.kind[shape] != static_cast<uint8_t>(ShapeKind::mesh)) return;
  shapes.triangle_range[shape] = {static_cast<uint32_t>(shapes.triangles.size()),
                                  static_cast<uint32_t>(mesh.triangles.size())};
  shapes.triangles.insert(shapes.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
}

void ModelBuilder::add_heights(const ModelHeights& heights, uint32_t shape) {
  SceneShapes& shapes = model_.info.shapes;
  shapes.height_range[shape] = {static_cast<uint32_t>(shapes.heights.size()),
                                static_cast<uint32_t>(heights.samples.size())};
  shapes.heights.insert(shapes.heights.end(), heights.samples.begin(), heights.samples.end());
}

uint32_t ModelBuilder::shape_index(const ModelShape& shape, const std::string& name) {
  std::string key(1, static_cast<char>(shape.kind));
  key.append(reinterpret_cast<const char*>(shape.params.data()), sizeof shape.params);
  for (const void* const shared : {static_cast<const void*>(shape.mesh.get()),
                                   static_cast<const void*>(shape.heights.get())}) {
    const auto address = reinterpret_cast<uintptr_t>(shared);
    key.append(reinterpret_cast<const char*>(&address), sizeof address);
  }
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const uint32_t index = add_shape(shape.kind, name);
  model_.info.shapes.params[index] = shape.params;
  if (shape.mesh != nullptr) {
    add_mesh(*shape.mesh, index);
    shared_.push_back(shape.mesh);
  }
  if (shape.heights != nullptr) {
    add_heights(*shape.heights, index);
    shared_.push_back(shape.heights);
  }
  known_.emplace(std::move(key), index);
  return index;
}

uint32_t ModelBuilder::compound_index(const ModelBody& body) {
  std::vector<uint32_t> children;
  for (const ModelShape& shape : body.shapes) children.push_back(shape_index(shape, body.name));
  const uint32_t index = add_shape(ShapeKind::compound, body.name);
  SceneShapes& shapes = model_.info.shapes;
  shapes.child_range[index] = {static_cast<uint32_t>(shapes.child_shape.size()),
                               static_cast<uint32_t>(children.size())};
  shapes.child_shape.insert(shapes.child_shape.end(), children.begin(), children.end());
  for (const ModelShape& shape : body.shapes) {
    shapes.child_position.push_back(floats(shape.placement.position));
    shapes.child_orientation.push_back(floats(shape.placement.orientation));
  }
  return index;
}

uint32_t ModelBuilder::add(const ModelBody& body) {
  SceneInfo& info = model_.info;
  const bool is_one = body.shapes.size() == 1;
  const Placement at = is_one ? body.placement * body.shapes.front().placement : body.placement;
  info.body_shape.push_back(is_one ? shape_index(body.shapes.front(), body.name)
                                   : compound_index(body));
  info.body_motion.push_back(static_cast<uint8_t>(body.motion));
  info.layer.push_back(body.layer);
  info.mask.push_back(body.mask);
  info.owner.push_back(body.owner);
  const std::array<float, 4> turn = floats(at.orientation);
  SceneFrame& frame = model_.frame;
  frame.position64.insert(frame.position64.end(), at.position.begin(), at.position.end());
  frame.orientation.insert(frame.orientation.end(), turn.begin(), turn.end());
  return static_cast<uint32_t>(info.bodies++);
}

void ModelBuilder::exclude(uint32_t a, uint32_t b) {
  model_.info.excluded_pairs.push_back({std::min(a, b), std::max(a, b)});
}

Model ModelBuilder::finish() {
  SceneInfo& info = model_.info;
  info.frames = 1;
  info.float64_positions = true;
  info.has_orientation = true;
  if (info.shapes.heights.empty()) info.shapes.height_range.clear();
  drop_lone_owners(info.owner);
  clear_if_all(info.owner, 0u);
  clear_if_all(info.layer, ~0u);
  clear_if_all(info.mask, ~0u);
  clear_if_all<uint8_t>(info.body_motion, static_cast<uint8_t>(Motion::dynamic));
  auto& excluded = info.excluded_pairs;
  std::sort(excluded.begin(), excluded.end());
  excluded.erase(std::unique(excluded.begin(), excluded.end()), excluded.end());
  return std::move(model_);
}

}  // namespace carom::io
