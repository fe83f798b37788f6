// GJK in doubles finds the likely answer and a reason: a direction that separates the shapes, or
// points of their difference around the origin. Then the reason is checked:
//   separate  The projections on the direction are apart by more than rounding.
//   overlap   The simplex has a point that is nearer to the origin than the radii reach. The point
//   is
//             a convex combination of the corners with weights that are positive beyond rounding.
//             Or, for shapes without radii, the simplex contains the origin by more than rounding.
//             Each corner is a point of B minus a point of A, up to rounding, so the shapes have a
//             common point.
#include "narrowphase/proof/proof.h"

#include <cmath>
#include <optional>
#include <variant>

#include "carom/results/tier.h"
#include "narrowphase/doubles/furthest_scalar.h"
#include "narrowphase/doubles/gjk.h"
#include "narrowphase/doubles/make_core.h"
#include "narrowphase/features/halfspace_scalar.h"
#include "narrowphase/proof/overlap_search.h"
#include "narrowphase/scalar/quaternion_as.h"

namespace carom {
namespace {

using Eigen::Vector3d;
using Vector = VectorOf<double>;
using PointHull = GrownHull<double>;
using scalar::Polytope;

// With the greatest coordinate between one and two, points err by less than this, including the
// rotation: some dozen roundings of 2^-52 each.
constexpr double kRounding = 0x1p-44;
// Corners of k-DOPs are found to within kDopRounding. The normal of a thick triangle errs by 2^-52
// over the sine of its angle.
constexpr double kRoundingOfDops = 4 * kDopRounding;
constexpr double kLeastDop = 0x1p-20;
constexpr double kRoundingOfFronts = 0x1p-30;
constexpr double kLeastSine = 0x1p-16;

// Sizes that can be scaled: all floats, and squared distances of them.
constexpr double kLeastSize = 0x1p-400;
constexpr double kGreatestSize = 0x1p400;

// GJK in doubles ends after some ten rounds, or cycles.
constexpr int kMostRounds = 32;

// --- The shapes in scaled units ---

Vector vector_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

struct ProofBody {
  PointHull hull;
  std::optional<Core> round;  // of a cylinder, cone or ellipsoid, which has no hull
  Vector3d middle = Vector3d::Zero();
  scalar::FrontRules rules;
  double rounding = kRounding;
  bool is_known = true;  // false: there is no bound of its rounding

  ProofBody() = default;
  explicit ProofBody(const Polytope& polytope) : middle(polytope.middle), rules(polytope.rules) {
    for (const Vector3d& p : polytope.points) hull.points.push_back(vector_of(p));
    hull.radius = polytope.radius;
  }

  void move(const Vector3d& by) {
    for (Vector& p : hull.points) p = p + vector_of(by);
    if (round) round->move(scalar::core_vector(by));
    middle += by;
    rules.corner += by;
  }

  Core core() const {
    if (round) return *round;
    Core core;
    core.resize(hull.points.size());
    for (size_t i = 0; i < hull.points.size(); ++i) core.set(i, hull.points[i]);
    core.pad();
    core.radius = hull.radius;
    core.middle = scalar::core_vector(middle);
    return core;
  }
};

struct BodyMaker {
  double scale;
  const scalar::Quaternion<double>& turn;

  template <class T>
  ProofBody operator()(const T& shape) const {
    return ProofBody(scalar::polytope_of(scalar::shape_as<double>(shape).scaled(scale), turn));
  }
  ProofBody operator()(const Hull& shape) const {
    Core core;
    scalar::make_core(scalar::shape_as<double>(shape).scaled(scale), turn, Vector3d::Zero(), core);
    ProofBody body;
    for (size_t i = 0; i < core.size(); ++i) body.hull.points.push_back(core.point(i));
    body.hull.radius = core.radius;
    body.middle = scalar::eigen_vector(core.middle);
    return body;
  }
  // Only solid k-DOPs: the corners of slabs that hardly intersect have no error bound.
  ProofBody operator()(const Dop& dop) const {
    const Polytope polytope =
        scalar::polytope_of(scalar::shape_as<double>(dop).scaled(scale), turn);
    ProofBody body(polytope);
    body.rounding = kRoundingOfDops;
    body.is_known = !polytope.points.empty() && polytope.inner_radius > kLeastDop;
    return body;
  }
  ProofBody operator()(const Triangle& triangle) const {
    const auto shape = scalar::shape_as<double>(triangle).scaled(scale);
    ProofBody body(scalar::polytope_of(shape, turn));
    if (!(triangle.thickness > 0 || triangle.one_sided)) return body;
    body.rounding = kRoundingOfFronts;
    body.is_known = has_sure_front(shape.corners);
    return body;
  }
  ProofBody operator()(const Halfspace&) const { return {}; }
  ProofBody operator()(const Cylinder& shape) const { return round(shape); }
  ProofBody operator()(const Cone& shape) const { return round(shape); }
  ProofBody operator()(const Ellipsoid& shape) const { return round(shape); }
  ProofBody operator()(const Mesh&) const { return nothing(); }
  ProofBody operator()(const HeightField&) const { return nothing(); }
  ProofBody operator()(const Compound&) const { return nothing(); }

