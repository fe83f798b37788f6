// The streams of a command: results go to `out`; errors, warnings and progress to `err`.
#pragma once

#include <ostream>
#include <string>

#include "carom/base/result.h"
#include "io/printable.h"

namespace carom::cli {

struct Console {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  // `err` is a terminal, so progress may be shown

  // One line each, even if names from files contain control characters.
  void error(const Error& error) const { err << "carom: " << io::printable(error.message) << '\n'; }
  void warning(const std::string& text) const {
    err << "carom: warning: " << io::printable(text) << '\n';
  }
};

}  // namespace carom::cli
