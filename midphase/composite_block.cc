#include "midphase/composite_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "midphase/body_pair.h"
#include "midphase/composite_results.h"
#include "midphase/contact_runs.h"
#include "midphase/outcome.h"
#include "midphase/part_batch.h"
#include "midphase/part_search.h"
#include "narrowphase/manifolds/merge.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

std::array<float, 3> at_row(const std::array<float*, 3>& columns, size_t row) {
  return {columns[0][row], columns[1][row], columns[2][row]};
}

// Moves a point relative to a part's position to one relative to its body's.
std::array<float, 3> moved(const std::array<float, 3>& point, const Double3& arm) {
  return {static_cast<float>(point[0] + arm[0]), static_cast<float>(point[1] + arm[1]),
          static_cast<float>(point[2] + arm[2])};
}

// The working memory of one thread.
struct CompositeScratch {
  PartBatch batch, again;
  std::array<Outcome, kPairsPerBlock> outcomes;
  ContactRuns contacts;
  RegionMerger merger;
  std::array<uint16_t, kPairsPerBlock> to_measure;
};

// Pairs of parts need their depth even where bodies do not: the deepest overlapping parts are
// reported.
Measured of_parts(Measured measured) {
  return measured == Measured::overlapping ? measured : Measured::all;
}

// Says whether bodies are valid. Pairs are sorted, so that it is mostly asked about the last one.
class ValidBodies {
 public:
  explicit ValidBodies(const BodyReader& reader) : reader_(reader) {}

  bool has(uint32_t body) {
    if (body != last_) is_valid_ = reader_.is_valid(body);
    last_ = body;
    return is_valid_;
  }

 private:
  const BodyReader& reader_;
  uint32_t last_ = 0xffffffffu;
  bool is_valid_ = false;
};

class CompositeRun {
 public:
  CompositeRun(const PairBlock& block, std::span<const uint16_t> rows, const ExtraRequest& extra,
               CompositeScratch& scratch)
      : block_(block),
        a_{block.a},
        b_{block.b},
        rows_(rows),
        tests_{.manifolds = has_manifolds(block.detail),
               .bounds = block.out.separation_bound != nullptr,
               .reach = block.reach != nullptr,
               .measured = of_parts(block.measured),
               .tier = block.accuracy.tier},
        slack_(has_proofs(block.accuracy.tier) ? 0 : block.accuracy.tolerance),
        batch_(scratch.batch),
        again_(scratch.again),
        outcomes_(scratch.outcomes),
        contacts_(scratch.contacts),
        results_(block, extra, scratch.merger),
        to_measure_(scratch.to_measure) {
    batch_.begin(tests_);
    again_.begin(tests_);
    contacts_.clear();
  }

  void run() {
    const bool measures =
        tests_.measured == Measured::all && (has_contacts(block_.detail) || tests_.bounds);
    const Apart apart = measures ? Apart::by_boxes : Apart::by_planes;
    ValidBodies valid_a(a_), valid_b(b_);
    for (current_ = 0; current_ < rows_.size(); ++current_) {
      const Pair p = pair(current_);
      outcomes_[current_] = valid_a.has(p.a) && valid_b.has(p.b) ? Outcome{} : no_answer();
      if (outcomes_[current_].is_invalid()) continue;
      if (slack(current_) > 0) flush();
      search(current_, reach(current_), apart);
    }
    flush();
    if (measures) measure();
  }

 private:
  Pair pair(size_t k) const {
    const size_t row = rows_[k];
    if (block_.pairs) return block_.pairs[row];
    const auto index = static_cast<uint32_t>(block_.first + row);
    return {index, index};
  }

  float reach(size_t k) const { return block_.reach ? block_.reach[rows_[k]] : 0; }

  // Whether pair k gets a contact from parts with this result.
  bool is_contact(size_t k, uint8_t overlap, float separation) const {
    return overlap == 1 || (tests_.reach && overlap == 0 && separation <= reach(k));
  }

