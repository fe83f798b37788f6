#include "accuracy/pairs/samples.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "accuracy/pairs/body_size.h"
#include "carom/reference/reference.h"

namespace carom::accuracy {
namespace {

using oracle::ConvexRandom;
using oracle::ConvexStyle;

// How far B may be from A, as a multiple of the distance at which their bounds touch.
constexpr double kReach = 1.3;

void make_plain(Shape& shape) {
  if (auto* triangle = std::get_if<Triangle>(&shape)) triangle->thickness = 0;
}

class PairDrawer {
 public:
  PairDrawer(const KindPair& kinds, uint64_t seed, bool aligned = false)
      : kinds_(kinds), random_(seed), shapes_(ConvexStyle{.aligned = aligned}, random_) {}
  PairDrawer(const PairDrawer&) = delete;
  PairDrawer& operator=(const PairDrawer&) = delete;

  Random& random() { return random_; }

  // Two random shapes with random orientations, both at the origin.
  ConvexPair shapes() {
    ConvexPair pair;
    pair.shape_a = shape(kinds_.a, random_.log_uniform(0.5, 2));
    pair.shape_b = shape(kinds_.b, random_.log_uniform(0.5, 2));
    for (Shape* shape : {&pair.shape_a, &pair.shape_b}) make_plain(*shape);
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
      pose->orientation = shapes_.orientation().normalized();
    }
    return pair;
  }

  // Gives both the same orientation (identity or quarter turns), then turns one by a further
  // `angle`.
  void turn_by(double angle, ConvexPair& pair) {
    const Eigen::Vector3d axis = random_.chance(0.5)
                                     ? random_.direction()
                                     : Eigen::Vector3d::Unit(shapes_.integer(0, 2)).eval();
    const Eigen::Vector3d v = axis * (angle / 2);
    const Eigen::Quaternionf turn = Eigen::Quaterniond(1, v.x(), v.y(), v.z()).cast<float>();
    const Eigen::Quaternionf base =
        random_.chance(0.5) ? Eigen::Quaternionf::Identity() : shapes_.quarter_turns();
    pair.pose_a.orientation = pair.pose_b.orientation = base;
    Pose& turned = kinds_.b == ShapeKind::aabb ? pair.pose_a : pair.pose_b;
    turned.orientation = base * turn;
  }

  // A random displacement from A to B that puts their bounds near each other.
  Eigen::Vector3d way(const ConvexPair& pair) {
    if (kind_of(pair.shape_a) == ShapeKind::halfspace) {
      return way_from_plane(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b);
    }
    if (kind_of(pair.shape_b) == ShapeKind::halfspace) {
      return -way_from_plane(pair.shape_b, pair.pose_b, pair.shape_a, pair.pose_a);
    }
    const Eigen::AlignedBox3d a = bounds(pair.shape_a, pair.pose_a);
    const Eigen::AlignedBox3d b = bounds(pair.shape_b, pair.pose_b);
    const Eigen::Vector3d reach = kReach / 2 * (a.sizes() + b.sizes());
    Eigen::Vector3d way = a.center() - b.center();
    for (int axis = 0; axis < 3; ++axis) way[axis] += random_.uniform(-reach[axis], reach[axis]);
    return way;
  }

 private:
  // Round shapes are at most four times as long in one direction as in another.
  Shape shape(ShapeKind kind, double size) {
    const auto length = [&] { return static_cast<float>(size * random_.log_uniform(0.25, 1)); };
    switch (kind) {
      case ShapeKind::cylinder:
        return Cylinder{length(), length()};
      case ShapeKind::cone:
        return Cone{length(), length()};
      case ShapeKind::ellipsoid:
        return Ellipsoid{{length(), length(), length()}};
      default:
        return shapes_.shape(kind, size);
    }
  }

  // Bounds relative to the body's position.
  static Eigen::AlignedBox3d bounds(const Shape& shape, const Pose& pose) {
    const Pose turned{Eigen::Vector3d::Zero(), pose.orientation};
    const reference::Box box = reference::bounds(shape, turned, PositionType::float32);
    return {box.lower.cast<double>(), box.upper.cast<double>()};
  }

