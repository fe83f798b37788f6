// Reads any bytes as two moving bodies of any two kinds that have a kernel. The search for the time
// of impact must end with a valid time, and every instruction set must give the bits of the scalar
// reference.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <tuple>
#include <utility>

#include "carom/impacts/time_of_impact.h"
#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "fuzz/kinds_bodies.h"

namespace {

using namespace carom;
using namespace carom::fuzz;

enum MotionFlag : uint8_t { kTurning = 4, kAnyMotion = 8 };

struct Row {
  uint32_t status = 0;
  std::array<float, 11> numbers{};  // toi, separation, normal, both points
};

// A sweep of any size, or one of about the distance of the bodies and one turn.
Sweep take_sweep(uint8_t flags, double reach, Data& data) {
  Sweep sweep;
  if (flags & kAnyMotion) {
    const auto numbers = take<std::array<float, 6>>(data);
    sweep.displacement = {numbers[0], numbers[1], numbers[2]};
    sweep.rotation = {numbers[3], numbers[4], numbers[5]};
  } else {
    sweep.displacement = (take_vector(data) * (2 * reach)).cast<float>();
    sweep.rotation = (take_vector(data) * 6).cast<float>();
  }
  if (!(flags & kTurning)) sweep.rotation.setZero();
  return sweep;
}

SweepView view_of(const std::array<Sweep, View::kBodies>& sweeps) {
  return {sweeps[0].displacement.data(), sizeof sweeps[0], sweeps[0].rotation.data(),
          sizeof sweeps[0]};
}

Row reference_row(const reference::Impact& impact) {
  Row row;
  row.status = static_cast<uint32_t>(impact.status);
  row.numbers[0] = impact.toi;
  row.numbers[1] = impact.separation;
  for (int axis = 0; axis < 3; ++axis) {
    row.numbers[2 + axis] = impact.normal[axis];
    row.numbers[5 + axis] = impact.arm_a[axis];
    row.numbers[8 + axis] = impact.arm_b[axis];
  }
  return row;
}

// The result for the first bodies of the two sets; the second ones are neighbours in the same
// vectors.
Row kernel_row(const Collidables& a, const Sweep& sweep_a, const Collidables& b,
               const Sweep& sweep_b) {
  constexpr std::array<Pair, 2> kList = {{{0, 0}, {1, 1}}};
  const std::array<Sweep, View::kBodies> sweeps_a = {sweep_a, sweep_b};
  const std::array<Sweep, View::kBodies> sweeps_b = {sweep_b, sweep_a};
  std::array<uint8_t, View::kBodies> status{};
  std::array<std::array<float, View::kBodies>, std::tuple_size_v<decltype(Row::numbers)>> columns{};
  ImpactColumns out;
  out.toi = columns[0].data();
  out.status = status.data();
  out.separation = columns[1].data();
  for (size_t axis = 0; axis < 3; ++axis) {
    out.normal[axis] = columns[2 + axis].data();
    out.point_a[axis] = columns[5 + axis].data();
    out.point_b[axis] = columns[8 + axis].data();
  }
  if (!time_of_impact(a, view_of(sweeps_a), b, view_of(sweeps_b), kList, out,
                      {.frame = WitnessFrame::body})) {
    std::abort();
  }
  Row row;
  row.status = status[0];
  for (size_t i = 0; i < columns.size(); ++i) row.numbers[i] = columns[i][0];
  return row;
}

bool is_answer(const Row& row) {
  const float toi = row.numbers[0];
  if (row.status == static_cast<uint32_t>(Status::invalid)) return std::isnan(toi);
  return (toi >= 0 && toi <= 1) || (std::isinf(toi) && toi > 0);
}

void print(const char* who, const Row& row) {
  std::fprintf(stderr, "%s: status %u", who, row.status);
  for (const float x : row.numbers) std::fprintf(stderr, " %a", x);
  std::fputc('\n', stderr);
}

[[noreturn]] void fail(const KindPair& kinds, Isa isa, const Row& row, const Row& wanted) {
  std::fprintf(stderr, "%s against %s\n", name(kinds.a), name(kinds.b));
  print("reference", wanted);
  print(name(isa), row);
  std::abort();
}

double reach_of(const Body& a, const Body& b) {
  double reach = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    reach = std::max(reach, std::fabs(b.position[axis] - a.position[axis]));
  }
  return std::isfinite(reach) ? std::min(reach, 1e30) : 1;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  Data rest(data, size);
  const TwoBodies two = take_two_bodies(rest);
  const KindPair& kinds = two.kinds;
  const double reach = reach_of(two.a, two.b);
  const Sweep sweep_a = take_sweep(two.flags, reach, rest),
              sweep_b = take_sweep(two.flags, reach, rest);

  const View a(kinds.a, two.a, two.beside_a, two.type), b(kinds.b, two.b, two.beside_b, two.type);
  const Row wanted = reference_row(
      reference::time_of_impact(shape_of(kinds.a, two.a), pose_of(two.a), sweep_a,
                                shape_of(kinds.b, two.b), pose_of(two.b), sweep_b, two.type));
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    const Row row = kernel_row(*a, sweep_a, *b, sweep_b);
    if (std::memcmp(&row, &wanted, sizeof row) != 0 || !is_answer(row)) {
      fail(kinds, isa, row, wanted);
    }
  }
  return 0;
}
