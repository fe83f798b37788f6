#include "cli/verify/verify_builtin.h"

#include <array>
#include <cassert>
#include <utility>

#include "cli/scenes/scene_bounds.h"
#include "io/generate/generator.h"
#include "io/generate/random.h"

namespace carom::cli {
namespace {

// In a mixed scene body i has shape i and motion i % kMotions. The stride is a multiple of
// kMotions, so that half-spaces are static.
constexpr uint32_t kMotions = 3;
constexpr uint32_t kHalfspaceStride = 67 * kMotions;

std::unique_ptr<io::SceneReader> generate(const std::string& text) {
  Result<io::GeneratorSpec> spec = io::parse_generator(text);
  assert(spec);
  return io::open_generator(*spec);
}

// Makes every other shape a sphere.
void make_spheres(io::SceneShapes& shapes) {
  for (size_t i = 0; i < shapes.kind.size(); i += 2) {
    shapes.kind[i] = static_cast<uint8_t>(ShapeKind::sphere);
  }
}

// A mesh of one triangle within these half extents.
void make_triangle(io::SceneShapes& shapes, size_t index, const std::array<float, 3>& half) {
  const auto [x, y, z] = half;
  shapes.params[index] = {index % 2 ? 1.0f : 0.0f, index % 3 ? 0.0f : 0.2f * x};
  shapes.vertex_range[index] = {static_cast<uint32_t>(shapes.vertices.size()), 3};
  shapes.triangle_range[index] = {static_cast<uint32_t>(shapes.triangles.size()), 1};
  shapes.vertices.insert(shapes.vertices.end(), {{x, y, z}, {-x, y, -z}, {0, -y, z}});
  shapes.triangles.push_back({0, 1, 2});
}

// Six vertices within these half extents.
void add_vertices(io::SceneShapes& shapes, size_t index, const std::array<float, 3>& half) {
  const auto [x, y, z] = half;
  shapes.vertex_range[index] = {static_cast<uint32_t>(shapes.vertices.size()), 6};
  shapes.vertices.insert(
      shapes.vertices.end(),
      {{x, 0, z / 2}, {-x, y / 2, 0}, {0, y, -z / 2}, {x / 2, -y, 0}, {0, 0, z}, {-x / 2, 0, -z}});
}

void make_dop(io::SceneShapes& shapes, size_t index, const std::array<float, 3>& half) {
  constexpr std::array kPlanes = {6.0f, 14.0f, 18.0f, 26.0f};
  shapes.params[index] = {kPlanes[index / 7 % kPlanes.size()]};
  add_vertices(shapes, index, half);
}

// Triangles that share edges.
void make_mesh(io::SceneShapes& shapes, size_t index, const std::array<float, 3>& half) {
  shapes.params[index] = {index % 2 ? 1.0f : 0.0f, index % 4 < 2 ? 0.0f : 0.2f * half[0]};
  add_vertices(shapes, index, half);
  shapes.triangle_range[index] = {static_cast<uint32_t>(shapes.triangles.size()), 4};
  shapes.triangles.insert(shapes.triangles.end(), {{0, 2, 4}, {4, 2, 1}, {4, 1, 3}, {1, 5, 3}});
}

// A ball and a box side by side; their shapes are appended after the others.
void make_compound(io::SceneShapes& shapes, size_t index, const std::array<float, 3>& half) {
  const auto [x, y, z] = half;
  shapes.params[index] = {};
  shapes.child_range[index] = {static_cast<uint32_t>(shapes.child_shape.size()), 2};
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box}) {
    const float side = kind == ShapeKind::box ? 0.5f : -0.5f;
    shapes.child_shape.push_back(static_cast<uint32_t>(shapes.kind.size()));
    shapes.child_position.push_back({side * x, 0, side * z});
    shapes.child_orientation.push_back({1, 0, side, 2});
    shapes.kind.push_back(static_cast<uint8_t>(kind));
    shapes.params.push_back({x / 2, y / 2, z / 2});
    shapes.vertex_range.emplace_back();
    shapes.triangle_range.emplace_back();
    shapes.child_range.emplace_back();
  }
}

