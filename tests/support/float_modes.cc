#include "tests/support/float_modes.h"

namespace carom::test {

std::vector<FloatMode> float_modes() {
  return {kDefaultMode,           {"flush to zero", 0x8000}, {"denormals are zero", 0x0040},
          {"both", 0x8040},       {"downward", 0x2000},      {"upward", 0x4000},
          {"toward zero", 0x6000}};
}

ScopedFloatMode::ScopedFloatMode(const FloatMode& mode) : saved_(_mm_getcsr()) {
  _mm_setcsr(0x1f80 | mode.mxcsr);
}

}  // namespace carom::test
