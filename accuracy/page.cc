#include "accuracy/page.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "accuracy/page_text.h"

namespace carom::accuracy {
namespace {

constexpr std::string_view kPlaceholder = "/*CAROM_DATA*/null";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string page_with(const nlohmann::ordered_json& json) {
  std::string data = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  replace_all(data, "</", "<\\/");  // nothing in a string may end the script
  std::string page;
  for (const char* piece : kPagePieces) page += piece;
  const size_t place = page.find(kPlaceholder);
  if (place != std::string::npos) page.replace(place, kPlaceholder.size(), data);
  return page;
}

}  // namespace carom::accuracy
