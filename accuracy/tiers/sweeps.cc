#include "accuracy/tiers/sweeps.h"

#include <nlohmann/json.hpp>

#include "accuracy/pairs/describe.h"
#include "accuracy/pairs/exact_pair.h"
#include "accuracy/pairs/samples.h"
#include "accuracy/tiers/judge.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;

// The settings whose curves are worth a look. The reference has the bits of standard.
std::vector<std::unique_ptr<Contender>> close_contenders(const KindPair& kinds) {
  auto all = contenders_for(kinds);
  std::erase_if(all, [](const auto& contender) {
    const std::string setting = contender->setting();
    return setting == "scalar reference";
  });
  return all;
}

std::vector<Attempt> attempts_of(const std::vector<std::unique_ptr<Contender>>& contenders) {
  std::vector<Attempt> attempts;
  for (const auto& contender : contenders) attempts.push_back({.contender = contender.get()});
  return attempts;
}

std::vector<Json> rows_of(const NamedKinds& kinds,
                          const std::vector<std::unique_ptr<Contender>>& contenders) {
  std::vector<Json> rows;
  for (const auto& contender : contenders) {
    rows.push_back({{"pair", kinds.name}, {"setting", contender->setting()}});
  }
  return rows;
}

double share_of(size_t count, size_t all) {
  return all == 0 ? 0 : static_cast<double>(count) / static_cast<double>(all);
}

std::string where(const NamedKinds& kinds, const std::string& what, const Contender& contender) {
  return std::string(kinds.name) + ", " + what + ", " + contender.setting();
}

// Moves all pairs to this gap; leaves out those for which move_to_gap() fails.
PairSet pairs_at(double gap, const std::vector<ConvexPair>& touching) {
  std::vector<ConvexPair> pairs;
  for (ConvexPair pair : touching) {
    if (move_to_gap(pair, gap * size_of(pair))) pairs.push_back(pair);
  }
  return {pairs, PositionType::float64};
}

// Moves both bodies of each pair away from the origin by `distance` times L, in float64.
std::vector<ConvexPair> moved_from_origin(std::vector<ConvexPair> pairs, double distance,
                                          uint64_t seed) {
  Random random(seed);
  for (ConvexPair& pair : pairs) {
    const Eigen::Vector3d way = random.direction() * (distance * size_of(pair));
    pair.pose_a.position += way;
    pair.pose_b.position += way;
  }
  return pairs;
}

// The worst error of the standard tier's separations, measured on the intended float64 positions
// while the tier gets positions of this type.
double worst_error(const std::vector<ConvexPair>& meant, PositionType positions) {
  const PairSet pairs(meant, positions);
  LibrarySetting standard = standard_setting();
  Answers answers(pairs.size());
  standard.run(pairs, Detail::contact, answers);
  double worst = 0;
  for (size_t i = 0; i < meant.size(); ++i) {
    worst = std::max(worst, ExactPair(meant[i]).error_share(answers.separation[i]));
  }
  return worst;
}

}  // namespace

void measure_gaps(const NamedKinds& kinds, const Effort& effort, uint64_t seed, Json& rows,
                  Failures& failures) {
  constexpr int kSteps[] = {-1024, -256, -64, -16, -4, -1, 0, 1, 4, 16, 64, 256, 1024};
  const auto contenders = close_contenders(kinds.kinds);
  const std::vector<Attempt> attempts = attempts_of(contenders);
  std::vector<ConvexPair> touching = loose_pairs(kinds.kinds, effort.gap, seed);
  std::erase_if(touching, [](ConvexPair& pair) { return !move_to_gap(pair, 0); });

  std::vector<Json> curves = rows_of(kinds, contenders);
  for (Json& curve : curves) curve["steps"] = kSteps;
  for (const int step : kSteps) {
    const std::vector<Tally> tallies = judge(pairs_at(step * 0x1p-23, touching), attempts);
    for (size_t i = 0; i < curves.size(); ++i) {
      const Tally& tally = tallies[i];
      curves[i]["pairs"].push_back(tally.pairs);
      curves[i]["false_overlaps"].push_back(share_of(tally.false_overlaps, tally.pairs));
      curves[i]["missed"].push_back(share_of(tally.missed, tally.pairs));
      curves[i]["undecided"].push_back(share_of(tally.undecided, tally.pairs));
      failures.note(where(kinds, "gap of " + std::to_string(step) + " steps", *contenders[i]),
                    tally);
    }
  }
  for (Json& curve : curves) rows.push_back(std::move(curve));
}

void measure_distances(const NamedKinds& kinds, const Effort& effort, uint64_t seed, Json& rows) {
  const std::vector<ConvexPair> pairs = loose_pairs(kinds.kinds, effort.distance, seed);
  const struct {
    PositionType type;
    const char* name;
  } positions[] = {{PositionType::float32, "float32"}, {PositionType::float64, "float64"}};
  for (const auto& stored : positions) {
    Json row = {{"pair", kinds.name}, {"positions", stored.name}};
    for (double distance = 1; distance <= 1e9; distance *= 10) {
      row["distance"].push_back(distance);
      row["error_worst"].push_back(
          worst_error(moved_from_origin(pairs, distance, seed), stored.type));
    }
    rows.push_back(std::move(row));
  }
}

void measure_angles(const NamedKinds& kinds, const Effort& effort, uint64_t seed, Json& rows,
                    Failures& failures) {
  if (!has_angle(kinds.kinds)) return;
  constexpr double kAngles[] = {0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  const auto contenders = close_contenders(kinds.kinds);
  const std::vector<Attempt> attempts = attempts_of(contenders);
  std::vector<Json> curves = rows_of(kinds, contenders);
  for (Json& curve : curves) curve["angle"] = kAngles;
  for (const double angle : kAngles) {
    const PairSet pairs(near_parallel_pairs(kinds.kinds, angle, effort.angle, seed),
                        PositionType::float64);
    const std::vector<Tally> tallies = judge(pairs, attempts);
    for (size_t i = 0; i < curves.size(); ++i) {
      curves[i]["error_worst"].push_back(tallies[i].error_worst);
      curves[i]["regret_worst"].push_back(tallies[i].regret_worst);
      curves[i]["wrong"].push_back(tallies[i].wrong());
      failures.note(where(kinds, text("angle of %g", angle), *contenders[i]), tallies[i]);
    }
  }
  for (Json& curve : curves) {
    curve["pairs"] = effort.angle;
    rows.push_back(std::move(curve));
  }
}

}  // namespace carom::accuracy
