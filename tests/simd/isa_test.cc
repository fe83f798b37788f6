// Choosing an instruction set: by default, by the environment, by force.
#include "carom/simd/isa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>

#include "simd/measured_kernels.h"

namespace carom {
namespace {

constexpr Isa kAllIsas[] = {Isa::scalar, Isa::sse4, Isa::avx2, Isa::avx512, Isa::neon};

// Sets CAROM_ISA (nullptr: unset) and chooses anew; restores both at the end.
class ScopedEnvironment {
 public:
  explicit ScopedEnvironment(const char* value) {
    if (const char* old = std::getenv("CAROM_ISA")) old_ = old;
    set(value);
  }
  ~ScopedEnvironment() { set(old_ ? old_->c_str() : nullptr); }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;

 private:
  static void set(const char* value) {
    if (value) {
      setenv("CAROM_ISA", value, 1);
    } else {
      unsetenv("CAROM_ISA");
    }
    unforce_isa();
  }

  std::optional<std::string> old_;
};

bool contains(const std::vector<Isa>& isas, Isa isa) {
  return std::find(isas.begin(), isas.end(), isa) != isas.end();
}

TEST(Isa, NamesAreReadBack) {
  for (const Isa isa : kAllIsas) EXPECT_EQ(isa_from_name(name(isa)), isa);
  EXPECT_STREQ(name(Isa::avx512), "avx512");
  for (const char* text : {"", "AVX2", "avx", "avx2 ", "sse4.1"}) {
    EXPECT_EQ(isa_from_name(text), std::nullopt) << text;
  }
}

TEST(Isa, UsableOnesAreCompiledAndAscend) {
  const std::vector<Isa> usable = usable_isas();
  const std::vector<Isa> compiled = compiled_isas();
  ASSERT_FALSE(usable.empty());
  EXPECT_EQ(usable.front(), Isa::scalar);
  EXPECT_TRUE(std::is_sorted(usable.begin(), usable.end()));
  EXPECT_TRUE(std::is_sorted(compiled.begin(), compiled.end()));
  for (const Isa isa : usable) EXPECT_TRUE(contains(compiled, isa)) << name(isa);
}

TEST(Isa, TheForcedOneRuns) {
  const ScopedEnvironment environment(nullptr);
  for (const Isa isa : usable_isas()) {
    EXPECT_TRUE(force_isa(isa));
    EXPECT_EQ(active_isa(), isa);
  }
  unforce_isa();
  EXPECT_EQ(active_isa(), usable_isas().back());
}

TEST(Isa, UnusableOnesChangeNothing) {
  const std::vector<Isa> usable = usable_isas();
  ASSERT_TRUE(force_isa(Isa::scalar));
  for (const Isa isa : kAllIsas) {
    if (contains(usable, isa)) continue;
    EXPECT_FALSE(force_isa(isa)) << name(isa);
    EXPECT_EQ(active_isa(), Isa::scalar);
  }
  unforce_isa();
}

TEST(Isa, TheEnvironmentChooses) {
  for (const Isa isa : usable_isas()) {
    const ScopedEnvironment environment(name(isa));
    EXPECT_EQ(active_isa(), isa);
  }
}

TEST(Isa, ForceBeatsTheEnvironment) {
  const ScopedEnvironment environment("scalar");
  const Isa best = usable_isas().back();
  ASSERT_TRUE(force_isa(best));
  EXPECT_EQ(active_isa(), best);
  unforce_isa();
  EXPECT_EQ(active_isa(), Isa::scalar);
}

constexpr simd::MeasuredKernel kMeasuredKernels[] = {
    simd::MeasuredKernel::sphere_hull_decision, simd::MeasuredKernel::capsule_hull_decision,
    simd::MeasuredKernel::aabb_hull_decision,   simd::MeasuredKernel::box_hull_decision,
    simd::MeasuredKernel::hull_hull_decision,   simd::MeasuredKernel::hull_triangle_decision,
    simd::MeasuredKernel::furthest_point,       simd::MeasuredKernel::tree_pairs,
    simd::MeasuredKernel::near_triangles,
};

// Some kernels may run on AVX2 in place of AVX-512, but only by default.
TEST(Isa, MeasuredKernelsRunOnTheForcedIsa) {
  const auto index = [] { return simd::chosen_target().GetIndex(); };
  for (const simd::MeasuredKernel kernel : kMeasuredKernels) {
    const auto index_for_kernel = [&] { return simd::target_for(kernel).GetIndex(); };
    for (const Isa isa : usable_isas()) {
      ASSERT_TRUE(force_isa(isa));
      EXPECT_EQ(index_for_kernel(), index()) << name(isa);
      unforce_isa();
      const ScopedEnvironment environment(name(isa));
      EXPECT_EQ(index_for_kernel(), index()) << name(isa);
    }
    const ScopedEnvironment environment(nullptr);
    const size_t by_default = index_for_kernel();
    if (by_default == index()) continue;
    EXPECT_TRUE(simd::is_faster_with_avx2(kernel));
    EXPECT_EQ(active_isa(), Isa::avx512);
    ASSERT_TRUE(force_isa(Isa::avx2));
    EXPECT_EQ(by_default, index());
    unforce_isa();
  }
}

// There are some of both sorts, so that the table decides.
TEST(Isa, SomeMeasuredKernelsAreFasterWithAvx2) {
  const auto faster = std::count_if(std::begin(kMeasuredKernels), std::end(kMeasuredKernels),
                                    simd::is_faster_with_avx2);
  EXPECT_GT(faster, 0);
  EXPECT_LT(faster, std::ssize(kMeasuredKernels));
}

TEST(Isa, WhatTheEnvironmentCannotMeanIsIgnored) {
  for (const char* text : {"", "fastest", "AVX2"}) {
    const ScopedEnvironment environment(text);
    EXPECT_EQ(active_isa(), usable_isas().back()) << text;
  }
}

}  // namespace
}  // namespace carom
