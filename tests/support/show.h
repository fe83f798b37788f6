// Failing inputs and results as text: hexadecimal floats, which can be pasted back.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>

#include "carom/shapes/compound_geometry.h"
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

std::string show(const Hull& hull);

// Meshes and compounds are too long to print: tests that use them print how to make them.
std::string show(const Mesh& mesh);
std::string show(const Compound& compound);

std::string show(const PlacedShape& body);

std::string show(const TestPair& pair);

}  // namespace carom::test
