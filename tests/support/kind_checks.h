// Checks of the accuracy that the library states, against the oracle.
#pragma once

#include <gtest/gtest.h>

#include "oracle/convex_oracle.h"
#include "tests/support/pairs.h"
#include "tests/support/show.h"
#include "tests/support/textbook.h"

namespace carom::test {

using namespace oracle;

// The exact answer for a pair as it is stored, and the sizes by which errors are measured.
struct ExactKinds {
  using Number = long double;
  using Vec = Vec3<Number>;

  ConvexOracle<Number> oracle;
  ConvexSeparation<Number> answer;
  Vec origin_b;  // position of B relative to A's
  Number scale;  // mean of the bounding radii; half-spaces count almost nothing
  Number gap;    // magnitude of the separation
  Number least;  // spacing of floats near zero, for several roundings
  Number arms;   // rounding of the arms of half-spaces, which reach far beyond the sizes

  ExactKinds(const TestPair& pair, PositionType positions);

  Number tolerance(Number of_size) const { return of_size * scale + least; }
  Number tolerance_with_gap(Number of_size) const { return of_size * (scale + gap) + least; }

 private:
  // Half-spaces far from a body are tested in double precision, but arms are floats.
  void measure_halfspace();

  static ConvexOracle<Number> oracle_of(const TestPair& pair, PositionType positions);
};

void check_decision(const ExactKinds& exact, const reference::PairResult& result);

void check_separation(const ExactKinds& exact, const reference::PairResult& result);

void check_normal(const ExactKinds& exact, const reference::PairResult& result);

// Witness points lie on the surfaces, and the separating vector leads from one to the other.
void check_witnesses(const ExactKinds& exact, const reference::PairResult& result);

void check_manifold(const ExactKinds& exact, const reference::PairResult& result);

void check_result(const ExactKinds& exact, const reference::PairResult& result);

// Checks every part of the reference's result and returns it.
reference::PairResult checked_result(const TestPair& pair, PositionType positions);

}  // namespace carom::test
