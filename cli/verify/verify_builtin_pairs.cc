// Makes random and special pairs of every two kinds that have a kernel, at rest and moving.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "carom/narrowphase/collide.h"
#include "carom/reference/reference.h"
#include "cli/verify/verify_builtin.h"
#include "cli/verify/verify_builtin_shapes.h"
#include "io/generate/random.h"

namespace carom::cli {
namespace {

constexpr std::array kKinds = {
    ShapeKind::sphere,    ShapeKind::capsule,     ShapeKind::aabb,        ShapeKind::box,
    ShapeKind::dop,       ShapeKind::hull,        ShapeKind::mesh,        ShapeKind::compound,
    ShapeKind::triangle,  ShapeKind::halfspace,   ShapeKind::cylinder,    ShapeKind::cone,
    ShapeKind::ellipsoid, ShapeKind::rounded_box, ShapeKind::rounded_hull};

constexpr float kDenormal = std::numeric_limits<float>::denorm_min();

// Kinds that are slow, because the library tests them one at a time or part by part.
bool is_slow(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::dop:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
    case ShapeKind::ellipsoid:
      return true;
    default:
      return has_geometry(kind);
  }
}
bool is_slow(ShapeKind a, ShapeKind b) { return is_slow(a) || is_slow(b); }

// Random pairs of sizes over six decades; about half of them overlap.
class RandomPairs {
 public:
  RandomPairs(PositionType positions, uint64_t seed)
      : random_(seed, 0), pairs_{BodyColumns(positions), BodyColumns(positions)} {
    spread_ = positions == PositionType::float64 ? 1e7 : 100;
  }

  void add(ShapeKind a, ShapeKind b) {
    const Placed pair = place(a, b);
    push(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b);
  }

  // Adds bodies that move, turning or not, to where add() would place them. Some arrive after the
  // interval, more of them with a half-space, which is hard to miss. If a pair would begin with an
  // overlap, most of the time its motion is reversed.
  void add_moving(ShapeKind a, ShapeKind b) {
    const Placed pair = place(a, b);
    const bool hard_to_miss = a == ShapeKind::halfspace || b == ShapeKind::halfspace;
    const double time = random_.between(0, hard_to_miss ? 4 : 1.7);
    Sweep sweep_a = sweep(pair.size);
    Sweep sweep_b = sweep(pair.size);
    Placed start = moved(pair, sweep_a, sweep_b, -time);
    if (!shapes_.one_of(4) && collide(start).overlap) {
      sweep_a = reversed(sweep_a);
      sweep_b = reversed(sweep_b);
      start = moved(pair, sweep_a, sweep_b, -time);
    }
    push(start.shape_a, start.pose_a, start.shape_b, start.pose_b, sweep_a, sweep_b);
  }

  // Adds coincident, touching, empty and ill-formed bodies; slow kinds along one axis each.
  void add_special(ShapeKind a, ShapeKind b) {
    const Eigen::Quaternionf turns[] = {Eigen::Quaternionf::Identity(), {1, 0, 0, 1}, {4, 1, 2, 3}};
    for (float size : {0.0f, 1.0f, 1e-30f, 1e18f, 3 * kDenormal, -1.0f, kNan, kInfinity}) {
      for (double distance : {0.0, 1.0, 2.0, -2.0, 2e-30, 2e18, double{kNan}, double{kInfinity}}) {
        const int only = static_cast<int>(pairs_.size() % 3);
        for (int axis = 0; axis < 3; ++axis) {
          if (is_slow(a, b) && axis != only) continue;
          push(even_shape(a, 1), {}, even_shape(b, size),
               {distance * Eigen::Vector3d::Unit(axis), turns[axis]});
        }
      }
    }
    add_orientations(a, b);
  }

  // Adds motions to exact touch, and tiny, huge and ill-formed ones.
  void add_special_motions(ShapeKind a, ShapeKind b) {
    const Eigen::Vector3f x = Eigen::Vector3f::UnitX();
    const Eigen::Vector3f y = Eigen::Vector3f::UnitY();
    const Eigen::Vector3f none = Eigen::Vector3f::Zero();
    for (const Sweep& sweep : {Sweep{none, none},
                               {-x, none},
                               {-2 * x, none},
                               {2 * x, none},
                               {-4 * x, 3 * y},
                               {none, 6 * y},
                               {-1e9f * x, none},
                               {kDenormal * x, kDenormal * y},
                               {kNan * x, none},
                               {kInfinity * y, none},
                               {-4 * x, kNan * y},
                               {-4 * x, -kInfinity * y}}) {
      const Shape shape_a = even_shape(a, 1);
      const Shape shape_b = even_shape(b, 1);
      Pose beside;
      beside.position.x() = 4;
      push(shape_a, {}, shape_b, beside, {}, sweep);
      push(shape_a, {}, shape_b, {}, sweep, {});
    }
  }

