#include "cli/run/state_hash.h"

#include <cstdio>

namespace carom::cli {

std::string StateHash::text() const {
  uint64_t last = (state_ ^ state_ >> 29) * 0xbf58476d1ce4e5b9u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(last ^ last >> 32));
  return text;
}

}  // namespace carom::cli
