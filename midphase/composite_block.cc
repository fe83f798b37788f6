#include "midphase/composite_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "midphase/contact_runs.h"
#include "midphase/part_batch.h"
#include "midphase/part_search.h"
#include "narrowphase/batch/world_point.h"
#include "narrowphase/manifolds/merge.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Two placed bodies.
struct BodyPair {
  Part part_a, part_b;
  PlacedPart a, b;

  // Positions are in world coordinates. If there is a compound, they are relative to A, since
  // children are placed in double precision.
  BodyPair(const BodyReader& reader_a, const BodyReader& reader_b, Pair pair)
      : part_a(body_part(reader_a, pair.a)),
        part_b(body_part(reader_b, pair.b)),
        a(part_a, position(reader_a, pair.a)),
        b(part_b, position(reader_b, pair.b)) {
    if (part_a.kind != ShapeKind::compound && part_b.kind != ShapeKind::compound) return;
    b.position = minus(b.position, a.position);
    a.position = {};
  }
  BodyPair(const BodyPair&) = delete;
  BodyPair& operator=(const BodyPair&) = delete;

 private:
  static Double3 position(const BodyReader& reader, size_t i) {
    const Position<double> p = reader.position<double>(i);
    return {p.x, p.y, p.z};
  }
};

// A pair of parts that may be the one to report, and how it overlaps.
struct Finding {
  uint8_t overlap = 0;
  std::array<uint8_t, 2> edges_to_close{};  // inner edges of triangles over which the contact came
  float separation = kInfinity;
  std::array<uint64_t, 2> parts{};

  bool is_over_edge() const { return edges_to_close[0] != 0 || edges_to_close[1] != 0; }

  // Orders overlapping pairs before undecided ones before separate ones. Contacts that came over an
  // inner edge go last, since the neighbouring triangle has the correct normal.
  bool is_before(const Finding& other) const {
    const auto order = [](const Finding& f) {
      const int rank = f.overlap == 1 ? 0 : f.overlap == kUndecided ? 1 : 2;
      return std::tuple(rank, f.is_over_edge(), f.separation, f.parts);
    };
    return order(*this) < order(other);
  }
};

// The result of a pair of bodies so far: that of the deepest pair of parts.
struct Outcome : Finding {
  uint8_t status = static_cast<uint8_t>(Status::ok);
  bool is_found = false;
  std::array<float, 3> normal = {kNan, kNan, kNan};
  std::array<float, 3> arm_a = {kNan, kNan, kNan};
  std::array<float, 3> arm_b = {kNan, kNan, kNan};
  float bound = 0;
  double nearest = HUGE_VAL;  // a lower bound of the true separation

  bool is_invalid() const { return status == static_cast<uint8_t>(Status::invalid); }
};

Outcome no_answer() {
  Outcome outcome;
  outcome.status = static_cast<uint8_t>(Status::invalid);
  outcome.separation = outcome.bound = kNan;
  return outcome;
}

std::array<float, 3> at_row(const std::array<float*, 3>& columns, size_t row) {
  return {columns[0][row], columns[1][row], columns[2][row]};
}

void set_row(const std::array<float*, 3>& columns, size_t row, const std::array<float, 3>& value) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (columns[axis]) columns[axis][row] = value[axis];
  }
}

template <class T>
void set_row(T* column, size_t row, const T& value) {
  if (column) column[row] = value;
}

// Moves a point relative to a part's position to one relative to its body's.
std::array<float, 3> moved(const std::array<float, 3>& point, const Double3& arm) {
  return {static_cast<float>(point[0] + arm[0]), static_cast<float>(point[1] + arm[1]),
          static_cast<float>(point[2] + arm[2])};
}

float rounded_up(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, HUGE_VALF) : rounded;
}

// The working memory of one thread.
struct CompositeScratch {
  PartBatch batch, again;
  std::array<Outcome, kPairsPerBlock> outcomes;
  ContactRuns contacts;
  std::vector<merging::SeenPoint> seen;
  std::array<uint16_t, kPairsPerBlock> to_measure;
};

// Pairs of parts need their depth even where bodies do not: the deepest overlapping parts are
// reported.
Measured of_parts(Measured measured) {
  return measured == Measured::overlapping ? measured : Measured::all;
}

