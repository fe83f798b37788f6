#include "simd/measured_kernels.h"

#include <array>

namespace carom::simd {
namespace {

// Nanoseconds with each, by which AVX2 is chosen or not.
struct Times {
  MeasuredKernel kernel;
  double avx2, avx512;
};

// In the order of MeasuredKernel. Zen 4 (family 25), one core, both in turns, the least of
// many passes. Decisions: a pair of a stream of random pairs, hulls of 16 corners. furthest_point:
// a pair of a hull of 16 corners and a triangle that touch to within rounding. tree_pairs and
// near_triangles: their share of a pair of meshes of 10,092 triangles.
constexpr std::array<Times, 9> kTimes = {{
    {MeasuredKernel::sphere_hull_decision, 38.8, 36.7},
    {MeasuredKernel::capsule_hull_decision, 55.2, 58.0},
    {MeasuredKernel::aabb_hull_decision, 56.7, 51.2},
    {MeasuredKernel::box_hull_decision, 50.8, 49.3},
    {MeasuredKernel::hull_hull_decision, 62.5, 64.6},
    {MeasuredKernel::hull_triangle_decision, 48.6, 49.8},
    {MeasuredKernel::furthest_point, 653, 685},
    {MeasuredKernel::tree_pairs, 16'700, 21'200},
    {MeasuredKernel::near_triangles, 5'800, 6'300},
}};

// Differences up to this are noise.
constexpr double kClearly = 1.02;

constexpr bool is_in_order() {
  for (size_t i = 0; i < kTimes.size(); ++i) {
    if (static_cast<size_t>(kTimes[i].kernel) != i) return false;
  }
  return true;
}
static_assert(is_in_order());

}  // namespace

bool is_faster_with_avx2(MeasuredKernel kernel) {
  const Times& times = kTimes[static_cast<size_t>(kernel)];
  return times.avx512 > kClearly * times.avx2;
}

}  // namespace carom::simd