  PairSet take() { return std::move(pairs_); }

 private:
  struct Placed {
    Shape shape_a;
    Shape shape_b;
    Pose pose_a;
    Pose pose_b;
    double size;
  };

  Placed place(ShapeKind a, ShapeKind b) {
    const double size_a = sizes_.draw(random_);
    const double size_b = size_a * random_.between(0.1, 1);
    Placed pair{shapes_.shape(a, size_a), shapes_.shape(b, size_b), {}, {}, size_a + size_b};
    pair.pose_a = {shapes_.in_ball(spread_), shapes_.orientation()};
    pair.pose_b.position = pair.pose_a.position + shapes_.in_ball(1.25 * pair.size);
    pair.pose_b.orientation = shapes_.orientation();
    switch (pairs_.size() % 4) {
      case 0:
        break;  // keep the random pose
      case 1:
        separate(pair, 0);
        break;
      default:
        separate(pair, size_b * depth(a, b) * random_.between(-1, most_apart(a, b)));
    }
    return pair;
  }

  // A random sweep; one in eight does not move, half do not turn.
  Sweep sweep(double size) {
    Sweep sweep;
    if (!shapes_.one_of(8)) sweep.displacement = shapes_.in_ball(6 * size).cast<float>();
    if (shapes_.one_of(2)) sweep.rotation = shapes_.in_ball(2).cast<float>();
    return sweep;
  }

  static Sweep reversed(const Sweep& sweep) { return {-sweep.displacement, -sweep.rotation}; }

  static Placed moved(Placed pair, const Sweep& sweep_a, const Sweep& sweep_b, double time) {
    move(pair.pose_a, sweep_a, time);
    move(pair.pose_b, sweep_b, time);
    return pair;
  }

