// Which instruction set the kernels use. By default the best that this machine has; the
// environment variable CAROM_ISA (a name below) or force_isa() choose another; a name that is
// unknown or not usable here counts as not given.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "carom/export.h"

namespace carom {

enum class Isa { scalar, sse4, avx2, avx512, neon };

// "scalar", "sse4", "avx2", "avx512", "neon".
CAROM_EXPORT const char* name(Isa isa);
CAROM_EXPORT std::optional<Isa> isa_from_name(std::string_view name);

// Compiled into this library; and those of them that this machine can run, weakest first.
CAROM_EXPORT std::vector<Isa> compiled_isas();
CAROM_EXPORT std::vector<Isa> usable_isas();

// The one in use. Results have the same bits whichever it is.
CAROM_EXPORT Isa active_isa();

// Uses `isa` from the next call on, in the whole process (carom's kernels only); false, and no
// change, if it is not usable. Not to be called while another thread runs kernels.
CAROM_EXPORT bool force_isa(Isa isa);

// Back to the default choice.
CAROM_EXPORT void unforce_isa();

}  // namespace carom
