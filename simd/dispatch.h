// Calls the version of a kernel that was compiled for the ISA in use.
#pragma once

#include "simd/targets.h"
// After the targets.
#include <hwy/highway.h>

namespace carom::simd {

// Carom's own choice, separate from Highway's process-wide one: forcing an ISA here changes nothing
// for other libraries that use Highway.
const hwy::ChosenTarget& chosen_target();

}  // namespace carom::simd

// CAROM_DISPATCH(f)(args) calls f from the HWY_EXPORT table of the ISA in use. It is a macro
// because Highway's macro builds the name of the table.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define CAROM_DISPATCH(function) HWY_STATIC_DISPATCH(function)
#else
#define CAROM_DISPATCH(function) \
  (*(HWY_DISPATCH_TABLE(function)[::carom::simd::chosen_target().GetIndex()]))
#endif