  void search(size_t k, double reach, Apart apart) {
    const BodyPair bodies(a_, b_, pair(k));
    const PartsWanted wanted = {reach, apart, may_skip()};
    find_part_pairs(bodies.a, bodies.b, wanted, [&](const NearParts& parts) {
      add(k, parts);
      return has_deep_face(k) && may_skip() ? outcomes_[k].separation - slack(k) : reach;
    });
  }

  // By so much a part may be deeper than the one that is reported. What is left out then depends on
  // what was tested before. Two meshes begin with an empty batch, so that it is their own
  // triangles.
  float slack(size_t k) const { return are_meshes(k) ? slack_ : 0; }

  bool are_meshes(size_t k) const {
    return a_.kind(pair(k).a) == ShapeKind::mesh && b_.kind(pair(k).b) == ShapeKind::mesh;
  }

  void add(size_t k, const NearParts& parts) {
    outcomes_[k].holds_nearest |= parts.hold_nearest;
    if (!parts.triangles.empty()) return add_triangles(k, parts);
    if (!parts.pairs.empty()) return add_triangle_pairs(k, parts);
    if (!find_pair_kind(parts.a.kind(), parts.b.kind()).exists()) return;
    if (batch_.is_full()) flush();
    const float least =
        may_skip() ? least_separation(parts.a, parts.b) : -std::numeric_limits<float>::infinity();
    std::isinf(least) ? batch_.add(k, parts.a, parts.b, reach(k))
                      : batch_.add_waiting(k, parts.a, parts.b, reach(k), least);
  }

  // Where all contacts count, or their bounds, no part may be skipped.
  bool may_skip() const { return !tests_.manifolds && !tests_.bounds; }

  // Every kind has a kernel with triangles.
  void add_triangles(size_t k, const NearParts& parts) {
    std::span<const float> least = may_skip() ? parts.least_separations : std::span<const float>();
    for (std::span<const uint32_t> left = parts.triangles; !left.empty();) {
      if (batch_.is_full()) flush();
      const size_t count = std::min(left.size(), batch_.room());
      const size_t bounded = std::min(count, least.size());
      batch_.add_triangles(k, {parts.a, parts.b, left.first(count), {}, least.first(bounded)},
                           reach(k));
      left = left.subspan(count);
      least = least.subspan(bounded);
    }
  }

  // Many are tested at once, since how deep they are spares most others.
  void add_triangle_pairs(size_t k, const NearParts& parts) {
    constexpr size_t kMany = 8;
    std::span<const float> least = may_skip() ? parts.least_separations : std::span<const float>();
    const bool are_many = least.size() >= kMany;
    for (std::span<const ItemPair> left = parts.pairs; !left.empty();) {
      if (batch_.is_full()) flush();
      const size_t count = std::min(left.size(), batch_.room());
      const size_t bounded = std::min(count, least.size());
      batch_.add_triangle_pairs(k, {parts.a, parts.b, {}, left.first(count), least.first(bounded)},
                                reach(k));
      left = left.subspan(count);
      least = least.subspan(bounded);
    }
    if (are_many) flush();
  }

  // Tests the waiting pairs of parts. All pairs of bodies before the current one are then complete.
  void flush() {
    run_batch();
    for (size_t k = first_open_; k < current_; ++k) {
      if (!outcomes_[k].is_over_edge()) write(k);
    }
    write_over_edges(first_open_, current_);
    first_open_ = current_;
    contacts_.forget_before(current_);
  }

  // Parts that cannot be the deepest wait until it is known how deep another one is.
  void run_batch() {
    constexpr size_t kTriesOfOne = 3;  // more would leave vectors empty
    test_and_merge();
    for (size_t tries = 0; batch_.has_waiting(); ++tries) {
      const auto admits_all = [&](size_t k) { return tries == kTriesOfOne || has_bound(k); };
      const auto may_be_best = [&](size_t k, float least_separation) {
        return !has_bound(k) || least_separation <= outcomes_[k].separation - slack(k);
      };
      batch_.admit_waiting(admits_all, may_be_best);
      test_and_merge();
    }
    batch_.clear();
  }

  // Whether pair k has a contact that only deeper ones replace.
  bool has_deep_face(size_t k) const {
    return outcomes_[k].overlap == 1 && !outcomes_[k].is_over_edge();
  }

