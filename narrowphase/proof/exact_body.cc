#include "narrowphase/proof/exact_body.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "narrowphase/proof/exact_dop.h"

namespace carom {
namespace {

ExactVector exact(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

ExactVector exact(const Position<double>& p) { return {p.x, p.y, p.z}; }

// The rotation matrix M(q) of a quaternion of any length. Its columns are |q|^2 long.
struct ExactRotation {
  ExactVector x, y, z;
  Dyadic squared_norm;
};

ExactRotation rotation_of(const Row& q) {
  const Dyadic x = q[0], y = q[1], z = q[2], w = q[3], two = 2;
  const Dyadic xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  const Dyadic xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
  return {{((ww + xx) - yy) - zz, two * (xy + wz), two * (xz - wy)},
          {two * (xy - wz), ((ww - xx) + yy) - zz, two * (yz + wx)},
          {two * (xz + wy), two * (yz - wx), ((ww - xx) - yy) + zz},
          (xx + yy) + (zz + ww)};
}

ExactVector rotate(const ExactRotation& turn, const ExactVector& v) {
  return (turn.x * v.x + turn.y * v.y) + turn.z * v.z;
}

// Builds the core in the body's own frame.
struct CoreMaker {
  ExactBody& body;

  void operator()(const Sphere& sphere) const {
    body.points = {{}};
    body.radius = sphere.radius;
  }
  void operator()(const Capsule& capsule) const {
    body.points = {exact(capsule.a), exact(capsule.b)};
    body.radius = capsule.radius;
  }
  void operator()(const Aabb& box) const { add_box(box.lower, box.upper); }
  void operator()(const Box& box) const {
    add_box(-box.half, box.half);
    body.radius = box.rounding;
  }
  void operator()(const Triangle& triangle) const {
    for (const Eigen::Vector3f& corner : triangle.corners) body.points.push_back(exact(corner));
    body.front = cross(body.points[1] - body.points[0], body.points[2] - body.points[0]);
    const bool has_front = sign_of(dot(body.front, body.front)) > 0;
    body.is_one_sided = has_front && triangle.one_sided;
    body.thickness = has_front ? triangle.thickness : 0;
  }
  void operator()(const Halfspace& halfspace) const {
    body.is_halfspace = true;
    body.front = exact(halfspace.normal);
    body.offset = halfspace.offset;
  }
  void operator()(const Dop& dop) const {
    body.points = exact_corners(dop);
    body.unit = kDopUnit;
  }

  void operator()(const Hull& hull) const {
    for (const Eigen::Vector3f& p : hull.geometry->points()) body.points.push_back(exact(p));
    body.radius = hull.rounding;
  }
  // Round shapes are not decided exactly.
  void operator()(const Cylinder&) const {}
  void operator()(const Cone&) const {}
  void operator()(const Ellipsoid&) const {}
  // Parts are decided one by one.
  void operator()(const Mesh&) const {}
  void operator()(const HeightField&) const {}
  void operator()(const Compound&) const {}

  void add_box(const Eigen::Vector3f& lower, const Eigen::Vector3f& upper) const {
    for (int i = 0; i < 8; ++i) {
      const auto end = [&](int axis) { return i >> axis & 1 ? upper[axis] : lower[axis]; };
      body.points.push_back({end(0), end(1), end(2)});
    }
  }
};

bool is_turned(const StatedBody& body) {
  const bool has_orientation =
      !std::holds_alternative<Sphere>(body.shape) && !std::holds_alternative<Aabb>(body.shape);
  const Row& q = body.orientation;
  return has_orientation && (q[0] != 0 || q[1] != 0 || q[2] != 0);
}

// The unit normal contains the root of its squared length. The root stays symbolic
// (depth_radicand), and everything else is multiplied by the squared length.
void thicken(ExactBody& body) {
  const Dyadic squared = dot(body.front, body.front);
  body.depth = body.front * (-Dyadic(body.thickness) * body.unit);
  body.depth_radicand = squared;
  for (ExactVector& p : body.points) p = p * squared;
  body.unit = body.unit * squared;
}

}  // namespace

ExactBody exact_body(const StatedBody& stated) {
  ExactBody body;
  std::visit(CoreMaker{body}, stated.shape);
  if (is_turned(stated)) {
    const ExactRotation turn = rotation_of(stated.orientation);
    for (ExactVector& p : body.points) p = rotate(turn, p);
    body.front = rotate(turn, body.front);
    body.unit = body.unit * turn.squared_norm;
    // The plane is n . x <= c. The rotation scales n, so c must scale too.
    if (body.is_halfspace) body.offset = body.offset * turn.squared_norm;
  }
  if (body.thickness > 0) thicken(body);
  for (const ExactVector& p : body.points) body.middle = body.middle + p;
  return body;
}

ExactVector exact_way(const StatedBody& a, const StatedBody& b) {
  return exact(b.position) - exact(a.position);
}

}  // namespace carom
