// The exact answer for a stored pair, and the errors of other answers.
#pragma once

#include <Eigen/Core>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

enum class Truth { apart, overlap, unknown };

// Computed in long double, whose rounding is far below all bounds tested. The decision may need
// more: if the gap is within the rounding, 100 digits decide, or 1500 if the positions nearly
// coincide. Shapes touch if these digits agree except for the last ten.
class ExactPair {
 public:
  explicit ExactPair(const ConvexPair& pair);

  // Unknown if planes of a k-DOP nearly meet in a point, because the oracle cannot tell.
  Truth truth() const { return truth_; }
  // Signed distance.
  long double gap() const { return gap_; }

  // `length` as a share of the pair's scale: L, the mean bounding radius, or |gap| if that is
  // larger. With a half-space L is the other body's radius plus the float32 rounding of the extent.
  // Lengths of a few of the smallest floats count as 0.
  double share(long double length) const;
  double gap_share() const { return share(gap_ < 0 ? -gap_ : gap_); }
  double error_share(float separation) const;
  // The separation minus the gap along this normal: 0 for the best normal.
  double regret_share(const Eigen::Vector3f& normal) const;
  // The factor, 1 to 2, by which to multiply a bound in L + |gap| before comparing it with a share.
  double allowance() const;

 private:
  void decide(const ConvexPair& pair);

  ConvexOracle<long double> oracle_;
  long double extent_;  // sum of the bounding radii and the distance of positions
  long double scale_;
  long double gap_;
  Truth truth_ = Truth::unknown;
};

// The actual error of long double for this pair, as a share of the extent (like the margin).
double rounding_share(const ConvexPair& pair);

}  // namespace carom::accuracy
