#include "bench/support/frames.h"

#include <cstdio>
#include <cstdlib>

#include "bench/support/measure.h"
#include "io/generate/generator.h"

namespace carom::bench {
namespace {

// Unwraps results of our own specs and generators, which do not fail.
template <class T>
T expect(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "carom_bench: %s\n", result.error().message.c_str());
  std::abort();
}

std::string generator_text(const SceneSpec& spec) {
  return spec.generator + ":n=" + std::to_string(spec.bodies) +
         ",frames=" + std::to_string(Frames::kCount) +
         (spec.kind == ShapeKind::sphere ? ",shape=sphere" : "");
}

}  // namespace

size_t FrameCycle::next() {
  if (frame_ == last_) forwards_ = false;
  if (frame_ == 0) forwards_ = true;
  return forwards_ ? ++frame_ : --frame_;
}

std::string SceneSpec::name() const { return generator + "_" + short_count(bodies); }

Frames::Frames(const SceneSpec& spec) : spec_(spec) {
  const auto reader = io::open_generator(expect(io::parse_generator(generator_text(spec))));
  const io::SceneInfo& info = reader->info();
  for (const uint32_t shape : info.body_shape) {
    const std::array<float, 8>& params = info.shapes.params[shape];
    if (spec.kind == ShapeKind::sphere) {
      shapes_.push_back(Sphere{params[0]});
    } else {
      shapes_.push_back(Aabb::from_half_extents({params[0], params[1], params[2]}));
    }
  }
  reader->want({.orientation = false, .linear_velocity = false, .angular_velocity = false});
  io::SceneFrame frame;
  for (size_t i = 0; i < kCount; ++i) {
    if (const Result<void> read = reader->read_frame(frame); !read) std::abort();
    positions_.push_back(frame.position32);
  }
}

std::vector<PlacedShape> Frames::bodies(size_t frame) const {
  std::vector<PlacedShape> bodies(shapes_.size());
  for (size_t i = 0; i < bodies.size(); ++i) {
    const auto position = Eigen::Map<const Eigen::Vector3f>(&positions_[frame][3 * i]);
    bodies[i] = {shapes_[i], position.cast<double>()};
  }
  return bodies;
}

std::vector<size_t> scene_sizes(size_t most) {
  std::vector<size_t> sizes;
  for (size_t size = 1'000; size <= most; size *= 10) sizes.push_back(size);
  return sizes;
}

}  // namespace carom::bench