// The kind of shape `i` in a scene of all kinds: spheres, capsules, aabbs, boxes and triangles in
// turn, fewer of the others.
ShapeKind kind_in_turn(size_t i) {
  constexpr std::array kSceneKinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,
                                      ShapeKind::box, ShapeKind::triangle};
  if (i % kHalfspaceStride == 0) return ShapeKind::halfspace;
  switch (i % 21) {
    case 1:
      return ShapeKind::dop;
    case 3:
      return ShapeKind::cylinder;
    case 6:
      return ShapeKind::cone;
    case 11:
      return ShapeKind::ellipsoid;
    case 8:
      return ShapeKind::hull;
    case 13:
      return ShapeKind::mesh;
    case 18:
      return ShapeKind::compound;
    default:
      return kSceneKinds[i % kSceneKinds.size()];
  }
}

// Scales every other hull, mesh and compound. Children of compounds are turned, which uneven
// factors would shear.
void add_scales(io::SceneShapes& shapes) {
  shapes.scale.assign(shapes.kind.size(), {1, 1, 1});
  for (size_t i = 1; i < shapes.kind.size(); i += 2) {
    const auto kind = static_cast<ShapeKind>(shapes.kind[i]);
    if (kind == ShapeKind::hull || kind == ShapeKind::mesh) shapes.scale[i] = {1, -0.75f, 1.25f};
    if (kind == ShapeKind::compound) shapes.scale[i] = {1.25f, -1.25f, 1.25f};
  }
}

// Makes all kinds from the half extents in `shapes`.
void make_all_kinds(io::SceneShapes& shapes) {
  const size_t count = shapes.kind.size();
  shapes.vertex_range.resize(count);
  shapes.triangle_range.resize(count);
  shapes.child_range.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const ShapeKind kind = kind_in_turn(i);
    // Files store a triangle as a mesh of one.
    shapes.kind[i] = static_cast<uint8_t>(kind == ShapeKind::triangle ? ShapeKind::mesh : kind);
    std::array<float, 8>& params = shapes.params[i];
    const std::array half = {params[0], params[1], params[2]};
    if (kind == ShapeKind::capsule) params = {-half[0], 0, half[2], half[0], 0, 0, half[1] / 2};
    if (kind == ShapeKind::halfspace) params = {half[0], -half[1], half[2], -1};
    if (kind == ShapeKind::cylinder || kind == ShapeKind::cone) params = {half[0], half[2]};
    if (kind == ShapeKind::triangle) make_triangle(shapes, i, half);
    if (kind == ShapeKind::dop) make_dop(shapes, i, half);
    if (kind == ShapeKind::hull) add_vertices(shapes, i, half);
    if (kind == ShapeKind::mesh) make_mesh(shapes, i, half);
    if (kind == ShapeKind::compound) make_compound(shapes, i, half);
  }
  shapes.rounding.resize(shapes.kind.size());
  for (size_t i = 0; i < count; ++i) {
    if (i % 2 == 0 && io::takes_rounding(shapes.kind[i])) shapes.rounding[i] = 0.1f;
  }
  add_scales(shapes);
  shapes.params[16][6] = -1;      // the radius of a capsule
  shapes.vertices[5][1] = kNan;   // of a k-DOP
  shapes.vertices[8][1] = kNan;   // of a triangle
  shapes.vertices[10][1] = kNan;  // of a hull
}

// A generated scene of boxes, some changed to other kinds, with layers, masks, owners, spaces,
// excluded pairs, sensors, all kinds of motion and, at float64, contact distances. In some frames
// some bodies are ill-formed.
class MixedScene : public io::SceneReader {
 public:
  // `oriented`: half of the bodies turn in every frame.
  MixedScene(std::unique_ptr<io::SceneReader> base, void (*change)(io::SceneShapes&), bool oriented)
      : base_(std::move(base)), info_(base_->info()) {
    change(info_.shapes);
    info_.has_orientation = oriented;
    info_.shapes.params[11][0] = -1;
    info_.shapes.params[12][0] = kNan;
    for (uint32_t i = 0; i < info_.bodies; ++i) {
      info_.body_motion.push_back(static_cast<uint8_t>(i % kMotions));
      info_.layer.push_back(1u << i % 5);
      info_.mask.push_back(i % 4 == 0 ? 0x0fu : 0x1fu);
      info_.owner.push_back(i % 10 < 4 ? 1 + i % 4 : 0);
      info_.space.push_back(i % 16 == 5);
      info_.sensor.push_back(i % 7 == 0);
      for (uint32_t b = i + 1 + i % 3; b < info_.bodies; b += 7)
        info_.excluded_pairs.push_back({i, b});
    }
    for (uint32_t i = 0; info_.float64_positions && i < info_.bodies; ++i) {
      info_.contact_distance.push_back(i % 11 == 0 ? 0.25f : 0);
    }
  }

