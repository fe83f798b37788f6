// The true answer of a pair as it is stored, and what an answer is off by.
#pragma once

#include <Eigen/Core>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

enum class Truth { apart, overlap, unknown };

// Computed in long double, whose rounding is far below any margin that matters but that of the
// decision: where that is within the margin, 100 digits decide, or 1500 where positions all but
// coincide. Two shapes that those see touching but for the last ten digits touch.
class ExactPair {
 public:
  explicit ExactPair(const ConvexPair& pair);

  // Unknown where planes of a k-DOP all but meet in a point: the oracle cannot tell.
  Truth truth() const { return truth_; }
  // Signed distance.
  long double gap() const { return gap_; }

  // Errors are shares of this: L, the mean of the bounding radii, or the gap or depth if that is
  // larger. Half-spaces count for the rounding of their distance, as floats have it. What a few of
  // the smallest floats make is no error.
  double share(long double length) const;
  double gap_share() const { return share(gap_ < 0 ? -gap_ : gap_); }
  double error_share(float separation) const;
  // The separation, less what the shapes are apart along this normal.
  double regret_share(const Eigen::Vector3f& normal) const;
  // Bounds are of L + gap: what they are to be multiplied by, 1 to 2, as shares.
  double allowance() const;

 private:
  void decide(const ConvexPair& pair);

  ConvexOracle<long double> oracle_;
  long double extent_;  // of everything that is computed with
  long double scale_;
  long double gap_;
  Truth truth_ = Truth::unknown;
};

// What long double errs by for this pair, as a share of the extent that the margin is a share of.
double rounding_share(const ConvexPair& pair);

}  // namespace carom::accuracy
