// Height fields in files.
#include <cmath>
#include <functional>

#include "io/pairs_file.h"
#include "io/shape_arrays.h"
#include "tests/io/io_test_util.h"
#include "tests/support/special_floats.h"

namespace carom::io {
namespace {

using test::kNan;

using ::testing::HasSubstr;

// A sphere, and a height field of 3 x 2 samples; others may have more.
SceneShapes two_shapes() {
  SceneShapes shapes;
  shapes.kind = {0, 12};
  shapes.params = {{1}, {3, 2, 0.5f, 1}};
  shapes.height_range = {{0, 0}, {2, 6}};
  shapes.heights = {8, 9, 1, kNan, 3, 4, 5, 6};
  return shapes;
}

std::string error_after(const std::function<void(SceneShapes&)>& change) {
  SceneShapes shapes = two_shapes();
  change(shapes);
  return message_of(check_shapes(shapes, "F"));
}

using HeightFieldArraysTest = TemporaryFolder;

TEST_F(HeightFieldArraysTest, PairsFilesKeepThem) {
  PairsFile written;
  written.pairs = 1;
  written.shapes = two_shapes();
  for (PairSide* side : {&written.a, &written.b}) {
    side->shape = {1};
    side->position32 = {{0, 0, 0}};
  }
  ASSERT_TRUE(succeeds(write_pairs(path("p.npz"), written)));
  const auto read = read_pairs(path("p.npz"));
  ASSERT_TRUE(succeeds(read));
  EXPECT_EQ(read->shapes.kind, written.shapes.kind);
  EXPECT_EQ(read->shapes.params, written.shapes.params);
  EXPECT_EQ(read->shapes.height_range, written.shapes.height_range);
  EXPECT_EQ(raw(read->shapes.heights), raw(written.shapes.heights));  // holes are kept
}

TEST_F(HeightFieldArraysTest, RangesLieInsideTheHeights) {
  EXPECT_EQ(error_after([](SceneShapes&) {}), "");
  EXPECT_EQ(error_after([](SceneShapes& s) { s.height_range[1][0] = 3; }),
            "F: member shape_height_range: element 1 is first 3, count 6 (a range inside 8 "
            "elements was expected)");
  EXPECT_THAT(error_after([](SceneShapes& s) {
                s.height_range[0] = {UINT32_MAX, UINT32_MAX};
              }),
              HasSubstr("element 0 is first 4294967295, count 4294967295"));
  EXPECT_EQ(error_after([](SceneShapes& s) { s.height_range.clear(); }),
            "F: member shape_height_range: is missing (shape 1 of kind 12 needs it)");
  EXPECT_THAT(error_after([](SceneShapes& s) { s.height_range.pop_back(); }),
              HasSubstr("member shape_height_range: holds 1 elements (2 were expected)"));
  EXPECT_THAT(error_after([](SceneShapes& s) { s.heights.clear(); }),
              HasSubstr("a range inside 0 elements"));
  EXPECT_THAT(error_after([](SceneShapes& s) {
                s.heights.resize(1 << 20);
                s.kind.assign(200, 12);
                s.params.assign(200, {1024, 1024, 1, 1});
                s.height_range.assign(200, {0, 1 << 20});
              }),
              HasSubstr("shape_height_range: names 209715200 elements of 1048576"));
}

TEST_F(HeightFieldArraysTest, GridsHaveAsManySamplesAsHeights) {
  EXPECT_EQ(error_after([](SceneShapes& s) { s.height_range[1][1] = 5; }),
            "F: member shape_height_range: element 1 has count 5 (6 for 3 x 2 samples was "
            "expected)");
  EXPECT_THAT(error_after([](SceneShapes& s) { s.params[1][1] = 3; }),
              HasSubstr("has count 6 (9 for 3 x 3 samples"));
  EXPECT_THAT(error_after([](SceneShapes& s) {
                s.params[1] = {0x1p22f, 0x1p22f, 1, 1};
              }),
              HasSubstr("has count 6 (17592186044416 for 4194304 x 4194304 samples"));
  EXPECT_EQ(error_after([](SceneShapes& s) { s.params[1][0] = 2.5f; }),
            "F: member shape_params: element 1 is a height field of 2.5 x 2 samples (whole numbers "
            "from 2 to 4194304 were expected)");
  for (const float bad : {0.0f, 1.0f, -2.0f, 4194305.0f, 1e30f, INFINITY, -INFINITY, kNan}) {
    for (const size_t side : {0, 1}) {
      EXPECT_THAT(error_after([&](SceneShapes& s) { s.params[1][side] = bad; }),
                  HasSubstr("member shape_params: element 1 is a height field of "))
          << bad;
    }
  }
}

TEST_F(HeightFieldArraysTest, BadMembersAreNamed) {
  const auto error_with = [&](const std::string& header, const std::string& values) {
    const SceneShapes shapes = two_shapes();
    write_zip(
        path("bad.npz"),
        {{"shape_kind.npy",
          npy_bytes("{'descr': '|u1', 'fortran_order': False, 'shape': (2,)}", raw(shapes.kind))},
         {"shape_params.npy", npy_bytes("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 8)}",
                                        raw(shapes.params))},
         {"shape_height_range.npy",
          npy_bytes("{'descr': '<u4', 'fortran_order': False, 'shape': (2, 2)}",
                    raw(shapes.height_range))},
         {"heights.npy", npy_bytes("{" + header + "}", values)}},
        true);
    const auto reader = NpzReader::open(path("bad.npz"));
    EXPECT_TRUE(succeeds(reader));
    return message_of(read_shapes(*reader));
  };
  const std::string eight = raw(two_shapes().heights);
  EXPECT_EQ(error_with("'descr': '<f4', 'fortran_order': False, 'shape': (8,)", eight), "");
  EXPECT_THAT(error_with("'descr': '<f4', 'fortran_order': False, 'shape': (9,)", eight),
              HasSubstr("member heights"));
  EXPECT_THAT(
      error_with("'descr': '<f4', 'fortran_order': False, 'shape': (2305843009213693951,)", eight),
      HasSubstr("member heights"));
  EXPECT_THAT(error_with("'descr': '<f4', 'fortran_order': False, 'shape': (4, 2)", eight),
              HasSubstr("member heights: has shape (4, 2) (float32 (any,) was expected)"));
  EXPECT_THAT(error_with("'descr': '<f8', 'fortran_order': False, 'shape': (4,)", eight),
              HasSubstr("member heights: has dtype float64"));
}

}  // namespace
}  // namespace carom::io