  Eigen::Vector3d way_from_plane(const Shape& plane, const Pose& plane_pose, const Shape& shape,
                                 const Pose& pose) {
    const auto& halfspace = std::get<Halfspace>(plane);
    const auto length = static_cast<double>(halfspace.normal.norm());
    const Eigen::Vector3d normal =
        (plane_pose.orientation * halfspace.normal).cast<double>() / length;
    const Eigen::AlignedBox3d box = bounds(shape, pose);
    const double reach = kReach / 2 * box.sizes().dot(normal.cwiseAbs());
    const Eigen::Vector3d along = normal.cross(random_.direction()) * box.sizes().norm();
    return normal * (halfspace.offset / length + random_.uniform(-reach, reach)) + along -
           box.center();
  }

  KindPair kinds_;
  Random random_;
  ConvexRandom shapes_;
};

Eigen::Vector3d rounded(const Eigen::Vector3d& position) {
  return position.cast<float>().cast<double>();
}

bool overlaps(const ConvexPair& pair) {
  return reference::collide(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b,
                            PositionType::float32)
      .overlap;
}

// Marks a random half of `count` elements.
std::vector<bool> random_halves(size_t count, Random& random) {
  std::vector<bool> is_first(count);
  for (size_t i = 0; i < count; ++i) is_first[i] = i < count / 2;
  for (size_t i = count; i > 1; --i) {
    const size_t other = random.below(i);
    const bool kept = is_first[i - 1];
    is_first[i - 1] = is_first[other];
    is_first[other] = kept;
  }
  return is_first;
}

}  // namespace

std::vector<ConvexPair> random_pairs(const KindPair& kinds, size_t count, uint64_t seed) {
  PairDrawer drawer(kinds, seed);
  std::vector<ConvexPair> pairs;
  for (const bool wanted : random_halves(count, drawer.random())) {
    ConvexPair pair;
    do {
      pair = drawer.shapes();
      Eigen::Vector3d place;
      for (double& x : place) x = drawer.random().uniform(-100, 100);
      pair.pose_a.position = rounded(place);
      pair.pose_b.position = rounded(pair.pose_a.position + drawer.way(pair));
    } while (overlaps(pair) != wanted);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<ConvexPair> loose_pairs(const KindPair& kinds, size_t count, uint64_t seed) {
  PairDrawer drawer(kinds, seed);
  std::vector<ConvexPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    pairs.push_back(drawer.shapes());
    pairs.back().pose_b.position = drawer.way(pairs.back());
  }
  return pairs;
}

std::vector<ConvexPair> near_parallel_pairs(const KindPair& kinds, double angle, size_t count,
                                            uint64_t seed) {
  PairDrawer drawer(kinds, seed, true);
  std::vector<ConvexPair> pairs;
  while (pairs.size() < count) {
    ConvexPair pair = drawer.shapes();
    drawer.turn_by(angle, pair);
    pair.pose_b.position = drawer.way(pair);
    const double share = drawer.random().log_uniform(1e-8, 1.0 / 3);
    const double sign = drawer.random().chance(0.5) ? 1 : -1;
    move_to_gap(pair, sign * share * size_of(pair));
    pairs.push_back(pair);
  }
  return pairs;
}

bool has_angle(const KindPair& kinds) {
  const bool is_sphere = kinds.a == ShapeKind::sphere || kinds.b == ShapeKind::sphere;
  const bool are_aabbs = kinds.a == ShapeKind::aabb && kinds.b == ShapeKind::aabb;
  return !is_sphere && !are_aabbs;
}

bool move_to_gap(ConvexPair& pair, long double gap) {
  constexpr int kMostSteps = 12;
  constexpr long double kEnough = 1e-4L * 0x1p-23L;
  const long double size = size_of(pair);
  for (int step = 0; step < kMostSteps; ++step) {
    const auto found = pair.oracle().separation();
    const long double rest = gap - found.value;
    if (std::fabs(rest) <= kEnough * size) return true;
    const auto move = found.normal * rest;
    pair.pose_b.position += Eigen::Vector3d(
        static_cast<double>(move.x), static_cast<double>(move.y), static_cast<double>(move.z));
  }
  return false;
}

double size_of(const ConvexPair& pair) {
  if (kind_of(pair.shape_a) == ShapeKind::halfspace) return bounding_radius(pair.shape_b);
  if (kind_of(pair.shape_b) == ShapeKind::halfspace) return bounding_radius(pair.shape_a);
  return (bounding_radius(pair.shape_a) + bounding_radius(pair.shape_b)) / 2;
}

}  // namespace carom::accuracy
