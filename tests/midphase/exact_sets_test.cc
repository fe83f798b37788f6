// Generated meshes and compounds against exact answers: the oracle, over all pairs of parts.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/midphase/exact_sets.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Number = long double;

// In units of L + gap: the standard tier decides right beyond this distance from touching.
constexpr Number kDecisions = 4 * 0x1p-23L;
// In units of L: the error of any separation, and of 99.9 % of them.
constexpr Number kWorst = 1e-5L;
constexpr Number kUsual = 1e-6L;
// In units of L. Kernels place children in double precision, the oracle places them exactly: a
// decision closer to touching than this is about another pose. No pair comes near it.
constexpr Number kPlacing = 0x1p-44L;

// Errors of separations, in units of L.
class Errors {
 public:
  void add(Number error) { all_.push_back(std::fabs(error)); }
  size_t count() const { return all_.size(); }
  Number worst() const { return share(1); }
  // The error that the share `part` of all errors does not exceed.
  Number share(double part) const {
    if (all_.empty()) return 0;
    std::vector<Number> sorted = all_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<size_t>(std::ceil(part * double(sorted.size()))) - 1];
  }

 private:
  std::vector<Number> all_;
};

struct Figures {
  size_t pairs = 0;
  size_t overlapping = 0;
  size_t undecided_by_floats = 0;  // pairs that the standard tier decides wrong, within its bound
  size_t undecided = 0;            // pairs that the certified tier leaves undecided
  size_t passed_over = 0;          // overlapping pairs whose deepest parts meet over an inner edge
  // Overlapping pairs of which all parts meet over inner edges, or may.
  size_t over_edges = 0;
  // Other overlapping pairs where rounding decides whether the deepest parts meet over an inner
  // edge.
  size_t unclear = 0;
  Errors separate, depths;
};

class Checks {
 public:
  Checks(const ExactPair& pair, const Row& row, const SubShapes& subs, Figures& figures)
      : pair_(pair), row_(row), subs_(subs), figures_(figures), scale_(pair.oracle.scale()) {}

  void run() {
    const Number exact = pair_.exact.all;
    const bool overlaps = exact <= 0;
    ++figures_.pairs;
    figures_.overlapping += overlaps;
    EXPECT_EQ(row_.overlap == 1, row_.separation <= 0);
    if ((row_.overlap == 1) != overlaps) {
      ++figures_.undecided_by_floats;
      EXPECT_LE(std::fabs(exact), kDecisions * (scale_ + std::fabs(exact)));
    } else if (overlaps) {
      check_depth();
    } else {
      check_gap();
    }
  }

 private:
  void check_gap() {
    const Number error = (row_.separation - pair_.exact.all) / scale_;
    figures_.separate.add(error);
    EXPECT_LE(std::fabs(error), kWorst) << row_.separation << " for " << pair_.exact.all;
    EXPECT_LE(named().all - pair_.exact.all, kWorst * scale_);
  }

  // The separation is that of the deepest pair of parts that does not meet over an inner edge, if
  // there is one. Where several penetration directions are about equally short, it is unclear
  // whether a pair meets over one; such pairs may count or not.
  void check_depth() {
    const ExactSeparations& exact = pair_.exact;
    const Number slack = kWorst * scale_;
    if (exact.open == exact.not_closed && (exact.open < -slack || exact.open == exact.all)) {
      figures_.depths.add((row_.separation - exact.open) / scale_);
      figures_.passed_over += exact.open > exact.all + slack;
      EXPECT_LE(std::fabs(row_.separation - exact.open), slack);
      EXPECT_LE(named().not_closed, exact.open + slack);
    } else if (exact.open < -slack) {
      ++figures_.unclear;
      EXPECT_LE(row_.separation, exact.open + slack);
      EXPECT_GE(row_.separation, exact.not_closed - slack);
      EXPECT_LE(named().not_closed, row_.separation + slack);
    } else {
      check_depth_over_edges();
    }
  }

  // If all parts meet over inner edges, the separation is that of the deepest pair or deeper, since
  // its penetration direction may not be allowed.
  void check_depth_over_edges() {
    const Number slack = kWorst * scale_;
    ++figures_.over_edges;
    EXPECT_LE(row_.separation, named().all + slack);
    if (pair_.exact.not_closed > slack) {
      EXPECT_LE(named().all, pair_.exact.all + slack);
    }
  }

  ExactSeparations named() const { return pair_.oracle.separations(subs_[0], subs_[1]); }

  const ExactPair& pair_;
  const Row& row_;
  const SubShapes subs_;
  Figures& figures_;
  const Number scale_;
};

std::vector<TestPair> pairs_of(const std::vector<ExactPair>& set) {
  std::vector<TestPair> pairs;
  for (const ExactPair& each : set) pairs.push_back(each.pair);
  return pairs;
}

