#include "io/pairs_file.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "carom/results/result_arrays.h"
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
  ResultArrays results(2, Detail::manifold, {ColumnRole::sub_shape});
  const ResultColumns& columns = results.columns();
  columns.overlap[0] = 1;
  columns.separation[1] = kNan;
  columns.normal[2][1] = 3;
  columns.status[1] = 3;
  columns.manifold_count[1] = 2;
  columns.manifold[1].point[1] = {1, 2, 5};
  columns.manifold[1].separation[1] = -4;
  columns.sub_b[1] = 7;
  const std::vector<float> toi = {0.5f, 1};
  ASSERT_TRUE(succeeds(write_pair_results(path("r.npz"), 2, columns, toi.data())));
  const auto reader = NpzReader::open(path("r.npz"));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_EQ(reader->members(),
            (std::vector<std::string>{"overlap", "status", "separation", "normal", "point_a",
                                      "point_b", "manifold_count", "manifold_point",
                                      "manifold_separation", "sub_a", "sub_b", "toi"}));
  EXPECT_EQ(*reader->read<uint8_t>("overlap", {2}), (std::vector<uint8_t>{1, 0}));
  EXPECT_EQ(*reader->read<uint8_t>("status", {2}), (std::vector<uint8_t>{0, 3}));
  EXPECT_EQ(raw(*reader->read<float>("separation", {2})), raw(std::vector<float>{0, kNan}));
  EXPECT_EQ(reader->read<float>("normal", {2, 3})->back(), 3);
  const std::vector<float> points = *reader->read<float>("manifold_point", {2, 4, 3});
  EXPECT_TRUE(std::isnan(points[0]));
  EXPECT_EQ(points[12 + 5], 5);
  EXPECT_TRUE(std::isnan(points.back()));
  EXPECT_EQ((*reader->read<float>("manifold_separation", {2, 4}))[5], -4);
  EXPECT_EQ(*reader->read<uint32_t>("sub_b", {2}), (std::vector<uint32_t>{0, 7}));
  EXPECT_EQ(*reader->read<float>("toi", {2}), toi);
}

TEST_F(PairsTest, ColumnsThatAreNotThereAreNotInTheFile) {
  ResultArrays results(2, Detail::overlap);
  ASSERT_TRUE(succeeds(write_pair_results(path("r.npz"), 2, results.columns())));
  EXPECT_EQ(NpzReader::open(path("r.npz"))->members(),
            (std::vector<std::string>{"overlap", "status"}));
  EXPECT_THAT(message_of(write_pair_results(path("none/r.npz"), 2, results.columns())),
              HasSubstr("none/r.npz: cannot be created"));
}

// Every column that files of results have is in the page of formats.
TEST_F(PairsTest, FormatsNameEveryColumn) {
  std::ifstream page(std::string(CAROM_TEST_DATA_DIR) + "/../../docs/formats.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  ASSERT_THAT(text, HasSubstr("`overlap`"));
  for_each_result(
      [&](const ColumnInfo& info, const auto&) {
        const bool is_member = info.role != ColumnRole::bound && info.role != ColumnRole::memory &&
                               info.role != ColumnRole::name;
        if (!is_member) return;
        const bool is_two = info.name == std::string("manifold");
        EXPECT_THAT(text, HasSubstr("`" + std::string(info.name) + (is_two ? "_point`" : "`")));
      },
      ResultColumns());
}

TEST_F(PairsTest, NoPairsAreAFileToo) {
  PairsFile none;
  ASSERT_TRUE(succeeds(write_pairs(path("p.npz"), none)));
  const auto pairs = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(pairs));
  EXPECT_EQ(pairs->pairs, 0u);
  EXPECT_TRUE(
      succeeds(write_pair_results(path("r.npz"), 0, ResultArrays(0, Detail::overlap).columns())));
  const auto results = NpzReader::open(path("r.npz"));
  ASSERT_TRUE(succeeds(results));
  EXPECT_EQ(results->members(),
            (std::vector<std::string>{
                "overlap", "status", "separation", "normal", "point_a", "point_b", "manifold_count",
                "manifold_point", "manifold_separation", "sub_a", "sub_b", "toi", "region_first",
                "region_normal", "region_separation", "region_part", "region_point_count",
                "region_point", "region_point_separation"}));
  EXPECT_EQ(*results->read<uint64_t>("region_first", {1}), std::vector<uint64_t>{0});
  EXPECT_TRUE(results->read<float>("manifold_point", {0, 4, 3})->empty());
  EXPECT_TRUE((results->read<std::array<float, 3>>("normal", {0})->empty()));
}

}  // namespace
}  // namespace carom::io
