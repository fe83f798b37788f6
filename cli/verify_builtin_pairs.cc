// Random and special pairs of every two kinds that have a kernel.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "carom/kernel/compound_geometry.h"
#include "carom/kernel/mesh_geometry.h"
#include "carom/narrowphase/collide.h"
#include "carom/reference/reference.h"
#include "cli/verify_builtin.h"
#include "io/build_hull.h"
#include "io/generate/random.h"

namespace carom::cli {
namespace {

constexpr std::array kKinds = {ShapeKind::sphere,   ShapeKind::capsule,  ShapeKind::aabb,
                               ShapeKind::box,      ShapeKind::dop,      ShapeKind::hull,
                               ShapeKind::mesh,     ShapeKind::compound, ShapeKind::triangle,
                               ShapeKind::halfspace};
constexpr std::array kDopKinds = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min();

// A cube of which the corners are cut off.
Dop even_dop(float size) {
  Dop dop{.kind = DopKind::k14};
  dop.lower.fill(-size);
  dop.upper.fill(size);
  return dop;
}

// What cannot be made is not valid.
Hull hull_of(const std::vector<Eigen::Vector3f>& points) {
  Result<io::BuiltHull> hull = io::build_hull(points);
  return hull ? Hull{std::move(hull->geometry)} : Hull{};
}

Mesh mesh_of(const std::vector<Eigen::Vector3f>& vertices,
             const std::vector<std::array<uint32_t, 3>>& triangles, const MeshRules& rules) {
  auto mesh = make_mesh(vertices, triangles, rules);
  return mesh ? Mesh{std::move(*mesh)} : Mesh{};
}

Compound compound_of(const std::vector<CompoundChild>& children) {
  auto compound = make_compound(children);
  return compound ? Compound{std::move(*compound)} : Compound{};
}

Hull even_hull(float size) {
  std::vector<Eigen::Vector3f> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? size : -size, i & 2 ? size : -size, i & 4 ? size : -size);
  }
  return hull_of(corners);
}

// A shape whose numbers are all 0 or plus or minus `size`.
Shape even_shape(ShapeKind kind, float size) {
  const Eigen::Vector3f x(size, 0, 0);
  const Eigen::Vector3f y(0, size, 0);
  switch (kind) {
    case ShapeKind::capsule:
      return Capsule{-x, x, size};
    case ShapeKind::aabb:
      return Aabb::from_half_extents(Eigen::Vector3f::Constant(size));
    case ShapeKind::box:
      return Box{Eigen::Vector3f::Constant(size)};
    case ShapeKind::triangle:
      return Triangle{{x, y - x, -y - x}, size < 0 ? size : 0, false, 0};
    case ShapeKind::halfspace:
      return Halfspace{Eigen::Vector3f::Constant(size), size};
    case ShapeKind::dop:
      return even_dop(size);
    case ShapeKind::hull:
      return even_hull(size);
    case ShapeKind::mesh:
      return mesh_of({x, y, -x, -y}, {{0, 1, 2}, {2, 3, 0}},
                     {.one_sided = false, .thickness = size < 0 ? size : 0});
    case ShapeKind::compound:
      return compound_of({{Sphere{size}, x, Eigen::Quaternionf::Identity()},
                          {Box{Eigen::Vector3f::Constant(size)}, -x, {1, 0, 0, 1}}});
    default:
      return Sphere{size};
  }
}

// Kinds that are tested one at a time, or by their parts.
bool is_slow(ShapeKind a, ShapeKind b) {
  return has_geometry(a) || has_geometry(b) || a == ShapeKind::dop || b == ShapeKind::dop;
}

// Sizes over six decades, about half of the pairs overlapping.
class RandomPairs {
 public:
  RandomPairs(PositionType positions, uint64_t seed)
      : random_(seed, 0), pairs_{BodyColumns(positions), BodyColumns(positions)} {
    spread_ = positions == PositionType::float64 ? 1e7 : 100;
  }

