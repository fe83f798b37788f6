// carom pairs with cylinders, cones, ellipsoids and rounded shapes: answers that are known without
// computing much.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/pairs_file.h"
#include "tests/cli/pairs/pair_results.h"
#include "tests/support/special_floats.h"

namespace carom::cli {
namespace {

struct KnownPair {
  uint32_t a, b;            // shapes
  std::array<float, 3> at;  // of B; A is at the origin
  float separation;
};

// Pairs of the shapes below, with their separations; all normals are towards B.
constexpr KnownPair kKnown[] = {
    {0, 3, {4, 0, 0}, 2.5f},                                     // beside a cylinder
    {0, 3, {0, 0, 2.25f}, -0.25f},                               // on its top
    {0, 3, {4, 0, 6}, 4.5f},                                     // off its rim, 3 and 4 away
    {1, 3, {0, 0, 4}, 1.5f},                                     // above the tip of a cone
    {1, 3, {0, 0, -3}, 0.5f},                                    // below its base
    {2, 3, {0, 5, 0}, 2.5f},                                     // beside an ellipsoid
    {2, 3, {0, 0, 3.25f}, -0.25f}, {0, 0, {0, 0, 3.5f}, -0.5f},  // a cylinder on another
    {2, 2, {3, 0, 0}, 1},          {0, 4, {0, 0, -3}, 1},        // over a half-space
    {2, 4, {0, 0, -2.5f}, -0.5f},  {3, 5, {0, 0, 3}, 1.25f},     // a ball over a rounded box
    {5, 5, {2, 0, 0}, -0.5f},                                    // two of them
    {5, 5, {5, 0, 6}, 4.5f},                                     // edge to edge, 3 and 4 away
    {5, 6, {0, 0, 3}, 0.25f},                                    // on a rounded cylinder
};

class RoundPairsTest : public CliTest {
 protected:
  RoundPairsTest() {
    file_.shapes.kind = {9, 10, 11, 0, 8, 3, 9};
    file_.shapes.params = {{1, 2}, {1, 2}, {1, 2, 3}, {0.5f}, {0, 0, 1, 0}, {1, 1, 1}, {1, 1}};
    file_.shapes.rounding = {0, 0, 0, 0, 0, 0.25f, 0.5f};
    for (const KnownPair& known : kKnown) {
      ++file_.pairs;
      file_.a.shape.push_back(known.a);
      file_.b.shape.push_back(known.b);
      file_.a.position32.push_back({});
      file_.b.position32.push_back(known.at);
    }
  }

  PairResultsFile find(const std::string& detail) {
    EXPECT_TRUE(io::write_pairs(path("in.npz"), file_));
    const CommandResult result =
        run_command({"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", detail});
    EXPECT_EQ(result.code, 0) << result.err;
    return read_pair_results(path("out.npz"), file_.pairs);
  }

  io::PairsFile file_;
};

TEST_F(RoundPairsTest, Separations) {
  for (const char* detail : {"contact", "manifold", "distance"}) {
    const PairResultsFile found = find(detail);
    for (size_t i = 0; i < std::size(kKnown); ++i) {
      EXPECT_EQ(found.overlap[i], kKnown[i].separation <= 0) << i;
      EXPECT_EQ(found.status[i], 0) << i;
      EXPECT_NEAR(found.separation[i], kKnown[i].separation, 1e-6) << detail << ' ' << i;
    }
  }
}

// B comes along an axis, and arrives when it has gone the separation. What is off the axes rests.
TEST_F(RoundPairsTest, TimesOfImpact) {
  for (size_t i = 0; i < std::size(kKnown); ++i) {
    const bool is_on_axis = kKnown[i].at[0] == 0 || kKnown[i].at[2] == 0;
    std::array<float, 3>& way = file_.b.displacement.emplace_back(kKnown[i].at);
    for (float& x : way) x *= is_on_axis ? -1.0f : 0.0f;
    file_.a.displacement.emplace_back();
  }
  const PairResultsFile found = find("toi");
  for (size_t i = 0; i < std::size(kKnown); ++i) {
    const auto [x, y, z] = kKnown[i].at;
    const float way = std::fabs(x) + std::fabs(y) + std::fabs(z);
    if (x == 0 || z == 0) {
      EXPECT_NEAR(found.toi[i], std::max(0.0f, kKnown[i].separation) / way, 1e-6) << i;
    } else {
      EXPECT_EQ(found.toi[i], test::kInfinity);
    }
  }
}

TEST_F(RoundPairsTest, WrongSizesAreInvalid) {
  file_.shapes.params[0][1] = -2;
  file_.shapes.params[1][0] = test::kNan;
  file_.shapes.params[2][2] = test::kInfinity;
  file_.shapes.params[5][0] = -1;
  const PairResultsFile found = find("contact");
  for (size_t i = 0; i < std::size(kKnown); ++i) EXPECT_EQ(found.status[i], 3) << i;
}

}  // namespace
}  // namespace carom::cli
