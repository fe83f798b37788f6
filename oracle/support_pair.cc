#include "oracle/support_pair.h"

#include <cmath>
#include <limits>
#include <memory>

#include "oracle/convex_oracle.h"
#include "oracle/round_surface.h"
#include "oracle/simplex_search.h"

namespace carom::oracle {
namespace {

using Vec = Vec3<long double>;

// Support points in the body's frame.
Vec own_support(const Cylinder& c, const Vec& way) {
  const Vec rim = normalized(Vec{way.x, way.y, 0}) * c.radius;
  return {rim.x, rim.y, way.z > 0 ? c.half_length : -c.half_length};
}
Vec own_support(const Cone& c, const Vec& way) {
  const Vec rim = normalized(Vec{way.x, way.y, 0}) * c.radius;
  const Vec base{rim.x, rim.y, -c.half_length}, tip{0, 0, c.half_length};
  return dot(way, tip) > dot(way, base) ? tip : base;
}
Vec own_support(const Ellipsoid& e, const Vec& way) {
  const Vec s = vec3_as<long double>(e.semi_axes);
  const Vec unit = normalized(Vec{s.x * way.x, s.y * way.y, s.z * way.z});
  return {s.x * unit.x, s.y * unit.y, s.z * unit.z};
}

template <class Round>
SupportShape round_support(const Round& shape, const Pose& pose, const Vec& at) {
  const Rotation<long double> turn(pose.orientation);
  return {
      [turn, at, shape](const Vec& way) { return turn(own_support(shape, turn.back(way))) + at; },
      shape.rounding};
}

SupportShape support_of(const std::shared_ptr<const ConvexShape<>>& solved) {
  const auto furthest = [solved](const Vec& way) {
    Vec best = solved->points.front();
    for (const Vec& p : solved->points) best = dot(way, p) > dot(way, best) ? p : best;
    return best;
  };
  return {furthest, solved->radius};
}

double reach_of(const Cylinder& c) { return std::hypot(c.radius, c.half_length) + c.rounding; }
double reach_of(const Cone& c) { return std::hypot(c.radius, c.half_length) + c.rounding; }
double reach_of(const Ellipsoid& e) { return double{e.semi_axes.maxCoeff()} + e.rounding; }

}  // namespace

SupportShape support_shape(const Shape& shape, const Pose& pose,
                           const Eigen::Vector3d& relative_to) {
  const Vec at = vec3_as<long double>(pose.position) - vec3_as<long double>(relative_to);
  if (const auto* c = std::get_if<Cylinder>(&shape)) return round_support(*c, pose, at);
  if (const auto* c = std::get_if<Cone>(&shape)) return round_support(*c, pose, at);
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) return round_support(*e, pose, at);
  return support_of(std::make_shared<ConvexShape<>>(shape, pose, relative_to));
}

SupportPair::Side SupportPair::side_of(const Shape& shape, const Pose& pose,
                                       const Eigen::Vector3d& relative_to) {
  if (std::holds_alternative<Halfspace>(shape)) {
    const ConvexShape<> plane(shape, pose, relative_to);
    const auto distance = [plane](const Vec& p) {
      return std::fabs(dot(plane.normal, p) - plane.offset);
    };
    return {{}, distance, Plane{plane.normal, plane.offset}, plane.bounding_radius};
  }
  const Vec at = vec3_as<long double>(pose.position) - vec3_as<long double>(relative_to);
  const auto round = [&](const auto& own) -> Side {
    const auto distance = [turn = Rotation<long double>(pose.orientation), at, own](const Vec& p) {
      return *round_surface_distance(own, turn.back(p - at));
    };
    return {round_support(own, pose, at), distance, {}, reach_of(own)};
  };
  if (const auto* c = std::get_if<Cylinder>(&shape)) return round(*c);
  if (const auto* c = std::get_if<Cone>(&shape)) return round(*c);
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) return round(*e);
  const auto solved = std::make_shared<const ConvexShape<>>(shape, pose, relative_to);
  const auto distance = [solved](const Vec& p) { return std::fabs(signed_distance(*solved, p)); };
  return {support_of(solved), distance, {}, solved->bounding_radius};
}

SupportPair::SupportPair(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                         const Pose& pose_b)
    : a_(side_of(shape_a, pose_a, pose_a.position)),
      b_(side_of(shape_b, pose_b, pose_a.position)) {}

SupportPair SupportPair::with_b_moved(const Vec& by) const {
  SupportPair moved = *this;
  moved.b_.distance = [distance = b_.distance, by](const Vec& p) { return distance(p - by); };
  if (moved.b_.plane) {
    moved.b_.plane->offset += dot(moved.b_.plane->normal, by);
  } else {
    moved.b_.shape.furthest = [furthest = b_.shape.furthest, by](const Vec& way) {
      return furthest(way) + by;
    };
  }
  return moved;
}

long double SupportPair::gap_over(const Plane& plane, const SupportShape& shape) {
  return (dot(plane.normal, shape.furthest(-plane.normal)) - shape.radius) - plane.offset;
}

SeparationBounds SupportPair::separation(long double tolerance, size_t most_triangles) const {
  if (!has_halfspace()) {
    return separation_by_supports(a_.shape, b_.shape, tolerance, most_triangles);
  }
  const long double gap = a_.plane ? gap_over(*a_.plane, b_.shape) : gap_over(*b_.plane, a_.shape);
  return {gap, gap, a_.plane ? a_.plane->normal : -b_.plane->normal};
}

SeparationBounds SupportPair::distance(long double tolerance) const {
  if (has_halfspace()) return separation(0);
  const auto difference = [this](const Vec& way) {
    return b_.shape.furthest(way) - a_.shape.furthest(-way);
  };
  const auto enough = [&](long double) { return tolerance; };
  const DistanceProof<long double> cores = distance_from_origin<long double>(difference, enough);
  const long double radii = a_.shape.radius + b_.shape.radius;
  return {cores.lower - radii, cores.upper - radii, cores.normal};
}

long double SupportPair::gap_along(const Vec& n) const {
  if (!has_halfspace()) {
    const long double of_b = dot(n, b_.shape.furthest(-n)) - b_.shape.radius;
    return of_b - (dot(n, a_.shape.furthest(n)) + a_.shape.radius);
  }
  const SeparationBounds true_one = separation(0);
  const long double share = dot(n, true_one.normal);
  if (!(share > 0)) return -std::numeric_limits<long double>::infinity();
  return true_one.low > 0 ? true_one.low * share : true_one.low / share;
}

long double SupportPair::plane_distance() const {
  if (a_.plane) return a_.bounding_radius;
  return b_.plane ? b_.bounding_radius : 0;
}

}  // namespace carom::oracle