  void add(ShapeKind a, ShapeKind b) {
    const double size_a = sizes_.draw(random_);
    const double size_b = size_a * random_.between(0.1, 1);
    const Shape shape_a = shape(a, size_a);
    const Shape shape_b = shape(b, size_b);
    const Pose pose_a{in_ball(spread_), orientation()};
    Pose pose_b{pose_a.position + in_ball(1.25 * (size_a + size_b)), orientation()};
    switch (pairs_.size() % 4) {
      case 0:
        break;  // as it comes
      case 1:
        separate(shape_a, pose_a, shape_b, pose_b, 0);
        break;
      default:
        separate(shape_a, pose_a, shape_b, pose_b,
                 size_b * depth(a, b) * random_.between(-1, most_apart(a, b)));
    }
    push(shape_a, pose_a, shape_b, pose_b);
  }

  // Coincident, touching, empty and ill-formed bodies; of slow kinds along one axis each.
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

  PairSet take() { return std::move(pairs_); }

 private:
  // Orientations that are hardly one, or none.
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

  // Compounds may be made of surfaces.
  static bool is_surface(ShapeKind kind) {
    return kind == ShapeKind::triangle || is_composite(kind);
  }

  // How deep two shapes may overlap before they are apart again; surfaces have no inside.
  static double depth(ShapeKind a, ShapeKind b) {
    return is_surface(a) || is_surface(b) ? 0.05 : 0.3;
  }

  // As a share of the depth, so that half of all pairs overlap: one-sided surfaces often do not
  // meet at all.
  static double most_apart(ShapeKind a, ShapeKind b) {
    return 0.5 - 0.25 * (is_surface(a) + is_surface(b));
  }

  // Moves B along the normal until it is about this far from A, unless it comes from behind a
  // one-sided triangle.
  void separate(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, Pose& pose_b,
                double separation) const {
    const reference::PairResult now =
        reference::collide(shape_a, pose_a, shape_b, pose_b, pairs_.a.positions());
    if (!std::isfinite(now.separation)) return;
    pose_b.position += (separation - double{now.separation}) * now.normal.cast<double>();
  }

  Eigen::Vector3d in_ball(double radius) {
    const io::Vec3 v = random_.in_ball(radius);
    return {v[0], v[1], v[2]};
  }
  Eigen::Vector3f point(double radius) { return in_ball(radius).cast<float>(); }
  bool one_of(uint32_t count) { return random_.below(count) == 0; }
  float up_to(double limit) { return static_cast<float>(random_.between(0, limit)); }

  // Most of them far from unit length.
  Eigen::Quaternionf orientation() {
    const double length = one_of(4) ? 1 : lengths_.draw(random_);
    const auto number = [&] { return static_cast<float>(length * random_.between(-1, 1)); };
    const float x = number(), y = number(), z = number(), w = number();
    return {w, x, y, z};
  }

  // Each of the three flat at times.
  Eigen::Vector3f half_extents(double size) {
    const auto edge = [&] {
      return one_of(16) ? 0 : static_cast<float>(size * random_.between(0.3, 1));
    };
    const float x = edge(), y = edge(), z = edge();
    return {x, y, z};
  }

  Shape shape(ShapeKind kind, double size) {
    switch (kind) {
      case ShapeKind::capsule:
        return capsule(size);
      case ShapeKind::aabb: {
        const Eigen::Vector3f lower = -half_extents(size);
        return Aabb{lower, half_extents(size)};
      }
      case ShapeKind::box:
        return Box{half_extents(size)};
      case ShapeKind::triangle:
        return triangle(size);
      case ShapeKind::halfspace:
        return halfspace(size);
      case ShapeKind::dop:
        return dop(size);
      case ShapeKind::hull:
        return hull(size);
      case ShapeKind::mesh:
        return mesh(size);
      case ShapeKind::compound:
        return compound(size);
      default:
        return Sphere{static_cast<float>(size)};
    }
  }

  Capsule capsule(double size) {
    Capsule capsule;
    capsule.a = point(size);
    capsule.b = one_of(8) ? capsule.a : point(size);
    capsule.radius = one_of(8) ? 0 : up_to(0.5 * size);
    return capsule;
  }

