#include "io/generate/generator.h"

#include <cmath>
#include <utility>

#include "io/generate/population.h"

namespace carom::io {
namespace {

constexpr uint64_t kSteeringStream = 16;

SceneInfo scene_info(const GeneratorSpec& spec, const Population& population) {
  SceneInfo info;
  info.name = spec.text;
  info.bodies = spec.bodies;
  info.frames = spec.frames;
  info.float64_positions = spec.float64_positions;
  info.has_linear_velocity = true;
  info.dt = spec.dt;
  bool one_shape =
      spec.spheres && (spec.kind == GeneratorKind::brownian || spec.kind == GeneratorKind::still);
  size_t shapes = one_shape ? 1 : spec.bodies;
  ShapeKind code = spec.spheres ? ShapeKind::sphere : ShapeKind::aabb;
  info.shapes.kind.assign(shapes, static_cast<uint8_t>(code));
  info.shapes.params.resize(shapes);
  for (size_t i = 0; i < shapes; ++i) {
    for (int axis = 0; axis < (spec.spheres ? 1 : 3); ++axis) {
      info.shapes.params[i][axis] = static_cast<float>(population.half[i][axis]);
    }
  }
  info.body_shape.resize(spec.bodies);
  for (size_t i = 0; i < spec.bodies && !one_shape; ++i) {
    info.body_shape[i] = static_cast<uint32_t>(i);
  }
  if (spec.mark_static) {
    info.body_motion.resize(spec.bodies);
    for (size_t i = 0; i < spec.bodies; i += population.mover_stride) info.body_motion[i] = 2;
  }
  return info;
}

// Mirrors a coordinate that has passed a wall.
void bounce(double lower, double upper, double& x, double& velocity) {
  if (x >= lower && x <= upper) return;
  double wall = x < lower ? lower : upper;
  velocity = x < lower ? std::fabs(velocity) : -std::fabs(velocity);
  x = std::fmin(std::fmax(wall + (wall - x), lower), upper);
}

class GeneratedScene : public SceneReader {
 public:
  explicit GeneratedScene(const GeneratorSpec& spec)
      : spec_(spec), population_(populate(spec)), info_(scene_info(spec, population_)) {}

  const SceneInfo& info() const override { return info_; }
  void want(const SceneArrays& wanted) override { wanted_ = wanted; }

  Result<void> read_frame(SceneFrame& frame) override {
    if (next_frame_ == spec_.frames) restart();
    if (next_frame_ > 0) advance();
    ++next_frame_;
    store(frame);
    return {};
  }

 private:
  void restart() {
    population_ = populate(spec_);
    steering_ = Random(spec_.seed, kSteeringStream);
    next_frame_ = 0;
  }

  void advance() {
    if (population_.speed == 0) return;
    for (uint64_t i = 0; i < spec_.bodies; i += population_.mover_stride) move(i);
    for (uint64_t i = 0; i < (population_.movers() + 99) / 100; ++i) steer();
  }

  void move(uint64_t body) {
    for (int axis = 0; axis < 3; ++axis) {
      double middle = (population_.lower[axis] + population_.upper[axis]) / 2;
      double half = population_.half[body][axis];
      double lower = std::fmin(population_.lower[axis] + half, middle);
      double upper = std::fmax(population_.upper[axis] - half, middle);
      double& velocity = population_.velocity[body][axis];
      double& x = population_.position[body][axis];
      x += velocity * spec_.dt;
      bounce(lower, upper, x, velocity);
    }
  }

  // A new velocity for a mover drawn at random; one may be drawn twice.
  void steer() {
    uint64_t mover = steering_.below(static_cast<uint32_t>(population_.movers()));
    population_.velocity[mover * population_.mover_stride] = steering_.in_ball(population_.speed);
  }

  void store(SceneFrame& frame) const {
    frame = {std::move(frame.position32),
             std::move(frame.position64),
             {},
             std::move(frame.linear_velocity),
             {},
             {}};
    if (spec_.float64_positions) {
      frame.position32.clear();
      store_rows(population_.position, frame.position64);
    } else {
      frame.position64.clear();
      store_rows(population_.position, frame.position32);
    }
    if (wanted_.linear_velocity) {
      store_rows(population_.velocity, frame.linear_velocity);
    } else {
      frame.linear_velocity.clear();
    }
  }

  template <class T>
  static void store_rows(const std::vector<Vec3>& rows, std::vector<T>& out) {
    out.resize(3 * rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
      for (size_t axis = 0; axis < 3; ++axis) out[3 * i + axis] = static_cast<T>(rows[i][axis]);
    }
  }

  GeneratorSpec spec_;
  Population population_;
  SceneInfo info_;
  SceneArrays wanted_;
  Random steering_{spec_.seed, kSteeringStream};
  uint64_t next_frame_ = 0;
};

}  // namespace

std::unique_ptr<SceneReader> open_generator(const GeneratorSpec& spec) {
  return std::make_unique<GeneratedScene>(spec);
}

}  // namespace carom::io
