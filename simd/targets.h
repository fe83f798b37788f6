// Selects the Highway targets to compile. Include it before any Highway header.
#pragma once

// Compiled are the ISAs that FORMATS names: emulated scalar, SSE4, AVX2, AVX-512, NEON. The others
// would add compile time and no speed (SSSE3, the VNNI flavour of AVX-512), or have vectors of
// unknown length. Builds that are slow to compile and run (sanitizers) have only the scalar target
// and AVX2.
#ifdef CAROM_FEW_TARGETS
#define CAROM_LEFT_OUT_TARGETS (HWY_SSE4 | HWY_AVX3)
#else
#define CAROM_LEFT_OUT_TARGETS 0
#endif
#define HWY_DISABLED_TARGETS                                                             \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | \
   CAROM_LEFT_OUT_TARGETS)

// The scalar target uses one plain float a lane with every compiler: g++ before 12.3 miscompiles
// Highway's emulated 128-bit vectors, the other choice.
#define HWY_BROKEN_EMU128 1
