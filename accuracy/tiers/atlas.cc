#include "accuracy/tiers/atlas.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/tiers/judge.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;

// A family, and whether the caller sets flush-to-zero.
struct Chapter {
  ConvexFamily family;
  std::string title;
  bool flush_to_zero = false;
};

std::vector<Chapter> all_chapters() {
  std::vector<Chapter> chapters;
  for (const ConvexFamily& family : oracle::convex_families()) {
    chapters.push_back({family, family.name});
    if (std::string(family.name) == "subnormal") {
      chapters.push_back({family, "subnormal, flush to zero", true});
    }
  }
  return chapters;
}

const char* name_of(PositionType positions) {
  return positions == PositionType::float32 ? "float32" : "float64";
}

const char* name_of(Detail detail) {
  if (detail == Detail::overlap) return "overlap";
  return detail == Detail::contact ? "contact" : "manifold";
}

Json atlas_row(const NamedKinds& kinds, const Chapter& chapter, PositionType positions,
               Detail detail, const Tally& tally) {
  Json row = {{"pair", kinds.name},
              {"family", chapter.title},
              {"positions", name_of(positions)},
              {"detail", name_of(detail)},
              {"pairs", tally.pairs},
              {"unjudged", tally.unjudged},
              {"wrong", tally.wrong()},
              {"worst_wrong_gap", tally.worst_wrong_gap},
              {"error_worst", nullptr},
              {"regret_worst", nullptr},
              {"not_finite", tally.not_finite}};
  if (detail != Detail::overlap) row["error_worst"] = tally.error_worst;
  if (detail == Detail::contact) row["regret_worst"] = tally.regret_worst;
  return row;
}

// All contenders at detail contact, and the tiers at the other details.
class Attempts {
 public:
  Attempts(std::span<const std::unique_ptr<Contender>> contenders, bool flush_to_zero) {
    for (const auto& contender : contenders) {
      list_.push_back({contender.get(), Detail::contact, flush_to_zero});
    }
    for (LibrarySetting* setting : {&standard_, &certified_, &exact_}) {
      list_.push_back({setting, Detail::overlap, flush_to_zero});
      list_.push_back({setting, Detail::manifold, flush_to_zero});
    }
  }
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;

  const std::vector<Attempt>& list() const { return list_; }

  // Index of the standard tier's attempt at that detail.
  size_t standard_at(Detail detail) const {
    const auto found = std::find_if(list_.begin(), list_.end(), [&](const Attempt& attempt) {
      return attempt.detail == detail && attempt.contender->setting() == std::string("standard");
    });
    return static_cast<size_t>(found - list_.begin());
  }

 private:
  LibrarySetting standard_ = standard_setting();
  LibrarySetting certified_ = certified_setting();
  LibrarySetting exact_ = exact_setting();
  std::vector<Attempt> list_;
};

}  // namespace

std::vector<Tally> judge_families(const NamedKinds& kinds, const Effort& effort, uint64_t seed,
                                  std::span<const std::unique_ptr<Contender>> contenders,
                                  Json& rows, Failures& failures) {
  std::vector<Tally> sums(contenders.size());
  for (const Chapter& chapter : all_chapters()) {
    const Attempts attempts(contenders, chapter.flush_to_zero);
    const std::vector<Attempt>& list = attempts.list();
    for (const PositionType positions : {PositionType::float32, PositionType::float64}) {
      const PairSet pairs(
          oracle::make_convex_pairs(chapter.family, kinds.kinds, positions, effort.family, seed),
          positions);
      const std::vector<Tally> tallies = judge(pairs, list);
      for (size_t i = 0; i < list.size(); ++i) {
        failures.note(std::string(kinds.name) + ", " + chapter.title + ", " + name_of(positions) +
                          ", " + list[i].contender->setting() + ", " + name_of(list[i].detail),
                      tallies[i]);
      }
      for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
        rows.push_back(
            atlas_row(kinds, chapter, positions, detail, tallies[attempts.standard_at(detail)]));
      }
      for (size_t i = 0; i < sums.size(); ++i) sums[i].add(tallies[i]);
    }
  }
  return sums;
}

}  // namespace carom::accuracy
