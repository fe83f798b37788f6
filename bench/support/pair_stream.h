// Streams of pairs of one pair of kinds with a given share of overlaps, and the reference's
// results.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bodies.h"
#include "carom/base/result.h"
#include "carom/reference/reference.h"
#include "carom/results/pair.h"
#include "carom/results/result_arrays.h"

namespace carom::bench {

// How the library finds the bodies of a pair.
enum class Access {
  rows,   // row i of both sets
  pairs,  // a list of pairs as from the broadphase: a ascends, b is random
};

const char* name(Detail detail);

// How the bodies of a pair lie. Pairs that are not drawn `freely` overlap about half of the time,
// whatever hit_percent says.
enum class Placing {
  freely,
  touching,  // to within rounding
  parallel,  // two boxes face to face, turned by up to 0.01 radians, apart or deep by 1e-8 to 1/3 m
};

struct StreamSpec {
  ShapeKind kind_a;
  ShapeKind kind_b;
  Storage storage = Storage::f32;
  int hit_percent = 50;
  Placing placing = Placing::freely;
  Access access = Access::rows;
  size_t count = 0;
  size_t vertices = 16;  // of hulls; few hulls, shared by the bodies

  friend bool operator==(const StreamSpec&, const StreamSpec&) = default;
};

// Overwrites all columns with bytes that no result has.
void spoil(ResultArrays& results);

// Movement from one step to the next: this share of the body's size, and this angle (radians).
inline constexpr double kStepLength = 0.01;
inline constexpr double kStepAngle = 0.01;

// Whether a row of results, in world coordinates, has the bits of the reference for two bodies.
bool has_bits_of(const reference::PairResult& expected, const PlacedShape& a, const PlacedShape& b,
                 Detail detail, const ResultColumns& out, size_t row);

class PairStream {
 public:
  explicit PairStream(const StreamSpec& spec);

  const StreamSpec& spec() const { return spec_; }
  // The stored bodies; with Access::rows pair i is row i of both.
  const std::vector<PlacedShape>& bodies_a() const { return bodies_a_; }
  const std::vector<PlacedShape>& bodies_b() const { return bodies_b_; }
  // The reference's result of pair i.
  const reference::PairResult& expected(size_t i) const { return expected_[i]; }
  double hit_percent() const;
  // The time of one pass of the reference.
  double reference_seconds() const { return reference_seconds_; }
  // The bytes of both bodies and of the columns that this detail needs: the least that a test reads
  // and writes.
  size_t bytes_per_pair(Detail detail) const;

  // Runs one pass.
  Result<void> run(Detail detail, const ResultColumns& out,
                   Measured measured = Measured::all) const;
  // Runs one pass with all second bodies one step further, as drawn by draw_next_step().
  Result<void> run_next_step(Detail detail, const ResultColumns& out, Measured measured) const;
  void draw_next_step();
  void run_reference(std::vector<reference::PairResult>& out) const;

  // A message on the first row of `out` that does not have the bits of the reference.
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
