// Formats numbers for readable text.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace carom::cli {

// One number as printf() writes it; at most 63 characters.
inline std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

inline std::string percent(double share) { return number("%.3g %%", 100 * share); }

// The shortest decimal that reads back as this float; without an exponent if that is readable.
std::string shortest(float value);

// part / whole; 0 if the whole is 0.
inline double share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace carom::cli
