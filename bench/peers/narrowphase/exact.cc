#include "bench/peers/narrowphase/exact.h"

#include <algorithm>
#include <utility>

#include "bench/peers/narrowphase/peer_bodies.h"
#include "bench/peers/narrowphase/turns.h"
#include "bench/support/pair_stream.h"
#include "carom/narrowphase/collide.h"

namespace carom::bench {
namespace {

constexpr size_t kMostPairs = 20'000;
constexpr size_t kMostOfCgal = 2'000;  // a pair of its hulls takes a tenth of a millisecond

struct ExactSpec {
  const char* pair;
  ShapeKind a, b;
};

std::vector<ExactSpec> exact_pairs() {
  using enum ShapeKind;
  return {{"sphere_sphere", sphere, sphere},
          {"sphere_triangle", sphere, triangle},
          {"triangle_triangle", triangle, triangle},
          {"box_box", box, box},
          {"hull_hull_16", hull, hull}};
}

// Carom decides the pairs of a stream at a tier.
class TierPass {
 public:
  TierPass(const ExactSpec& spec, const PairStream& stream)
      : a_(spec.a, stream.bodies_a(), Storage::f32),
        b_(spec.b, stream.bodies_b(), Storage::f32),
        results_(stream.spec().count, Detail::overlap) {}

  const ResultColumns& run(Tier tier) {
    (void)collide_rows(a_.view(), b_.view(), Detail::overlap, results_.columns(),
                       {.accuracy = {.tier = tier}});
    return results_.columns();
  }

 private:
  DenseBodies a_, b_;
  ResultArrays results_;
};

class CgalPass {
 public:
  CgalPass(const ExactSpec& spec, const PairStream& stream)
      : answers_(std::min(stream.spec().count, kMostOfCgal)) {
    PeerBodies a = peer_bodies(spec.a, stream.bodies_a());
    PeerBodies b = peer_bodies(spec.b, stream.bodies_b());
    a.bodies.resize(answers_.overlaps.size());
    b.bodies.resize(answers_.overlaps.size());
    pairs_ = make_cgal_pairs(a, b, PeerDetail::overlap);
  }

  const std::vector<uint8_t>& run() {
    pairs_->run(answers_);
    return answers_.overlaps;
  }

 private:
  std::unique_ptr<PairPeer> pairs_;
  PairAnswers answers_;
};

ExactResult compare_exact(const ExactSpec& spec, bool touching, size_t pairs, double budget) {
  const PairStream stream({.kind_a = spec.a,
                           .kind_b = spec.b,
                           .placing = touching ? Placing::touching : Placing::freely,
                           .count = std::min(pairs, kMostPairs)});
  TierPass carom(spec, stream);
  CgalPass cgal(spec, stream);
  const std::vector<uint8_t>& decided = cgal.run();
  const uint8_t* const exact = carom.run(Tier::exact).overlap;
  ExactResult result = {
      .pair = spec.pair,
      .touching = touching,
      .pairs = decided.size(),
      .hit_percent = 100.0 *
                     static_cast<double>(std::count(exact, exact + decided.size(), uint8_t{1})) /
                     static_cast<double>(decided.size()),
      .runners = {}};
  for (size_t i = 0; i < decided.size(); ++i) result.different += decided[i] != exact[i] ? 1 : 0;

  const auto pass = [&](Tier tier) { return [&carom, tier] { (void)carom.run(tier); }; };
  std::vector<TimedRunner> runners;
  const size_t count = stream.spec().count;
  runners.emplace_back(RunnerResult{.runner = "standard", .pairs = count}, pass(Tier::standard));
  runners.emplace_back(RunnerResult{.runner = "exact", .pairs = count}, pass(Tier::exact));
  runners.emplace_back(RunnerResult{.runner = "cgal", .pairs = decided.size()},
                       [&] { (void)cgal.run(); });
  result.runners = time_in_turns(std::move(runners), budget);
  return result;
}

}  // namespace

std::vector<ExactResult> compare_exact(const std::string& names, size_t pairs, double budget) {
  std::vector<ExactResult> results;
  for (const ExactSpec& spec : exact_pairs()) {
    if (!std::string(spec.pair).starts_with(names)) continue;
    for (const bool touching : {false, true}) {
      results.push_back(compare_exact(spec, touching, pairs, budget));
    }
  }
  return results;
}

}  // namespace carom::bench
