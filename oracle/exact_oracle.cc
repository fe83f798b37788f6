#include "oracle/exact_oracle.h"

namespace carom::oracle {

ExactGap exact_gap(const ConvexPair& pair) {
  const ConvexOracle<long double> wide = pair.oracle<long double>();
  const long double gap = wide.separation().value;
  const long double size = wide.scale() + length(wide.b.centroid()) + std::fabs(gap);
  if (std::fabs(gap) > 1e-8L * size) return {Digits<100>(gap), Digits<100>(0)};
  const ConvexOracle<Digits<100>> oracle = pair.oracle<Digits<100>>();
  return {oracle.separation().value, Digits<100>(size) * Digits<100>("1e-45")};
}

}  // namespace carom::oracle