class CompositeRun {
 public:
  CompositeRun(const PairBlock& block, std::span<const uint16_t> rows, CompositeScratch& scratch)
      : block_(block),
        a_{block.a},
        b_{block.b},
        rows_(rows),
        tests_{.manifolds = block.detail == Detail::manifold,
               .bounds = block.out.separation_bound != nullptr,
               .measured = of_parts(block.measured),
               .accuracy = block.accuracy},
        batch_(scratch.batch),
        again_(scratch.again),
        outcomes_(scratch.outcomes),
        contacts_(scratch.contacts),
        seen_(scratch.seen),
        to_measure_(scratch.to_measure) {
    batch_.clear();
    contacts_.clear();
  }

  void run() {
    for (current_ = 0; current_ < rows_.size(); ++current_) {
      outcomes_[current_] = is_valid(pair(current_)) ? Outcome{} : no_answer();
      if (!outcomes_[current_].is_invalid()) search(current_, 0);
    }
    flush();
    const bool is_asked = has_contacts(block_.detail) || tests_.bounds;
    if (tests_.measured == Measured::all && is_asked) measure();
  }

 private:
  Pair pair(size_t k) const {
    const size_t row = rows_[k];
    if (block_.pairs) return block_.pairs[row];
    const auto index = static_cast<uint32_t>(block_.first + row);
    return {index, index};
  }

  bool is_valid(Pair p) const { return a_.is_valid(p.a) && b_.is_valid(p.b); }

  void search(size_t k, double reach) {
    const BodyPair bodies(a_, b_, pair(k));
    find_part_pairs(bodies.a, bodies.b, reach,
                    [&](const PlacedPart& a, const PlacedPart& b) { add(k, a, b); });
  }

  void add(size_t k, const PlacedPart& a, const PlacedPart& b) {
    if (!find_pair_kind(a.kind(), b.kind()).exists()) return;
    if (batch_.is_full()) flush();
    batch_.add(k, a, b);
  }

  // Tests the waiting pairs of parts. All pairs of bodies before the current one are then complete.
  void flush() {
    run_batch();
    for (size_t k = first_open_; k < current_; ++k) {
      if (!outcomes_[k].is_over_edge()) write(k, contacts_.of(k));
    }
    write_over_edges(first_open_, current_);
    first_open_ = current_;
    contacts_.forget_before(current_);
  }

  void run_batch() {
    batch_.run(tests_);
    for (size_t begin = 0; begin < batch_.count();) {
      size_t end = begin + 1;
      while (end < batch_.count() && batch_.owner(end) == batch_.owner(begin)) ++end;
      merge(begin, end);
      begin = end;
    }
    batch_.clear();
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
    if (best.overlap == 1 && out.overlap[i] == 0 && !tests_.bounds) return;
    Finding found{out.overlap[i], {}, out.separation[i], batch_.orders(i)};
    // A finding that is not the best in any case need not know over which edge it came.
    const bool may_be_best = !best.is_found || found.is_before(best);
    if (!may_be_best && !tests_.manifolds && !tests_.bounds) return;
    if (found.overlap == 1) found.edges_to_close = batch_.edges_to_close(i);
    const bool is_best = may_be_best && (!best.is_found || found.is_before(best));
    if (tests_.bounds) keep_bound(i, found, is_best, best);
    if (is_best) {
      static_cast<Finding&>(best) = found;
      best.is_found = true;
      if (found.overlap != 0 || tests_.measured == Measured::all) {
        set_contact(batch_, i, best);
      } else {
        best.status = out.status[i];
      }
    }
    if (tests_.manifolds && found.overlap == 1) contacts_.add(k, contact_of(batch_, i, found));
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

  static PartContact contact_of(const PartBatch& batch, size_t i, const Finding& found) {
    const ResultColumns& out = batch.results();
    PartContact contact{found.parts,           at_row(out.normal, i), found.separation,
                        out.manifold_count[i], out.manifold[i],       found.is_over_edge()};
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
      again_.add(k, part_at(bodies.a, o.parts[0]), part_at(bodies.b, o.parts[1]), o.edges_to_close);
    }
    again_.run(tests_);
    for (size_t i = 0; i < again_.count(); ++i) {
      const size_t k = again_.owner(i);
      Outcome& o = outcomes_[k];
      PartContact contact{o.parts, o.normal, o.separation, 1, {}, false};
      contact.points.point[0] = o.arm_a;
      contact.points.separation[0] = o.separation;
      if (again_.results().overlap[i] == 1) {
        set_contact(again_, i, o);
        if (tests_.manifolds) contact = contact_of(again_, i, o);
        contact.is_over_edge = false;
      }
      write(k, replaced(contacts_.of(k), contact));
    }
  }

