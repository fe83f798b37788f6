#include "accuracy/pairs/decisions.h"

#include <cmath>
#include <vector>

#include "accuracy/pairs/bodies.h"
#include "accuracy/pairs/describe.h"
#include "accuracy/tiers/answers.h"
#include "carom/narrowphase/collide.h"
#include "narrowphase/proof/exact_overlap.h"
#include "narrowphase/proof/proof.h"

namespace carom::accuracy {
namespace {

using oracle::ConvexRandom;

constexpr size_t kBatch = 4096;

// A batch of pairs of one random style: ratio of sizes, aspect, near parallel or not.
class Pairs {
 public:
  Pairs(const KindPair& kinds, Random& random) : random_(random) {
    constexpr double kAspects[] = {4, 100, 1e4};
    ConvexRandom shapes({.aspect = kAspects[random.below(3)],
                         .degenerate = random.chance(0.1),
                         .aligned = random.chance(0.3)},
                        random);
    const double ratio = random.chance(0.3) ? 100 : 2;
    const bool near_parallel = random.chance(0.4);
    for (size_t i = 0; i < kBatch; ++i) {
      const double size_b = random.log_uniform(1 / ratio, ratio);
      const Eigen::Quaternionf turn_a = shapes.orientation();
      const Eigen::Quaternionf turn_b =
          near_parallel ? turned_a_little(turn_a) : shapes.orientation();
      const Eigen::Vector3d at = random.direction() * random.uniform(0, 10);
      const Eigen::Vector3d way = random.direction() * ((1 + size_b) * random.uniform(0, 2));
      a_.push_back({shapes.shape(kinds.a, 1), {as_float(at), turn_a}});
      b_.push_back({shapes.shape(kinds.b, size_b), {as_float(at + way), turn_b}});
    }
  }

  const std::vector<Placed>& a() const { return a_; }
  const std::vector<Placed>& b() const { return b_; }

  // Moves every B along the normal until the pair touches, give or take `roundings` roundings.
  void move_to_touch(double roundings) {
    const BodyArrays a(a_, PositionType::float32), b(b_, PositionType::float32);
    Answers answers(kBatch);
    if (!collide_rows(a.view(), b.view(), Detail::contact, answers)) return;
    for (size_t i = 0; i < kBatch; ++i) {
      const double off = random_.uniform(-roundings, roundings) * 0x1p-24;
      const Eigen::Vector3d normal = Answers::row(answers.normal, i).cast<double>();
      const Eigen::Vector3d at = b_[i].pose.position + normal * (off - answers.separation[i]);
      if (at.allFinite()) b_[i].pose.position = as_float(at);
    }
  }

 private:
  static Eigen::Vector3d as_float(const Eigen::Vector3d& v) {
    return v.cast<float>().cast<double>();
  }

  Eigen::Quaternionf turned_a_little(const Eigen::Quaternionf& from) {
    const double angle = random_.chance(0.1) ? 0 : std::pow(10.0, -random_.uniform(1, 9));
    const Eigen::Vector3d v = random_.direction() * (angle / 2);
    return (from.cast<double>() * Eigen::Quaterniond(1, v.x(), v.y(), v.z())).cast<float>();
  }

  Random& random_;
  std::vector<Placed> a_, b_;
};

std::vector<uint8_t> decisions(const BodyArrays& a, const BodyArrays& b, Tier tier) {
  std::vector<uint8_t> overlap(kBatch), status(kBatch);
  const ResultColumns out = {.overlap = overlap.data(), .status = status.data()};
  (void)collide_rows(a.view(), b.view(), Detail::overlap, out, {.accuracy = {.tier = tier}});
  return overlap;
}

void judge(const Pairs& pairs, DecisionCount& count) {
  const BodyArrays a(pairs.a(), PositionType::float32), b(pairs.b(), PositionType::float32);
  const std::vector<uint8_t> certified = decisions(a, b, Tier::certified);
  const std::vector<uint8_t> exact = decisions(a, b, Tier::exact);
  for (size_t i = 0; i < kBatch; ++i) {
    const StatedBody body_a = stated_body(BodyReader{a.view()}, i);
    const StatedBody body_b = stated_body(BodyReader{b.view()}, i);
    uint8_t truth = prove_overlap(body_a, body_b);
    if (truth == kUndecided) truth = exact_overlap(body_a, body_b);
    const bool abstains = certified[i] == kUndecided;
    const bool wrong_certified = !abstains && certified[i] != truth;
    const bool wrong_exact = exact[i] != truth;
    ++count.pairs;
    count.overlapping += truth;
    count.undecided += abstains;
    count.wrong_certified += wrong_certified;
    count.wrong_exact += wrong_exact;
    if ((wrong_certified || wrong_exact) && count.failure.empty()) {
      const Placed &x = pairs.a()[i], &y = pairs.b()[i];
      count.failure = describe({x.shape, x.pose, y.shape, y.pose}, PositionType::float32);
    }
  }
}

}  // namespace

DecisionCount count_decisions(const KindPair& kinds, size_t count, uint64_t seed,
                              const std::function<void(size_t done)>& progress) {
  constexpr double kRoundings[] = {64, 4};
  Random random(seed);
  DecisionCount result;
  while (result.pairs < count) {
    Pairs pairs(kinds, random);
    judge(pairs, result);
    for (const double roundings : kRoundings) {
      pairs.move_to_touch(roundings);
      judge(pairs, result);
    }
    progress(result.pairs);
  }
  return result;
}

}  // namespace carom::accuracy