  // Its support points err no more than other points.
  template <class T>
  ProofBody round(const T& shape) const {
    ProofBody body;
    scalar::make_core(scalar::shape_as<double>(shape).scaled(scale), turn, Vector3d::Zero(),
                      body.round.emplace());
    return body;
  }

  // Parts are proven one by one.
  static ProofBody nothing() {
    ProofBody body;
    body.is_known = false;
    return body;
  }

  static bool has_sure_front(const std::array<Vector3d, 3>& c) {
    const Vector3d u = c[1] - c[0], v = c[2] - c[0];
    const Vector3d n = scalar::cross(u, v);
    const double sizes = scalar::largest_component(u) * scalar::largest_component(v);
    return scalar::largest_component(n) > kLeastSine * sizes && sizes > 0;
  }
};

scalar::Quaternion<double> turn_of(const StatedBody& body) {
  return scalar::quaternion_as<double>(Eigen::Vector4f(body.orientation[0], body.orientation[1],
                                                       body.orientation[2], body.orientation[3]));
}

Vector3d way_between(const StatedBody& a, const StatedBody& b) {
  return {b.position.x - a.position.x, b.position.y - a.position.y, b.position.z - a.position.z};
}

// --- Shapes from behind a one-sided triangle ---

enum class Side { front, behind, unknown };

Side side_of(const scalar::FrontRules& rules, const Vector3d& middle, double rounding) {
  if (!rules.one_sided) return Side::front;
  const double height = scalar::dot(rules.front, Vector3d(middle - rules.corner)) + rules.thickness;
  if (std::fabs(height) <= rounding) return Side::unknown;
  return height < 0 ? Side::behind : Side::front;
}

// --- Two hulls ---

double length(const Vector& v) { return std::sqrt(dot(v, v)); }

bool is_apart_along(const PointHull& a, const PointHull& b, const Vector& way, double rounding) {
  const double scale = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  if (!(scale > 0)) return false;
  const Vector n = {way.x / scale, way.y / scale, way.z / scale};
  double top = -HUGE_VAL, bottom = HUGE_VAL;
  for (const Vector& p : a.points) top = std::max(top, dot(n, p));
  for (const Vector& p : b.points) bottom = std::min(bottom, dot(n, p));
  return bottom - top > length(n) * ((a.radius + b.radius) + rounding);
}

// The point nearest to the origin, as a combination of the corners. With any non-negative weights
// that sum to one it is a point of the simplex.
Vector nearest_by_weights(const FewOf<Vector, 4>& y) {
  std::array<double, 4> weight{};
  if (y.size() == 2) {
    const Vector along = y[1] - y[0];
    weight = {dot(along, y[1]), -dot(along, y[0])};
  } else if (y.size() == 3) {
    const Vector n = cross(y[1] - y[0], y[2] - y[0]);
    for (size_t i = 0; i < 3; ++i) weight[i] = dot(n, cross(y[(i + 1) % 3], y[(i + 2) % 3]));
  } else {
    weight[0] = 1;
  }
  double sum = 0;
  for (double& w : weight) {
    w = std::max(w, 0.0);
    sum += w;
  }
  Vector v{0, 0, 0};
  for (size_t i = 0; i < y.size(); ++i) v = v + y[i] * (weight[i] / sum);
  return v;
}

// Whether the origin is inside all four faces by more than the corners may err.
bool holds_origin(const FewOf<Vector, 4>& y, double rounding) {
  if (y.size() < 4) return false;
  for (size_t i = 0; i < 4; ++i) {
    const Vector &apex = y[i], &a = y[(i + 1) % 4], &b = y[(i + 2) % 4], &c = y[(i + 3) % 4];
    const Vector n = cross(b - a, c - a);
    const double to_apex = dot(n, apex - a);
    const double to_origin = to_apex < 0 ? dot(n, a) : -dot(n, a);
    if (!(to_origin > length(n) * (4 * rounding) + kProvenVolume)) return false;
  }
  return true;
}

uint8_t prove_hulls(const PointHull& a, const PointHull& b, double rounding) {
  const auto evidence = OverlapSearch<double>(a, b, kMostRounds).run();
  if (!evidence.overlap) {
    return is_apart_along(a, b, evidence.way, 4 * rounding) ? uint8_t{0} : kUndecided;
  }
  if (holds_origin(evidence.simplex, rounding)) return 1;
  if (evidence.simplex.size() == 4) return kUndecided;
  const double nearest = length(nearest_by_weights(evidence.simplex));
  return nearest + 4 * rounding < a.radius + b.radius ? uint8_t{1} : kUndecided;
}

// The same reasons as for hulls, from the search of round cores.
uint8_t prove_round(const Core& a, const Core& b, double rounding) {
  const double radii = a.radius + b.radius;
  const NearestWay nearest = nearest_round_way(a, b, &scalar::furthest_point);
  if (nearest.corners.size() == 4) {
    return holds_origin(nearest.corners, rounding) ? uint8_t{1} : kUndecided;
  }
  if (nearest.gap > length(nearest.way) * (radii + 4 * rounding)) return 0;
  const double distance = length(nearest_by_weights(nearest.corners));
  return distance + 4 * rounding < radii ? uint8_t{1} : kUndecided;
}

uint8_t prove_bodies(const ProofBody& a, ProofBody b, const Vector3d& way) {
  if (!a.is_known || !b.is_known) return kUndecided;
  b.move(way);
  const double rounding = std::max(a.rounding, b.rounding);
  for (const Side side :
       {side_of(a.rules, b.middle, rounding), side_of(b.rules, a.middle, rounding)}) {
    if (side == Side::unknown) return kUndecided;
    if (side == Side::behind) return 0;
  }
  if (a.round || b.round) return prove_round(a.core(), b.core(), rounding);
  return prove_hulls(a.hull, b.hull, rounding);
}

// --- A half-space (A) ---

uint8_t prove_over_plane(const StatedBody& a, const ProofBody& b, const Vector3d& way,
                         double scale) {
  if (!b.is_known) return kUndecided;
  const auto halfspace = scalar::shape_as<double>(std::get<Halfspace>(a.shape)).scaled(scale);
  const auto plane = scalar::plane_of<double>(halfspace, turn_of(a), -way);
  if (b.rules.one_sided) {
    const double towards = scalar::dot(b.rules.front, plane.normal);
    if (std::fabs(towards) <= b.rounding) return kUndecided;
    if (towards > 0) return 0;
  }
  const Vector n = vector_of(plane.normal);
  double lowest = b.round ? dot(n, b.round->furthest_round(-n)) : HUGE_VAL;
  for (const Vector& p : b.hull.points) lowest = std::min(lowest, dot(n, p));
  const double radius = b.round ? b.round->radius : b.hull.radius;
  const double height = (lowest - plane.height) - radius;
  if (!(std::fabs(height) > 4 * b.rounding)) return kUndecided;
  return height < 0;
}

}  // namespace

uint8_t prove_overlap(const StatedBody& a, const StatedBody& b) {
  const Vector3d metres = way_between(a, b);
  const double size =
      std::max({scalar::largest_component(metres), size_of(a.shape), size_of(b.shape)});
  if (!(size > kLeastSize && size < kGreatestSize)) return kUndecided;
  const double scale = scalar::scale_of(size).down;
  const Vector3d way = metres * scale;
  const auto made = [&](const StatedBody& body) {
    return std::visit(BodyMaker{scale, turn_of(body)}, body.shape);
  };
  if (std::holds_alternative<Halfspace>(a.shape)) return prove_over_plane(a, made(b), way, scale);
  if (std::holds_alternative<Halfspace>(b.shape)) return prove_over_plane(b, made(a), -way, scale);
  return prove_bodies(made(a), made(b), way);
}

}  // namespace carom
