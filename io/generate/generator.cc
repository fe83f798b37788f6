#include "io/generate/generator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/generate/bullets.h"
#include "io/generate/made_shapes.h"
#include "io/generate/motion.h"
#include "io/generate/population.h"

namespace carom::io {
namespace {

constexpr uint64_t kSteeringStream = 16;
constexpr uint64_t kMadeShapesStream = 17;
constexpr uint64_t kMadeShapes = 16;  // bodies of one size use them in turn

std::array<float, 8> shape_params(ShapeKind shape, const Population& population, size_t body) {
  const auto share_of_edge = [&](double share) {
    return static_cast<float>(population.edges[body][1] * share);
  };
  switch (shape) {
    case ShapeKind::capsule:
      return {0, -share_of_edge(0.25), 0, 0, share_of_edge(0.25), 0, share_of_edge(0.25)};
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return {share_of_edge(0.25), share_of_edge(0.5)};
    case ShapeKind::ellipsoid:
      return {share_of_edge(0.5), share_of_edge(0.375), share_of_edge(0.25)};
    default:
      break;
  }
  std::array<float, 8> params{};
  for (int axis = 0; axis < (shape == ShapeKind::sphere ? 1 : 3); ++axis) {
    double half =
        shape == ShapeKind::box ? population.edges[body][axis] / 2 : population.half[body][axis];
    params[axis] = static_cast<float>(half);
  }
  return params;
}

bool has_one_size(const GeneratorSpec& spec) {
  return spec.kind == GeneratorKind::brownian || spec.kind == GeneratorKind::still;
}

// The number of shapes; body i has shape i modulo this.
uint64_t shape_count(const GeneratorSpec& spec) {
  if (!has_one_size(spec)) return spec.bodies;
  if (spec.mixed) return std::min(kMadeShapes * kMixedShapes.size(), spec.bodies);
  if (spec.shape == ShapeKind::aabb) return spec.bodies;
  return is_made(spec.shape) ? std::min(kMadeShapes, spec.bodies) : 1;
}

// Whether all shapes are their parameters, so that the arrays of ranges stay empty.
bool needs_no_ranges(const GeneratorSpec& spec) { return !spec.mixed && !is_made(spec.shape); }

void add_cores(const GeneratorSpec& spec, const Population& population, SceneShapes& shapes) {
  const uint64_t count = shape_count(spec);
  if (needs_no_ranges(spec)) {
    shapes.kind.assign(count, static_cast<uint8_t>(spec.shape));
    shapes.params.resize(count);
    for (size_t i = 0; i < count; ++i) {
      shapes.params[i] = shape_params(spec.shape, population, i);
    }
    return;
  }
  resize_shapes(spec.shape, count, shapes);
  Random random(spec.seed, kMadeShapesStream);
  for (size_t i = 0; i < count; ++i) {
    const ShapeKind shape = spec.shape_of(i);
    shapes.kind[i] = static_cast<uint8_t>(shape);
    if (is_made(shape)) {
      make_shape(shape, population.edges[i][0], random, i, shapes);
    } else {
      shapes.params[i] = shape_params(shape, population, i);
    }
  }
}

void add_shapes(const GeneratorSpec& spec, const Population& population, SceneShapes& shapes) {
  add_cores(spec, population, shapes);
  if (!(spec.rounding > 0)) return;
  shapes.rounding.resize(shapes.kind.size());
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    if (takes_rounding(shapes.kind[i])) shapes.rounding[i] = static_cast<float>(spec.rounding);
  }
}

SceneInfo scene_info(const GeneratorSpec& spec, const Population& population) {
  SceneInfo info;
  info.name = spec.text;
  info.bodies = spec.bodies;
  info.frames = spec.frames;
  info.float64_positions = spec.float64_positions;
  info.has_orientation = spec.has_orientation();
  info.has_linear_velocity = true;
  info.has_angular_velocity = spec.has_orientation();
  info.dt = spec.dt;
  add_shapes(spec, population, info.shapes);
  const uint64_t shapes = shape_count(spec);
  info.body_shape.resize(spec.bodies);
  for (size_t i = 0; i < spec.bodies; ++i) info.body_shape[i] = static_cast<uint32_t>(i % shapes);
  if (spec.mark_static) {
    info.body_motion.resize(spec.bodies);
    for (size_t i = 0; i < spec.bodies; i += population.mover_stride) info.body_motion[i] = 2;
  }
  return info;
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
    uint64_t stride = population_.mover_stride;
    if (population_.speed > 0) {
      for (uint64_t i = 0; i < spec_.bodies; i += stride) move(i);
      for (uint64_t i = 0; i < (population_.movers() + 99) / 100; ++i) steer();
    }
    if (population_.spin > 0) {
      for (uint64_t i = 0; i < spec_.bodies; i += stride) turn(i);
    }
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

  void turn(uint64_t body) {
    population_.orientation[body] =
        turned(population_.orientation[body], population_.angular_velocity[body], spec_.dt);
  }

  // Gives a new velocity to a random mover. It may draw the same mover twice.
  void steer() {
    uint64_t mover = steering_.below(static_cast<uint32_t>(population_.movers()));
    population_.velocity[mover * population_.mover_stride] = steering_.in_ball(population_.speed);
  }

  void store(SceneFrame& frame) const {
    const Population& bodies = population_;
    bool float64 = spec_.float64_positions;
    store_rows(!float64, bodies.position, frame.position32);
    store_rows(float64, bodies.position, frame.position64);
    store_rows(wanted_.orientation, bodies.orientation, frame.orientation);
    store_rows(wanted_.linear_velocity, bodies.velocity, frame.linear_velocity);
    store_rows(wanted_.angular_velocity, bodies.angular_velocity, frame.angular_velocity);
    frame.boxes.clear();
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
  if (spec.kind == GeneratorKind::bullets) return open_bullets(spec);
  return std::make_unique<GeneratedScene>(spec);
}

}  // namespace carom::io