  static void move(Pose& pose, const Sweep& sweep, double time) {
    pose.position += time * sweep.displacement.cast<double>();
    const Eigen::Vector3d turn = time * sweep.rotation.cast<double>();
    if (turn.isZero(0)) return;
    const Eigen::Quaterniond by(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    pose.orientation = (by * pose.orientation.cast<double>()).cast<float>();
  }

  // Adds orientations that are invalid or nearly so.
  void add_orientations(ShapeKind a, ShapeKind b) {
    const Eigen::Vector3d unit_y = Eigen::Vector3d::UnitY();
    for (const Eigen::Quaternionf& q : {Eigen::Quaternionf{0, 0, 0, 0},
                                        {1, 0, kNan, 0},
                                        {-kInfinity, 0, 0, 1},
                                        {1e-30f, 2e-30f, 0, 0},
                                        {0, 1e18f, 0, -1e18f},
                                        {kDenormal, 0, 0, kDenormal}}) {
      push(even_shape(a, 1), {unit_y, q}, even_shape(b, 1), {});
      push(even_shape(a, 1), {unit_y, Eigen::Quaternionf::Identity()}, even_shape(b, 1),
           {Eigen::Vector3d::Zero(), q});
    }
  }

  void push(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b) {
    pairs_.a.push(shape_a, pose_a);
    pairs_.b.push(shape_b, pose_b);
  }

  void push(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b,
            const Sweep& sweep_a, const Sweep& sweep_b) {
    push(shape_a, pose_a, shape_b, pose_b);
    pairs_.motions_a.push(sweep_a);
    pairs_.motions_b.push(sweep_b);
  }

  // Counts compounds as surfaces, because they may consist of them.
  static bool is_surface(ShapeKind kind) {
    return kind == ShapeKind::triangle || is_composite(kind);
  }

  // A depth of overlap that most pairs can have, as a share of the size; surfaces have no inside.
  static double depth(ShapeKind a, ShapeKind b) {
    return is_surface(a) || is_surface(b) ? 0.05 : 0.3;
  }

  // The greatest separation, as a share of the depth. The values make half of all pairs overlap,
  // because one-sided surfaces often do not meet at all.
  static double most_apart(ShapeKind a, ShapeKind b) {
    return 0.5 - 0.25 * (is_surface(a) + is_surface(b));
  }

  reference::PairResult collide(const Placed& pair) const {
    return reference::collide(pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b,
                              pairs_.a.positions());
  }

  // Moves B along the normal until it is about this far from A. Does nothing if B is behind a
  // one-sided triangle.
  void separate(Placed& pair, double separation) const {
    const reference::PairResult now = collide(pair);
    if (!std::isfinite(now.separation)) return;
    pair.pose_b.position += (separation - double{now.separation}) * now.normal.cast<double>();
  }

  io::Random random_;
  RandomShapes shapes_{random_};
  io::LogUniform sizes_{1e-3, 1e3};
  PairSet pairs_;
  double spread_;
};

constexpr size_t kPairs = 2003;
constexpr size_t kMixedPairs = 1009;
constexpr size_t kSlowPairs = 83;
constexpr size_t kPairsOfParts = 53;
constexpr size_t kMovingPairs = 131;
constexpr size_t kSlowMovingPairs = 29;

size_t pair_count(ShapeKind a, ShapeKind b) {
  if (is_composite(a) || is_composite(b)) return kPairsOfParts;
  return is_slow(a, b) ? kSlowPairs : kPairs;
}

BuiltinPairs pairs_of(ShapeKind a, ShapeKind b, PositionType positions, uint64_t seed) {
  RandomPairs pairs(positions, seed);
  for (size_t i = 0; i < pair_count(a, b); ++i) pairs.add(a, b);
  pairs.add_special(a, b);
  return {std::string(name(a)) + "-" + name(b) + " pairs", pairs.take()};
}

BuiltinPairs moving_pairs_of(ShapeKind a, ShapeKind b) {
  RandomPairs pairs(PositionType::float32, 1);
  const size_t count = is_slow(a, b) ? kSlowMovingPairs : kMovingPairs;
  for (size_t i = 0; i < count; ++i) pairs.add_moving(a, b);
  pairs.add_special_motions(a, b);
  return {std::string(name(a)) + "-" + name(b) + " moving pairs, float32", pairs.take()};
}

bool meets_all(ShapeKind a) {
  return std::all_of(kKinds.begin(), kKinds.end(), [&](ShapeKind b) { return supports(a, b); });
}

// Pairs of kinds that may be in one set.
std::vector<std::pair<ShapeKind, ShapeKind>> mixed_kinds() {
  std::vector<std::pair<ShapeKind, ShapeKind>> kinds;
  for (ShapeKind a : kKinds) {
    for (ShapeKind b : kKinds) {
      if (meets_all(a)) kinds.push_back({a, b});
    }
  }
  return kinds;
}

BuiltinPairs mixed_pairs(PositionType positions, uint64_t seed) {
  const auto kinds = mixed_kinds();
  RandomPairs pairs(positions, seed);
  for (const auto& [a, b] : kinds) {
    if (!is_slow(a, b)) pairs.add_special(a, b);
  }
  for (size_t i = 0; i < kMixedPairs; ++i) {
    const auto& [a, b] = kinds[i % kinds.size()];
    pairs.add(a, b);
  }
  return {"mixed pairs", pairs.take()};
}

BuiltinPairs mixed_moving_pairs() {
  const auto kinds = mixed_kinds();
  RandomPairs pairs(PositionType::float64, 1);
  for (size_t i = 0; i < kMixedPairs; ++i) {
    const auto& [a, b] = kinds[i % kinds.size()];
    pairs.add_moving(a, b);
  }
  return {"mixed moving pairs, float64", pairs.take()};
}

// New kinds leave the pairs of others as they are.
uint64_t seed_of(ShapeKind a, ShapeKind b, PositionType positions) {
  constexpr uint64_t kMostKinds = 64;
  const uint64_t of_positions = positions == PositionType::float64 ? 1 : 0;
  return (of_positions * kMostKinds + static_cast<uint64_t>(a)) * kMostKinds +
         static_cast<uint64_t>(b);
}

}  // namespace

std::vector<BuiltinPairs> builtin_pairs() {
  std::vector<BuiltinPairs> sets;
  for (PositionType positions : {PositionType::float32, PositionType::float64}) {
    const bool is_float64 = positions == PositionType::float64;
    const size_t first = sets.size();
    for (auto a = kKinds.begin(); a != kKinds.end(); ++a) {
      for (auto b = a; b != kKinds.end(); ++b) {
        if (!supports(*a, *b)) continue;
        // float64 with the sides exchanged: kernels exist for one order only.
        const uint64_t seed = seed_of(*a, *b, positions);
        sets.push_back(is_float64 ? pairs_of(*b, *a, positions, seed)
                                  : pairs_of(*a, *b, positions, seed));
      }
    }
    sets.push_back(mixed_pairs(positions, is_float64 ? 2 : 1));
    for (size_t i = first; i < sets.size(); ++i) {
      sets[i].name += is_float64 ? ", float64" : ", float32";
    }
  }
  return sets;
}

std::vector<BuiltinPairs> builtin_motions() {
  std::vector<BuiltinPairs> sets;
  for (auto a = kKinds.begin(); a != kKinds.end(); ++a) {
    for (auto b = a; b != kKinds.end(); ++b) {
      if (supports(*a, *b)) sets.push_back(moving_pairs_of(*a, *b));
    }
  }
  sets.push_back(mixed_moving_pairs());
  return sets;
}

}  // namespace carom::cli
