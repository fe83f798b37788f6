#include "tests/support/spoilt_bodies.h"

namespace carom::test {

SpoiltBodies::SpoiltBodies(const PlacedShape& body) : body_(body) {
  for (const float bad : kBad) {
    for (int axis = 0; axis < 3; ++axis) {
      add([&](PlacedShape& b) { b.position[axis] = bad; });
    }
  }
  if (has_rows(body.shape)) add_orientations();
  std::visit([this](const auto& shape) { add_shapes(shape); }, body.shape);
}

void SpoiltBodies::add_orientations() {
  for (const float bad : kBad) {
    for (int c = 0; c < 4; ++c) {
      add([&](PlacedShape& b) { b.orientation.coeffs()[c] = bad; });
    }
  }
  add([](PlacedShape& b) { b.orientation.coeffs().setZero(); });
  add([](PlacedShape& b) { b.orientation.coeffs().setConstant(-0.0f); });
}

void SpoiltBodies::add_shapes(const Aabb& box) {
  add_vectors(box, &Aabb::lower);
  add_vectors(box, &Aabb::upper);
  for (int i = 0; i < 3; ++i) {
    add_shape(box, [&](Aabb& b) { std::swap(b.lower[i], b.upper[i]); });
  }
}

void SpoiltBodies::add_shapes(const Capsule& capsule) {
  add_vectors(capsule, &Capsule::a);
  add_vectors(capsule, &Capsule::b);
  add_size(capsule, &Capsule::radius);
}

// A rounding changes the kind of a box or a hull.
void SpoiltBodies::add_shapes(const Box& box) {
  if (box.rounding != 0) add_size(box, &Box::rounding);
  add_vectors(box, &Box::half);
  for (int i = 0; i < 3; ++i) {
    add_shape(box, [&](Box& b) { b.half[i] = -1e-45f; });
  }
}

void SpoiltBodies::add_shapes(const Ellipsoid& ellipsoid) {
  add_size(ellipsoid, &Ellipsoid::rounding);
  add_vectors(ellipsoid, &Ellipsoid::semi_axes);
  for (int i = 0; i < 3; ++i) {
    add_shape(ellipsoid, [&](Ellipsoid& e) { e.semi_axes[i] = -1e-45f; });
  }
}

void SpoiltBodies::add_shapes(const Triangle& triangle) {
  for (size_t corner = 0; corner < 3; ++corner) {
    for (const float bad : kBad) {
      add_shape(triangle, [&](Triangle& t) { t.corners[corner][2] = bad; });
    }
  }
  add_size(triangle, &Triangle::thickness);
  add_shape(triangle, [](Triangle& t) { t.inner_edges = 8; });
}

void SpoiltBodies::add_shapes(const Halfspace& halfspace) {
  add_vectors(halfspace, &Halfspace::normal);
  add_shape(halfspace, [](Halfspace& h) { h.normal.setZero(); });
  for (const float bad : kBad) add_shape(halfspace, [&](Halfspace& h) { h.offset = bad; });
}

void SpoiltBodies::add_shapes(const Dop& dop) {
  const size_t last = slab_count(dop.kind) - 1;
  for (const size_t slab : {size_t{0}, last}) {
    for (const float bad : kBad) {
      add_shape(dop, [&](Dop& d) { d.lower[slab] = bad; });
      add_shape(dop, [&](Dop& d) { d.upper[slab] = bad; });
    }
    add_shape(dop, [&](Dop& d) { std::swap(d.lower[slab], d.upper[slab]); });
  }
  for (const int kind : {0, 7, 8, 16, 200}) {
    add_shape(dop, [&](Dop& d) { d.kind = static_cast<DopKind>(kind); });
  }
  if (last < 3) return;
  add_shape(dop, [&](Dop& d) {  // in order, but without a common point
    d.lower[last] = 8 * (std::fabs(d.upper[1]) + std::fabs(d.lower[1]) + 1 + std::fabs(d.upper[0]) +
                         std::fabs(d.lower[0]) + std::fabs(d.upper[2]) + std::fabs(d.lower[2]));
    d.upper[last] = 2 * d.lower[last];
  });
}

void SpoiltBodies::add_shapes(const Hull& hull) {
  if (hull.rounding != 0) add_size(hull, &Hull::rounding);
  add_shape(hull, [](Hull& h) { h.geometry = nullptr; });
}

std::vector<TestPair> spoilt(const TestPair& pair) {
  std::vector<TestPair> all;
  const SpoiltBodies spoilt_a(pair.a);
  const SpoiltBodies spoilt_b(pair.b);
  for (const PlacedShape& body : spoilt_a.all()) all.push_back({body, pair.b});
  for (const PlacedShape& body : spoilt_b.all()) all.push_back({pair.a, body});
  return all;
}

}  // namespace carom::test
