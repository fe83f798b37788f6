#include "accuracy/tiers/judge.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/pairs/describe.h"
#include "accuracy/pairs/exact_pair.h"
#include "accuracy/pairs/round_pair.h"
#include "accuracy/tiers/flush_to_zero.h"

namespace carom::accuracy {
namespace {

bool is_finite(const Eigen::Vector3f& v) { return v.allFinite(); }

// Compares the answers of one attempt with the exact pairs, one after the other.
class Judgement {
 public:
  Judgement(const Attempt& attempt, const PairSet& pairs)
      : attempt_(attempt), pairs_(pairs), answers_(pairs.size()) {
    attempt.contender->prepare(pairs);
    const FlushToZero mode(attempt.flush_to_zero);
    attempt.contender->run(pairs, attempt.detail, answers_);
  }

  // `exact`: an ExactPair or a RoundPair.
  template <class Exact>
  void add(size_t i, const Exact& exact) {
    row_ = i;
    ++tally_.pairs;
    const bool is_number = check_finite();
    add_decision(exact);
    if (!is_number) return;
    if (attempt_.detail == Detail::contact) add_contact(exact);
    if (attempt_.detail == Detail::manifold) add_manifold(exact);
  }

  Tally take() { return std::move(tally_); }

 private:
  bool promises(Promise promise) const { return attempt_.contender->promise() >= promise; }

  void note_broken(const std::string& what) {
    ++tally_.broken;
    tally_.add_example(what + ": " + describe(pairs_[row_], pairs_.positions()));
  }

  bool is_answer_finite() const {
    if (attempt_.detail == Detail::overlap) return true;
    return std::isfinite(answers_.separation[row_]) &&
           is_finite(Answers::row(answers_.normal, row_)) &&
           is_finite(Answers::row(answers_.point_a, row_)) &&
           is_finite(Answers::row(answers_.point_b, row_)) && is_manifold_finite();
  }

  bool is_manifold_finite() const {
    if (attempt_.detail != Detail::manifold) return true;
    const ManifoldPoints& manifold = answers_.manifold[row_];
    for (size_t k = 0; k < answers_.manifold_count[row_]; ++k) {
      const auto& p = manifold.point[k];
      const bool is_point = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
      if (!is_point || !std::isfinite(manifold.separation[k])) return false;
    }
    return true;
  }

  bool check_finite() {
    const bool is_valid = answers_.status[row_] != static_cast<uint8_t>(Status::invalid);
    if (is_valid && is_answer_finite()) return true;
    ++tally_.not_finite;
    if (promises(Promise::finite)) note_broken(is_valid ? "not finite" : "called invalid");
    return false;
  }

  template <class Exact>
  void add_decision(const Exact& exact) {
    const uint8_t overlap = answers_.overlap[row_];
    if (overlap == kUndecided) {
      ++tally_.undecided;
      if (attempt_.contender->promise() != Promise::proven) note_broken("undecided");
      return;
    }
    if (exact.truth() == Truth::unknown) {
      ++tally_.unjudged;
      return;
    }
    const bool is_overlap = exact.truth() == Truth::overlap;
    if ((overlap == 1) == is_overlap) return;
    ++(is_overlap ? tally_.missed : tally_.false_overlaps);
    const double gap = exact.gap_share();
    tally_.worst_wrong_gap = std::max(tally_.worst_wrong_gap, gap);
    const bool is_broken = promises(Promise::proven) || (promises(Promise::standard) &&
                                                         gap > kDecisionBound * exact.allowance());
    if (is_broken) {
      note_broken(is_overlap ? text("missed, depth %.3g L", gap)
                             : text("overlap of shapes %.3g L apart", gap));
    }
  }

  // A contender without a promise (Bullet) reports contacts of overlapping pairs only.
  template <class Exact>
  void add_contact(const Exact& exact) {
    const uint8_t overlap = answers_.overlap[row_];
    if (!promises(Promise::finite) && overlap != 1) return;
    const bool is_negative = answers_.separation[row_] <= 0;
    if (promises(Promise::standard) && overlap != kUndecided && is_negative != (overlap == 1)) {
      note_broken("decision and separation disagree");
    }
    const double error = exact.error_share(answers_.separation[row_]);
    tally_.add_error(error);
    if (promises(Promise::standard) && !(error <= kSeparationBound * exact.allowance())) {
      note_broken(text("separation wrong by %.3g L", error));
    }
    const double regret = exact.regret_share(Answers::row(answers_.normal, row_));
    tally_.regret_worst = std::max(tally_.regret_worst, regret);
    if (promises(Promise::standard) && !(regret <= kNormalBound * exact.allowance())) {
      note_broken(text("normal wrong by %.3g L", regret));
    }
  }

  // A manifold point must not be deeper than the exact depth.
  template <class Exact>
  void add_manifold(const Exact& exact) {
    const size_t count = answers_.manifold_count[row_];
    const bool is_overlap = answers_.overlap[row_] == 1;
    if ((count > 0) != is_overlap || count > 4) note_broken("not 1 to 4 points an overlap");
    float deepest = 0;
    for (size_t k = 0; k < std::min<size_t>(count, 4); ++k) {
      deepest = std::min(deepest, answers_.manifold[row_].separation[k]);
    }
    const double error = exact.share(std::min(exact.gap(), 0.0L) - deepest);
    tally_.add_error(error);
    if (promises(Promise::standard) && !(error <= kSeparationBound * exact.allowance())) {
      note_broken(text("a manifold point too deep by %.3g L", error));
    }
  }

  Attempt attempt_;
  const PairSet& pairs_;
  Answers answers_;
  Tally tally_;
  size_t row_ = 0;
};

}  // namespace

std::vector<Tally> judge(const PairSet& pairs, std::span<const Attempt> attempts) {
  std::vector<Judgement> judgements;
  judgements.reserve(attempts.size());
  for (const Attempt& attempt : attempts) judgements.emplace_back(attempt, pairs);
  const auto judge_all = [&](size_t i, const auto& exact) {
    for (Judgement& judgement : judgements) judgement.add(i, exact);
  };
  for (size_t i = 0; i < pairs.size(); ++i) {
    const ConvexPair& pair = pairs[i];
    if (has_round({kind_of(pair.shape_a), kind_of(pair.shape_b)})) {
      judge_all(i, RoundPair(pair));
    } else {
      judge_all(i, ExactPair(pair));
    }
  }
  std::vector<Tally> tallies;
  for (Judgement& judgement : judgements) tallies.push_back(judgement.take());
  return tallies;
}

}  // namespace carom::accuracy
