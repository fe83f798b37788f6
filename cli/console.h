// Where a command writes: results to `out`; errors, warnings and progress to `err`.
#pragma once

#include <ostream>

#include "carom/kernel/result.h"

namespace carom::cli {

struct Console {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  // err is one: progress may be shown

  void error(const Error& error) const { err << "carom: " << error.message << '\n'; }
  void warning(const std::string& text) const { err << "carom: warning: " << text << '\n'; }
};

}  // namespace carom::cli
