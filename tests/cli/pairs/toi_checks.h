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
  bool has_to_be_found(size_t i) const {
    return grazing[i] == 0 || least[i] < -kGrazeDepth * size[i];
  }
};

enum ImpactState : uint8_t { kNoImpact, kImpact, kOverlapAtStart, kTouchAtStart, kUnresolved };

inline ImpactAnswers read_impact_answers(const std::string& path) {
  ImpactAnswers answers;
  auto reader = io::NpzReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  if (!reader) return answers;
  const auto read = [&](const char* name, auto& out) {
    using T = typename std::decay_t<decltype(out)>::value_type;
    auto values = reader->read<T>(name, {io::kAny});
    EXPECT_TRUE(values) << values.error().message;
    if (values) out = *values;
  };
  read("toi_lo", answers.toi_lo);
  read("toi_hi", answers.toi_hi);
  read("L", answers.size);
  read("travel", answers.travel);
  read("min_separation", answers.least);
  read("state", answers.state);
  read("grazing", answers.grazing);
  return answers;
}

// Describes the fault of a time of impact; empty: there is none.
inline std::string fault_of(float toi, const ImpactAnswers& answers, size_t i) {
  const bool found = std::isfinite(toi);
  const uint8_t state = answers.state[i];
  if (std::isnan(toi) || toi < 0 || (found && toi > 1)) return "is no time of impact";
  if (state == kOverlapAtStart || state == kTouchAtStart) {
    return toi == 0 ? "" : "is not at the start";
  }
  if (state == kNoImpact) {
    return found && answers.least[i] > answers.slack(i) ? "is of a pair that stays apart" : "";
  }
  if (state == kUnresolved) return "";
  if (!found) return answers.has_to_be_found(i) ? "misses the impact" : "";
  if (double{std::nextafter(toi, 0.0f)} > answers.toi_hi[i]) return "is late";
  const double early = (answers.toi_lo[i] - double{toi}) * answers.travel[i];
  return early > answers.slack(i) ? "is early" : "";
}

inline void expect_times(const std::vector<float>& toi, const ImpactAnswers& answers) {
  ASSERT_EQ(toi.size(), answers.state.size());
  for (size_t i = 0; i < toi.size(); ++i) {
    const std::string fault = fault_of(toi[i], answers, i);
    EXPECT_EQ(fault, "") << "pair " << i << ": toi " << toi[i] << ' ' << fault << ", expected "
                         << answers.toi_lo[i] << " to " << answers.toi_hi[i] << ", least distance "
                         << answers.least[i] << " of L " << answers.size[i] << ", travel "
                         << answers.travel[i];
  }
}

// The contact of an impact has a separation of about zero, that of an overlap at the start has its
// depth, and a pair without impact has no contact.
inline void expect_contacts_of_impacts(const PairResultsFile& results,
                                       const ImpactAnswers& answers) {
  for (size_t i = 0; i < results.toi.size(); ++i) {
    const float separation = results.separation[i];
    const auto& [x, y, z] = results.normal[i];
    const bool found = std::isfinite(results.toi[i]);
    EXPECT_EQ(results.overlap[i], found) << i;
    EXPECT_LT(results.status[i], 3) << i;
    EXPECT_EQ(std::isnan(separation), !found) << i;
    EXPECT_EQ(std::isnan(results.point_a[i][0]) || std::isnan(results.point_b[i][2]), !found) << i;
    if (!found) continue;
    EXPECT_NEAR(std::hypot(x, y, z), 1, 1e-5) << i;
    const bool ended_early = results.status[i] == 1;
    EXPECT_TRUE(separation <= answers.slack(i) || ended_early) << i << ": " << separation;
    if (results.toi[i] > 0) {
      EXPECT_GE(separation, -answers.slack(i)) << i;
    }
  }
}

}  // namespace carom::cli
