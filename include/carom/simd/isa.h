/// @file
/// The instruction set that the kernels use. By default it is the best one that this machine has.
/// The environment variable CAROM_ISA (a name below) or force_isa() chooses another; a name that is
/// unknown or not usable here counts as not given.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "carom/export.h"

namespace carom {

/// An instruction set.
enum class Isa {
  scalar,  ///< plain C++
  sse4,    ///< SSE4.2, 4 floats at a time
  avx2,    ///< AVX2 and FMA, 8 floats at a time
  avx512,  ///< AVX-512 (F, BW, CD, DQ, VL), 16 floats at a time
  neon     ///< Arm NEON, 4 floats at a time
};

/// "scalar", "sse4", "avx2", "avx512", "neon".
CAROM_EXPORT const char* name(Isa isa);
/// The instruction set with this name, if there is one.
CAROM_EXPORT std::optional<Isa> isa_from_name(std::string_view name);

/// The instruction sets compiled into this library, weakest first.
CAROM_EXPORT std::vector<Isa> compiled_isas();
/// Those of them that this machine can run, weakest first.
CAROM_EXPORT std::vector<Isa> usable_isas();

/// The one in use. Results have the same bits whichever it is. Some kernels use AVX2 in place of
/// AVX-512 on processors on which they are faster so, unless the choice is forced.
CAROM_EXPORT Isa active_isa();

/// Makes all kernels of this process use `isa` from the next call on. Returns false, and changes
/// nothing, if it is not usable. No other thread may run kernels during the call.
CAROM_EXPORT bool force_isa(Isa isa);

/// Returns to the default choice. No other thread may run kernels during the call.
CAROM_EXPORT void unforce_isa();

}  // namespace carom