  const io::SceneInfo& info() const override { return info_; }
  void want(const io::SceneArrays& wanted) override { base_->want(wanted); }

  Result<void> read_frame(io::SceneFrame& frame) override {
    Result<void> read = base_->read_frame(frame);
    if (!read) return read;
    if (info_.has_orientation) turn(frame.orientation);
    if (frame_++ % 3 == 1) {
      spoil(frame.position32);
      spoil(frame.position64);
      spoil_orientations(frame.orientation);
    }
    return {};
  }

 private:
  // Writes quaternions that are not unit ones.
  void turn(std::vector<float>& orientations) const {
    orientations.clear();
    for (uint64_t i = 0; i < info_.bodies; ++i) {
      io::Random random(i, i % 2 ? 0 : frame_ % info_.frames);
      for (int k = 0; k < 4; ++k) {
        orientations.push_back(static_cast<float>(random.between(-1, 1)));
      }
    }
  }

  template <class T>
  static void spoil(std::vector<T>& rows) {
    if (rows.empty()) return;
    rows[3 * 20 + 1] = kNan;
    rows[3 * 21 + 2] = kInfinity;
  }

  static void spoil_orientations(std::vector<float>& rows) {
    if (rows.empty()) return;
    for (int k = 0; k < 4; ++k) rows[4 * 23 + k] = 0;
    rows[4 * 24 + 3] = kNan;
  }

  std::unique_ptr<io::SceneReader> base_;
  io::SceneInfo info_;
  uint64_t frame_ = 0;
};

// The bounds of a generated scene, as a recording.
class RecordedScene : public io::SceneReader {
 public:
  explicit RecordedScene(std::unique_ptr<io::SceneReader> base)
      : base_(std::move(base)), bounds_(base_->info()) {
    info_.name = base_->info().name;
    info_.bodies = base_->info().bodies;
    info_.frames = base_->info().frames;
    info_.bounds_recording = true;
    base_->want({.linear_velocity = false});
  }

  const io::SceneInfo& info() const override { return info_; }
  void want(const io::SceneArrays&) override {}

  Result<void> read_frame(io::SceneFrame& frame) override {
    Result<void> read = base_->read_frame(frame_);
    if (read) frame.boxes = bounds_.boxes(frame_);
    return read;
  }

 private:
  std::unique_ptr<io::SceneReader> base_;
  SceneBounds bounds_;
  io::SceneInfo info_;
  io::SceneFrame frame_;
};

}  // namespace

std::vector<BuiltinScene> builtin_scenes() {
  std::vector<BuiltinScene> scenes;
  for (const char* text :
       {"brownian:n=500,frames=8,density=0.4", "brownian:n=500,frames=8,density=0.6,shape=sphere",
        "brownian:n=500,frames=8,density=0.6,shape=sphere,positions=float64",
        "varied:n=500,frames=8,density=0.4", "varied:n=300,frames=8,density=0.5,shape=sphere",
        "static:n=1000,frames=8,motion=static", "static:n=1000,frames=8,shape=sphere",
        "still:n=500,frames=4,density=0.4,shape=sphere"}) {
    scenes.push_back({text, generate(text)});
  }
  for (const char* positions : {"float32", "float64"}) {
    const auto mixed = [&](auto change, bool oriented) {
      return std::make_unique<MixedScene>(
          generate(std::string("brownian:n=403,frames=10,density=0.8,speed=3,positions=") +
                   positions),
          change, oriented);
    };
    scenes.push_back({std::string("spheres and aabbs, ") + positions, mixed(make_spheres, false)});
    scenes.push_back({std::string("all kinds, ") + positions, mixed(make_all_kinds, true)});
  }
  scenes.push_back(
      {"recording of bounds", std::make_unique<RecordedScene>(generate("static:n=800,frames=8"))});
  return scenes;
}

}  // namespace carom::cli