  // Whether only parts that are deeper, or nearer, than those of pair k so far still matter. A
  // proof may call parts undecided that are further apart.
  bool has_bound(size_t k) const {
    const Outcome& o = outcomes_[k];
    const bool is_distance = o.holds_nearest && o.is_found && o.overlap == 0;
    return has_deep_face(k) || (is_distance && !has_proofs(tests_.tier));
  }

  void test_and_merge() {
    batch_.run();
    for (size_t begin = batch_.tested_before(); begin < batch_.count();) {
      size_t end = begin + 1;
      while (end < batch_.count() && batch_.owner(end) == batch_.owner(begin)) ++end;
      merge(begin, end);
      begin = end;
    }
  }

  // Merges the deepest pair of parts first, since that leaves less to compute for the others.
  void merge(size_t begin, size_t end) {
    const ResultColumns& out = batch_.results();
    size_t first = begin;
    for (size_t i = begin + 1; i < end; ++i) {
      if (out.separation[i] < out.separation[first]) first = i;
    }
    merge(first);
    for (size_t i = begin; i < end; ++i) {
      if (i != first) merge(i);
    }
  }

  void merge(size_t i) {
    const ResultColumns& out = batch_.results();
    const size_t k = batch_.owner(i);
    Outcome& best = outcomes_[k];
    const bool touches = is_contact(k, out.overlap[i], out.separation[i]);
    if (best.overlap == 1 && out.overlap[i] == 0 && !touches && !tests_.bounds) return;
    Finding found{out.overlap[i], {}, out.separation[i], batch_.orders(i)};
    // A finding that is not the best in any case need not know over which edge it came.
    const bool may_be_best = !best.is_found || found.is_before(best);
    if (!may_be_best && !tests_.manifolds && !tests_.bounds) return;
    std::array<uint8_t, 2> edges{};
    if (touches) edges = batch_.edges_to_close(i);
    if (found.overlap == 1) found.edges_to_close = edges;
    const bool is_best = may_be_best && (!best.is_found || found.is_before(best));
    if (tests_.bounds) keep_bound(i, found, is_best, best);
    if (is_best) {
      static_cast<Finding&>(best) = found;
      best.is_found = true;
      if (found.overlap != 0 || touches || tests_.measured == Measured::all) {
        set_contact(batch_, i, best);
      } else {
        best.status = out.status[i];
      }
    }
    if (tests_.manifolds && touches) {
      contacts_.add(k, contact_of(batch_, i, found.parts, edges[0] != 0 || edges[1] != 0));
    }
  }

  // Must run before `best` is replaced.
  void keep_bound(size_t i, const Finding& found, bool is_best, Outcome& best) const {
    const float bound = batch_.results().separation_bound[i];
    const bool is_alike = found.is_over_edge() == best.is_over_edge();
    const double others = best.is_found && is_alike ? best.nearest : HUGE_VAL;
    if (is_best) best.bound = bound;
    if (is_best || is_alike) best.nearest = std::min(double{found.separation} - bound, others);
  }

  static void set_contact(const PartBatch& batch, size_t i, Outcome& outcome) {
    const ResultColumns& out = batch.results();
    outcome.status = out.status[i];
    outcome.separation = out.separation[i];
    outcome.normal = at_row(out.normal, i);
    outcome.arm_a = moved(at_row(out.point_a, i), batch.arm_a(i));
    outcome.arm_b = moved(at_row(out.point_b, i), batch.arm_b(i));
  }

  static PartContact contact_of(const PartBatch& batch, size_t i,
                                const std::array<uint64_t, 2>& parts, bool is_over_edge) {
    const ResultColumns& out = batch.results();
    PartContact contact{.parts = parts,
                        .normal = at_row(out.normal, i),
                        .separation = out.separation[i],
                        .arm_a = moved(at_row(out.point_a, i), batch.arm_a(i)),
                        .arm_b = moved(at_row(out.point_b, i), batch.arm_b(i)),
                        .status = out.status[i],
                        .is_over_edge = is_over_edge,
                        .count = out.manifold_count[i],
                        .points = out.manifold[i]};
    for (size_t k = 0; k < contact.count; ++k) {
      contact.points.point[k] = moved(contact.points.point[k], batch.arm_a(i));
    }
    return contact;
  }

