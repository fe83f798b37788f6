#include "io/printable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "io/files/npy.h"
#include "tests/support/rounds.h"

namespace carom::io {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Printable, KeepsWhatCanBeShown) {
  for (const char* text :
       {"", "plain text", "C:\\path\\x1b", "ä é ß", "日本語", "\xf0\x9f\x8e\xb1", "'\"`$"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable_name(text), text);
  }
  EXPECT_EQ(quoted_name("key"), "'key'");
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("a\nb\x7f"), "a\\x0ab\\x7f");
  EXPECT_EQ(printable("\x1b[2J\x1b]0;title\x07"), "\\x1b[2J\\x1b]0;title\\x07");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // CSI in UTF-8
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "txt"),
            "\\xe2\\x80\\xaetxt");                          // right to left
  EXPECT_EQ(printable("\xe2\x80\xa8"), "\\xe2\\x80\\xa8");  // line separator
  EXPECT_EQ(printable("\xef\xbb\xbf"), "\\xef\\xbb\\xbf");
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\x80"), "\\x80");
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
  EXPECT_EQ(printable("a\xff"
                      "b"),
            "a\\xffb");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");  // cut
  EXPECT_EQ(printable("\xe2"
                      "a\xac"),
            "\\xe2"
            "a\\xac");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");  // longer than need be
  EXPECT_EQ(printable("\xe0\x80\x9b"), "\\xe0\\x80\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond the last
  EXPECT_EQ(printable("\xf8\x88\x80\x80\x80"), "\\xf8\\x88\\x80\\x80\\x80");
}

TEST(Printable, ShortensNames) {
  const std::string name = "begin" + std::string(1'000'000, 'x') + "end.npz";
  const std::string shown = printable_name(name);
  EXPECT_LE(shown.size(), 240u);
  EXPECT_THAT(shown, StartsWith("begin"));
  EXPECT_THAT(shown, HasSubstr("..."));
  EXPECT_THAT(shown, EndsWith("end.npz"));
  EXPECT_EQ(printable_name(std::string(200, 'x')), std::string(200, 'x'));
  EXPECT_LE(printable_name(std::string(200, '\x1b')).size(), 240u);
  EXPECT_LE(quoted_name(std::string(5000, '\xff')).size(), 242u);
}

// Whatever the bytes: one line of visible ASCII and UTF-8, which stays as it is if shown again.
TEST(Printable, AnyBytes) {
  std::mt19937_64 random(1);
  const uint32_t count = test::rounds(20'000);
  for (uint32_t i = 0; i < count; ++i) {
    std::string bytes(random() % 300, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 4 == 0 ? 'a' : random());
    for (const std::string& shown : {printable(bytes), printable_name(bytes)}) {
      for (const char c : shown) {
        ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << shown;
      }
      ASSERT_EQ(printable(shown), shown);
    }
    ASSERT_LE(printable_name(bytes).size(), 240u);
    ASSERT_EQ(printable_name(printable_name(bytes)), printable_name(bytes));
  }
}

TEST(Printable, KeysOfABrokenHeader) {
  const auto key = parse_npy_dict("{'\x1b[2J\n': 1}");
  ASSERT_FALSE(key);
  EXPECT_THAT(key.error().message, HasSubstr("unknown or repeated key '\\x1b[2J\\x0a'"));
  const auto dtype = parse_npy_dict("{'descr': '\x1b]0;\x07'}");
  ASSERT_FALSE(dtype);
  EXPECT_THAT(dtype.error().message, HasSubstr("unknown dtype '\\x1b]0;\\x07'"));
  const auto endless = parse_npy_dict("{'" + std::string(60'000, 'k') + "': 1}");
  ASSERT_FALSE(endless);
  EXPECT_LT(endless.error().message.size(), 400u);
}

}  // namespace
}  // namespace carom::io
