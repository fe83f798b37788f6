#include "carom/simd/isa.h"

#include <array>
#include <cstdlib>

#include "simd/dispatch.h"

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

void choose(hwy::ChosenTarget& chosen, Isa isa) { chosen.Update(usable_bits() & target(isa).bits); }

bool is_usable(Isa isa) { return (usable_bits() & target(isa).bits) != 0; }

Isa default_isa() {
  if (const char* forced = std::getenv("CAROM_ISA")) {
    const std::optional<Isa> isa = isa_from_name(forced);
    if (isa && is_usable(*isa)) return *isa;
  }
  return usable_isas().back();
}

}  // namespace

namespace simd {

hwy::ChosenTarget& chosen_target() {
  static struct Chosen {
    Chosen() { choose(target, default_isa()); }
    hwy::ChosenTarget target;
  } chosen;
  return chosen.target;
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
  choose(simd::chosen_target(), isa);
  return true;
}

void unforce_isa() { choose(simd::chosen_target(), default_isa()); }

}  // namespace carom
