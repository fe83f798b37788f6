// HTML pages that contain their data.
#pragma once

#include <span>
#include <string>

namespace carom::io {

// Joins the pieces of a page and puts a JSON document in place of /*CAROM_DATA*/null.
std::string fill_page(std::span<const char* const> pieces, const std::string& json);

}  // namespace carom::io
