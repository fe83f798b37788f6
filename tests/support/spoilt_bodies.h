// Bodies that are not valid: NaN, infinity, negative sizes, a quaternion or a normal of zero.
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/pairs.h"

namespace carom::test {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kBad[] = {kNan, kInfinity, -kInfinity};

// Copies of `body` in which one number is invalid.
class SpoiltBodies {
 public:
  explicit SpoiltBodies(const PlacedShape& body) : body_(body) {
    for (const float bad : kBad) {
      for (int axis = 0; axis < 3; ++axis) {
        add([&](PlacedShape& b) { b.position[axis] = bad; });
      }
    }
    if (has_rows(body.shape)) add_orientations();
    std::visit([this](const auto& shape) { add_shapes(shape); }, body.shape);
  }

  const std::vector<PlacedShape>& all() const { return all_; }

 private:
  template <class Change>
  void add(const Change& change) {
    all_.push_back(body_);
    change(all_.back());
  }

  void add_orientations() {
    for (const float bad : kBad) {
      for (int c = 0; c < 4; ++c) {
        add([&](PlacedShape& b) { b.orientation.coeffs()[c] = bad; });
      }
    }
    add([](PlacedShape& b) { b.orientation.coeffs().setZero(); });
    add([](PlacedShape& b) { b.orientation.coeffs().setConstant(-0.0f); });
  }

  template <class T, class Change>
  void add_shape(T shape, const Change& change) {
    change(shape);
    all_.push_back(body_);
    all_.back().shape = shape;
  }
  template <class T>
  void add_vectors(const T& shape, Eigen::Vector3f T::*vector) {
    for (const float bad : kBad) {
      for (int i = 0; i < 3; ++i) add_shape(shape, [&](T& s) { (s.*vector)[i] = bad; });
    }
  }
  template <class T>
  void add_size(const T& shape, float T::*size) {
    for (const float bad : {kNan, kInfinity, -kInfinity, -1.0f, -1e-45f}) {
      add_shape(shape, [&](T& s) { s.*size = bad; });
    }
  }

  void add_shapes(const Sphere& sphere) { add_size(sphere, &Sphere::radius); }
  void add_shapes(const Aabb& box) {
    add_vectors(box, &Aabb::lower);
    add_vectors(box, &Aabb::upper);
    for (int i = 0; i < 3; ++i) {
      add_shape(box, [&](Aabb& b) { std::swap(b.lower[i], b.upper[i]); });
    }
  }
  void add_shapes(const Capsule& capsule) {
    add_vectors(capsule, &Capsule::a);
    add_vectors(capsule, &Capsule::b);
    add_size(capsule, &Capsule::radius);
  }
  void add_shapes(const Box& box) {
    add_vectors(box, &Box::half);
    for (int i = 0; i < 3; ++i) {
      add_shape(box, [&](Box& b) { b.half[i] = -1e-45f; });
    }
  }
  void add_shapes(const Triangle& triangle) {
    for (size_t corner = 0; corner < 3; ++corner) {
      for (const float bad : kBad) {
        add_shape(triangle, [&](Triangle& t) { t.corners[corner][2] = bad; });
      }
    }
    add_size(triangle, &Triangle::thickness);
    add_shape(triangle, [](Triangle& t) { t.inner_edges = 8; });
  }
  void add_shapes(const Halfspace& halfspace) {
    add_vectors(halfspace, &Halfspace::normal);
    add_shape(halfspace, [](Halfspace& h) { h.normal.setZero(); });
    for (const float bad : kBad) add_shape(halfspace, [&](Halfspace& h) { h.offset = bad; });
  }

  void add_shapes(const Dop& dop) {
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
      d.lower[last] =
          8 * (std::fabs(d.upper[1]) + std::fabs(d.lower[1]) + 1 + std::fabs(d.upper[0]) +
               std::fabs(d.lower[0]) + std::fabs(d.upper[2]) + std::fabs(d.lower[2]));
      d.upper[last] = 2 * d.lower[last];
    });
  }

  // make_hull() checks the numbers of a hull, so they cannot be invalid.
  void add_shapes(const Hull& hull) {
    add_shape(hull, [](Hull& h) { h.geometry = nullptr; });
  }
  void add_shapes(const Mesh& /*tested by its parts*/) {}
  void add_shapes(const Compound& /*tested by its parts*/) {}

  PlacedShape body_;
  std::vector<PlacedShape> all_;
};

// Every way to spoil either side of the pair.
inline std::vector<TestPair> spoilt(const TestPair& pair) {
  std::vector<TestPair> all;
  const SpoiltBodies spoilt_a(pair.a);
  const SpoiltBodies spoilt_b(pair.b);
  for (const PlacedShape& body : spoilt_a.all()) all.push_back({body, pair.b});
  for (const PlacedShape& body : spoilt_b.all()) all.push_back({pair.a, body});
  return all;
}

}  // namespace carom::test
