// Failing inputs and results as text: hexadecimal floats, which can be pasted back.
#pragma once

#include <cstdio>
#include <string>

#include "tests/support/pairs.h"

namespace carom::test {

inline std::string hex(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

template <class Vector>
std::string hex3(const Vector& v) {
  return hex(v[0]) + ", " + hex(v[1]) + ", " + hex(v[2]);
}

inline std::string show(const PlacedShape& body) {
  std::string text;
  if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
    text = std::string("sphere r ") + hex(sphere->radius);
  } else {
    const Aabb& box = std::get<Aabb>(body.shape);
    text = std::string("aabb ") + hex3(box.lower) + " .. " + hex3(box.upper);
  }
  return text + " @ " + hex3(body.position);
}

inline std::string show(const TestPair& pair) { return show(pair.a) + "\n" + show(pair.b); }

}  // namespace carom::test
