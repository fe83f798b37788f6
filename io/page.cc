#include "io/page.h"

#include <string_view>

namespace carom::io {
namespace {

constexpr std::string_view kPlaceholder = "/*CAROM_DATA*/null";

// Escapes '<', which only occurs in strings of JSON: some tags would end the script or change how
// it is read.
std::string without_tags(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string fill_page(std::span<const char* const> pieces, const std::string& json) {
  std::string page;
  for (const char* piece : pieces) page += piece;
  const size_t place = page.find(kPlaceholder);
  if (place != std::string::npos) page.replace(place, kPlaceholder.size(), without_tags(json));
  return page;
}

}  // namespace carom::io
