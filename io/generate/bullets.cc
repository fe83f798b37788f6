#include "io/generate/bullets.h"

#include <algorithm>

#include "io/generate/made_shapes.h"
#include "io/generate/motion.h"

namespace carom::io {
namespace {

constexpr double kHalfRoom = 10;     // metres
constexpr double kSpeed = 300;       // metres a second, the greatest; the least is a sixth of it
constexpr double kBulletSpin = 200;  // radians a second
constexpr double kThinnest = 0.02, kWidest = 0.1;  // of bullets, metres
constexpr uint64_t kBulletShapes = 64;             // bullets use them in turn
constexpr uint64_t kWalls = 6, kBoxes = 24, kSheets = 12;
constexpr double kHalfBox = 0.01;  // half the thickness of a box
constexpr uint32_t kWallCells = 8, kSheetCells = 2;
constexpr double kHalfSheet = 1.5;

enum BulletStream : uint64_t { kShapeStream = 32, kRoomStream = 33, kBulletStream = 34 };

constexpr ShapeKind kBulletKinds[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                      ShapeKind::hull};

// Every wall's front looks inwards.
constexpr double kHalfRoot = 0.70710678118654752;
constexpr Quaternion kWallTurns[kWalls] = {{0, 0, 0, 1},
                                           {1, 0, 0, 0},
                                           {kHalfRoot, 0, 0, kHalfRoot},
                                           {-kHalfRoot, 0, 0, kHalfRoot},
                                           {0, kHalfRoot, 0, kHalfRoot},
                                           {0, -kHalfRoot, 0, kHalfRoot}};
constexpr Vec3 kWallPlaces[kWalls] = {{0, 0, -kHalfRoom}, {0, 0, kHalfRoom},  {0, kHalfRoom, 0},
                                      {0, -kHalfRoom, 0}, {-kHalfRoom, 0, 0}, {kHalfRoom, 0, 0}};

void add_shape(ShapeKind kind, SceneShapes& shapes) {
  resize_shapes(kind, shapes.kind.size() + 1, shapes);
}

void add_bullet_shape(ShapeKind kind, Random& random, SceneShapes& shapes) {
  add_shape(kind, shapes);
  const double width = random.between(kThinnest, kWidest);
  const auto half = static_cast<float>(width / 2);
  std::array<float, 8>& params = shapes.params.back();
  switch (kind) {
    case ShapeKind::sphere:
      params[0] = half;
      break;
    case ShapeKind::capsule:
      params = {0, -half / 2, 0, 0, half / 2, 0, half / 2};
      break;
    case ShapeKind::box:
      for (int axis = 0; axis < 3; ++axis) {
        params[axis] = static_cast<float>(random.between(0.3, 1) * width / 2);
      }
      break;
    default:
      make_shape(kind, width, random, shapes.kind.size() - 1, shapes);
  }
}

// A square in the plane z = 0. It is one-sided: only its front, towards +z, collides.
void add_sheet_shape(double half, uint32_t cells, SceneShapes& shapes) {
  add_shape(ShapeKind::mesh, shapes);
  shapes.params.back()[0] = 1;
  const auto first_vertex = static_cast<uint32_t>(shapes.vertices.size());
  const auto first_triangle = static_cast<uint32_t>(shapes.triangles.size());
  const auto place = [&](uint32_t i) { return static_cast<float>(half * (2.0 * i / cells - 1)); };
  const uint32_t row = cells + 1;
  for (uint32_t y = 0; y < row; ++y) {
    for (uint32_t x = 0; x < row; ++x) shapes.vertices.push_back({place(x), place(y), 0});
  }
  for (uint32_t y = 0; y < cells; ++y) {
    for (uint32_t x = 0; x < cells; ++x) {
      const uint32_t corner = y * row + x;
      shapes.triangles.push_back({corner, corner + 1, corner + row + 1});
      shapes.triangles.push_back({corner, corner + row + 1, corner + row});
    }
  }
  shapes.vertex_range.back() = {first_vertex, row * row};
  shapes.triangle_range.back() = {first_triangle, 2 * cells * cells};
}

// Every list has one entry for each body.
struct Rows {
  std::vector<Vec3> position;
  std::vector<Quaternion> orientation;
  std::vector<Vec3> velocity;
  std::vector<Vec3> spin;

