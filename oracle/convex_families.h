// Families of random pairs of placed shapes. Each family makes inputs hard in one way, for any two
// convex kinds.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "oracle/convex_oracle.h"
#include "oracle/convex_random.h"
#include "oracle/support_pair.h"

namespace carom::oracle {

struct KindPair {
  ShapeKind a;
  ShapeKind b;
};

inline constexpr ShapeKind kConvexKinds[] = {
    ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,     ShapeKind::box,
    ShapeKind::dop,    ShapeKind::hull,    ShapeKind::triangle, ShapeKind::halfspace};

// Shapes that only support_pair.h knows.
inline constexpr ShapeKind kRoundKinds[] = {ShapeKind::cylinder, ShapeKind::cone,
                                            ShapeKind::ellipsoid, ShapeKind::rounded_box,
                                            ShapeKind::rounded_hull};

// All ordered pairs of convex kinds except two half-spaces.
std::vector<KindPair> convex_kind_pairs();
// All ordered pairs of convex or round kinds of which one is round.
std::vector<KindPair> round_kind_pairs();

std::string name(const KindPair& kinds);

bool has_round(const KindPair& kinds);

// Polytopes with many faces and round shapes are slow in the library and in the oracle, so tests
// take fewer of these pairs.
bool is_slow(const KindPair& kinds);
size_t fewer_if_slow(const KindPair& kinds, size_t count);

struct ConvexPair {
  Shape shape_a;
  Pose pose_a;
  Shape shape_b;
  Pose pose_b;

  // Not of round shapes.
  template <class R = long double>
  ConvexOracle<R> oracle() const {
    return ConvexOracle<R>(shape_a, pose_a, shape_b, pose_b);
  }
};

ConvexPair swapped(const ConvexPair& pair);

enum class ConvexPlacement {
  free,        // from coincident centroids to twice the distance of touch
  near_touch,  // touching, then moved by a few floats
  coincident,  // same position
  same_pose,   // same position and rotation
  lattice,     // small integers and quarter turns, which give exact ties
};

struct ConvexFamily {
  const char* name;
  double smallest = 0.5;  // of the sizes, which are log-uniform
  double largest = 2;
  double ratio = 1;      // the greatest ratio of the two sizes
  double aspect = 4;     // the greatest ratio of lengths, radii and half extents
  double distance = 10;  // distance of A from the origin, in metres or in sizes
  bool distance_in_sizes = false;
  ConvexPlacement placement = ConvexPlacement::free;
  bool degenerate = false;
  bool near_parallel = false;  // rotations that differ by 0 or 1e-8 to 1e-1
};

std::vector<ConvexFamily> convex_families();

class ConvexPairMaker {
 public:
  ConvexPairMaker(const ConvexFamily& family, KindPair kinds, PositionType positions,
                  uint64_t seed);
  ConvexPairMaker(const ConvexPairMaker&) = delete;
  ConvexPairMaker& operator=(const ConvexPairMaker&) = delete;

  ConvexPair next();

 private:
  template <class R>
  using Vec = Vec3<R>;

  void orient(ConvexPair& pair);
  void place_pair(ConvexPair& pair, double size);

  // As place(), for pairs with a round shape: roughly at `factor` times the distance of touch or,
  // if they are to touch, exactly there.
  void place_round(ConvexPair& pair, double size, double factor);
  void let_touch(ConvexPair& pair);

  // Turns b from a by a small angle. A quaternion near identity stores the small angle; others lose
  // it in rounding.
  void turn_a_little(Orientation& a, Orientation& b);

  Eigen::Vector3d stored(const Eigen::Vector3d& position) const;

  // Starts B where the centroids coincide, finds the distance along a random direction at which the
  // shapes touch, and moves B by `factor` times this distance.
  template <class R>
  void place(ConvexPair& pair, double size, double factor, int steps) {
    ConvexOracle<R> oracle = pair.oracle<R>();
    if (oracle.a.is_halfspace && oracle.b.is_halfspace) return;
    const Vec<R> start = meeting(oracle.a, oracle.b);
    oracle.b.translate(start);
    const Vec<R> direction = way(oracle);
    R reach = distance_to_touch(oracle, direction, steps) * R(factor);
    // Flat shapes are separate after any movement, so the distance is zero.
    const bool flat = reach < R(1e-12 * size);
    if (flat && family_.placement == ConvexPlacement::free && random_.chance(0.6)) {
      reach = R(random_.uniform(0, 1) * size);
    }
    const Vec<R> shift = start + direction * reach;
    const Eigen::Vector3d to(static_cast<double>(shift.x), static_cast<double>(shift.y),
                             static_cast<double>(shift.z));
    pair.pose_b.position = stored(pair.pose_a.position + to);
  }

