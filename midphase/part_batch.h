// Pairs of parts on their way through the narrow phase, as two sets of bodies of their own.
#pragma once

#include <array>
#include <cstdint>

#include "carom/kernel/tier.h"
#include "midphase/placed_part.h"
#include "narrowphase/passes.h"

namespace carom {

// One side, dense, with float64 positions.
class PartColumns {
 public:
  void clear() { rows_used_ = 0; }
  void put(size_t i, const PlacedPart& part);

  Collidables view(size_t count) const;
  ShapeKind kind(size_t i) const { return kind_[i]; }
  Part part(size_t i) const;
  const Double3& arm(size_t i) const { return arm_[i]; }
  uint64_t order(size_t i) const { return order_[i]; }

  // Whether row i is a triangle of a mesh; if so, which.
  bool is_of_mesh(size_t i) const { return mesh_[i] != nullptr; }
  PlacedTriangle triangle(size_t i) const;
  // A triangle's inner edges.
  void set_inner_edges(size_t i, uint8_t edges) {
    rows_[first_row_[i] + 2][3] = static_cast<float>(edges);
  }

 private:
  void put_rows(size_t i, const Row* rows, uint32_t count);

  struct Position {
    double x, y, z, radius;
  };

  alignas(64) std::array<Position, kPairsPerBlock> record_;
  std::array<Double3, kPairsPerBlock> position_;
  std::array<Double3, kPairsPerBlock> arm_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<std::array<float, kPairsPerBlock>, 3> lower_, upper_;  // of aabbs
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<uint32_t, kPairsPerBlock> first_row_;
  std::array<Row, kPairsPerBlock * kMostRows> rows_;
  std::array<const MeshGeometry*, kPairsPerBlock> mesh_;
  std::array<uint32_t, kPairsPerBlock> triangle_;
  std::array<uint64_t, kPairsPerBlock> order_;
  uint32_t rows_used_ = 0;
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
  size_t count() const { return count_; }
  bool is_full() const { return count_ == kPairsPerBlock; }
  void clear();
  // The pair belongs to `owner`; it must be of kinds that have a kernel.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b);
  // The same, with inner edges of triangles.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b,
           const std::array<uint8_t, 2>& inner_edges);

  // Tests all pairs, and finds which overlaps come over inner edges of meshes.
  void run(const PartTests& tests);
  // Tests all pairs with inner edges as they are set.
  void run_again(const PartTests& tests) { run_plain(tests); }

  const PartColumns& side(size_t which) const { return sides_[which]; }
  size_t owner(size_t i) const { return owner_[i]; }
  // The inner edges of the triangle on each side over one of which the contact of row i came; 0: it
  // did not.
  const std::array<uint8_t, 2>& edges_to_close(size_t i) const { return edges_to_close_[i]; }
  // Those of the last run, as far as they were asked for.
  ResultColumns results();

 private:
  ResultColumns asked(const PartTests& tests);
  void run_plain(const PartTests& tests);
  std::array<uint8_t, 2> find_edges_to_close(size_t i);

  size_t count_ = 0;
  std::array<PartColumns, 2> sides_;
  std::array<uint32_t, kPairsPerBlock> owner_;
  bool has_meshes_ = false;
  ScratchColumns scratch_;
  std::array<uint8_t, kPairsPerBlock> manifold_count_;
  std::array<ManifoldPoints, kPairsPerBlock> manifold_;
  std::array<float, kPairsPerBlock> bound_;
  std::array<std::array<uint8_t, 2>, kPairsPerBlock> edges_to_close_;
};

}  // namespace carom