  // Replaces the contact of the same parts among the contacts of a pair.
  static std::span<PartContact> replaced(std::span<PartContact> contacts,
                                         const PartContact& contact) {
    for (PartContact& each : contacts) {
      if (each.parts == contact.parts) each = contact;
    }
    return contacts;
  }

  static PlacedPart part_at(const PlacedPart& body, uint64_t part) {
    PlacedPart result = body;
    if (result.kind() == ShapeKind::compound) result = result.item(uint32_t(part >> 32));
    if (result.kind() == ShapeKind::mesh) result = result.item(uint32_t(part));
    return result;
  }

  // Measures the separation of pairs whose parts do not overlap. The separation of one near pair of
  // parts is an upper bound, which limits the search.
  void measure() {
    size_t count = 0;
    for (size_t k = 0; k < rows_.size(); ++k) {
      const Outcome& o = outcomes_[k];
      if (!o.is_invalid() && o.overlap != 1) to_measure_[count++] = static_cast<uint16_t>(k);
    }
    const std::span<const uint16_t> to_measure = std::span(to_measure_).first(count);
    for (const size_t k : to_measure) {
      if (outcomes_[k].is_found) continue;
      const BodyPair bodies(a_, b_, pair(k));
      find_near_part_pair(bodies.a, bodies.b,
                          [&](const PlacedPart& a, const PlacedPart& b) { add(k, a, b); });
    }
    run_batch();
    for (const size_t k : to_measure) {
      const float reach = std::max(outcomes_[k].separation, 0.0f);
      outcomes_[k] = {};
      search(k, reach);
    }
    run_batch();
    contacts_.clear();
    for (const size_t k : to_measure) write(k, {});
  }

  // `contacts`: those of the pair's parts, at detail manifold.
  void write(size_t k, std::span<PartContact> contacts) {
    const size_t row = rows_[k];
    const Pair p = pair(k);
    const Outcome& o = outcomes_[k];
    const ResultColumns& out = block_.out;
    set_row(out.overlap, row, o.overlap);
    set_row(out.status, row, o.status);
    set_row(out.separation_bound, row, bound_of(o));
    if (!has_contacts(block_.detail)) return;
    set_row(out.separation, row, o.separation);
    set_row(out.normal, row, o.normal);
    set_row(out.point_a, row, in_frame(a_, p.a, o.arm_a));
    set_row(out.point_b, row, in_frame(b_, p.b, o.arm_b));
    set_row(out.sub_a, row, sub_shape(a_.kind(p.a), o.parts[0]));
    set_row(out.sub_b, row, sub_shape(b_.kind(p.b), o.parts[1]));
    if (block_.detail == Detail::manifold) write_manifold(k, contacts);
  }

  void write_manifold(size_t k, std::span<PartContact> contacts) {
    const size_t row = rows_[k];
    MergedManifold manifold = merged_manifold(contacts, seen_);
    for (size_t i = 0; i < manifold.count; ++i) {
      std::array<float, 3>& point = manifold.points.point[i];
      point = in_frame(a_, pair(k).a, point);
    }
    set_row(block_.out.manifold_count, row, manifold.count);
    set_row(block_.out.manifold, row, manifold.points);
  }

  std::array<float, 3> in_frame(const BodyReader& reader, size_t body,
                                const std::array<float, 3>& arm) const {
    return block_.frame == WitnessFrame::body ? arm : world_point(reader, body, arm);
  }

  static uint32_t sub_shape(ShapeKind kind, uint64_t part) {
    return static_cast<uint32_t>(kind == ShapeKind::compound ? part >> 32 : part);
  }

  // The true deepest pair of parts may be another one, deeper than the reported one by the rounding
  // of its test.
  static float bound_of(const Outcome& o) {
    const double deeper = double{o.separation} - o.nearest;
    return rounded_up(std::isfinite(deeper) ? std::max(double{o.bound}, deeper) : o.bound);
  }

  const PairBlock& block_;
  const BodyReader a_, b_;
  const std::span<const uint16_t> rows_;
  const PartTests tests_;
  PartBatch& batch_;
  PartBatch& again_;  // pairs to test again without inner edges
  std::array<Outcome, kPairsPerBlock>& outcomes_;
  ContactRuns& contacts_;
  std::vector<merging::SeenPoint>& seen_;
  std::array<uint16_t, kPairsPerBlock>& to_measure_;
  size_t current_ = 0;
  size_t first_open_ = 0;
};

}  // namespace

void run_composite_pairs(const PairBlock& block, std::span<const uint16_t> rows) {
  static thread_local const auto scratch = std::make_unique<CompositeScratch>();
  CompositeRun(block, rows, *scratch).run();
}

}  // namespace carom