  void add(const Vec3& at, const Quaternion& turn, const Vec3& speed, const Vec3& turning) {
    position.push_back(at);
    orientation.push_back(turn);
    velocity.push_back(speed);
    spin.push_back(turning);
  }
};

class Bullets : public SceneReader {
 public:
  explicit Bullets(const GeneratorSpec& spec) : spec_(spec) {
    info_.name = spec.text;
    info_.frames = spec.frames;
    info_.float64_positions = spec.float64_positions;
    info_.has_orientation = info_.has_linear_velocity = info_.has_angular_velocity = true;
    info_.dt = spec.dt;
    add_bullets();
    add_room();
    info_.bodies = info_.body_shape.size();
    now_ = first_;
  }

  const SceneInfo& info() const override { return info_; }
  void want(const SceneArrays& wanted) override { wanted_ = wanted; }

  Result<void> read_frame(SceneFrame& frame) override {
    if (next_frame_ == spec_.frames) next_frame_ = 0;
    if (next_frame_ == 0) {
      now_ = first_;
    } else {
      advance();
    }
    ++next_frame_;
    store_rows(!spec_.float64_positions, now_.position, frame.position32);
    store_rows(spec_.float64_positions, now_.position, frame.position64);
    store_rows(wanted_.orientation, now_.orientation, frame.orientation);
    store_rows(wanted_.linear_velocity, now_.velocity, frame.linear_velocity);
    store_rows(wanted_.angular_velocity, now_.spin, frame.angular_velocity);
    frame.boxes.clear();
    return {};
  }

 private:
  void add_bullets() {
    const uint64_t shapes = std::min(kBulletShapes, spec_.bodies);
    Random of_shapes(spec_.seed, kShapeStream);
    for (uint64_t i = 0; i < shapes; ++i) {
      add_bullet_shape(kBulletKinds[i % std::size(kBulletKinds)], of_shapes, info_.shapes);
    }
    Random random(spec_.seed, kBulletStream);
    const double fastest = spec_.speed.value_or(kSpeed);
    for (uint64_t i = 0; i < spec_.bodies; ++i) {
      const Vec3 place = place_within(kHalfRoom - kWidest, random);
      const Quaternion turn = normalized(random.rotation());
      const Vec3 velocity = random.in_shell(fastest / 6, fastest);
      first_.add(place, turn, velocity, random.in_ball(spec_.spin.value_or(kBulletSpin)));
      info_.body_shape.push_back(static_cast<uint32_t>(i % kBulletShapes));
      info_.body_motion.push_back(2);
    }
  }

  void add_room() {
    add_sheet_shape(kHalfRoom, kWallCells, info_.shapes);
    for (uint64_t i = 0; i < kWalls; ++i) add_static(kWallPlaces[i], kWallTurns[i]);
    Random random(spec_.seed, kRoomStream);
    for (uint64_t i = 0; i < kBoxes; ++i) {
      add_shape(ShapeKind::box, info_.shapes);
      for (int axis = 0; axis < 2; ++axis) {
        info_.shapes.params.back()[axis] = static_cast<float>(random.between(0.8, 2.2));
      }
      info_.shapes.params.back()[2] = static_cast<float>(kHalfBox);
      add_static(place_within(kHalfRoom - 3, random), normalized(random.rotation()));
    }
    add_sheet_shape(kHalfSheet, kSheetCells, info_.shapes);
    for (uint64_t i = 0; i < kSheets; ++i) {
      add_static(place_within(kHalfRoom - 3, random), normalized(random.rotation()));
    }
  }

  // Adds a static body with the last added shape.
  void add_static(const Vec3& place, const Quaternion& turn) {
    first_.add(place, turn, {}, {});
    info_.body_shape.push_back(static_cast<uint32_t>(info_.shapes.kind.size() - 1));
    info_.body_motion.push_back(0);
  }

  static Vec3 place_within(double half, Random& random) {
    Vec3 place;
    for (double& x : place) x = random.between(-half, half);
    return place;
  }

  void advance() {
    constexpr double kReach = kHalfRoom - kWidest;
    for (uint64_t i = 0; i < spec_.bodies; ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        double& x = now_.position[i][axis];
        x += now_.velocity[i][axis] * spec_.dt;
        bounce(-kReach, kReach, x, now_.velocity[i][axis]);
      }
      now_.orientation[i] = turned(now_.orientation[i], now_.spin[i], spec_.dt);
    }
  }

  GeneratorSpec spec_;
  SceneInfo info_;
  SceneArrays wanted_;
  Rows first_;
  Rows now_;
  uint64_t next_frame_ = 0;
};

}  // namespace

std::unique_ptr<SceneReader> open_bullets(const GeneratorSpec& spec) {
  return std::make_unique<Bullets>(spec);
}

}  // namespace carom::io
