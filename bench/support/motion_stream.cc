#include "bench/support/motion_stream.h"

#include <algorithm>
#include <bit>

#include "bench/support/bodies.h"
#include "bench/support/measure.h"

namespace carom::bench {
namespace {

constexpr size_t kImpactFloats = 11;
constexpr size_t kHullVertices = 16;

Pose pose_of(const PlacedShape& body) { return {body.position, body.orientation}; }

bool has_vector(const std::array<float*, 3>& columns, size_t row, const Eigen::Vector3f& v) {
  return same_bits(columns[0][row], v.x()) && same_bits(columns[1][row], v.y()) &&
         same_bits(columns[2][row], v.z());
}

bool has_bits_of(const reference::Impact& impact, const ImpactColumns& out, size_t row) {
  return same_bits(out.toi[row], impact.toi) &&
         out.status[row] == static_cast<uint8_t>(impact.status) &&
         same_bits(out.separation[row], impact.separation) &&
         has_vector(out.normal, row, impact.normal) && has_vector(out.point_a, row, impact.arm_a) &&
         has_vector(out.point_b, row, impact.arm_b);
}

const float* data_of(const std::vector<Eigen::Vector3f>& vectors) {
  return vectors.empty() ? nullptr : vectors[0].data();
}

}  // namespace

ImpactArrays::ImpactArrays(size_t count) : status_(count), floats_(kImpactFloats * count) {
  const auto column = [&](size_t i) { return &floats_[i * count]; };
  columns_.toi = column(0);
  columns_.status = status_.data();
  columns_.separation = column(1);
  columns_.normal = {column(2), column(3), column(4)};
  columns_.point_a = {column(5), column(6), column(7)};
  columns_.point_b = {column(8), column(9), column(10)};
}

MotionStream::MotionStream(const MotionSpec& spec) : spec_(spec) {
  draw();
  a_ = std::make_unique<DenseBodies>(spec.kind_a, bodies_a_, Storage::f32);
  b_ = std::make_unique<DenseBodies>(spec.kind_b, bodies_b_, Storage::f32);
  for (uint32_t i = 0; i < spec.count; ++i) pairs_.push_back({i, i});
  const Stopwatch watch;
  run_reference(expected_);
  reference_seconds_ = watch.seconds();
}

void MotionStream::draw() {
  oracle::Random random(7);
  const std::vector<Hull> hulls = draw_hulls(kHulls, kHullVertices, random);
  const auto small_vector = [&](double size) -> Eigen::Vector3f {
    return (random.direction() * random.uniform(0, size)).cast<float>();
  };
  while (bodies_a_.size() < spec_.count) {
    const bool hit = static_cast<int>(bodies_a_.size() % 100) < spec_.hit_percent;
    const PlacedShape a = as_stored(draw_body(spec_.kind_a, random, hulls), Storage::f32);
    PlacedShape b = draw_body(spec_.kind_b, random, hulls);
    const Eigen::Vector3d way =
        random.direction() * random.uniform(8, 14);  // separate at the start
    b.position = a.position + way;
    bodies_a_.push_back(a);
    bodies_b_.push_back(as_stored(b, Storage::f32));
    if (spec_.turning) {
      rotation_a_.push_back(small_vector(1));
      rotation_b_.push_back(small_vector(1));
    }
    displacement_.emplace_back();
    do {
      const Eigen::Vector3d aside = random.direction() * random.uniform(0, 4);
      displacement_.back() = ((aside - way) * random.uniform(0.3, 2)).cast<float>();
    } while ((reference_impact(bodies_a_.size() - 1).toi <= 1) != hit);
  }
}

reference::Impact MotionStream::reference_impact(size_t i) const {
  Sweep a, b;
  b.displacement = displacement_[i];
  if (spec_.turning) {
    a.rotation = rotation_a_[i];
    b.rotation = rotation_b_[i];
  }
  return reference::time_of_impact(bodies_a_[i].shape, pose_of(bodies_a_[i]), a, bodies_b_[i].shape,
                                   pose_of(bodies_b_[i]), b, PositionType::float32);
}

double MotionStream::hit_percent() const {
  const auto hits = std::count_if(expected_.begin(), expected_.end(),
                                  [](const reference::Impact& impact) { return impact.toi <= 1; });
  return 100.0 * static_cast<double>(hits) / static_cast<double>(expected_.size());
}

Result<void> MotionStream::run(const ImpactColumns& out) const {
  const SweepView sweep_a{.rotation = data_of(rotation_a_)};
  const SweepView sweep_b{.displacement = data_of(displacement_), .rotation = data_of(rotation_b_)};
  return time_of_impact(a_->view(), sweep_a, b_->view(), sweep_b, pairs_, out,
                        {.frame = WitnessFrame::body});
}

void MotionStream::run_reference(std::vector<reference::Impact>& out) const {
  out.clear();
  for (size_t i = 0; i < spec_.count; ++i) out.push_back(reference_impact(i));
}

std::optional<std::string> MotionStream::difference(const ImpactColumns& out) const {
  for (size_t row = 0; row < expected_.size(); ++row) {
    if (!has_bits_of(expected_[row], out, row)) {
      return "row " + std::to_string(row) + " differs from the reference";
    }
  }
  return std::nullopt;
}

}  // namespace carom::bench
