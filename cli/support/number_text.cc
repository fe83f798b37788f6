#include "cli/support/number_text.h"

#include <charconv>

namespace carom::cli {

std::string shortest(float value) {
  char buffer[32];
  const auto format =
      value >= 1e-5f && value < 1e7f ? std::chars_format::fixed : std::chars_format::general;
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr};
}

}  // namespace carom::cli
