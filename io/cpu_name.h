// The name of the processor, for reports of measurements.
#pragma once

#include <string>

namespace carom::io {

// The name that Linux gives; "unknown" elsewhere.
std::string cpu_name();

}  // namespace carom::io
