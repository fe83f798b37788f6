#include "accuracy/exact_pair.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

namespace carom::accuracy {
namespace {

using Digits100 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                                boost::multiprecision::et_off>;

// What long double errs by, as a share of the extent; tests/accuracy/exact_pair_test.cc holds it
// against 100 digits.
constexpr long double kMargin = 1e-17L;
// Corners of k-DOPs that are closer than 2^-50 are one to the oracle.
constexpr long double kDopMargin = 1e-13L;
// Of 100 digits: closer is touching.
constexpr double kNothing = 1e-90;
// Spacing of floats near zero, rounded several times.
constexpr long double kLeast = 32 * 0x1p-149L;

bool is_halfspace(const Shape& shape) { return std::holds_alternative<Halfspace>(shape); }
bool is_dop(const Shape& shape) { return std::holds_alternative<Dop>(shape); }

bool has_dop(const ConvexPair& pair) { return is_dop(pair.shape_a) || is_dop(pair.shape_b); }

long double extent_of(const ConvexPair& pair, const ConvexOracle<long double>& oracle) {
  const Eigen::Vector3d way = pair.pose_b.position - pair.pose_a.position;
  return oracle.a.bounding_radius + oracle.b.bounding_radius + way.stableNorm();
}

long double scale_of(const ConvexPair& pair, const ConvexOracle<long double>& oracle,
                     long double extent) {
  if (is_halfspace(pair.shape_a)) return oracle.b.bounding_radius + extent * 0x1p-24L;
  if (is_halfspace(pair.shape_b)) return oracle.a.bounding_radius + extent * 0x1p-24L;
  return oracle.scale();
}

// The sign is that of the gap. Of shapes without radius an axis that parts them is enough, at a
// tenth of the time.
Digits100 signed_gap(const ConvexPair& pair) {
  const auto oracle = pair.oracle<Digits100>();
  const bool has_plane = oracle.a.is_halfspace || oracle.b.is_halfspace;
  if (has_plane || oracle.a.radius + oracle.b.radius > 0) return oracle.separation().value;
  return oracle::convex::AxisSearch<Digits100>(oracle.a, oracle.b).gap();
}

}  // namespace

ExactPair::ExactPair(const ConvexPair& pair)
    : oracle_(pair.oracle<long double>()),
      extent_(extent_of(pair, oracle_)),
      scale_(scale_of(pair, oracle_, extent_)),
      gap_(oracle_.separation().value) {
  decide(pair);
}

void ExactPair::decide(const ConvexPair& pair) {
  const long double margin = (accuracy::has_dop(pair) ? kDopMargin : kMargin) * extent_;
  if (std::fabs(gap_) > margin) {
    truth_ = gap_ > 0 ? Truth::apart : Truth::overlap;
    return;
  }
  const Digits100 gap = signed_gap(pair);
  if (abs(gap) <= Digits100(extent_) * kNothing) {
    truth_ = Truth::overlap;
  } else if (!accuracy::has_dop(pair) || abs(gap) > Digits100(margin)) {
    truth_ = gap > 0 ? Truth::apart : Truth::overlap;
  }
}

double ExactPair::share(long double length) const {
  const long double rest = length - kLeast;
  if (!(rest > 0)) return std::isnan(length) ? std::numeric_limits<double>::quiet_NaN() : 0;
  return static_cast<double>(rest / std::max(scale_, gap_));
}

double ExactPair::error_share(float separation) const {
  return share(std::fabs(static_cast<long double>(separation) - gap_));
}

double ExactPair::regret_share(const Eigen::Vector3f& normal) const {
  return share(gap_ -
               oracle::gap_along(oracle_.a, oracle_.b, oracle::vec3_as<long double>(normal)));
}

double gap_in_100_digits(const ConvexPair& pair) {
  return static_cast<double>(pair.oracle<Digits100>().separation().value);
}

}  // namespace carom::accuracy
