// Pages (HTML) that carry their data.
#pragma once

#include <span>
#include <string>

namespace carom::io {

// The pieces of a page, put together, with a JSON document in place of its /*CAROM_DATA*/null.
std::string fill_page(std::span<const char* const> pieces, const std::string& json);

}  // namespace carom::io
