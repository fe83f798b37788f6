// Calls the version of a kernel that was compiled for the ISA in use.
#pragma once

#include "simd/targets.h"
// After the targets.
#include <hwy/highway.h>

namespace carom::simd {

// Carom's own choice, separate from Highway's process-wide one: forcing an ISA here changes nothing
// for other libraries that use Highway.
const hwy::ChosenTarget& chosen_target();

// For searches whose lanes end at different times. A wider vector waits longer for its slowest
// lane, and a processor that runs AVX-512 in two halves does not make up for it: there it is AVX2,
// unless an ISA is forced. Elsewhere it is chosen_target().
const hwy::ChosenTarget& target_for_searches();

}  // namespace carom::simd

// CAROM_DISPATCH(f)(args) calls f from the HWY_EXPORT table of the ISA in use,
// CAROM_DISPATCH_SEARCH(f)(args) from that for searches. They are macros because Highway's macro
// builds the name of the table.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define CAROM_DISPATCH(function) HWY_STATIC_DISPATCH(function)
#define CAROM_DISPATCH_SEARCH(function) HWY_STATIC_DISPATCH(function)
#else
#define CAROM_DISPATCH(function) \
  (*(HWY_DISPATCH_TABLE(function)[::carom::simd::chosen_target().GetIndex()]))
#define CAROM_DISPATCH_SEARCH(function) \
  (*(HWY_DISPATCH_TABLE(function)[::carom::simd::target_for_searches().GetIndex()]))
#endif
