// Pairs with a cylinder, cone or ellipsoid: their separation between two bounds, and the errors of
// other answers.
#pragma once

#include <vector>

#include "accuracy/pairs/exact_pair.h"
#include "oracle/support_pair.h"

namespace carom::accuracy {

using oracle::has_round;

// Every pair of kinds with one of these and a kernel.
const std::vector<NamedKinds>& round_kinds();

// The same questions as of ExactPair, answered by an oracle that knows support points alone. It
// bounds the separation to 3e-8 of the scale. What lies between the bounds is no error.
class RoundPair {
 public:
  explicit RoundPair(const ConvexPair& pair);

  Truth truth() const;
  long double gap() const { return (bounds_.low + bounds_.high) / 2; }

  double share(long double length) const;
  double gap_share() const;
  double error_share(float separation) const;
  double regret_share(const Eigen::Vector3f& normal) const;
  double allowance() const;

 private:
  oracle::SupportPair shapes_;
  long double scale_;
  oracle::SeparationBounds bounds_;
};

}  // namespace carom::accuracy
