#include "io/files/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/io_test_util.h"

namespace carom::io {
namespace {

TEST(NpyHeader, ParsesWhatNumpyWrites) {
  const auto header =
      parse_npy_dict("{'descr': '<f4', 'fortran_order': False, 'shape': (30, 2029, 3), }   \n");
  ASSERT_TRUE(succeeds(header));
  EXPECT_EQ(header->dtype, DType::kFloat32);
  EXPECT_FALSE(header->fortran_order);
  EXPECT_EQ(header->shape, (Shape{30, 2029, 3}));
}

TEST(NpyHeader, ParsesAnyOrderQuotesAndRanks) {
  const auto scalar = parse_npy_dict("{\"shape\":(),\"fortran_order\":True,\"descr\":\"|u1\"}");
  ASSERT_TRUE(succeeds(scalar));
  EXPECT_TRUE(scalar->shape.empty());
  EXPECT_TRUE(scalar->fortran_order);
  const auto row = parse_npy_dict("{'descr': '<i8', 'fortran_order': False, 'shape': (7,)}");
  ASSERT_TRUE(succeeds(row));
  EXPECT_EQ(row->shape, Shape{7});
}

TEST(NpyHeader, PrintsWhatItParses) {
  for (const DType dtype : {DType::kUint8, DType::kInt32, DType::kUint32, DType::kUint64,
                            DType::kFloat32, DType::kFloat64}) {
    for (const Shape& shape : {Shape{}, Shape{0}, Shape{5}, Shape{1, 2, 3}}) {
      for (const size_t min_bytes : {0, 256}) {
        const std::string text = print_npy_header({dtype, false, shape}, min_bytes);
        EXPECT_EQ(text.size() % 64, 0u);
        EXPECT_GE(text.size(), min_bytes);
        EXPECT_EQ(text.back(), '\n');
        const auto prefix = parse_npy_prefix(std::as_bytes(std::span(text.data(), text.size())));
        ASSERT_TRUE(succeeds(prefix));
        ASSERT_EQ(prefix->text_begin + prefix->text_bytes, text.size());
        const auto header = parse_npy_dict(text.substr(prefix->text_begin));
        ASSERT_TRUE(succeeds(header));
        EXPECT_EQ(header->dtype, dtype);
        EXPECT_EQ(header->shape, shape);
      }
    }
  }
}

TEST(NpyHeader, RefusesBigEndian) {
  EXPECT_EQ(message_of(parse_npy_dict("{'descr': '>f4', 'fortran_order': False, 'shape': (1,)}")),
            "has the big-endian dtype '>f4' (little endian was expected)");
  EXPECT_TRUE(succeeds(parse_npy_dict("{'descr': '>u1', 'fortran_order': False, 'shape': (1,)}")));
}

TEST(NpyHeader, RefusesWhatIsNoHeader) {
  const char* bad[] = {
      "",
      "{",
      "{}",
      "[]",
      "{'descr': '<f4', 'fortran_order': False}",
      "{'descr': '<f4', 'fortran_order': Maybe, 'shape': (1,)}",
      "{'descr': '<U5', 'fortran_order': False, 'shape': (1,)}",
      "{'descr': '', 'fortran_order': False, 'shape': (1,)}",
      "{'descr': '!f4', 'fortran_order': False, 'shape': (1,)}",
      "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (1)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': 1}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (-1,)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (1.5,)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999,)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (18446744073709551615,)}",
      "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (1,)}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (1,), 'more': 1}",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (1,)} more",
      "{'descr': '<f4', 'fortran_order': False, 'shape': (1,)",
      "{'descr: <f4",
  };
  for (const char* text : bad) {
    EXPECT_THAT(message_of(parse_npy_dict(text)), ::testing::HasSubstr("bad .npy header")) << text;
  }
}

TEST(NpyHeader, CountsBytesWithoutOverflow) {
  EXPECT_EQ(*npy_data_bytes({DType::kFloat64, false, {3, 5}}), 120u);
  EXPECT_EQ(*npy_data_bytes({DType::kFloat64, false, {}}), 8u);
  EXPECT_EQ(*npy_data_bytes({DType::kFloat64, false, {UINT64_MAX - 1, 0, UINT64_MAX - 1}}), 0u);
  for (const Shape& shape : {Shape{1ull << 62}, Shape{1ull << 32, 1ull << 32}, Shape{1ull << 61, 3},
                             Shape{UINT64_MAX - 1, UINT64_MAX - 1}}) {
    EXPECT_THAT(message_of(npy_data_bytes({DType::kFloat32, false, shape})),
                ::testing::HasSubstr("is absurdly large"));
  }
}

TEST(NpyPrefix, KnowsVersionsOneToThree) {
  const auto prefix_of = [](const std::string& text) {
    return parse_npy_prefix(std::as_bytes(std::span(text.data(), text.size())));
  };
  EXPECT_EQ(prefix_of(npy_bytes(std::string(300, ' '), ""))->text_bytes, 300u);
  EXPECT_EQ(prefix_of(npy_bytes(std::string(300, ' '), "", 2))->text_begin, 12u);
  EXPECT_EQ(prefix_of(npy_bytes(std::string(300, ' '), "", 3))->text_bytes, 300u);
  EXPECT_THAT(message_of(prefix_of(npy_bytes("  ", "", 4))), ::testing::HasSubstr("version 4"));
  EXPECT_THAT(message_of(prefix_of("NUMPY is not here")), ::testing::HasSubstr("magic"));
  std::string huge = npy_bytes(std::string(4, ' '), "", 2);
  huge[11] = '\x7f';
  EXPECT_THAT(message_of(prefix_of(huge)), ::testing::HasSubstr("its length is"));
}

}  // namespace
}  // namespace carom::io
