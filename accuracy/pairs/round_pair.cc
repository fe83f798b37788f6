#include "accuracy/pairs/round_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "accuracy/pairs/body_size.h"
#include "accuracy/pairs/samples.h"
#include "narrowphase/pairs/pair_kinds.h"

namespace carom::accuracy {
namespace {

using oracle::dot;
using Vec = oracle::Vec3<long double>;

// How far apart the bounds of a separation are at most, as a share of the scale.
constexpr long double kWidest = 3e-8L;

// The point of a round shape that is furthest along `n`, in its own frame.
struct Furthest {
  Vec n;

  Vec rim(float radius) const { return oracle::normalized(Vec{n.x, n.y, 0}) * radius; }

  Vec operator()(const Cylinder& c) const {
    const Vec at = rim(c.radius);
    return {at.x, at.y, n.z > 0 ? c.half_length : -c.half_length};
  }
  Vec operator()(const Cone& c) const {
    const Vec at = rim(c.radius);
    const Vec base{at.x, at.y, -c.half_length}, tip{0, 0, c.half_length};
    return dot(n, tip) > dot(n, base) ? tip : base;
  }
  Vec operator()(const Ellipsoid& e) const {
    const Vec s = oracle::vec3_as<long double>(e.semi_axes);
    const Vec unit = oracle::normalized(Vec{s.x * n.x, s.y * n.y, s.z * n.z});
    return {s.x * unit.x, s.y * unit.y, s.z * unit.z};
  }
  template <class Other>
  Vec operator()(const Other&) const {
    return {};
  }
};

// Any shape but a half-space, relative to `origin`.
oracle::SupportShape support_of(const Shape& shape, const Pose& pose,
                                const Eigen::Vector3d& origin) {
  const Eigen::Vector3d way = pose.position - origin;
  if (!is_round(kind_of(shape))) {
    const auto convex = std::make_shared<oracle::ConvexShape<>>(shape, Pose{way, pose.orientation});
    return {[convex](const Vec& n) {
              const auto is_nearer = [&](const Vec& p, const Vec& q) {
                return dot(n, p) < dot(n, q);
              };
              return *std::max_element(convex->points.begin(), convex->points.end(), is_nearer);
            },
            convex->radius};
  }
  const oracle::Rotation<long double> turn(pose.orientation);
  const Vec at = oracle::vec3_as<long double>(way);
  return {[shape, turn, at](const Vec& n) {
            return turn(std::visit(Furthest{turn.back(n)}, shape)) + at;
          },
          0};
}

// A half-space has one direction.
oracle::SeparationBounds separation_from_plane(const Shape& plane, const Pose& pose,
                                               const oracle::SupportShape& body,
                                               const Eigen::Vector3d& origin) {
  const oracle::ConvexShape<> halfspace(plane, {pose.position - origin, pose.orientation});
  const Vec lowest = body.furthest(-halfspace.normal);
  const long double gap = dot(halfspace.normal, lowest) - body.radius - halfspace.offset;
  return {gap, gap, halfspace.normal};
}

bool is_plane(const Shape& shape) { return std::holds_alternative<Halfspace>(shape); }

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

RoundPair::RoundPair(const ConvexPair& pair) : scale_(size_of(pair)) {
  const Eigen::Vector3d& origin = pair.pose_a.position;
  if (!is_plane(pair.shape_a)) a_ = support_of(pair.shape_a, pair.pose_a, origin);
  if (!is_plane(pair.shape_b)) b_ = support_of(pair.shape_b, pair.pose_b, origin);
  if (is_plane(pair.shape_a)) {
    bounds_ = separation_from_plane(pair.shape_a, pair.pose_a, b_, origin);
  } else if (is_plane(pair.shape_b)) {
    bounds_ = separation_from_plane(pair.shape_b, pair.pose_b, a_, origin);
    bounds_.normal = -bounds_.normal;
  } else {
    bounds_ = separation_by_supports(a_, b_, kWidest * scale_);
  }
}

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
  const Vec n = oracle::normalized(oracle::vec3_as<long double>(normal));
  // Any other direction than that of a plane has an infinite gap.
  if (!a_.furthest || !b_.furthest) return share(length(n - bounds_.normal) * scale_);
  const long double along =
      dot(n, b_.furthest(-n)) - dot(n, a_.furthest(n)) - a_.radius - b_.radius;
  return share(bounds_.low - along);
}

double RoundPair::allowance() const {
  const long double gap_length = std::fabs(gap());
  return static_cast<double>((scale_ + gap_length) / std::max(scale_, gap_length));
}

}  // namespace carom::accuracy
