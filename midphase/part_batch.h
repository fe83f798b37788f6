// Pairs of parts on their way through the narrow phase, as two sets of bodies of their own.
#pragma once

#include <array>
#include <cstdint>

#include "carom/results/tier.h"
#include "midphase/placed_part.h"
#include "narrowphase/batch/scratch_columns.h"

namespace carom {

// One side, dense, with float64 positions.
class PartColumns {
 public:
  void clear();
  // The place of the part's body. A part that comes again and again is put once.
  uint32_t put(size_t owner, const PlacedPart& part);

  Collidables view() const;
  ShapeKind kind(size_t body) const { return kind_[body]; }
  Double3 middle(size_t body) const;
  const Double3& arm(size_t body) const { return frames_[frame_[body]].arm; }
  uint64_t order(size_t body) const { return order_[body]; }

  // Whether it is a triangle of a mesh; if so, which.
  bool is_of_mesh(size_t body) const { return triangle_[body] != PlacedPart::kWhole; }
  PlacedTriangle triangle(size_t body) const;
  // A triangle's inner edges.
  void set_inner_edges(size_t body, uint8_t edges) {
    rows_[first_row_[body] + 2][3] = static_cast<float>(edges);
  }

 private:
  Part part(size_t body) const;

  // What the triangles of a mesh have in common.
  struct Frame {
    Double3 position, arm;
    Turn turn;
    const MeshGeometry* mesh;  // nullptr: of another shape
    uint32_t child;
    size_t owner;

    bool is_of(size_t its_owner, const PlacedPart& placed) const {
      return owner == its_owner && child == placed.child;
    }
  };

  void put_frame(size_t owner, const PlacedPart& part);

  struct Position {
    double x, y, z, radius;
  };

  uint32_t count_ = 0, frames_used_ = 0, rows_used_ = 0;
  bool are_mixed_ = false;
  alignas(64) std::array<Position, kPairsPerBlock> record_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<std::array<float, kPairsPerBlock>, 3> lower_, upper_;  // of aabbs
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<uint32_t, kPairsPerBlock> first_row_;
  std::array<Row, kPairsPerBlock * kMostRows> rows_;
  std::array<uint32_t, kPairsPerBlock> frame_;
  std::array<uint32_t, kPairsPerBlock> triangle_;
  std::array<uint64_t, kPairsPerBlock> order_;
  std::array<Frame, kPairsPerBlock> frames_;
};

// What is asked of all pairs.
struct PartTests {
  bool manifolds = false;
  bool bounds = false;
  Measured measured = Measured::all;
  Accuracy accuracy;
};

// Results are relative to the parts' own positions.
class PartBatch {
 public:
  PartBatch();

  size_t count() const { return count_; }
  bool is_full() const { return count_ == kPairsPerBlock; }
  void clear();
  // The pair belongs to `owner`; it must be of kinds that have a kernel.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b);
  // The same, with inner edges of triangles.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b,
           const std::array<uint8_t, 2>& inner_edges);

  // Tests all pairs.
  void run(const PartTests& tests);

  size_t owner(size_t i) const { return owner_[i]; }
  // Of the parts of pair i.
  std::array<uint64_t, 2> orders(size_t i) const {
    return {sides_[0].order(pairs_[i].a), sides_[1].order(pairs_[i].b)};
  }
  const Double3& arm_a(size_t i) const { return sides_[0].arm(pairs_[i].a); }
  const Double3& arm_b(size_t i) const { return sides_[1].arm(pairs_[i].b); }
  // Those of the last run, as far as they were asked for.
  const ResultColumns& results() const { return results_; }
  // Of an overlapping pair: the inner edges of the triangle on each side over one of which the
  // contact came; 0: it did not.
  std::array<uint8_t, 2> edges_to_close(size_t i) const;

 private:
  size_t count_ = 0;
  std::array<PartColumns, 2> sides_;
  std::array<Pair, kPairsPerBlock> pairs_;
  std::array<uint32_t, kPairsPerBlock> owner_;
  ScratchColumns scratch_;
  std::array<uint8_t, kPairsPerBlock> manifold_count_;
  std::array<ManifoldPoints, kPairsPerBlock> manifold_;
  std::array<float, kPairsPerBlock> bound_;
  ResultColumns results_;
};

}  // namespace carom