// The same on every ISA, and when only the decision is asked for.
void check_same(const std::vector<TestPair>& pairs, const Call& call, const std::vector<Row>& rows,
                const std::vector<SubShapes>& subs) {
  Call decisions = call;
  decisions.detail = Detail::overlap;
  for_each_isa([&] {
    EXPECT_TRUE(same_rows(rows, run_rows(pairs, call), pairs));
    EXPECT_EQ(subs, run_sub_shapes(pairs, call));
    const std::vector<Row> decided = run_rows(pairs, decisions);
    for (size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(decided[i].overlap, rows[i].overlap) << i;
  });
}

void check_standard(const std::vector<ExactPair>& set, Figures& figures) {
  const std::vector<TestPair> pairs = pairs_of(set);
  const Call call = call_with(PositionType::float64);
  const std::vector<Row> rows = run_rows(pairs, call);
  const std::vector<SubShapes> subs = run_sub_shapes(pairs, call);
  for (size_t i = 0; i < set.size(); ++i) {
    const ShownIfFailed shown([&] { return "pair " + std::to_string(i) + "\n" + show(pairs[i]); });
    Checks(set[i], rows[i], subs[i], figures).run();
  }
  check_same(pairs, call, rows, subs);
}

void check_proven(const std::vector<ExactPair>& set, Tier tier, Figures& figures) {
  const std::vector<TestPair> pairs = pairs_of(set);
  Call call = call_with(PositionType::float64);
  call.accuracy.tier = tier;
  const std::vector<Row> rows = run_rows(pairs, call);
  for (size_t i = 0; i < set.size(); ++i) {
    const ShownIfFailed shown([&] { return "pair " + std::to_string(i) + "\n" + show(pairs[i]); });
    const Number exact = set[i].exact.all;
    EXPECT_GT(std::fabs(exact), kPlacing * set[i].oracle.scale());
    if (tier == Tier::certified && rows[i].overlap == kUndecided) {
      ++figures.undecided;
      continue;
    }
    EXPECT_EQ(rows[i].overlap, exact <= 0 ? 1 : 0) << exact;
    EXPECT_EQ(rows[i].separation <= 0, exact <= 0);
  }
  check_same(pairs, call, rows, run_sub_shapes(pairs, call));
}

void check_kinds(ShapeKind a, ShapeKind b, uint64_t seed, Figures& figures) {
  SCOPED_TRACE(std::string(name(a)) + "_" + name(b));
  ExactSets sets(seed);
  std::vector<ExactPair> set;
  for (uint32_t i = 0; i < rounds(300, 37); ++i) set.push_back(sets.next(a, b));
  const auto hits = std::count_if(set.begin(), set.end(),
                                  [](const ExactPair& each) { return each.exact.all <= 0; });
  EXPECT_GE(10 * size_t(hits), 3 * set.size());
  EXPECT_LE(10 * size_t(hits), 7 * set.size());
  check_standard(set, figures);
  check_proven(set, Tier::certified, figures);
  check_proven(set, Tier::exact, figures);
}

void print(const Figures& figures) {
  const auto print_errors = [](const char* what, const Errors& errors) {
    std::cout << what << ": " << errors.count() << " pairs, error at most "
              << double(errors.worst()) << " L, 99.9 % " << double(errors.share(0.999)) << " L\n";
  };
  std::cout << figures.pairs << " pairs, " << figures.overlapping << " of them overlap\n";
  print_errors("separate", figures.separate);
  print_errors("depths", figures.depths);
  std::cout << figures.passed_over << " of these passed over deeper parts that met over an inner "
            << "edge; " << figures.over_edges << " pairs met over such edges alone, of "
            << figures.unclear << " it is not clear which parts did\n"
            << figures.undecided_by_floats << " decided wrong by the standard tier, within its "
            << "bound; " << figures.undecided << " undecided by the certified one\n";
}

TEST(CompositesExact, MeetTheTargets) {
  static constexpr ShapeKind kOthers[] = {ShapeKind::sphere,  ShapeKind::capsule,  ShapeKind::box,
                                          ShapeKind::hull,    ShapeKind::triangle, ShapeKind::mesh,
                                          ShapeKind::compound};
  Figures figures;
  uint64_t seed = 0;
  for (const ShapeKind a : {ShapeKind::mesh, ShapeKind::compound}) {
    for (const ShapeKind b : kOthers) check_kinds(a, b, ++seed, figures);
  }
  EXPECT_LE(figures.separate.share(0.999), kUsual);
  EXPECT_GE(10 * figures.depths.count(), 9 * figures.overlapping);
  EXPECT_GE(100 * figures.passed_over, figures.overlapping);
  print(figures);
}

}  // namespace
}  // namespace carom::test
