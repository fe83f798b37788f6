#include "accuracy/pairs/exact_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/digits.h"

namespace carom::accuracy {
namespace {

using oracle::Digits;

// The error bound of long double, as a share of the extent; tests/accuracy/exact_pair_test.cc
// checks it against 100 digits.
constexpr long double kMargin = 1e-17L;
// The bound for k-DOPs, whose corners are intersections of planes.
constexpr long double kDopMargin = 1e-13L;
// If positions differ by a smaller share of the extent, 100 digits do not suffice.
constexpr double kTiny = 1e-25;
// Several roundings at the spacing of floats near zero.
constexpr long double kLeast = 32 * 0x1p-149L;

bool is_dop(const Shape& shape) { return std::holds_alternative<Dop>(shape); }

bool has_dop(const ConvexPair& pair) { return is_dop(pair.shape_a) || is_dop(pair.shape_b); }

// Whether every plane of the k-DOP either contains a corner exactly or is clearly off it. Otherwise
// the oracle, which compares corners and planes in long double, may merge two corners.
bool has_sure_corners(const Dop& dop) {
  using R = Digits<100>;
  const oracle::ConvexDop<R> polytope(dop);
  for (const oracle::Vec3<R>& corner : polytope.points()) {
    for (size_t i = 0; i < slab_count(dop.kind); ++i) {
      const auto direction = oracle::vec3_as<R>(slab_directions(dop.kind)[i]);
      const R height = oracle::dot(direction, corner);
      for (const float limit : {dop.lower[i], dop.upper[i]}) {
        const R size = oracle::length(corner) + std::fabs(limit);
        const R off = abs(height - limit);
        if (off > size * 1e-90 && off < size * 1e-13) return false;
      }
    }
  }
  return true;
}

bool has_sure_corners(const ConvexPair& pair) {
  const auto is_sure = [](const Shape& shape) {
    const auto* dop = std::get_if<Dop>(&shape);
    return !dop || has_sure_corners(*dop);
  };
  return is_sure(pair.shape_a) && is_sure(pair.shape_b);
}

long double extent_of(const ConvexPair& pair, const ConvexOracle<long double>& oracle) {
  const Eigen::Vector3d way = pair.pose_b.position - pair.pose_a.position;
  return oracle.a.bounding_radius + oracle.b.bounding_radius + way.stableNorm();
}

long double scale_of(const ConvexPair& pair, const ConvexOracle<long double>& oracle,
                     long double extent) {
  if (kind_of(pair.shape_a) == ShapeKind::halfspace)
    return oracle.b.bounding_radius + extent * 0x1p-24L;
  if (kind_of(pair.shape_b) == ShapeKind::halfspace)
    return oracle.a.bounding_radius + extent * 0x1p-24L;
  return oracle.scale();
}

// A number with the sign of the gap. For shapes without radius the best axis is enough and takes a
// tenth of the time.
template <class R>
R signed_gap(const ConvexPair& pair) {
  const auto oracle = pair.oracle<R>();
  const bool has_plane = oracle.a.is_halfspace || oracle.b.is_halfspace;
  if (has_plane || oracle.a.radius + oracle.b.radius > 0) return oracle.separation().value;
  return oracle::widest_gap(oracle.a, oracle.b);
}

// Whether the pair mixes numbers of such different sizes that 100 digits do not hold both, or their
// squares.
bool needs_more_digits(const ConvexPair& pair, long double extent) {
  const Eigen::Vector3d way = pair.pose_b.position - pair.pose_a.position;
  return std::any_of(way.begin(), way.end(),
                     [&](double x) { return x != 0 && std::fabs(x) < kTiny * extent; });
}

// Shapes closer than the last ten digits touch. Otherwise a gap up to `unsure` is unknown.
template <unsigned kDigits>
Truth decide_in_digits(const ConvexPair& pair, long double extent, long double unsure) {
  using R = Digits<kDigits>;
  const R gap = signed_gap<R>(pair);
  if (abs(gap) <= R(extent) * pow(R(10), 10 - static_cast<int>(kDigits))) return Truth::overlap;
  if (abs(gap) <= R(unsure)) return Truth::unknown;
  return gap > 0 ? Truth::apart : Truth::overlap;
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
  const long double unsure = has_sure_corners(pair) ? 0 : margin;
  truth_ = needs_more_digits(pair, extent_) ? decide_in_digits<1500>(pair, extent_, unsure)
                                            : decide_in_digits<100>(pair, extent_, unsure);
}

double ExactPair::share(long double length) const {
  const long double rest = length - kLeast;
  if (!(rest > 0)) return std::isnan(length) ? std::numeric_limits<double>::quiet_NaN() : 0;
  return static_cast<double>(rest / std::max(scale_, std::fabs(gap_)));
}

double ExactPair::allowance() const {
  const long double gap = std::fabs(gap_);
  return gap > 0 ? static_cast<double>((scale_ + gap) / std::max(scale_, gap)) : 1;
}

double ExactPair::error_share(float separation) const {
  return share(std::fabs(static_cast<long double>(separation) - gap_));
}

double ExactPair::regret_share(const Eigen::Vector3f& normal) const {
  return share(gap_ -
               oracle::gap_along(oracle_.a, oracle_.b, oracle::vec3_as<long double>(normal)));
}

double rounding_share(const ConvexPair& pair) {
  const auto oracle = pair.oracle<long double>();
  const Digits<100> exact = pair.oracle<Digits<100>>().separation().value;
  const Digits<100> error = abs(exact - Digits<100>(oracle.separation().value));
  return error == 0 ? 0 : static_cast<double>(error / Digits<100>(extent_of(pair, oracle)));
}

}  // namespace carom::accuracy
