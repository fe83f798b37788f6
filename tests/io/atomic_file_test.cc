#include "io/files/atomic_file.h"

#include <sys/wait.h>

#include "tests/io/io_test_util.h"

namespace carom::io {
namespace {

using AtomicFileTest = TemporaryFolder;

TEST_F(AtomicFileTest, TextAppearsWhole) {
  ASSERT_TRUE(succeeds(write_text_file(path("a.json"), "{}\n")));
  EXPECT_EQ(read_file("a.json"), "{}\n");
  ASSERT_TRUE(succeeds(write_text_file(path("a.json"), "[]\n")));
  EXPECT_EQ(read_file("a.json"), "[]\n");
  EXPECT_EQ(entries(), std::vector<std::string>{"a.json"});
}

TEST_F(AtomicFileTest, AppearsOnlyWhenCommitted) {
  const std::string text = "text";
  {
    auto file = AtomicFile::create(path("a"));
    ASSERT_TRUE(succeeds(file));
    ASSERT_TRUE(succeeds(file->write(std::as_bytes(std::span(text.data(), text.size())))));
    EXPECT_FALSE(std::filesystem::exists(path("a")));
    AtomicFile moved = std::move(*file);
    EXPECT_EQ(moved.bytes_written(), 4u);
  }
  EXPECT_TRUE(entries().empty());
}

TEST_F(AtomicFileTest, TwoWritersOfOneNameDoNotMeet) {
  auto one = AtomicFile::create(path("a"));
  auto other = AtomicFile::create(path("a"));
  ASSERT_TRUE(one && other);
  EXPECT_NE(one->temporary_path(), other->temporary_path());
  ASSERT_TRUE(succeeds(one->commit()));
  ASSERT_TRUE(succeeds(other->commit()));
  EXPECT_EQ(entries(), std::vector<std::string>{"a"});
}

// More files than slots, and slots that are used again.
TEST_F(AtomicFileTest, ManyFilesLiveAtOnce) {
  for (int round = 0; round < 2; ++round) {
    std::vector<AtomicFile> files;
    for (int i = 0; i < 50; ++i) {
      auto file = AtomicFile::create(path("a" + std::to_string(i)));
      ASSERT_TRUE(succeeds(file));
      files.push_back(std::move(*file));
    }
    ASSERT_TRUE(succeeds(files.front().commit()));
  }
  EXPECT_EQ(entries(), std::vector<std::string>{"a0"});
}

// In another process, since the slots of removed files stay taken.
TEST_F(AtomicFileTest, AllTemporaryFilesAreRemovedAtOnce) {
  const pid_t child = ::fork();
  if (child == 0) {
    auto committed = AtomicFile::create(path("a"));
    auto one = AtomicFile::create(path("b"));
    auto other = AtomicFile::create(path("c"));
    const bool ready = committed && committed->commit() && one && other;
    const AtomicFile moved = std::move(*one);
    remove_temporary_files();
    ::_exit(ready ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(entries(), std::vector<std::string>{"a"});
}

TEST_F(AtomicFileTest, FailureNamesTheTarget) {
  EXPECT_EQ(message_of(write_text_file(path("none/a.json"), "x")),
            path("none/a.json") + ": cannot be created: No such file or directory");
  EXPECT_TRUE(entries().empty());
  // A folder takes the file's name while the file is being written.
  auto file = AtomicFile::create(path("a"));
  std::filesystem::create_directory(path("a"));
  EXPECT_EQ(message_of(file->commit()),
            path("a") + ": is a directory (a name for a file was expected)");
}

TEST_F(AtomicFileTest, SpoolsHaveNoName) {
  const auto spool = open_spool(path("a"));
  ASSERT_TRUE(succeeds(spool));
  EXPECT_TRUE(entries().empty());
}

TEST(Paths, AreTakenApart) {
  EXPECT_EQ(folder_of("a/b/c.npz"), "a/b/");
  EXPECT_EQ(folder_of("c.npz"), "./");
  EXPECT_EQ(stem_of("a/b.c/d.e.npz"), "d.e");
  EXPECT_EQ(stem_of("a/.hidden"), ".hidden");
  EXPECT_TRUE(has_extension("X.NPZ", ".npz"));
  EXPECT_FALSE(has_extension("npz", ".npz"));
}

}  // namespace
}  // namespace carom::io
