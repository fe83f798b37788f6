#include "io/files/npz.h"

#include <sys/stat.h>

#include <numeric>

#include "tests/io/io_test_util.h"

namespace carom::io {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class NpzTest : public TemporaryFolder {
 protected:
  // The error of reading member "x", made of `dict` and `data`, as float32 (any, 3).
  std::string error_of(const std::string& dict, const std::string& data) {
    write_zip(path("bad.npz"), {{"x.npy", npy_bytes(dict, data)}}, true);
    const auto reader = NpzReader::open(path("bad.npz"));
    EXPECT_TRUE(succeeds(reader));
    return message_of(reader->read<std::array<float, 3>>("x", {kAny}));
  }

  // Two arrays: one is added whole, the other in portions.
  void write_two(const std::string& name, Compression compression) {
    auto writer = NpzWriter::create(path(name), compression);
    ASSERT_TRUE(succeeds(writer));
    ASSERT_TRUE(succeeds(writer->add("first", first_)));
    const auto member = writer->begin("second", DType::kFloat32, {5});
    ASSERT_TRUE(succeeds(member));
    for (size_t i = 0; i < second_.size(); i += 25) {
      ASSERT_TRUE(
          succeeds(writer->append(*member, std::as_bytes(std::span(second_).subspan(i, 25)))));
    }
    ASSERT_TRUE(succeeds(writer->finish()));
  }

  void SetUp() override { std::iota(second_.begin(), second_.end(), 0.5f); }

  std::vector<std::array<double, 2>> first_ = {{1, 2}, {3, 4}, {5, 6}};
  std::vector<float> second_ = std::vector<float>(50000);
};

TEST_F(NpzTest, ReadsWhatItWrites) {
  for (const Compression compression : {Compression::kStored, Compression::kDeflated}) {
    write_two("two.npz", compression);
    EXPECT_EQ(entries(), std::vector<std::string>{"two.npz"});
    const auto reader = NpzReader::open(path("two.npz"));
    ASSERT_TRUE(succeeds(reader));
    EXPECT_EQ(reader->members(), (std::vector<std::string>{"first", "second"}));
    const auto first = reader->read<std::array<double, 2>>("first", {3});
    ASSERT_TRUE(succeeds(first));
    EXPECT_EQ(*first, first_);
    EXPECT_EQ(reader->header("second")->shape, (Shape{10000, 5}));
    const auto second = reader->read<float>("second", {kAny, 5});
    ASSERT_TRUE(succeeds(second));
    EXPECT_EQ(*second, second_);
  }
}

TEST_F(NpzTest, TheSameArraysMakeTheSameFile) {
  write_two("a.npz", Compression::kDeflated);
  write_two("b.npz", Compression::kDeflated);
  EXPECT_EQ(read_file("a.npz"), read_file("b.npz"));
}

TEST_F(NpzTest, StreamsInterleaveAndRewind) {
  for (const Compression compression : {Compression::kStored, Compression::kDeflated}) {
    write_two("two.npz", compression);
    const auto reader = NpzReader::open(path("two.npz"));
    ASSERT_TRUE(succeeds(reader));
    auto one = reader->stream("second");
    auto other = reader->stream("second");
    ASSERT_TRUE(one && other);
    std::vector<float> piece(100);
    for (int round = 0; round < 2; ++round) {
      for (size_t i = 0; i < second_.size(); i += piece.size()) {
        for (NpzStream* stream : {&*one, &*other}) {
          ASSERT_TRUE(succeeds(stream->read(std::as_writable_bytes(std::span(piece)))));
          ASSERT_TRUE(std::equal(piece.begin(), piece.end(), second_.begin() + i));
        }
      }
      EXPECT_EQ(one->bytes_left(), 0u);
      EXPECT_THAT(message_of(one->read(std::as_writable_bytes(std::span(piece)))),
                  HasSubstr("two.npz: member second: ends 400 bytes before what was asked"));
      ASSERT_TRUE(succeeds(one->rewind()));
      ASSERT_TRUE(succeeds(other->rewind()));
    }
  }
}

TEST_F(NpzTest, KeepsArraysWithoutElements) {
  auto writer = NpzWriter::create(path("empty.npz"));
  ASSERT_TRUE(succeeds(writer));
  ASSERT_TRUE(succeeds(writer->add("none", std::vector<std::array<float, 3>>{})));
  const auto frames = writer->begin("frames", DType::kFloat32, {0, 3});
  ASSERT_TRUE(succeeds(writer->append(*frames, {})));
  ASSERT_TRUE(succeeds(writer->append(*frames, {})));
  ASSERT_TRUE(succeeds(writer->finish()));
  const auto reader = NpzReader::open(path("empty.npz"));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_TRUE((reader->read<std::array<float, 3>>("none", {kAny}))->empty());
  EXPECT_EQ(reader->header("frames")->shape, (Shape{2, 0, 3}));
}

TEST_F(NpzTest, RefusesWrongTypesAndShapes) {
  const std::string data(24, '\0');
  EXPECT_EQ(error_of("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3)}", data),
            path("bad.npz") + ": member x: has dtype float64 (float32 (any, 3) was expected)");
  EXPECT_EQ(error_of("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2)}", data),
            path("bad.npz") + ": member x: has shape (3, 2) (float32 (any, 3) was expected)");
  EXPECT_EQ(error_of("{'descr': '<f4', 'fortran_order': False, 'shape': (6,)}", data),
            path("bad.npz") + ": member x: has shape (6,) (float32 (any, 3) was expected)");
  EXPECT_EQ(
      error_of("{'descr': '>f4', 'fortran_order': False, 'shape': (2, 3)}", data),
      path("bad.npz") + ": member x: has the big-endian dtype '>f4' (little endian was expected)");
  EXPECT_EQ(error_of("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3)}", data),
            path("bad.npz") + ": member x: is in Fortran order (C order was expected)");
}

TEST_F(NpzTest, RefusesWrongSizes) {
  const std::string dict = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3)}";
  EXPECT_THAT(error_of(dict, std::string(23, '\0')),
              HasSubstr("member x: holds 23 bytes of data (24 bytes were expected for shape"));
  EXPECT_THAT(error_of(dict, std::string(25, '\0')), HasSubstr("holds 25 bytes of data"));
  EXPECT_THAT(
      error_of("{'descr': '<f4', 'fortran_order': False, 'shape': (4611686018427387904, 3)}",
               std::string(24, '\0')),
      HasSubstr("member x: is absurdly large: shape (4611686018427387904, 3)"));
  EXPECT_THAT(error_of("{'descr': '<f4', 'fortran_order': False, 'shape': (100000000000, 3)}",
                       std::string(24, '\0')),
              HasSubstr("holds 24 bytes of data (1200000000000 bytes were expected"));
}

