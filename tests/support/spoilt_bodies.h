// Bodies that are not valid: NaN, infinity, negative sizes, a quaternion or a normal of zero.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/pairs.h"
#include "tests/support/special_floats.h"

namespace carom::test {

inline constexpr float kBad[] = {kNan, kInfinity, -kInfinity};

// Copies of `body` in which one number is invalid.
class SpoiltBodies {
 public:
  explicit SpoiltBodies(const PlacedShape& body);

  const std::vector<PlacedShape>& all() const { return all_; }

 private:
  template <class Change>
  void add(const Change& change) {
    all_.push_back(body_);
    change(all_.back());
  }

  void add_orientations();

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
  void add_shapes(const Aabb& box);
  void add_shapes(const Capsule& capsule);
  void add_shapes(const Box& box);
  void add_shapes(const Cylinder& cylinder) {
    add_size(cylinder, &Cylinder::rounding);
    add_size(cylinder, &Cylinder::radius);
    add_size(cylinder, &Cylinder::half_length);
  }
  void add_shapes(const Cone& cone) {
    add_size(cone, &Cone::rounding);
    add_size(cone, &Cone::radius);
    add_size(cone, &Cone::half_length);
  }
  void add_shapes(const Ellipsoid& ellipsoid);
  void add_shapes(const Triangle& triangle);
  void add_shapes(const Halfspace& halfspace);

  void add_shapes(const Dop& dop);

  // make_hull() checks the points of a hull, so they cannot be invalid.
  void add_shapes(const Hull& hull);
  void add_shapes(const Mesh& /*tested by its parts*/) {}
  void add_shapes(const HeightField& /*tested by its parts*/) {}
  void add_shapes(const Compound& /*tested by its parts*/) {}

  PlacedShape body_;
  std::vector<PlacedShape> all_;
};

// Every way to spoil either side of the pair.
std::vector<TestPair> spoilt(const TestPair& pair);

}  // namespace carom::test
