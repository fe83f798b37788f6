// Foreign bytes in messages: names and arguments, and what stands in a broken file.
#pragma once

#include <string>
#include <string_view>

namespace carom::io {

// Text that cannot break a line or steer a terminal: control characters, bytes that are no UTF-8
// and characters that turn the direction of writing or are invisible become escapes (\x1b), a byte
// each. All other UTF-8 stays, backslashes too, so that what is printable already does not change.
std::string printable(std::string_view text);

// The same for a name or word of any length: of a long one the beginning and the end.
std::string printable_name(std::string_view name);

// The same in single quotes.
std::string quoted_name(std::string_view name);

}  // namespace carom::io
