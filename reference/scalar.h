// The reference calls the scalar tests that the library is made of (narrowphase/, impacts/) by
// their own names.
#pragma once

namespace carom::scalar {}

namespace carom::reference {
using namespace scalar;
}  // namespace carom::reference
