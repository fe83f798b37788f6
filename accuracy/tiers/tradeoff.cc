#include "accuracy/tiers/tradeoff.h"

#include <functional>
#include <nlohmann/json.hpp>

#include "accuracy/pairs/samples.h"
#include "accuracy/tiers/atlas.h"
#include "accuracy/tiers/judge.h"
#include "accuracy/tiers/timing.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;
using Contenders = std::vector<std::unique_ptr<Contender>>;

std::vector<double> nanoseconds_a_pair(const PairSet& pairs, const Contenders& contenders,
                                       int rounds) {
  Answers answers(pairs.size());
  std::vector<std::function<void()>> passes;
  for (const auto& contender : contenders) {
    contender->prepare(pairs);
    passes.emplace_back([&] { contender->run(pairs, Detail::contact, answers); });
  }
  std::vector<double> times = median_seconds(passes, rounds);
  for (double& time : times) time *= 1e9 / static_cast<double>(pairs.size());
  return times;
}

Json tradeoff_row(const NamedKinds& kinds, const Contender& contender, size_t timed,
                  double nanoseconds, const Tally& tally) {
  return {{"pair", kinds.name},
          {"setting", contender.setting()},
          {"tier", contender.tier()},
          {"detail", "contact"},
          {"pairs", timed},
          {"judged", tally.pairs},
          {"unjudged", tally.unjudged},
          {"ns_per_pair", nanoseconds},
          {"error_worst", tally.error_worst},
          {"error_p9999", tally.error_quantile(0.9999)},
          {"false_overlaps", tally.false_overlaps},
          {"missed", tally.missed},
          {"undecided", tally.undecided},
          {"worst_wrong_gap", tally.worst_wrong_gap}};
}

Json matrix_row(const NamedKinds& kinds, const Tally& standard) {
  return {{"pair", kinds.name},
          {"a", name(kinds.kinds.a)},
          {"b", name(kinds.kinds.b)},
          {"error_worst", standard.error_worst},
          {"bound", kSeparationBound}};
}

}  // namespace

void measure_tradeoff(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                      const TradeoffRows& rows, Failures& failures) {
  const Contenders contenders = contenders_for(kinds.kinds);
  const PairSet stream(random_pairs(kinds.kinds, effort.stream, seed), PositionType::float32);
  const std::vector<double> times = nanoseconds_a_pair(stream, contenders, effort.rounds);

  std::vector<Attempt> attempts;
  for (const auto& contender : contenders) attempts.push_back({.contender = contender.get()});
  std::vector<Tally> tallies = judge(stream, attempts);
  for (size_t i = 0; i < contenders.size(); ++i) {
    const std::string setting = contenders[i]->setting();
    failures.note(std::string(kinds.name) + ", random pairs, " + setting, tallies[i]);
  }
  const std::vector<Tally> hard =
      judge_families(kinds, effort, seed, contenders, rows.atlas, failures);
  for (size_t i = 0; i < contenders.size(); ++i) {
    tallies[i].add(hard[i]);
    rows.tradeoff.push_back(
        tradeoff_row(kinds, *contenders[i], stream.size(), times[i], tallies[i]));
    if (std::string(contenders[i]->setting()) == "standard") {
      rows.matrix.push_back(matrix_row(kinds, tallies[i]));
    }
  }
}

void measure_round(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                   const TradeoffRows& rows, Failures& failures) {
  Contenders contenders = contenders_for(kinds.kinds);
  std::erase_if(contenders, [](const auto& c) { return c->promise() != Promise::standard; });
  const PairSet stream(random_pairs(kinds.kinds, effort.stream, seed), PositionType::float32);
  const std::vector<double> times = nanoseconds_a_pair(stream, contenders, effort.rounds);
  std::vector<Attempt> attempts;
  for (const auto& contender : contenders) attempts.push_back({.contender = contender.get()});
  const std::vector<Tally> tallies = judge(stream, attempts);
  for (size_t i = 0; i < contenders.size(); ++i) {
    const std::string setting = contenders[i]->setting();
    failures.note(std::string(kinds.name) + ", random pairs, " + setting, tallies[i]);
    rows.tradeoff.push_back(
        tradeoff_row(kinds, *contenders[i], stream.size(), times[i], tallies[i]));
    if (setting == "standard") rows.matrix.push_back(matrix_row(kinds, tallies[i]));
  }
}

}  // namespace carom::accuracy
