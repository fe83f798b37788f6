// Lets the reference call the library's scalar tests (narrowphase/, impacts/) without a prefix.
#pragma once

namespace carom::scalar {}

namespace carom::reference {
using namespace scalar;
}  // namespace carom::reference
