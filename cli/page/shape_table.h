// A table of the distinct shapes of a world.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "carom/shapes/shape.h"

namespace carom::cli {

class ShapeTable {
 public:
  // Adds a shape after its children and returns its place. Shapes with the same numbers or the same
  // geometry share a place.
  size_t add(const Shape& shape);

  size_t size() const { return shapes_.size(); }
  const Shape& operator[](size_t place) const { return shapes_[place]; }

 private:
  std::vector<Shape> shapes_;
  std::unordered_map<std::string, size_t> places_;  // key: kind and numbers as bytes
};

}  // namespace carom::cli
