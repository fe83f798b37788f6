// When moving bodies meet for the first time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"

namespace carom {

// Where time_of_impact() writes; one entry a pair in every column that is not nullptr, dense.
//   toi      in [0, 1]; 0: they touch or overlap at the start; +infinity: they do not meet; NaN:
//            there is no answer
//   status   ok; budget: the search ended early, and they may meet later, or not at all, but not
//            sooner; invalid: a body is not valid, or its sweep is not finite
// The other columns are of the contact at the time of impact, with names and signs as in Contact:
// a separation of about zero, or the depth of what overlaps at the start. NaN where nothing meets,
// sub-shapes 0.
struct ImpactColumns {
  float* toi = nullptr;
  uint8_t* status = nullptr;  // Status
  float* separation = nullptr;
  std::array<float*, 3> normal{};
  std::array<float*, 3> point_a{};
  std::array<float*, 3> point_b{};
  uint32_t* sub_a = nullptr;  // the parts that meet first; of several the first by their indices
  uint32_t* sub_b = nullptr;

  bool want_contacts() const { return separation || normal[0] || point_a[0] || point_b[0]; }
};

// For pair i = (a[pairs[i].a], b[pairs[i].b]) the first time in [0, 1] at which they touch, and the
// contact then; `a` and `b` may be the same set. Rows of the sweeps are those of the bodies.
//
// Never late, never missed: before `toi` the bodies, as they are stored, do not touch (toi is
// rounded downwards to float32). At `toi`, before that rounding, they are no further apart than
// kImpactSlack x (size + travel), so bodies that graze each other within that distance may be found
// to meet. The size is the sum of the distances of both shapes' furthest points from their bodies'
// positions (a half-space has none); the travel is the length of the relative displacement plus, of
// bodies that turn, the angle times that distance (of a half-space: of the furthest that the other
// body gets from its position).
//
// Points and arms are those of the bodies where they are at the time of impact.
//
// Of meshes and compounds the parts that the swept bounds reach are tested. A one-sided triangle is
// met by what first touches it with its middle in front of the triangle's back: what comes from
// behind passes for the whole interval, and so does what overlaps it from behind at the start.
// Inner edges do not matter to the time.
//
// Bits are the same on every instruction set and for any number of threads, and do not depend on a
// pair's place in the list. Fails if a pair is of kinds that never meet (supports()); nothing is
// written then.
CAROM_EXPORT Result<void> time_of_impact(const Collidables& a, const SweepView& sweep_a,
                                         const Collidables& b, const SweepView& sweep_b,
                                         std::span<const Pair> pairs, const ImpactColumns& out,
                                         WitnessFrame frame = WitnessFrame::world,
                                         Parallelism parallelism = Parallelism::none);

inline constexpr double kImpactSlack = 1e-11;

}  // namespace carom
