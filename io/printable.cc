#include "io/printable.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace carom::io {
namespace {

constexpr size_t kLongestName = 240;  // bytes of a printable name

struct Character {
  uint32_t code = 0;
  size_t bytes = 0;  // 0: the text does not begin with a character of UTF-8
};

// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // of that many bytes
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc0 || lead >= 0xf8 || text.size() < bytes) return {};
  uint32_t code = lead & (0x7fu >> bytes);
  for (size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || code > 0x10ffff || is_surrogate) return {};
  return {code, bytes};
}

// Control and format characters that terminals obey or do not show.
bool is_hidden(uint32_t code) {
  struct Range {
    uint32_t first, last;
  };
  constexpr Range kHidden[] = {
      {0, 0x1f},        {0x7f, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},   {0x200b, 0x200f},
      {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe0fff}};
  for (const Range& range : kHidden) {
    if (code >= range.first && code <= range.last) return true;
  }
  return false;
}

void append_escape(std::string& out, char c) {
  constexpr char kDigits[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  out += "\\x";
  out += kDigits[byte >> 4];
  out += kDigits[byte & 15];
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character character = first_character(text);
    const size_t bytes = character.bytes > 0 ? character.bytes : 1;
    const bool is_shown = character.bytes > 0 && !is_hidden(character.code);
    for (const char c : text.substr(0, bytes)) {
      if (is_shown) {
        out += c;
      } else {
        append_escape(out, c);
      }
    }
    text.remove_prefix(bytes);
  }
  return out;
}

std::string printable_name(std::string_view name) {
  // The bytes of the middle are not looked at: a name may be as long as its file.
  constexpr size_t kHalf = (kLongestName - 3) / 2;
  if (name.size() <= kLongestName) {
    const std::string whole = printable(name);
    if (whole.size() <= kLongestName) return whole;
  }
  std::string begin = printable(name.substr(0, kHalf));
  std::string end = printable(name.substr(name.size() - std::min(name.size(), kHalf)));
  // Cuts no character in two.
  size_t keep = std::min(begin.size(), kHalf);
  while (keep < begin.size() && keep > 0 && continues_character(begin[keep])) --keep;
  size_t drop = end.size() - std::min(end.size(), kHalf);
  while (drop < end.size() && continues_character(end[drop])) ++drop;
  return begin.substr(0, keep) + "..." + end.substr(drop);
}

std::string quoted_name(std::string_view name) { return "'" + printable_name(name) + "'"; }

}  // namespace carom::io
