#include "tests/support/oracle.h"

namespace carom::test {

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Real norm(const Real3& a) { return sqrt(dot(a, a)); }

ExactShape::ExactShape(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    radius = sphere->radius;
  } else {
    lower = exact(std::get<Aabb>(shape).lower);
    upper = exact(std::get<Aabb>(shape).upper);
  }
}

Real ExactShape::support(const Real3& n) const {
  Real sum = radius;
  for (int i = 0; i < 3; ++i) sum += std::max<Real>(lower[i] * n[i], upper[i] * n[i]);
  return sum;
}

Real ExactShape::bounding_radius() const {
  Real3 corner;
  for (int i = 0; i < 3; ++i) corner[i] = std::max<Real>(abs(lower[i]), abs(upper[i]));
  return norm(corner) + radius;
}

Real ExactShape::distance(const Real3& point) const {
  Real3 outside;
  Real deepest = -1e300;
  for (int i = 0; i < 3; ++i) {
    const Real gap = std::max<Real>(lower[i] - point[i], point[i] - upper[i]);
    outside[i] = std::max<Real>(gap, 0);
    deepest = std::max<Real>(deepest, gap);
  }
  return (deepest > 0 ? norm(outside) : deepest) - radius;
}

ExactPair::ExactPair(const TestPair& pair, PositionType positions)
    : a(pair.a.shape), b(pair.b.shape) {
  const Real3 position_a = exact(stored(pair.a.position, positions));
  const Real3 position_b = exact(stored(pair.b.position, positions));
  for (int i = 0; i < 3; ++i) d[i] = position_b[i] - position_a[i];
  scale = (a.bounding_radius() + b.bounding_radius()) / 2;
  separation = exact_separation();
}

Real ExactPair::gap_along(const Real3& normal) const {
  const Real length = norm(normal);
  const Real3 n = {normal[0] / length, normal[1] / length, normal[2] / length};
  return dot(d, n) - a.support(n) - b.support({-n[0], -n[1], -n[2]});
}

Real ExactPair::exact_separation() const {
  ExactShape difference{Shape{Sphere{}}};
  for (int i = 0; i < 3; ++i) {
    difference.lower[i] = d[i] + b.lower[i] - a.upper[i];
    difference.upper[i] = d[i] + b.upper[i] - a.lower[i];
  }
  difference.radius = a.radius + b.radius;
  return difference.distance({});
}

}  // namespace carom::test
