#include "cli/support/json_output.h"

#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace carom::cli {

Result<JsonOutput> JsonOutput::open(const std::string& target) {
  JsonOutput output;
  if (target == "-") {
    output.standard_output_ = true;
  } else if (!target.empty()) {
    Result<io::AtomicFile> file = io::AtomicFile::create(target);
    if (!file) return file.error();
    output.file_.emplace(std::move(*file));
  }
  return output;
}

Result<void> JsonOutput::write(const nlohmann::ordered_json& json, const Console& console) {
  // Names come from files: bytes that are not UTF-8 are replaced. All that is not ASCII is escaped,
  // since a terminal obeys U+0080 to U+009F.
  std::string text = json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + '\n';
  if (standard_output_) console.out << text;
  if (!file_) return {};
  Result<void> written = file_->write(std::as_bytes(std::span(text)));
  return written ? file_->commit() : written;
}

std::string json_library_version() {
  return std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_PATCH);
}

}  // namespace carom::cli
