#include "oracle/convex_families.h"

namespace carom::oracle {

std::vector<KindPair> convex_kind_pairs() {
  std::vector<KindPair> all;
  for (ShapeKind a : kConvexKinds) {
    for (ShapeKind b : kConvexKinds) {
      if (a != ShapeKind::halfspace || b != ShapeKind::halfspace) all.push_back({a, b});
    }
  }
  return all;
}

std::string name(const KindPair& kinds) {
  return std::string(carom::name(kinds.a)) + "_" + carom::name(kinds.b);
}

bool has_polytope(const KindPair& kinds) {
  const auto is_polytope = [](ShapeKind kind) {
    return kind == ShapeKind::dop || kind == ShapeKind::hull;
  };
  return is_polytope(kinds.a) || is_polytope(kinds.b);
}

size_t fewer_polytopes(const KindPair& kinds, size_t count) {
  return has_polytope(kinds) ? std::max<size_t>(count / 8, 1) : count;
}

ConvexPair swapped(const ConvexPair& pair) {
  return {pair.shape_b, pair.pose_b, pair.shape_a, pair.pose_a};
}

std::vector<ConvexFamily> convex_families() {
  using enum ConvexPlacement;
  return {
      {.name = "plain"},
      {.name = "at 1e3", .distance = 1e3},
      {.name = "at 1e6", .smallest = 0.5, .largest = 1e3, .distance = 1e6},
      {.name = "at 1e9", .smallest = 0.5, .largest = 1e6, .distance = 1e9},
      {.name = "sizes", .smallest = 1e-30, .largest = 1e18, .distance_in_sizes = true},
      {.name = "ratio", .ratio = 1e10},
      {.name = "aspect", .aspect = 1e6},
      {.name = "touch", .distance = 0, .placement = near_touch},
      {.name = "touch at 1e3", .distance = 1e3, .placement = near_touch},
      {.name = "touch of all sizes",
       .smallest = 1e-30,
       .largest = 1e18,
       .ratio = 1e3,
       .distance = 0,
       .placement = near_touch},
      {.name = "touch of long and flat", .aspect = 1e4, .distance = 0, .placement = near_touch},
      {.name = "coincident", .placement = coincident},
      {.name = "coincident at 1e9", .distance = 1e9, .placement = coincident},
      {.name = "same pose", .placement = same_pose},
      {.name = "lattice", .smallest = 1, .largest = 1, .placement = lattice},
      {.name = "lattice of subnormals",
       .smallest = 0x1p-140,
       .largest = 0x1p-140,
       .placement = lattice},
      {.name = "degenerate", .degenerate = true},
      {.name = "degenerate touch", .distance = 0, .placement = near_touch, .degenerate = true},
      {.name = "degenerate, same pose", .placement = same_pose, .degenerate = true},
      {.name = "near parallel", .near_parallel = true},
      {.name = "near parallel touch",
       .distance = 0,
       .placement = near_touch,
       .near_parallel = true},
      {.name = "near parallel, coincident", .placement = coincident, .near_parallel = true},
      {.name = "subnormal", .smallest = 1e-44, .largest = 1e-36, .distance_in_sizes = true},
  };
}

ConvexPairMaker::ConvexPairMaker(const ConvexFamily& family, KindPair kinds, PositionType positions,
                                 uint64_t seed)
    : family_(family),
      kinds_(kinds),
      positions_(positions),
      random_(seed),
      shapes_({.aspect = family.aspect,
               .degenerate = family.degenerate,
               .lattice = family.placement == ConvexPlacement::lattice,
               .aligned = family.near_parallel},
              random_) {}

ConvexPair ConvexPairMaker::next() {
  ConvexPair pair;
  const bool lattice = family_.placement == ConvexPlacement::lattice;
  const double size =
      lattice ? family_.smallest : random_.log_uniform(family_.smallest, family_.largest);
  const double size_b =
      lattice ? size : size * random_.log_uniform(1 / family_.ratio, family_.ratio);
  pair.shape_a = shapes_.shape(kinds_.a, size);
  pair.shape_b = shapes_.shape(kinds_.b, size_b);
  orient(pair);
  if (lattice) {
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
      for (int i = 0; i < 3; ++i) pose->position[i] = size * shapes_.integer(-3, 3);
    }
    return pair;
  }
  const double distance = family_.distance * (family_.distance_in_sizes ? size : 1);
  pair.pose_a.position = stored(random_.direction() * distance);
  pair.pose_b.position = pair.pose_a.position;
  if (family_.placement == ConvexPlacement::free) {
    const double factor = random_.uniform(0, 2);
    if (has_polytope(kinds_) && family_.largest > 1e30) {
      place<long double>(pair, size, factor, 8);  // doubles would overflow
    } else {
      place<double>(pair, size, factor, has_polytope(kinds_) ? 8 : 10);
    }
  } else if (family_.placement == ConvexPlacement::near_touch) {
    const double factor = 1 + 0x1p-23 * shapes_.integer(-8, 8);
    if (has_polytope(kinds_)) {
      place<double>(pair, size, factor, 16);
    } else {
      place<long double>(pair, size, factor, 100);
    }
    nudge(pair.pose_b.position);
  } else if (kinds_.a == kinds_.b && random_.chance(0.3)) {
    pair.shape_b = pair.shape_a;
  }
  return pair;
}

void ConvexPairMaker::orient(ConvexPair& pair) {
  Orientation& a = pair.pose_a.orientation;
  Orientation& b = pair.pose_b.orientation;
  const bool lattice = family_.placement == ConvexPlacement::lattice;
  a = lattice ? shapes_.quarter_turns() : shapes_.orientation();
  b = lattice ? shapes_.quarter_turns() : shapes_.orientation();
  if (family_.near_parallel) turn_a_little(a, b);
  if (family_.placement == ConvexPlacement::same_pose) b = a;
}

void ConvexPairMaker::turn_a_little(Orientation& a, Orientation& b) {
  if (random_.chance(0.6)) a = shapes_.quarter_turns();
  const int power = shapes_.integer(1, 9);
  const double angle = power == 9 ? 0 : std::pow(10.0, -power);
  const Eigen::Vector3d axis = random_.chance(0.5)
                                   ? random_.direction()
                                   : Eigen::Vector3d::Unit(shapes_.integer(0, 2)).eval();
  const Eigen::Vector3d v = axis * (angle / 2);
  b = (a.cast<double>() * Eigen::Quaterniond(1, v.x(), v.y(), v.z())).cast<float>();
}

Eigen::Vector3d ConvexPairMaker::stored(const Eigen::Vector3d& position) const {
  if (positions_ == PositionType::float64) return position;
  return position.cast<float>().cast<double>();
}

void ConvexPairMaker::nudge(Eigen::Vector3d& position) {
  double& x = position[shapes_.integer(0, 2)];
  const double towards = random_.chance(0.5) ? HUGE_VAL : -HUGE_VAL;
  for (int steps = shapes_.integer(0, 4); steps > 0; --steps) {
    x = positions_ == PositionType::float64
            ? std::nextafter(x, towards)
            : std::nextafter(static_cast<float>(x), static_cast<float>(towards));
  }
}

std::vector<ConvexPair> make_convex_pairs(const ConvexFamily& family, KindPair kinds,
                                          PositionType positions, size_t count, uint64_t seed) {
  ConvexPairMaker maker(family, kinds, positions, seed);
  std::vector<ConvexPair> pairs;
  for (size_t i = 0; i < count; ++i) pairs.push_back(maker.next());
  return pairs;
}

}  // namespace carom::oracle
