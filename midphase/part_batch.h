// A batch of pairs of parts for the narrow phase. The parts form two sets of bodies of their own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "carom/results/pair.h"
#include "carom/results/tier.h"
#include "midphase/part_search.h"
#include "midphase/placed_part.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {

// The bodies of one side, dense, with float64 positions.
class PartColumns {
 public:
  // How corners of triangles of surfaces are stored: counted from the origin that they are put with
  // (geometries/local_origin.h), or as the mesh has them; whole bodies then lie where they are
  // stored.
  enum class Corners { near, as_made };

  void clear(Corners corners);
  // Adds a part, and returns the index of its body. A part that repeats the last one is not added
  // again.
  uint32_t put(size_t owner, const PlacedPart& part, const std::array<float, 3>& origin);
  // Adds `count` triangles of a surface, number i being triangle(i), and returns the index of the
  // first one's body. Those that wait have no corners until write_corners(): few of them are
  // tested.
  template <class Triangle>
  uint32_t put_triangles(size_t owner, const PlacedPart& surface,
                         const std::array<float, 3>& origin, bool they_wait, size_t count,
                         const Triangle& triangle);
  // For all but triangles of surfaces it does nothing.
  void write_corners(uint32_t body);

  Collidables view() const;
  ShapeKind kind(size_t body) const { return kind_[body]; }
  Double3 middle(size_t body) const;
  const Double3& arm(size_t body) const { return frames_[frame_[body]].arm; }
  // See PlacedPart::order().
  uint64_t order(size_t body) const {
    const uint32_t triangle = is_of_surface(body) ? triangle_[body] : 0;
    return uint64_t{frames_[frame_[body]].child} << 32 | triangle;
  }

  // Whether the body is a triangle of a surface; triangle() then gives it.
  bool is_of_surface(size_t body) const { return triangle_[body] != PlacedPart::kWhole; }
  PlacedTriangle triangle(size_t body) const;
  // Sets the inner edges of a triangle.
  void set_inner_edges(size_t body, uint8_t edges) {
    rows_[first_row_[body] + 2][3] = static_cast<float>(edges);
  }

 private:
  Part part(size_t body) const;

  // The triangles of one surface share these numbers.
  struct Frame {
    Double3 position, arm;  // of the origin
    std::array<float, 3> origin;
    Double3 position_of_surface;
    Turn turn;
    std::optional<Surface> surface;
    std::optional<bool> one_sided;
    uint32_t child;
    size_t owner;

    bool is_of(size_t its_owner, const PlacedPart& placed,
               const std::array<float, 3>& its_origin) const {
      return owner == its_owner && child == placed.child && origin == its_origin;
    }
  };

  // Whether it is the last one.
  bool has_frame(size_t owner, const PlacedPart& part, const std::array<float, 3>& origin) const {
    return frames_used_ > 0 && frames_[frames_used_ - 1].is_of(owner, part, origin);
  }
  void put_frame(size_t owner, const PlacedPart& part, const std::array<float, 3>& origin);

  struct Position {
    double x, y, z, radius;
  };

  std::array<float, 3> origin_of_rows(const std::array<float, 3>& origin) const {
    return corners_ == Corners::near ? origin : std::array<float, 3>{};
  }

  Corners corners_ = Corners::near;
  uint32_t count_ = 0, frames_used_ = 0, rows_used_ = 0;
  bool are_mixed_ = false;
  alignas(64) std::array<Position, kPairsPerBlock> record_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<std::array<float, kPairsPerBlock>, 3> lower_, upper_;  // aabbs only
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<uint32_t, kPairsPerBlock> first_row_;
  std::array<Row, kPairsPerBlock * kMostRows> rows_;
  std::array<const DopGeometry*, kPairsPerBlock> dops_;
  std::array<uint32_t, kPairsPerBlock> frame_;
  std::array<uint32_t, kPairsPerBlock> triangle_;
  std::array<Frame, kPairsPerBlock> frames_;
};

// What to compute for all pairs of a batch.
struct PartTests {
  bool manifolds = false;
  bool bounds = false;
  bool reach = false;       // pairs have contact distances
  bool counts_near = true;  // corners of triangles of surfaces, from a place near the other part
  Measured measured = Measured::all;
  Tier tier = Tier::standard;
};

// Results are relative to the parts' own positions.
class PartBatch {
 public:
  size_t count() const { return count_; }
  bool is_full() const { return room() == 0; }
  // How many pairs may still be added.
  size_t room() const { return kPairsPerBlock - count_ - waiting_count_; }
  // Forgets all pairs. Those that follow get these tests.
  void begin(const PartTests& tests);
  void clear();
  // Adds a pair for `owner`, with its contact distance. Its kinds must have a kernel.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach);
  // The same of a pair whose separation is not less: it waits until it is admitted.
  void add_waiting(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach,
                   float least_separation);
  // Adds the pairs of one part with each of some triangles of a surface; there must be room for
  // them. Those with a least separation wait until they are admitted.
  void add_triangles(size_t owner, const NearParts& parts, float reach);
  // Adds pairs of triangles of two meshes; there must be room for them.
  void add_triangle_pairs(size_t owner, const NearParts& parts, float reach);
  // Adds a pair, and sets the inner edges of triangles, whose corners are counted as the surface
  // does.
  void add(size_t owner, const PlacedPart& a, const PlacedPart& b, float reach,
           const std::array<uint8_t, 2>& inner_edges);

