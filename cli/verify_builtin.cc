#include "cli/verify_builtin.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "cli/scene_bounds.h"
#include "io/generate/generator.h"
#include "io/generate/random.h"

namespace carom::cli {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::unique_ptr<io::SceneReader> generate(const std::string& text) {
  Result<io::GeneratorSpec> spec = io::parse_generator(text);
  assert(spec);
  return io::open_generator(*spec);
}

// A generated scene of boxes in which every other body is a sphere, with layers, masks, owners,
// sensors and all kinds of motion, and with bodies that are ill-formed in some frames.
class MixedScene : public io::SceneReader {
 public:
  explicit MixedScene(std::unique_ptr<io::SceneReader> base)
      : base_(std::move(base)), info_(base_->info()) {
    for (size_t i = 0; i < info_.shapes.kind.size(); i += 2) {
      info_.shapes.kind[i] = static_cast<uint8_t>(ShapeKind::sphere);
    }
    info_.shapes.params[11][0] = -1;
    info_.shapes.params[12][0] = kNan;
    for (uint32_t i = 0; i < info_.bodies; ++i) {
      info_.body_motion.push_back(static_cast<uint8_t>(i % 3));
      info_.layer.push_back(1u << i % 5);
      info_.mask.push_back(i % 4 == 0 ? 0x0fu : 0x1fu);
      info_.owner.push_back(i % 10 < 4 ? 1 + i % 4 : 0);
      info_.sensor.push_back(i % 7 == 0);
    }
  }

  const io::SceneInfo& info() const override { return info_; }
  void want(const io::SceneArrays& wanted) override { base_->want(wanted); }

  Result<void> read_frame(io::SceneFrame& frame) override {
    Result<void> read = base_->read_frame(frame);
    if (read && frame_++ % 3 == 1) {
      spoil(frame.position32);
      spoil(frame.position64);
    }
    return read;
  }

 private:
  template <class T>
  static void spoil(std::vector<T>& rows) {
    if (rows.empty()) return;
    rows[3 * 20 + 1] = kNan;
    rows[3 * 21 + 2] = kInfinity;
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

// Sizes over six decades, about half of the pairs overlapping.
class RandomPairs {
 public:
  RandomPairs(PositionType positions, uint64_t seed)
      : random_(seed, 0), pairs_{BodyColumns(positions), BodyColumns(positions)} {
    spread_ = positions == PositionType::float64 ? 1e7 : 100;
  }

  void add(ShapeKind a, ShapeKind b) {
    double size_a = sizes_.draw(random_);
    double size_b = size_a * random_.between(0.1, 1);
    Eigen::Vector3d position = vector(spread_);
    double touch = reach(a) * size_a + reach(b) * size_b;
    pairs_.a.push(shape(a, size_a), position);
    pairs_.b.push(shape(b, size_b), position + vector(1.25 * touch));
  }

  // Coincident, touching, empty and ill-formed bodies.
  void add_special(ShapeKind a, ShapeKind b) {
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const double denormal = std::numeric_limits<float>::denorm_min();
    for (double size :
         {0.0, 1.0, 1e-30, 1e18, 3 * denormal, -1.0, double{kNan}, double{kInfinity}}) {
      for (double distance : {0.0, 1.0, 2.0, -2.0, 2e-30, 2e18, double{kNan}, double{kInfinity}}) {
        for (int axis = 0; axis < 3; ++axis) {
          pairs_.a.push(even_shape(a, 1.0), origin);
          pairs_.b.push(even_shape(b, size), distance * Eigen::Vector3d::Unit(axis));
        }
      }
    }
  }

  PairSet take() { return std::move(pairs_); }

 private:
  Eigen::Vector3d vector(double radius) {
    io::Vec3 v = random_.in_ball(radius);
    return {v[0], v[1], v[2]};
  }

  // How far a shape of size 1 reaches in a middling direction.
  static double reach(ShapeKind kind) { return kind == ShapeKind::sphere ? 1 : 0.8; }

  static Shape even_shape(ShapeKind kind, double size) {
    auto half = static_cast<float>(size);
    if (kind == ShapeKind::sphere) return Sphere{half};
    return Aabb::from_half_extents(Eigen::Vector3f::Constant(half));
  }

  Shape shape(ShapeKind kind, double size) {
    if (kind == ShapeKind::sphere) return even_shape(kind, size);
    auto edge = [&] { return static_cast<float>(size * random_.between(0.3, 1)); };
    Eigen::Vector3f lower(-edge(), -edge(), -edge());
    Eigen::Vector3f upper(edge(), edge(), edge());
    return Aabb{lower, upper};
  }

  io::Random random_;
  io::LogUniform sizes_{1e-3, 1e3};
  PairSet pairs_;
  double spread_;
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
  const std::string mixed = "brownian:n=403,frames=10,density=0.8,speed=3";
  scenes.push_back({"mixed bodies, float32", std::make_unique<MixedScene>(generate(mixed))});
  scenes.push_back({"mixed bodies, float64",
                    std::make_unique<MixedScene>(generate(mixed + ",positions=float64"))});
  scenes.push_back(
      {"recording of bounds", std::make_unique<RecordedScene>(generate("static:n=800,frames=8"))});
  return scenes;
}

std::vector<BuiltinPairs> builtin_pairs() {
  constexpr size_t kPairs = 2003;
  constexpr ShapeKind kKinds[] = {ShapeKind::sphere, ShapeKind::aabb};
  std::vector<BuiltinPairs> sets;
  for (PositionType positions : {PositionType::float32, PositionType::float64}) {
    const std::string type = positions == PositionType::float64 ? ", float64" : ", float32";
    RandomPairs mixed(positions, 99);
    for (ShapeKind a : kKinds) {
      for (ShapeKind b : kKinds) {
        RandomPairs pairs(positions, sets.size());
        for (size_t i = 0; i < kPairs; ++i) pairs.add(a, b);
        pairs.add_special(a, b);
        mixed.add_special(a, b);
        sets.push_back({std::string(name(a)) + "-" + name(b) + " pairs" + type, pairs.take()});
      }
    }
    for (size_t i = 0; i < kPairs; ++i) mixed.add(kKinds[i % 2], kKinds[i / 2 % 2]);
    sets.push_back({"mixed pairs" + type, mixed.take()});
  }
  return sets;
}

}  // namespace carom::cli
