// Kernels that were measured with AVX2 beside AVX-512 on a processor that runs AVX-512 in two
// halves: there a wider vector may wait longer for its slowest lane, and gain nothing for it.
#pragma once

#include <cstdint>

#include "simd/dispatch.h"

namespace carom::simd {

enum class MeasuredKernel : uint8_t {
  sphere_hull_decision,
  capsule_hull_decision,
  aabb_hull_decision,
  box_hull_decision,
  hull_hull_decision,
  hull_triangle_decision,
  furthest_point,
  tree_pairs,
  near_triangles,
};

// Whether the kernel took clearly less time with AVX2 there.
bool is_faster_with_avx2(MeasuredKernel kernel);

// The target for a kernel: chosen_target(), or AVX2 in place of AVX-512 on such a processor, if the
// kernel is faster so and no ISA is forced. The bits are the same.
const hwy::ChosenTarget& target_for(MeasuredKernel kernel);

}  // namespace carom::simd

// CAROM_DISPATCH_MEASURED(kernel, f)(args) calls f from its HWY_EXPORT table for a MeasuredKernel.
// It is a macro as CAROM_DISPATCH is.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define CAROM_DISPATCH_MEASURED(kernel, function) HWY_STATIC_DISPATCH(function)
#else
#define CAROM_DISPATCH_MEASURED(kernel, function) \
  (*(HWY_DISPATCH_TABLE(                          \
      function)[::carom::simd::target_for(::carom::simd::MeasuredKernel::kernel).GetIndex()]))
#endif
