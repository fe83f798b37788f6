#include "tests/cli/pairs/toi_checks.h"

namespace carom::cli {

bool ImpactAnswers::has_to_be_found(size_t i) const {
  return grazing[i] == 0 || least[i] < -kGrazeDepth * size[i];
}

ImpactAnswers read_impact_answers(const std::string& path) {
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

std::string fault_of(float toi, const ImpactAnswers& answers, size_t i) {
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

void expect_times(const std::vector<float>& toi, const ImpactAnswers& answers) {
  ASSERT_EQ(toi.size(), answers.state.size());
  for (size_t i = 0; i < toi.size(); ++i) {
    const std::string fault = fault_of(toi[i], answers, i);
    EXPECT_EQ(fault, "") << "pair " << i << ": toi " << toi[i] << ' ' << fault << ", expected "
                         << answers.toi_lo[i] << " to " << answers.toi_hi[i] << ", least distance "
                         << answers.least[i] << " of L " << answers.size[i] << ", travel "
                         << answers.travel[i];
  }
}

void expect_contacts_of_impacts(const PairResultsFile& results, const ImpactAnswers& answers) {
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
