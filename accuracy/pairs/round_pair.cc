#include "accuracy/pairs/round_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "accuracy/pairs/body_size.h"
#include "accuracy/pairs/samples.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom::accuracy {
namespace {

// How far apart the bounds of a separation are at most, as a share of the scale.
constexpr long double kWidest = 3e-8L;

}  // namespace

const std::vector<NamedKinds>& round_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PairKind& kind : kPairKinds) {
      all.push_back(std::string(name(kind.a)) + "_" + name(kind.b));
    }
    return all;
  }();
  static const std::vector<NamedKinds> kinds = [] {
    std::vector<NamedKinds> all;
    for (size_t i = 0; i < kPairKinds.size(); ++i) {
      const KindPair pair{kPairKinds[i].a, kPairKinds[i].b};
      if (has_round(pair)) all.push_back({names[i].c_str(), pair});
    }
    return all;
  }();
  return kinds;
}

RoundPair::RoundPair(const ConvexPair& pair)
    : shapes_(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b),
      scale_(size_of(pair)),
      bounds_(shapes_.separation(kWidest * scale_)) {}

Truth RoundPair::truth() const {
  if (bounds_.low > 0) return Truth::apart;
  return bounds_.high <= 0 ? Truth::overlap : Truth::unknown;
}

double RoundPair::share(long double length) const {
  if (std::isnan(length)) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(std::max(length, 0.0L) / std::max(scale_, std::fabs(gap())));
}

double RoundPair::gap_share() const { return share(std::fabs(gap())); }

double RoundPair::error_share(float separation) const {
  const long double found = separation;
  return share(std::max(bounds_.low - found, found - bounds_.high));
}

double RoundPair::regret_share(const Eigen::Vector3f& normal) const {
  const oracle::Vec3<long double> n = oracle::normalized(oracle::vec3_as<long double>(normal));
  // Any other direction than that of a plane has an infinite gap.
  if (shapes_.has_halfspace()) return share(length(n - bounds_.normal) * scale_);
  return share(bounds_.low - shapes_.gap_along(n));
}

double RoundPair::allowance() const {
  const long double gap_length = std::fabs(gap());
  return static_cast<double>((scale_ + gap_length) / std::max(scale_, gap_length));
}

}  // namespace carom::accuracy
