// What the machine calls its processor, for reports of measurements.
#pragma once

#include <string>

namespace carom::io {

// As Linux calls it; "unknown" elsewhere.
std::string cpu_name();

}  // namespace carom::io