TEST_F(NpzTest, RefusesWhatIsNoArray) {
  write_zip(path("bad.npz"),
            {{"text.npy", "this is no array"}, {"short.npy", "short"}, {"other.txt", "ignored"}},
            false);
  const auto reader = NpzReader::open(path("bad.npz"));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_EQ(reader->members(), (std::vector<std::string>{"text", "short"}));
  EXPECT_THAT(message_of(reader->header("text")), HasSubstr("member text: is not a .npy array"));
  EXPECT_THAT(message_of(reader->header("short")), HasSubstr("member short: is too short"));
  EXPECT_EQ(message_of(reader->read<float>("none", {3})),
            path("bad.npz") + ": member none: is missing (float32 (3,) was expected)");
}

TEST_F(NpzTest, ErrorsStayOnOneLine) {
  write_zip(path("bad.npz"), {{"a\nb.npy", "this is no array"}}, false);
  const auto reader = NpzReader::open(path("bad.npz"));
  ASSERT_TRUE(succeeds(reader));
  EXPECT_THAT(message_of(reader->header("a\nb")), HasSubstr("member a\\x0ab: is not"));
}

TEST_F(NpzTest, RefusesFilesThatAreNoArchive) {
  EXPECT_EQ(message_of(NpzReader::open(write_file("empty.npz", ""))),
            path("empty.npz") + ": is empty (a .npz archive was expected)");
  EXPECT_THAT(message_of(NpzReader::open(write_file("text.npz", "hello, world\n"))),
              StartsWith(path("text.npz") + ": is not a readable zip archive: "));
  EXPECT_EQ(message_of(NpzReader::open(path(""))),
            path("") + ": is a directory (a .npz archive was expected)");
  EXPECT_EQ(message_of(NpzReader::open(path("none.npz"))),
            path("none.npz") + ": cannot be opened: No such file or directory");
  ASSERT_EQ(::mkfifo(path("pipe.npz").c_str(), 0600), 0);
  EXPECT_THAT(message_of(NpzReader::open(path("pipe.npz"))), HasSubstr("is not a regular file"));
}

TEST_F(NpzTest, EveryTruncationIsAnError) {
  auto writer = NpzWriter::create(path("small.npz"));
  ASSERT_TRUE(succeeds(writer->add("x", first_)));
  ASSERT_TRUE(succeeds(writer->finish()));
  const std::string whole = read_file("small.npz");
  for (size_t size = 1; size < whole.size(); ++size) {
    EXPECT_THAT(message_of(NpzReader::open(write_file("cut.npz", whole.substr(0, size)))),
                StartsWith(path("cut.npz") + ": "))
        << size;
  }
}

TEST_F(NpzTest, DamagedDataAreAnError) {
  for (const Compression compression : {Compression::kStored, Compression::kDeflated}) {
    write_two("two.npz", compression);
    std::string bytes = read_file("two.npz");
    bytes[bytes.size() / 2] ^= 0x10;
    const auto reader = NpzReader::open(write_file("damaged.npz", bytes));
    ASSERT_TRUE(succeeds(reader));
    EXPECT_TRUE(succeeds(reader->read<std::array<double, 2>>("first", {3})));
    EXPECT_THAT(message_of(reader->read<float>("second", {kAny, 5})),
                StartsWith(path("damaged.npz") + ": member second: "));
  }
}

