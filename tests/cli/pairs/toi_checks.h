// Checks of times of impact against known ones.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/cli/pairs/pair_results.h"

namespace carom::cli {

// The known answers for a file of moving pairs, one entry a pair.
struct ImpactAnswers {
  std::vector<double> toi_lo;  // separate until then; infinite: no impact
  std::vector<double> toi_hi;  // overlapping by then
  std::vector<double> size;    // L: the mean bounding radius of the two
  std::vector<double> travel;  // the greatest path of a point of one body relative to the other
  std::vector<double> least;   // the least separation over the interval
  std::vector<uint8_t> state;
  // 1: the pair must be found only if it gets deeper than kGrazeDepth
  std::vector<uint8_t> grazing;

  // Lengths may be wrong by this share of size + travel.
  static constexpr double kSlack = 1e-5;
  static constexpr double kGrazeDepth = 1e-6;  // in units of the size

  double slack(size_t i) const { return kSlack * (size[i] + travel[i]); }
  bool has_to_be_found(size_t i) const;
};

enum ImpactState : uint8_t { kNoImpact, kImpact, kOverlapAtStart, kTouchAtStart, kUnresolved };

ImpactAnswers read_impact_answers(const std::string& path);

// Describes the fault of a time of impact; empty: there is none.
std::string fault_of(float toi, const ImpactAnswers& answers, size_t i);

void expect_times(const std::vector<float>& toi, const ImpactAnswers& answers);

// The contact of an impact has a separation of about zero, that of an overlap at the start has its
// depth, and a pair without impact has no contact.
void expect_contacts_of_impacts(const PairResultsFile& results, const ImpactAnswers& answers);

}  // namespace carom::cli
