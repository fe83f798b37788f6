// Streams of moving pairs of one pair of kinds with a given share of impacts, and the reference's
// results.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bodies.h"
#include "carom/base/result.h"
#include "carom/impacts/time_of_impact.h"
#include "carom/reference/reference.h"
#include "carom/results/pair.h"

namespace carom::bench {

struct MotionSpec {
  ShapeKind kind_a;
  ShapeKind kind_b;
  bool turning = false;  // both bodies turn as well, by up to a radian
  int hit_percent = 50;
  size_t count = 0;

  friend bool operator==(const MotionSpec&, const MotionSpec&) = default;
};

// Memory for all columns of `count` impacts.
class ImpactArrays {
 public:
  explicit ImpactArrays(size_t count);

  const ImpactColumns& columns() const { return columns_; }
  ImpactColumns times_alone() const { return {.toi = columns_.toi, .status = columns_.status}; }

 private:
  std::vector<uint8_t> status_;
  std::vector<float> floats_;
  ImpactColumns columns_;
};

// Body B starts a few sizes away and moves by up to twice that distance.
class MotionStream {
 public:
  explicit MotionStream(const MotionSpec& spec);

  const MotionSpec& spec() const { return spec_; }
  const std::vector<PlacedShape>& bodies_a() const { return bodies_a_; }
  const std::vector<PlacedShape>& bodies_b() const { return bodies_b_; }
  // Displacements of B; A can turn but does not move.
  const std::vector<Eigen::Vector3f>& displacements() const { return displacement_; }
  // Rotations, axis times angle; empty if the bodies do not turn.
  const std::vector<Eigen::Vector3f>& turns_a() const { return rotation_a_; }
  const std::vector<Eigen::Vector3f>& turns_b() const { return rotation_b_; }
  const reference::Impact& expected(size_t i) const { return expected_[i]; }
  double hit_percent() const;
  double reference_seconds() const { return reference_seconds_; }

  // Runs one pass, with points relative to the bodies.
  Result<void> run(const ImpactColumns& out) const;
  void run_reference(std::vector<reference::Impact>& out) const;
  // A message on the first row that does not have the bits of the reference.
  std::optional<std::string> difference(const ImpactColumns& out) const;

 private:
  void draw();
  reference::Impact reference_impact(size_t i) const;

  MotionSpec spec_;
  std::vector<PlacedShape> bodies_a_, bodies_b_;
  std::vector<Eigen::Vector3f> displacement_, rotation_a_, rotation_b_;
  std::unique_ptr<DenseBodies> a_, b_;
  std::vector<Pair> pairs_;
  std::vector<reference::Impact> expected_;
  double reference_seconds_ = 0;
};

}  // namespace carom::bench