// Sets a little-endian field of every central directory entry, at `offset` in the entry.
void patch_directory(std::string& zip, size_t offset, uint32_t value) {
  for (size_t i = zip.find("PK\1\2"); i != std::string::npos; i = zip.find("PK\1\2", i + 1)) {
    for (size_t k = 0; k < 4; ++k) zip[i + offset + k] = static_cast<char>(value >> (8 * k));
  }
}

TEST_F(NpzTest, DirectoryThatLiesAboutSizesIsAnError) {
  for (const Compression compression : {Compression::kStored, Compression::kDeflated}) {
    write_two("two.npz", compression);
    std::string bytes = read_file("two.npz");
    patch_directory(bytes, 24, 0xfffffff0);  // the uncompressed size
    EXPECT_THAT(message_of(NpzReader::open(write_file("liar.npz", bytes))),
                HasSubstr("liar.npz: member first: is absurdly large: it claims 4294967280 bytes"));
  }
}

TEST_F(NpzTest, RepeatedMembersAreAnError) {
  std::string bytes;
  write_zip(path("twice.npz"), {{"aa.npy", "x"}, {"ab.npy", "y"}}, false);
  bytes = read_file("twice.npz");
  for (size_t i = bytes.find("ab.npy"); i != std::string::npos; i = bytes.find("ab.npy")) {
    bytes[i + 1] = 'a';
  }
  EXPECT_THAT(message_of(NpzReader::open(write_file("twice.npz", bytes))),
              StartsWith(path("twice.npz") + ": "));
}

TEST_F(NpzTest, UnfinishedWritersLeaveNothing) {
  {
    auto writer = NpzWriter::create(path("x.npz"));
    ASSERT_TRUE(succeeds(writer->add("first", first_)));
    const auto member = writer->begin("second", DType::kFloat32, {5});
    ASSERT_TRUE(succeeds(writer->append(*member, std::as_bytes(std::span(second_)))));
  }
  EXPECT_TRUE(entries().empty());
}

TEST_F(NpzTest, FailedWritersLeaveTheOldFile) {
  write_file("x.npz", "old");
  {
    auto writer = NpzWriter::create(path("x.npz"));
    const auto member = writer->begin("x", DType::kFloat32, {5});
    ASSERT_TRUE(succeeds(writer->append(*member, std::as_bytes(std::span(first_)).first(10))));
    EXPECT_THAT(message_of(writer->finish()),
                HasSubstr("member x: holds 10 bytes, which is no whole number of rows"));
  }
  EXPECT_EQ(entries(), std::vector<std::string>{"x.npz"});
  EXPECT_EQ(read_file("x.npz"), "old");
}

TEST_F(NpzTest, WriterRefusesWhatCannotBe) {
  auto writer = NpzWriter::create(path("x.npz"));
  EXPECT_THAT(message_of(writer->finish()), HasSubstr("x.npz: would hold no array"));
  ASSERT_TRUE(succeeds(writer->add("x", first_)));
  EXPECT_THAT(message_of(writer->add("x", first_)), HasSubstr("member x: is added twice"));
  EXPECT_THAT(message_of(writer->add("y", std::span<const float>(second_), {3})),
              HasSubstr("member y: holds 200000 bytes, which is not shape (3,) of float32"));
  EXPECT_THAT(message_of(NpzWriter::create(path(""))), HasSubstr("is not the name of a file"));
  std::filesystem::create_directory(path("folder"));
  EXPECT_THAT(message_of(NpzWriter::create(path("folder"))), HasSubstr("is a directory"));
  EXPECT_THAT(message_of(NpzWriter::create(path("none/x.npz"))),
              HasSubstr("cannot be created: No such file or directory"));
  EXPECT_THAT(message_of(NpzWriter::create("/dev/null")), HasSubstr("is not a regular file"));
}

TEST_F(NpzTest, UnwritableFoldersStayEmpty) {
  std::filesystem::create_directory(path("closed"));
  using std::filesystem::perms;
  std::filesystem::permissions(path("closed"), perms::owner_read | perms::owner_exec);
  // The superuser may write anywhere, so the test drops to nobody for a moment.
  constexpr uid_t kNobody = 65534;
  const bool superuser = ::geteuid() == 0;
  std::filesystem::permissions(path(""), perms::others_exec, std::filesystem::perm_options::add);
  ASSERT_TRUE(!superuser || ::seteuid(kNobody) == 0);
  const std::string message = message_of(NpzWriter::create(path("closed/x.npz")));
  ASSERT_TRUE(!superuser || ::seteuid(0) == 0);
  EXPECT_THAT(message, HasSubstr("cannot be created: Permission denied"));
  EXPECT_TRUE(std::filesystem::is_empty(path("closed")));
}

}  // namespace
}  // namespace carom::io
