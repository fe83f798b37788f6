#include "io/recording.h"

#include <cmath>

#include "tests/io/io_test_util.h"
#include "tests/support/special_floats.h"

namespace carom::io {
namespace {

using test::kNan;

using ::testing::HasSubstr;

class RecordingTest : public TemporaryFolder {
 protected:
  // `bodies` boxes; box i of frame f is the cube that starts at 10 f + i.
  static std::vector<float> boxes_of(size_t frame, size_t bodies) {
    std::vector<float> boxes;
    for (size_t i = 0; i < bodies; ++i) {
      const float low = static_cast<float>(10 * frame + i);
      boxes.insert(boxes.end(), {low, low, low, 0, low + 1, low + 1, low + 1, 0});
    }
    return boxes;
  }

  std::string write_recording(size_t frames, size_t bodies) {
    auto writer = RecordingWriter::create(path("r.aabb"), "Scene", "Cubes", bodies);
    EXPECT_TRUE(succeeds(writer));
    for (size_t f = 0; f < frames; ++f) {
      EXPECT_TRUE(succeeds(writer->write_frame(boxes_of(f, bodies))));
    }
    EXPECT_TRUE(succeeds(writer->finish()));
    return path("r.aabb");
  }

  std::string error_of(const std::string& bytes) {
    return message_of(RecordingReader::open(write_file("bad.aabb", bytes)));
  }
};

TEST_F(RecordingTest, ReadsWhatItWritesAndWrapsAround) {
  auto reader = RecordingReader::open(write_recording(3, 2));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_EQ(reader->info().name, "Scene");
  EXPECT_EQ(reader->info().object_type, "Cubes");
  EXPECT_EQ(reader->info().bodies, 2u);
  EXPECT_EQ(reader->info().frames, 3u);
  EXPECT_EQ(reader->info().world, (std::array<float, 8>{0, 0, 0, 0, 22, 22, 22, 0}));
  EXPECT_EQ(read_file("r.aabb").size(), 304u + 32 * 2 * 3);
  std::vector<float> boxes;
  for (size_t f = 0; f < 7; ++f) {
    ASSERT_TRUE(succeeds(reader->read_frame(boxes)));
    EXPECT_EQ(boxes, boxes_of(f % 3, 2));
  }
}

TEST_F(RecordingTest, EveryOtherSizeIsAnError) {
  write_recording(2, 2);
  const std::string whole = read_file("r.aabb");
  EXPECT_THAT(error_of(whole.substr(0, 303)),
              HasSubstr("bad.aabb: is truncated: has 303 bytes (a header of 304 was expected)"));
  EXPECT_EQ(error_of(whole.substr(0, 400)),
            path("bad.aabb") + ": has 400 bytes (304 + 32 * 2 bodies * 2 frames were expected)");
  for (size_t size = 1; size < whole.size(); ++size) {
    EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
  }
  EXPECT_NE(error_of(whole + '\0'), "");
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
}

TEST_F(RecordingTest, NumbersThatCannotBeAreErrors) {
  write_recording(1, 1);
  const std::string whole = read_file("r.aabb");
  const auto with = [&](size_t offset, int32_t value) {
    std::string bytes = whole;
    bytes.replace(offset, 4, reinterpret_cast<const char*>(&value), 4);
    return bytes;
  };
  EXPECT_THAT(error_of(with(256, -1)), HasSubstr("header holds -1 bodies and 0 frames"));
  EXPECT_THAT(error_of(with(260, -2)), HasSubstr("header holds 1 bodies and -2 frames"));
  EXPECT_THAT(error_of(with(256, INT32_MAX)), HasSubstr("has 336 bytes"));
  EXPECT_THAT(error_of(with(260, INT32_MAX)), HasSubstr("2147483648 frames were expected"));
}

TEST_F(RecordingTest, StrangeBoxesPassButNotAFrameOfThem) {
  auto writer = RecordingWriter::create(path("nan.aabb"), "", "", 2);
  const std::vector<float> half = {kNan, 0, 0, 0, 1, 1, 1, 0, 5, 5, 5, 0, 4, 4, 4, 0};
  const std::vector<float> none = {kNan, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, INFINITY, 1, 1, 0};
  ASSERT_TRUE(succeeds(writer->write_frame(half)));
  ASSERT_TRUE(succeeds(writer->write_frame(none)));
  ASSERT_TRUE(succeeds(writer->finish()));
  auto reader = RecordingReader::open(path("nan.aabb"));
  std::vector<float> boxes;
  ASSERT_TRUE(succeeds(reader->read_frame(boxes)));
  EXPECT_EQ(raw(boxes), raw(half));
  EXPECT_EQ(message_of(reader->read_frame(boxes)),
            path("nan.aabb") + ": frame 1 holds no finite box (at least one was expected)");
}

TEST_F(RecordingTest, FileThatShrinksIsAnError) {
  auto reader = RecordingReader::open(write_recording(3, 2));
  std::filesystem::resize_file(path("r.aabb"), 304 + 64 + 10);
  std::vector<float> boxes;
  EXPECT_TRUE(succeeds(reader->read_frame(boxes)));
  EXPECT_THAT(message_of(reader->read_frame(boxes)), HasSubstr("r.aabb: is truncated"));
}

TEST_F(RecordingTest, WriterRefusesWhatCannotBeAndLeavesNothing) {
  {
    auto writer = RecordingWriter::create(path("x.aabb"), "", "", 2);
    EXPECT_THAT(message_of(writer->write_frame(boxes_of(0, 1))),
                HasSubstr("frame 0 holds 8 floats"));
    EXPECT_THAT(message_of(writer->finish()), HasSubstr("cannot hold 0 frames"));
  }
  EXPECT_THAT(message_of(RecordingWriter::create(path("x.aabb"), "", "", uint64_t{1} << 31)),
              HasSubstr("cannot hold 2147483648 bodies"));
  EXPECT_TRUE(entries().empty());
}

TEST_F(RecordingTest, LongNamesAreCut) {
  auto writer = RecordingWriter::create(path("x.aabb"), std::string(300, 'n'), "", 0);
  ASSERT_TRUE(succeeds(writer->write_frame({})));
  ASSERT_TRUE(succeeds(writer->finish()));
  auto reader = RecordingReader::open(path("x.aabb"));
  EXPECT_EQ(reader->info().name, std::string(127, 'n'));
  std::vector<float> boxes;
  EXPECT_TRUE(succeeds(reader->read_frame(boxes)));
}

}  // namespace
}  // namespace carom::io
