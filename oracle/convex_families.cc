#include "oracle/convex_families.h"

namespace carom::oracle {
namespace {

Eigen::Vector3d as_doubles(const Vec3<long double>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Relative to the body's position. Of round shapes and half-spaces that position itself.
Eigen::Vector3d middle_of(const Shape& shape, const Orientation& turn) {
  const ShapeKind kind = kind_of(shape);
  if (is_round(kind) || kind == ShapeKind::halfspace) return Eigen::Vector3d::Zero();
  const ConvexShape<double> solved(shape, {Eigen::Vector3d::Zero(), turn});
  const Vec3<double> middle = solved.centroid();
  return {middle.x, middle.y, middle.z};
}

}  // namespace

std::vector<KindPair> convex_kind_pairs() {
  std::vector<KindPair> all;
  for (ShapeKind a : kConvexKinds) {
    for (ShapeKind b : kConvexKinds) {
      if (a != ShapeKind::halfspace || b != ShapeKind::halfspace) all.push_back({a, b});
    }
  }
  return all;
}

std::vector<KindPair> round_kind_pairs() {
  std::vector<KindPair> all;
  for (const ShapeKind round : kRoundKinds) {
    for (const ShapeKind other : kConvexKinds) {
      all.push_back({round, other});
      all.push_back({other, round});
    }
    for (const ShapeKind other : kRoundKinds) all.push_back({round, other});
  }
  return all;
}

bool has_round(const KindPair& kinds) {
  const auto is_one = [](ShapeKind kind) { return is_round(kind) || is_rounded(kind); };
  return is_one(kinds.a) || is_one(kinds.b);
}

std::string name(const KindPair& kinds) {
  return std::string(carom::name(kinds.a)) + "_" + carom::name(kinds.b);
}

bool is_slow(const KindPair& kinds) {
  const auto has_many_faces = [](ShapeKind kind) {
    return kind == ShapeKind::dop || kind == ShapeKind::hull;
  };
  return has_many_faces(kinds.a) || has_many_faces(kinds.b) || has_round(kinds);
}

size_t fewer_if_slow(const KindPair& kinds, size_t count) {
  return is_slow(kinds) ? std::max<size_t>(count / 8, 1) : count;
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
  place_pair(pair, size);
  return pair;
}

void ConvexPairMaker::place_pair(ConvexPair& pair, double size) {
  if (has_round(kinds_) && !pair.pose_a.position.allFinite()) return;
  if (family_.placement == ConvexPlacement::free) {
    const double factor = random_.uniform(0, 2);
    if (has_round(kinds_)) {
      place_round(pair, size, factor);
    } else if (is_slow(kinds_) && family_.largest > 1e30) {
      place<long double>(pair, size, factor, 8);  // doubles would overflow
    } else {
      place<double>(pair, size, factor, is_slow(kinds_) ? 8 : 10);
    }
  } else if (family_.placement == ConvexPlacement::near_touch) {
    const double factor = 1 + 0x1p-23 * shapes_.integer(-8, 8);
    if (has_round(kinds_)) {
      place_round(pair, size, 1.5);
      let_touch(pair);
    } else if (is_slow(kinds_)) {
      place<double>(pair, size, factor, 16);
    } else {
      place<long double>(pair, size, factor, 100);
    }
    nudge(pair.pose_b.position);
  } else if (kinds_.a == kinds_.b && random_.chance(0.3)) {
    pair.shape_b = pair.shape_a;
  }
}

// The separation is a convex function of the distance moved. A few steps of bisection find its root
// well enough for pairs of which half are to overlap.
void ConvexPairMaker::place_round(ConvexPair& pair, double size, double factor) {
  const SupportPair start(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b);
  const auto scale = static_cast<double>(start.scale());
  const Eigen::Vector3d between = middle_of(pair.shape_a, pair.pose_a.orientation) -
                                  middle_of(pair.shape_b, pair.pose_b.orientation);
  Eigen::Vector3d middle = pair.pose_a.position + between, way = random_.direction();
  if (start.has_halfspace()) {  // from below the plane to above it
    const SeparationBounds found = start.separation(0);
    const Eigen::Vector3d out = as_doubles(found.normal);
    way = (out * 1.1 + way).normalized();
    middle -= out * (static_cast<double>(found.low) + size);
  }
  const auto gap = [&](double reach) {
    const Eigen::Vector3d by = middle + way * reach - pair.pose_b.position;
    const SupportPair placed = start.with_b_moved(vec3_as<long double>(by));
    return static_cast<double>(placed.distance(1e-4L * size).low);
  };
  double low = 0, high = (start.has_halfspace() ? 40 : 4) * scale;
  for (int i = 0; i < 16; ++i) {
    const double middle_reach = (low + high) / 2;
    (gap(middle_reach) > 0 ? high : low) = middle_reach;
  }
  pair.pose_b.position = stored(middle + way * (high * factor));
}

void ConvexPairMaker::let_touch(ConvexPair& pair) {
  const SupportPair placed(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b);
  const SeparationBounds found = placed.distance(1e-12L * placed.scale());
  if (!std::isfinite(found.low)) return;  // they meet in a point, and no direction is known
  const long double by = found.low + 0x1p-22L * placed.scale() * shapes_.integer(-8, 8);
  pair.pose_b.position = stored(pair.pose_b.position + as_doubles(found.normal * -by));
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