  // Tests pairs of [begin, end) again if all their contacts are over inner edges, with such
  // directions forbidden. It does not change the decision that they overlap.
  void write_over_edges(size_t begin, size_t end) {
    again_.clear();
    for (size_t k = begin; k < end; ++k) {
      const Outcome& o = outcomes_[k];
      if (!o.is_over_edge()) continue;
      const BodyPair bodies(a_, b_, pair(k));
      again_.add(k, part_at(bodies.a, o.parts[0]), part_at(bodies.b, o.parts[1]), reach(k),
                 o.edges_to_close);
    }
    again_.run();
    for (size_t i = 0; i < again_.count(); ++i) {
      const size_t k = again_.owner(i);
      Outcome& o = outcomes_[k];
      PartContact contact{.parts = o.parts,
                          .normal = o.normal,
                          .separation = o.separation,
                          .arm_a = o.arm_a,
                          .arm_b = o.arm_b,
                          .status = o.status,
                          .is_over_edge = false,
                          .count = 1,
                          .points = {}};
      contact.points.point[0] = o.arm_a;
      contact.points.separation[0] = o.separation;
      if (again_.results().overlap[i] == 1) {
        set_contact(again_, i, o);
        if (tests_.manifolds) contact = contact_of(again_, i, o.parts, false);
      }
      for (PartContact& each : contacts_.of(k)) {
        if (each.parts == contact.parts) each = contact;
      }
      write(k);
    }
  }

  // Measures the separation of pairs whose parts do not overlap. The separation of one near pair of
  // parts is an upper bound, which limits the search.
  void measure() {
    size_t count = 0;
    for (size_t k = 0; k < rows_.size(); ++k) {
      const Outcome& o = outcomes_[k];
      const bool is_known =
          o.is_invalid() ||
          (o.is_found && (o.holds_nearest || is_contact(k, o.overlap, o.separation)));
      if (!is_known && o.overlap != 1) to_measure_[count++] = static_cast<uint16_t>(k);
    }
    const std::span<const uint16_t> to_measure = std::span(to_measure_).first(count);
    for (const size_t k : to_measure) {
      if (outcomes_[k].is_found) continue;
      const BodyPair bodies(a_, b_, pair(k));
      find_near_part_pair(bodies.a, bodies.b, [&](const NearParts& parts) {
        add(k, parts);
        return 0.0;
      });
    }
    run_batch();
    for (const size_t k : to_measure) {
      const float reach = std::max(outcomes_[k].separation, 0.0f);
      outcomes_[k] = {};
      search(k, reach, Apart::by_planes);
    }
    run_batch();
    contacts_.clear();
    for (const size_t k : to_measure) write(k);
  }

  void write(size_t k) {
    const Outcome& o = outcomes_[k];
    results_.write({.row = rows_[k],
                    .pair = pair(k),
                    .outcome = o,
                    .is_contact = is_contact(k, o.overlap, o.separation),
                    .contacts = contacts_.of(k),
                    .dropped = contacts_.dropped(k)});
  }

  const PairBlock& block_;
  const BodyReader a_, b_;
  const std::span<const uint16_t> rows_;
  const PartTests tests_;
  const float slack_;  // what the tolerance leaves two meshes
  PartBatch& batch_;
  PartBatch& again_;  // pairs to test again without inner edges
  std::array<Outcome, kPairsPerBlock>& outcomes_;
  ContactRuns& contacts_;
  CompositeResults results_;
  std::array<uint16_t, kPairsPerBlock>& to_measure_;
  size_t current_ = 0;
  size_t first_open_ = 0;
};

}  // namespace

void run_composite_pairs(const PairBlock& block, std::span<const uint16_t> rows,
                         const ExtraRequest& extra) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<CompositeScratch>();
  CompositeRun(block, rows, extra, *scratch).run();
}

}  // namespace carom