  // The displacement of B that makes the centroids coincide. With a half-space: that moves the
  // other's centroid onto the plane, plus a random drift along it.
  template <class R>
  Vec<R> meeting(const ConvexShape<R>& a, const ConvexShape<R>& b) {
    if (!a.is_halfspace && !b.is_halfspace) return a.centroid() - b.centroid();
    const ConvexShape<R>& plane = a.is_halfspace ? a : b;
    const ConvexShape<R>& body = a.is_halfspace ? b : a;
    const Vec<R> drift = vec3_as<R>(random_.direction()) * body.bounding_radius;
    const Vec<R> way = plane.normal * (plane.offset - dot(plane.normal, body.centroid())) +
                       across(drift, plane.normal);
    return a.is_halfspace ? way : -way;
  }

  // A random direction; half of the time from a point of B to a point of A, which suits long and
  // flat shapes. With a half-space it points out of the half-space.
  template <class R>
  Vec<R> way(const ConvexOracle<R>& oracle) {
    const Vec<R> any = vec3_as<R>(random_.direction());
    if (oracle.a.is_halfspace) return normalized(oracle.a.normal * R(1.1) + any);
    if (oracle.b.is_halfspace) return normalized(any - oracle.b.normal * R(1.1));
    if (random_.chance(0.5)) return any;
    const Vec<R> from = point_in(oracle.b);
    const Vec<R> within = normalized(point_in(oracle.a) - from);
    return dot(within, within) > 0 ? within : any;
  }

  template <class R>
  Vec<R> point_in(const ConvexShape<R>& shape) {
    const Vec<R>& p = shape.points[random_.below(shape.points.size())];
    const Vec<R>& q = shape.points[random_.below(shape.points.size())];
    return p + (q - p) * R(random_.uniform(0, 1));
  }

  // The separation is a convex function of the distance moved. This finds its root by false
  // position with the Illinois rule.
  template <class R>
  static R distance_to_touch(const ConvexOracle<R>& oracle, const Vec<R>& direction, int steps) {
    const ConvexDirections<R> directions(oracle.a, oracle.b);
    ConvexShape<R> b = oracle.b;  // keeps its memory from step to step
    const auto gap = [&](const R& t) {
      b = oracle.b;
      b.translate(direction * t);
      return separation_with_normal(oracle.a, b, directions).value;
    };
    R low = 0, gap_low = gap(low);
    if (!(gap_low < 0)) return low;
    R high = oracle.scale(), gap_high = gap(high);
    while (!(gap_high > 0)) {
      high *= 2;
      gap_high = gap(high);
    }
    R best = -gap_low < gap_high ? low : high, least = std::min<R>(-gap_low, gap_high);
    int kept = 0;  // the end that the last step kept: 1 high, -1 low
    for (int i = 0; i < steps; ++i) {
      const R t = low - gap_low * ((high - low) / (gap_high - gap_low));
      if (!(t > low && t < high)) break;
      const R gap_t = gap(t);
      const R off = gap_t < 0 ? -gap_t : gap_t;
      if (off < least) {
        best = t;
        least = off;
      }
      if (gap_t > 0) {
        high = t;
        gap_high = gap_t;
        if (kept == -1) gap_low /= 2;
        kept = -1;
      } else {
        low = t;
        gap_low = gap_t;
        if (kept == 1) gap_high /= 2;
        kept = 1;
      }
    }
    return best;
  }

  // Moves one coordinate by up to four steps of its float type.
  void nudge(Eigen::Vector3d& position);

  ConvexFamily family_;
  KindPair kinds_;
  PositionType positions_;
  Random random_;
  ConvexRandom shapes_;
};

std::vector<ConvexPair> make_convex_pairs(const ConvexFamily& family, KindPair kinds,
                                          PositionType positions, size_t count, uint64_t seed = 1);

}  // namespace carom::oracle
