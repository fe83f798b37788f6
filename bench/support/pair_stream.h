// Streams of pairs of one pair of kinds, with a given share of overlaps, and what the reference
// says of each.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bodies.h"
#include "carom/base/result.h"
#include "carom/reference/reference.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"

namespace carom::bench {

// How the bodies of a pair are found.
enum class Access {
  rows,   // row i of both sets
  pairs,  // a list of pairs as the broadphase yields it: a ascends, b is anywhere
};

const char* name(Detail detail);

struct StreamSpec {
  ShapeKind kind_a;
  ShapeKind kind_b;
  Storage storage = Storage::f32;
  int hit_percent = 50;
  Access access = Access::rows;
  size_t count = 0;
  size_t vertices = 16;  // of hulls, which are few: bodies share them

  friend bool operator==(const StreamSpec&, const StreamSpec&) = default;
};

// Room for all columns of `count` results, one after the other.
class ResultArrays {
 public:
  explicit ResultArrays(size_t count);

  const ResultColumns& columns() const { return columns_; }
  // Overwrites everything with bytes that no result has.
  void spoil();

 private:
  std::vector<uint8_t> bytes_;
  std::vector<float> floats_;
  std::vector<ManifoldPoints> manifolds_;
  ResultColumns columns_;
};

// Steps of pairs that move: by this share of the size of a body, and by this angle.
inline constexpr double kStepLength = 0.01;
inline constexpr double kStepAngle = 0.01;

// Whether a row of results, in world coordinates, is what the reference says of two bodies.
bool has_bits_of(const reference::PairResult& expected, const PlacedShape& a, const PlacedShape& b,
                 Detail detail, const ResultColumns& out, size_t row);

class PairStream {
 public:
  explicit PairStream(const StreamSpec& spec);

  const StreamSpec& spec() const { return spec_; }
  // Bodies as they are stored; with Access::rows pair i is row i of both.
  const std::vector<PlacedShape>& bodies_a() const { return bodies_a_; }
  const std::vector<PlacedShape>& bodies_b() const { return bodies_b_; }
  // What the reference says of pair i.
  const reference::PairResult& expected(size_t i) const { return expected_[i]; }
  double hit_percent() const;
  // The time of one pass of the reference.
  double reference_seconds() const { return reference_seconds_; }

  // One pass.
  Result<void> run(Detail detail, const ResultColumns& out,
                   Measured measured = Measured::all) const;
  // The same with all second bodies a step further, as draw_next_step() has them.
  Result<void> run_next_step(Detail detail, const ResultColumns& out, Measured measured) const;
  void draw_next_step();
  void run_reference(std::vector<reference::PairResult>& out) const;

  // The first row of `out` that does not have the bits of the reference, as a message.
  std::optional<std::string> difference(Detail detail, const ResultColumns& out) const;

 private:
  void draw();
  Result<void> run(const DenseBodies& b, Detail detail, const ResultColumns& out,
                   Measured measured) const;

  StreamSpec spec_;
  std::vector<PlacedShape> bodies_a_;
  std::vector<PlacedShape> bodies_b_;
  std::vector<Pair> pairs_;
  std::unique_ptr<DenseBodies> a_;
  std::unique_ptr<DenseBodies> b_;
  std::unique_ptr<DenseBodies> b_next_;
  std::vector<reference::PairResult> expected_;
  double reference_seconds_ = 0;
};

}  // namespace carom::bench
