// The target of --json: a file that appears when complete, standard output, or none.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/support/console.h"
#include "io/files/atomic_file.h"

namespace carom::cli {

class JsonOutput {
 public:
  // An empty target means none, "-" standard output. Opened before the work, so that a bad target
  // fails early.
  static Result<JsonOutput> open(const std::string& target);

  bool wanted() const { return file_ || standard_output_; }
  Result<void> write(const nlohmann::ordered_json& json, const Console& console);

 private:
  std::optional<io::AtomicFile> file_;
  bool standard_output_ = false;
};

// The version of the library that writes the JSON.
std::string json_library_version();

}  // namespace carom::cli
