// Draws pairs of bodies that turn and compares their times of impact with the oracle, which
// advances in steps that it proves free, in double and long double precision:
//
//     turning_pairs COUNT [SEED [FAMILY]]
//
// COUNT motions of every two kinds in every family that turns and has FAMILY in its name. Prints a
// row for each two kinds, one for each family, and the motions that are wrong or whose search ended
// early while the bodies were far apart.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/impacts.h"

namespace {

using namespace carom;
using namespace carom::test;

// The answers for a pair of kinds. Lengths are shares of size plus travel.
struct Row {
  size_t pairs = 0;
  size_t impacts = 0;
  size_t early = 0;
  size_t late = 0;
  size_t missed = 0;
  size_t budget = 0;
  size_t unknown = 0;       // the oracle cannot tell
  double widest = 0;        // the greatest separation at a time of impact that is early
  double most_early = 0;    // the longest travel from such a time to the true one
  double deepest_late = 0;  // the greatest depth before a time of impact

  void add(const Row& other) {
    pairs += other.pairs;
    impacts += other.impacts;
    early += other.early;
    late += other.late;
    missed += other.missed;
    budget += other.budget;
    unknown += other.unknown;
    widest = std::max(widest, other.widest);
    most_early = std::max(most_early, other.most_early);
    deepest_late = std::max(deepest_late, other.deepest_late);
  }
};

void print(const std::string& what, const Row& row) {
  std::printf("%-30s %9zu %9zu %6zu %6zu %6zu %6zu %7zu  %8.1e  %8.1e  %8.1e\n", what.c_str(),
              row.pairs, row.impacts, row.early, row.late, row.missed, row.budget, row.unknown,
              row.widest, row.most_early, row.deepest_late);
  std::fflush(stdout);
}

constexpr double kFarApart = 5e-5;

void measure_early(const MovedPair& pair, float toi, Row& row) {
  const MovingPair<double> moving = moving_pair<double>(pair);
  const double length = moving.size() + moving.travel();
  const MotionMoment<double> moment(moving, toi, -moving.rounding());
  row.widest = std::max(row.widest, moment.upper() / length);
  if (moment.upper() > kFarApart * length) {
    std::printf("%g of size plus travel apart at %.9g\n%s\n", moment.upper() / length, toi,
                show(pair).c_str());
  }
  const ImpactBracket<double> truth = impact(pair);
  if (truth.meeting != Meeting::found) return;
  row.most_early = std::max(row.most_early, (truth.low - toi) * moving.travel() / length);
}

void judge_row(const char* family, const MovedPair& pair, const ImpactRow& answer, Row& row) {
  ++row.pairs;
  if (answer.is_impact()) ++row.impacts;
  const bool is_bound = answer.status == static_cast<uint32_t>(Status::budget);
  if (is_bound) ++row.budget;
  const Judgement found = is_bound ? judge_bound(pair, answer.toi) : judge(pair, answer.toi);
  if (found.fault == Fault::unknown) ++row.unknown;
  if (is_bound || found.fault == Fault::early) measure_early(pair, answer.toi, row);
  if (found.fault == Fault::early) ++row.early;
  if (found.fault == Fault::late) {
    ++(answer.is_impact() ? row.late : row.missed);
    const MovingPair<double> moving = moving_pair<double>(pair);
    const double depth = -found.separation / (moving.size() + moving.travel());
    row.deepest_late = std::max(row.deepest_late, depth);
  }
  if (found.fault == Fault::none || found.fault == Fault::unknown) return;
  std::printf("%s, %s: %g apart at %.9g\n%s\n%s\n", family, name(found.fault), found.separation,
              found.time, show(pair).c_str(), show(answer).c_str());
}

void check(const MotionFamily& family, const KindPair& kinds, size_t count, uint64_t seed,
           Row& row) {
  constexpr size_t kPiece = 1024;  // fits into memory
  MotionMaker maker(family, kinds, seed);
  for (size_t done = 0; done < count; done += kPiece) {
    std::vector<MovedPair> pairs;
    while (pairs.size() < std::min(kPiece, count - done)) pairs.push_back(maker.next());
    const std::vector<ImpactRow> answers = run_impacts(pairs, impact_call(family.positions));
    for (size_t i = 0; i < pairs.size(); ++i) judge_row(family.name, pairs[i], answers[i], row);
  }
}

std::vector<MotionFamily> turning_families() {
  std::vector<MotionFamily> families = plain_motions(), hard = hard_motions();
  families.insert(families.end(), hard.begin(), hard.end());
  std::erase_if(families, [](const MotionFamily& family) { return family.most_turn == 0; });
  return families;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "turning_pairs COUNT [SEED [FAMILY]]\n");
    return 2;
  }
  const size_t count = std::strtoull(argv[1], nullptr, 10);
  const uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  std::printf("lengths are shares of size plus travel\n");
  std::printf("%-30s %9s %9s %6s %6s %6s %6s %7s  %8s  %8s  %8s\n", "", "pairs", "impacts", "early",
              "late", "missed", "budget", "unknown", "gap", "too soon", "depth");
  const std::vector<MotionFamily> families = turning_families();
  const std::string named = argc > 3 ? argv[3] : "";
  std::vector<Row> of_family(families.size());
  Row all;
  uint64_t next_seed = seed << 20;
  for (const KindPair& kinds : convex_kind_pairs()) {
    Row of_kinds;
    for (size_t i = 0; i < families.size(); ++i) {
      Row row;
      ++next_seed;  // whether or not the family is measured
      if (std::string(families[i].name).find(named) == std::string::npos) continue;
      check(families[i], kinds, count, next_seed, row);
      of_family[i].add(row);
      of_kinds.add(row);
    }
    print(name(kinds), of_kinds);
    all.add(of_kinds);
  }
  for (size_t i = 0; i < families.size(); ++i) print(families[i].name, of_family[i]);
  print("all", all);
  return all.early + all.late + all.missed == 0 ? 0 : 1;
}
