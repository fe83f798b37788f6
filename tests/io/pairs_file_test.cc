#include "io/pairs_file.h"

#include <cmath>

#include "tests/io/io_test_util.h"
#include "tests/support/special_floats.h"

namespace carom::io {
namespace {

using test::kNan;

using ::testing::HasSubstr;

PairsFile two_pairs() {
  PairsFile pairs;
  pairs.pairs = 2;
  pairs.shapes.kind = {0, 2};
  pairs.shapes.params = {{1}, {1, 2, 3}};
  pairs.a.shape = {0, 1};
  pairs.b.shape = {1, 1};
  pairs.a.position32 = {{1, 2, 3}, {4, 5, 6}};
  pairs.b.position32 = {{7, 8, 9}, {kNan, INFINITY, 0}};
  return pairs;
}

class PairsTest : public TemporaryFolder {
 protected:
  std::string error_of(const PairsFile& pairs) {
    EXPECT_TRUE(succeeds(write_pairs(path("p.npz"), pairs)));
    return message_of(read_pairs(path("p.npz")));
  }
};

TEST_F(PairsTest, ReadsWhatItWrites) {
  ASSERT_TRUE(succeeds(write_pairs(path("p.npz"), two_pairs())));
  const auto pairs = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(pairs));
  EXPECT_EQ(pairs->pairs, 2u);
  EXPECT_FALSE(pairs->float64_positions);
  EXPECT_EQ(pairs->shapes.params, two_pairs().shapes.params);
  EXPECT_EQ(pairs->a.shape, two_pairs().a.shape);
  EXPECT_EQ(pairs->a.position32, two_pairs().a.position32);
  EXPECT_EQ(raw(pairs->b.position32), raw(two_pairs().b.position32));  // NaN is kept
  EXPECT_TRUE(pairs->a.orientation.empty() && pairs->b.rotation.empty());
}

TEST_F(PairsTest, ReadsMotionsAndFloat64) {
  PairsFile written = two_pairs();
  written.float64_positions = true;
  for (PairSide* side : {&written.a, &written.b}) {
    side->position64 = {{0.1, 0.2, 0.3}, {1e9, 1, 2}};
    side->orientation = {{0, 0, 0, 1}, {1, 0, 0, 0}};
    side->displacement = {{1, 0, 0}, {0, 1, 0}};
    side->rotation = {{0, 0, 1}, {0, 0, 2}};
  }
  ASSERT_TRUE(succeeds(write_pairs(path("p.npz"), written)));
  const auto pairs = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(pairs));
  EXPECT_TRUE(pairs->float64_positions);
  EXPECT_TRUE(pairs->a.position32.empty());
  EXPECT_EQ(pairs->b.position64, written.b.position64);
  EXPECT_EQ(pairs->b.orientation, written.b.orientation);
  EXPECT_EQ(pairs->b.displacement, written.b.displacement);
  EXPECT_EQ(pairs->b.rotation, written.b.rotation);
}

TEST_F(PairsTest, MixedPositionTypesBecomeFloat64) {
  auto writer = NpzWriter::create(path("p.npz"));
  ASSERT_TRUE(succeeds(write_shapes(two_pairs().shapes, *writer)));
  ASSERT_TRUE(succeeds(writer->add("pair_shape_a", std::vector<uint32_t>{0})));
  ASSERT_TRUE(succeeds(writer->add("pair_shape_b", std::vector<uint32_t>{0})));
  ASSERT_TRUE(succeeds(writer->add("position_a", std::vector<std::array<float, 3>>{{1, 2, 3}})));
  ASSERT_TRUE(succeeds(writer->add("position_b", std::vector<std::array<double, 3>>{{.1, 2, 3}})));
  ASSERT_TRUE(succeeds(writer->finish()));
  const auto pairs = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(pairs));
  EXPECT_EQ(pairs->a.position64.at(0), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(pairs->b.position64.at(0), (std::array<double, 3>{.1, 2, 3}));
}

TEST_F(PairsTest, WrongArraysAreNamed) {
  PairsFile pairs = two_pairs();
  pairs.b.shape[1] = 2;
  EXPECT_EQ(error_of(pairs),
            path("p.npz") + ": member pair_shape_b: element 1 is shape 2 (there are 2)");
  pairs = two_pairs();
  pairs.b.shape.pop_back();
  EXPECT_EQ(error_of(pairs), path("p.npz") +
                                 ": member pair_shape_b: has shape (1,) (uint32 (2,) "
                                 "was expected)");
  pairs = two_pairs();
  pairs.a.position32.pop_back();
  EXPECT_THAT(error_of(pairs), HasSubstr("member position_a: has shape (1, 3)"));
  pairs = two_pairs();
  pairs.a.orientation = {{0, 0, 0, 1}};
  EXPECT_THAT(error_of(pairs), HasSubstr("member orientation_a: has shape (1, 4)"));
  auto writer = NpzWriter::create(path("p.npz"));
  ASSERT_TRUE(succeeds(write_shapes(two_pairs().shapes, *writer)));
  ASSERT_TRUE(succeeds(writer->finish()));
  EXPECT_EQ(message_of(read_pairs(path("p.npz"))),
            path("p.npz") + ": member pair_shape_a: is missing (uint32 (any,) was expected)");
}

TEST_F(PairsTest, ResultsHoldWhatIsGiven) {
  PairResults results;
  results.pairs = 2;
  results.overlap = {1, 2};
  results.separation = {-1, kNan};
  results.manifold_point.resize(2);
  results.manifold_point[1][11] = 5;
  results.status = {0, 3};
  ASSERT_TRUE(succeeds(write_pair_results(path("r.npz"), results)));
  const auto reader = NpzReader::open(path("r.npz"));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_EQ(reader->members(),
            (std::vector<std::string>{"overlap", "separation", "manifold_point", "status"}));
  EXPECT_EQ(*reader->read<uint8_t>("overlap", {2}), results.overlap);
  EXPECT_EQ(raw(*reader->read<float>("separation", {2})), raw(results.separation));
  EXPECT_EQ(reader->read<float>("manifold_point", {2, 4, 3})->back(), 5);
}

TEST_F(PairsTest, ResultsOfTheWrongSizeLeaveNothing) {
  PairResults results;
  results.pairs = 2;
  results.overlap = {1};
  EXPECT_EQ(message_of(write_pair_results(path("r.npz"), results)),
            path("r.npz") + ": member overlap: holds 1 elements (2 were expected)");
  results.overlap = {1, 1};
  EXPECT_THAT(message_of(write_pair_results(path("none/r.npz"), results)),
              HasSubstr("none/r.npz: cannot be created"));
  EXPECT_TRUE(entries().empty());
}

TEST_F(PairsTest, NoPairsAreAFileToo) {
  PairsFile none;
  ASSERT_TRUE(succeeds(write_pairs(path("p.npz"), none)));
  const auto pairs = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(pairs));
  EXPECT_EQ(pairs->pairs, 0u);
  EXPECT_TRUE(succeeds(write_pair_results(path("r.npz"), {})));
}

}  // namespace
}  // namespace carom::io
