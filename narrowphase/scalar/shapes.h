// The shapes that the scalar tests take, in float and in double, scaled to the unit of the test.
#pragma once

#include <algorithm>
#include <array>

#include "carom/shapes/shape.h"
#include "narrowphase/scalar/vector.h"
#include "shapes/dop_geometry.h"

namespace carom::scalar {

// Every shape has
//   size()        an upper bound of all coordinates, within a factor of two
//   scaled(s)     the shape, s times as large
template <class Real>
struct SphereShape {
  Real radius;

  Real size() const { return radius; }
  SphereShape scaled(Real s) const { return {radius * s}; }
};

template <class Real>
struct CapsuleShape {
  Vector3<Real> a, b;
  Real radius;

  Real size() const { return max(max(largest_component(a), largest_component(b)), radius); }
  CapsuleShape scaled(Real s) const { return {a * s, b * s, radius * s}; }
};

template <class Real>
struct AabbShape {
  Vector3<Real> lower, upper;

  Real size() const { return max(largest_component(lower), largest_component(upper)); }
  AabbShape scaled(Real s) const { return {lower * s, upper * s}; }
};

// Tests of boxes and hulls in float32 are of those without a rounding
// (narrowphase/pairs/rounded/).
template <class Real>
struct BoxShape {
  Vector3<Real> half;
  Real rounding = 0;

  Real size() const { return max(largest_component(half), rounding); }
  BoxShape scaled(Real s) const { return {half * s, rounding * s}; }
};

// Cylinders and cones: the rim is this far from the axis, and so far from the middle.
template <class Real>
struct CylinderShape {
  Real radius, half_length, rounding;

  Real size() const { return max(max(radius, half_length), rounding); }
  CylinderShape scaled(Real s) const { return {radius * s, half_length * s, rounding * s}; }
};

template <class Real>
struct ConeShape {
  Real radius, half_length, rounding;

  Real size() const { return max(max(radius, half_length), rounding); }
  ConeShape scaled(Real s) const { return {radius * s, half_length * s, rounding * s}; }
};

template <class Real>
struct EllipsoidShape {
  Vector3<Real> semi_axes;
  Real rounding;

  Real size() const { return max(largest_component(semi_axes), rounding); }
  EllipsoidShape scaled(Real s) const { return {semi_axes * s, rounding * s}; }
};

// Shapes that are not the hull of a few points, grown by a radius.
template <class S>
inline constexpr bool kIsRound = false;
template <class Real>
inline constexpr bool kIsRound<CylinderShape<Real>> = true;
template <class Real>
inline constexpr bool kIsRound<ConeShape<Real>> = true;
template <class Real>
inline constexpr bool kIsRound<EllipsoidShape<Real>> = true;

template <class S>
concept RoundShape = kIsRound<S>;

// Slabs are double for either Real: finding the corners needs it.
template <class Real>
struct DopShape {
  DopSlabs slabs;
  double greatest;                        // of all coordinates
  const DopGeometry* geometry = nullptr;  // if it is known, in its own unit
  double scale = 1;                       // of the slabs : those of the geometry

  Real size() const { return static_cast<Real>(greatest); }
  DopShape scaled(Real s) const {
    DopShape result = *this;
    for (double& end : result.slabs.lower) end *= s;
    for (double& end : result.slabs.upper) end *= s;
    result.greatest *= s;
    result.scale *= s;
    return result;
  }
};

// Refers to the stored points; tests apply `scale` when they turn the points.
template <class Real>
struct HullShape {
  const HullGeometry* geometry;
  double scale;
  Real rounding = 0;

  Real size() const { return max(static_cast<Real>(geometry->size() * scale), rounding); }
  HullShape scaled(Real s) const { return {geometry, scale * s, rounding * s}; }
};

// Meshes and compounds. The library tests them part by part, so there is no test of the whole.
template <class Real>
struct CompositeShape {
  Real size() const { return 0; }
  CompositeShape scaled(Real) const { return {}; }
};

template <class Real>
struct TriangleShape {
  std::array<Vector3<Real>, 3> corners;
  Real thickness;
  bool one_sided;
  uint8_t inner_edges;
  bool has_properties;  // has one of the three above; stays when scaling rounds `thickness` to 0

  // Kernels do not test special triangles; the general test in double precision does.
  bool is_special() const { return has_properties; }

  Real size() const {
    return max(max(largest_component(corners[0]), largest_component(corners[1])),
               max(largest_component(corners[2]), thickness));
  }
  TriangleShape scaled(Real s) const {
    return {{corners[0] * s, corners[1] * s, corners[2] * s},
            thickness * s,
            one_sided,
            inner_edges,
            has_properties};
  }
};

// The normal is a unit vector.
template <class Real>
struct HalfspaceShape {
  Vector3<Real> normal;
  Real offset;

  Real size() const { return std::fabs(offset); }
  HalfspaceShape scaled(Real s) const { return {normal, offset * s}; }
};

// shape_as<Real>(shape): the public shape as a shape of the tests.
template <class Real>
SphereShape<Real> shape_as(const Sphere& s) {
  return {s.radius};
}
template <class Real>
CapsuleShape<Real> shape_as(const Capsule& c) {
  return {c.a.cast<Real>(), c.b.cast<Real>(), c.radius};
}
template <class Real>
AabbShape<Real> shape_as(const Aabb& box) {
  return {box.lower.cast<Real>(), box.upper.cast<Real>()};
}
template <class Real>
BoxShape<Real> shape_as(const carom::Box& box) {
  return {box.half.cast<Real>(), box.rounding};
}
template <class Real>
CylinderShape<Real> shape_as(const Cylinder& c) {
  return {c.radius, c.half_length, c.rounding};
}
template <class Real>
ConeShape<Real> shape_as(const Cone& c) {
  return {c.radius, c.half_length, c.rounding};
}
template <class Real>
EllipsoidShape<Real> shape_as(const Ellipsoid& e) {
  return {e.semi_axes.cast<Real>(), e.rounding};
}
template <class Real>
DopShape<Real> shape_as(const Dop& dop) {
  const DopSlabs slabs(dop);
  const DopGeometry* geometry = known_geometry(dop);
  return {slabs, geometry ? geometry->size() : slabs.with_tight_axes().size(), geometry};
}
template <class Real>
HullShape<Real> shape_as(const Hull& hull) {
  return {hull.geometry.get(), 1, hull.rounding};
}
template <class Real>
CompositeShape<Real> shape_as(const Mesh&) {
  return {};
}
template <class Real>
CompositeShape<Real> shape_as(const HeightField&) {
  return {};
}
template <class Real>
CompositeShape<Real> shape_as(const Compound&) {
  return {};
}
template <class Real>
TriangleShape<Real> shape_as(const Triangle& t) {
  return {{t.corners[0].cast<Real>(), t.corners[1].cast<Real>(), t.corners[2].cast<Real>()},
          t.thickness,
          t.one_sided,
          t.inner_edges,
          t.thickness > 0 || t.one_sided || t.inner_edges > 0};
}
// Scales the normal by a power of two first, so that its squares neither vanish nor overflow.
template <class Real>
HalfspaceShape<Real> shape_as(const Halfspace& h) {
  const Scale scale = scale_of(largest_component(h.normal));
  const Vector3<Real> n = (h.normal * scale.down).template cast<Real>();
  const Real length = std::sqrt(dot(n, n));
  const Real offset = Real(h.offset) * Real(scale.down) / length;
  return {n * (1 / length), finite(offset)};
}

}  // namespace carom::scalar
