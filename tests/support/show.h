// Failing inputs and results as text: hexadecimal floats, which can be pasted back.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "tests/support/pairs.h"

namespace carom::test {

std::string hex(double x);

template <class Vector>
std::string hex3(const Vector& v) {
  return hex(v[0]) + ", " + hex(v[1]) + ", " + hex(v[2]);
}

std::string show(const Sphere& sphere);
std::string show(const Aabb& box);
std::string show(const Capsule& capsule);
std::string show(const Box& box);
std::string show(const Triangle& triangle);
std::string show(const Halfspace& halfspace);

std::string show(const Dop& dop);

std::string show(const Cylinder& cylinder);
std::string show(const Cone& cone);
std::string show(const Ellipsoid& ellipsoid);
std::string show(const Hull& hull);

// Meshes and compounds are too long to print: tests that use them print how to make them.
std::string show(const Mesh& mesh);
std::string show(const HeightField& field);
std::string show(const Compound& compound);

std::string show(const PlacedShape& body);

std::string show(const TestPair& pair);

// Says in which case expectations failed while it lived: fails with the text that `show` returns.
// Unlike SCOPED_TRACE it makes the text only then; printing numbers took a tenth of some tests.
template <class Show>
class ShownIfFailed {
 public:
  explicit ShownIfFailed(Show show) : show_(std::move(show)), before_(parts()) {}
  ~ShownIfFailed() {
    if (parts() > before_) ADD_FAILURE() << "The failure above is of\n" << show_();
  }
  ShownIfFailed(const ShownIfFailed&) = delete;
  ShownIfFailed& operator=(const ShownIfFailed&) = delete;

 private:
  static int parts() {
    return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
  }

  Show show_;
  int before_;
};

}  // namespace carom::test
