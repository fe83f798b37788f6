#include "oracle/round_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace carom::oracle {
namespace {

using LongVec = Vec3<long double>;

// A point of the half plane through the axis: its distance from the axis and its height.
struct AxialPoint {
  long double out, up;
};

AxialPoint axial(const LongVec& p) { return {std::hypot(p.x, p.y), p.z}; }

long double distance_to_segment(const AxialPoint& p, const AxialPoint& a, const AxialPoint& b) {
  const AxialPoint way{b.out - a.out, b.up - a.up}, to{p.out - a.out, p.up - a.up};
  const long double square = way.out * way.out + way.up * way.up;
  const long double along = to.out * way.out + to.up * way.up;
  const long double t = square > 0 ? std::clamp(along / square, 0.0L, 1.0L) : 0;
  return std::hypot(to.out - t * way.out, to.up - t * way.up);
}

// The distance from the surface that a line of these points makes as it turns about the axis.
long double distance_to_turned(const AxialPoint& p, std::initializer_list<AxialPoint> line) {
  long double nearest = INFINITY;
  for (auto to = line.begin() + 1; to != line.end(); ++to) {
    nearest = std::min(nearest, distance_to_segment(p, to[-1], *to));
  }
  return nearest;
}

// The nearest point of an ellipsoid has the coordinates a^2 x / (a^2 + t), with the t at which it
// lies on the surface: D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a
// Hyperellipsoid, 2013. By symmetry all coordinates are positive.
class EllipsoidSurface {
 public:
  EllipsoidSurface(const Ellipsoid& e, const LongVec& p)
      : axis_{e.semi_axes.x(), e.semi_axes.y(), e.semi_axes.z()},
        point_{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)} {
    shortest_ = static_cast<size_t>(std::min_element(axis_.begin(), axis_.end()) - axis_.begin());
  }

  long double distance() const {
    const long double least = -axis_[shortest_] * axis_[shortest_];
    // Inside, on the plane across the shortest axis, the nearest point may lie off that plane.
    if (place(least) < 1) return distance_to(nearest_off_plane(least));
    return distance_to(nearest(root_above(least)));
  }

 private:
  // The left side of the ellipsoid's equation at the point of t; an axis whose denominator is 0
  // counts only if the point is off its plane.
  long double place(long double t) const {
    long double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      if (point_[i] == 0 || axis_[i] == 0) continue;
      const long double below = axis_[i] * axis_[i] + t;
      if (!(below > 0)) return INFINITY;
      const long double share = axis_[i] * point_[i] / below;
      sum += share * share;
    }
    return sum;
  }

  long double root_above(long double least) const {
    // No root is greater: at this t the sum is at most one.
    long double low = least,
                high = std::hypot(axis_[0] * point_[0], axis_[1] * point_[1], axis_[2] * point_[2]);
    for (int i = 0; i < 200; ++i) {
      const long double middle = low + (high - low) / 2;
      (place(middle) > 1 ? low : high) = middle;
    }
    return high;
  }

  std::array<long double, 3> nearest(long double t) const {
    std::array<long double, 3> found{};
    for (size_t i = 0; i < 3; ++i) {
      if (axis_[i] > 0 && point_[i] > 0) {
        found[i] = axis_[i] * axis_[i] * point_[i] / (axis_[i] * axis_[i] + t);
      }
    }
    return found;
  }

  std::array<long double, 3> nearest_off_plane(long double t) const {
    std::array<long double, 3> found = nearest(t);
    long double rest = 1;
    for (size_t i = 0; i < 3; ++i) {
      if (axis_[i] > 0) rest -= found[i] * found[i] / (axis_[i] * axis_[i]);
    }
    found[shortest_] = axis_[shortest_] * std::sqrt(std::max(rest, 0.0L));
    return found;
  }

  long double distance_to(const std::array<long double, 3>& to) const {
    return std::hypot(point_[0] - to[0], point_[1] - to[1], point_[2] - to[2]);
  }

  std::array<long double, 3> axis_, point_;
  size_t shortest_;
};

// Whether a point, in the body's frame, lies in the shape without its rounding.
bool holds(const Cylinder& c, const LongVec& p) {
  return std::hypot(p.x, p.y) <= c.radius && std::fabs(p.z) <= c.half_length;
}
bool holds(const Cone& c, const LongVec& p) {
  if (!(std::fabs(p.z) <= c.half_length)) return false;
  const long double out = std::hypot(p.x, p.y), height = 2 * c.half_length;
  return out <= c.radius && out * height <= c.radius * (c.half_length - p.z);
}
bool holds(const Ellipsoid& e, const LongVec& p) {
  long double sum = 0;
  const long double of_p[] = {p.x, p.y, p.z};
  for (int axis = 0; axis < 3; ++axis) {
    const long double semi_axis = e.semi_axes[axis];
    if (of_p[axis] != 0) sum += (of_p[axis] / semi_axis) * (of_p[axis] / semi_axis);
  }
  return sum <= 1;
}

long double core_distance(const Cylinder& c, const LongVec& point) {
  const long double r = c.radius, h = c.half_length;
  return distance_to_turned(axial(point), {{0, h}, {r, h}, {r, -h}, {0, -h}});
}
long double core_distance(const Cone& c, const LongVec& point) {
  const long double r = c.radius, h = c.half_length;
  return distance_to_turned(axial(point), {{0, h}, {r, -h}, {0, -h}});
}
long double core_distance(const Ellipsoid& e, const LongVec& point) {
  return EllipsoidSurface(e, point).distance();
}

template <class Round>
long double grown_distance(const Round& shape, const LongVec& p) {
  const long double of_core = core_distance(shape, p);
  return holds(shape, p) ? of_core + shape.rounding : std::fabs(of_core - shape.rounding);
}

}  // namespace

std::optional<long double> round_surface_distance(const Shape& shape, const LongVec& point) {
  if (const auto* c = std::get_if<Cylinder>(&shape)) return grown_distance(*c, point);
  if (const auto* c = std::get_if<Cone>(&shape)) return grown_distance(*c, point);
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) return grown_distance(*e, point);
  return std::nullopt;
}

}  // namespace carom::oracle
