#include "carom/simd/isa.h"

#include <array>
#include <cstdlib>

#include "simd/measured_kernels.h"

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace carom {
namespace {

struct Target {
  Isa isa;
  const char* name;
  int64_t bits;  // Highway's targets that count as this ISA
};

// Weakest first.
constexpr std::array<Target, 5> kTargets = {{
    {Isa::scalar, "scalar", HWY_SCALAR},
    {Isa::sse4, "sse4", HWY_SSE4},
    {Isa::avx2, "avx2", HWY_AVX2},
    {Isa::avx512, "avx512", HWY_AVX3},
    {Isa::neon, "neon", HWY_NEON},
}};

const Target& target(Isa isa) { return kTargets[static_cast<size_t>(isa)]; }

// The scalar target is always usable: Highway does not list it as a feature of the machine. It asks
// the processor anew in every call, which a virtual machine answers slowly.
int64_t usable_bits() {
  static const int64_t supported = hwy::SupportedTargets();
  return (supported | HWY_SCALAR) & int64_t{HWY_TARGETS};
}

std::vector<Isa> isas_in(int64_t bits) {
  std::vector<Isa> isas;
  for (const Target& t : kTargets) {
    if (t.bits & bits) isas.push_back(t.isa);
  }
  return isas;
}

bool is_usable(Isa isa) { return (usable_bits() & target(isa).bits) != 0; }

// Whether this is an AMD processor of family 25. Those of them that have AVX-512 (Zen 4) run it in
// two halves.
bool runs_wide_vectors_in_halves() {
#if HWY_ARCH_X86
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(0, &a, &b, &c, &d) == 0 || b != signature_AMD_ebx) return false;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0) return false;
  const unsigned family = (a >> 8 & 0xf) + (a >> 20 & 0xff);
  return family == 25;
#else
  return false;
#endif
}

// For kernels that are faster with AVX2 there.
Isa narrow_isa(Isa best) {
  static const bool are_halves = runs_wide_vectors_in_halves();
  return best == Isa::avx512 && are_halves && is_usable(Isa::avx2) ? Isa::avx2 : best;
}

struct ChosenTargets {
  hwy::ChosenTarget all, narrow;

  ChosenTargets() { choose_default(); }

  void choose(Isa isa, Isa narrow_one) {
    all.Update(usable_bits() & target(isa).bits);
    narrow.Update(usable_bits() & target(narrow_one).bits);
  }
  void choose_default() {
    const char* const name = std::getenv("CAROM_ISA");
    const std::optional<Isa> forced = name ? isa_from_name(name) : std::nullopt;
    if (forced && is_usable(*forced)) return choose(*forced, *forced);
    const Isa best = usable_isas().back();
    choose(best, narrow_isa(best));
  }
};

ChosenTargets& chosen_targets() {
  static ChosenTargets chosen;
  return chosen;
}

}  // namespace

namespace simd {

const hwy::ChosenTarget& chosen_target() { return chosen_targets().all; }

const hwy::ChosenTarget& target_for(MeasuredKernel kernel) {
  const ChosenTargets& targets = chosen_targets();
  return is_faster_with_avx2(kernel) ? targets.narrow : targets.all;
}

}  // namespace simd

const char* name(Isa isa) { return target(isa).name; }

std::optional<Isa> isa_from_name(std::string_view name) {
  for (const Target& t : kTargets) {
    if (name == t.name) return t.isa;
  }
  return std::nullopt;
}

std::vector<Isa> compiled_isas() { return isas_in(HWY_TARGETS); }

std::vector<Isa> usable_isas() { return isas_in(usable_bits()); }

bool force_isa(Isa isa) {
  if (!is_usable(isa)) return false;
  chosen_targets().choose(isa, isa);
  return true;
}

void unforce_isa() { chosen_targets().choose_default(); }

}  // namespace carom
