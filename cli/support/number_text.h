// Numbers in the text that people read.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace carom::cli {

// One number as printf() writes it; no longer than 63 characters.
inline std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// 0 of nothing.
inline double share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace carom::cli