  bool has_waiting() const { return waiting_count_ > 0; }
  // Adds waiting pairs, and forgets those that do not matter. may_matter(owner, least separation)
  // is asked about each. Of owners that are_known(owner) it adds all others that may matter, of
  // the others one pair, that of the least separation. Nothing is added after it until clear().
  template <class IsKnown, class MayMatter>
  void admit_waiting(const IsKnown& is_known, const MayMatter& may_matter);

  // Tests all pairs that were added since the last run.
  void run();
  // How many pairs were tested in all runs but the last.
  size_t tested_before() const { return tested_before_; }

  size_t owner(size_t i) const { return owner_[i]; }
  // The places of the parts of pair i in the order of sub-shapes.
  std::array<uint64_t, 2> orders(size_t i) const {
    return {sides_[0].order(pairs_[i].a), sides_[1].order(pairs_[i].b)};
  }
  const Double3& arm_a(size_t i) const { return sides_[0].arm(pairs_[i].a); }
  const Double3& arm_b(size_t i) const { return sides_[1].arm(pairs_[i].b); }
  // The results of all runs, in the columns that were asked for.
  const ResultColumns& results() const { return results_; }
  // For a pair with a contact, by side: all inner edges of the triangle if the contact came over
  // one of them; 0 otherwise.
  std::array<uint8_t, 2> edges_to_close(size_t i) const;

 private:
  struct WaitingPair {
    Pair pair;
    uint32_t owner;
    float reach;
    float least_separation;
  };

  void put_pair(Pair pair, size_t owner, float reach) {
    reach_[count_] = reach;
    owner_[count_] = static_cast<uint32_t>(owner);
    pairs_[count_++] = pair;
  }

  void put_waiting(Pair pair, size_t owner, float reach, float least_separation) {
    waiting_[waiting_count_++] = {pair, static_cast<uint32_t>(owner), reach, least_separation};
  }

  // Runs the pairs from the first that is not tested.
  void run_from(const std::array<PartColumns, 2>& sides, const PartTests& tests, Detail detail,
                const ResultColumns& out) const;
  void prove(const ResultColumns& tested);
  void write_corners(Pair pair);
  std::array<float, 3> origin_of(const PlacedPart& part, const PlacedPart& other) const;
  // The pair with both parts, which are added.
  Pair put_parts(size_t owner, const PlacedPart& a, const PlacedPart& b, bool counts_near);

  PartTests tests_;
  size_t count_ = 0, tested_ = 0, tested_before_ = 0, waiting_count_ = 0;
  std::array<PartColumns, 2> sides_;
  // The same bodies for proofs, which are about triangles as they are made. Kept for the next ones.
  bool proves_ = false;
  std::unique_ptr<std::array<PartColumns, 2>> as_made_;
  std::array<uint8_t, kPairsPerBlock> proven_;
  std::array<Pair, kPairsPerBlock> pairs_;
  std::array<uint32_t, kPairsPerBlock> owner_;
  std::array<float, kPairsPerBlock> reach_;
  std::array<WaitingPair, kPairsPerBlock> waiting_;
  ColumnMemory<kPairsPerBlock, ColumnRole::test, ColumnRole::manifold, ColumnRole::bound> memory_;
  const ResultColumns results_ = memory_.columns();
};

template <class IsKnown, class MayMatter>
void PartBatch::admit_waiting(const IsKnown& is_known, const MayMatter& may_matter) {
  size_t kept = 0;
  for (size_t begin = 0, end = 0; begin < waiting_count_; begin = end) {
    const uint32_t owner = waiting_[begin].owner;
    size_t least = begin;
    float lowest =
        waiting_[begin].least_separation;  // not by its place: each would wait for the last
    for (; end < waiting_count_ && waiting_[end].owner == owner; ++end) {
      const float own = waiting_[end].least_separation;
      least = own < lowest ? end : least;
      lowest = own < lowest ? own : lowest;
    }
    const bool all = is_known(owner);
    for (size_t i = begin; i < end; ++i) {
      const WaitingPair waiting = waiting_[i];
      if (all ? may_matter(owner, waiting.least_separation) : i == least) {
        write_corners(waiting.pair);
        put_pair(waiting.pair, owner, waiting.reach);
      } else if (!all) {
        waiting_[kept++] = waiting;
      }
    }
  }
  waiting_count_ = kept;
}

}  // namespace carom