  std::vector<Eigen::Vector3f> some_points(size_t count, double size) {
    std::vector<Eigen::Vector3f> points(count);
    for (Eigen::Vector3f& p : points) p = point(size);
    return points;
  }

  // Of a point and more.
  Dop dop(double size) {
    const std::vector<Eigen::Vector3f> points = some_points(1 + random_.below(12), size);
    return Dop::of_points(points, kDopKinds[random_.below(kDopKinds.size())]);
  }

  // Of a point and more, flat at times.
  Hull hull(double size) {
    std::vector<Eigen::Vector3f> points = some_points(1 + random_.below(20), size);
    if (one_of(8)) {
      for (Eigen::Vector3f& p : points) p.z() = 0;
    }
    return hull_of(points);
  }

  // A strip of triangles that share edges.
  Mesh mesh(double size) {
    const std::vector<Eigen::Vector3f> vertices = some_points(4 + random_.below(4), size);
    std::vector<std::array<uint32_t, 3>> triangles;
    for (uint32_t i = 0; i + 2 < vertices.size(); ++i) {
      triangles.push_back({i + i % 2, i + 1 - i % 2, i + 2});
    }
    if (one_of(8)) triangles[0][1] = triangles[0][0];
    const float thickness = one_of(4) ? up_to(0.5 * size) : 0;
    return mesh_of(vertices, triangles, {.one_sided = one_of(4), .thickness = thickness});
  }

  Compound compound(double size) {
    constexpr std::array kParts = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::aabb,
                                   ShapeKind::box,    ShapeKind::dop,     ShapeKind::hull,
                                   ShapeKind::mesh,   ShapeKind::triangle};
    std::vector<CompoundChild> children(1 + random_.below(3));
    for (CompoundChild& child : children) {
      child.shape = shape(kParts[random_.below(kParts.size())], size / 2);
      child.position = point(size / 2);
      child.orientation = orientation();
    }
    return compound_of(children);
  }

  Triangle triangle(double size) {
    Triangle triangle;
    for (Eigen::Vector3f& corner : triangle.corners) corner = point(size);
    if (one_of(16)) triangle.corners[2] = triangle.corners[0];
    triangle.thickness = one_of(4) ? up_to(0.5 * size) : 0;
    triangle.one_sided = one_of(4);
    triangle.inner_edges = static_cast<uint8_t>(one_of(2) ? random_.below(8) : 0);
    return triangle;
  }

  Halfspace halfspace(double size) {
    Halfspace halfspace;
    halfspace.normal = point(1);
    halfspace.offset = static_cast<float>(size * random_.between(-1, 1));
    return halfspace;
  }

  io::Random random_;
  io::LogUniform sizes_{1e-3, 1e3};
  io::LogUniform lengths_{1e-15, 1e15};
  PairSet pairs_;
  double spread_;
};

constexpr size_t kPairs = 2003;
constexpr size_t kMixedPairs = 1009;
constexpr size_t kSlowPairs = 83;
constexpr size_t kPairsOfParts = 53;

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

bool meets_all(ShapeKind a) {
  return std::all_of(kKinds.begin(), kKinds.end(), [&](ShapeKind b) { return supports(a, b); });
}

BuiltinPairs mixed_pairs(PositionType positions, uint64_t seed) {
  std::vector<std::pair<ShapeKind, ShapeKind>> kinds;
  for (ShapeKind a : kKinds) {
    for (ShapeKind b : kKinds) {
      if (meets_all(a)) kinds.push_back({a, b});
    }
  }
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
        sets.push_back(is_float64 ? pairs_of(*b, *a, positions, sets.size())
                                  : pairs_of(*a, *b, positions, sets.size()));
      }
    }
    sets.push_back(mixed_pairs(positions, sets.size()));
    for (size_t i = first; i < sets.size(); ++i) {
      sets[i].name += is_float64 ? ", float64" : ", float32";
    }
  }
  return sets;
}

}  // namespace carom::cli
