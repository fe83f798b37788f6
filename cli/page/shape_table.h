// The different shapes of a world, each once.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "carom/shapes/shape.h"

namespace carom::cli {

class ShapeTable {
 public:
  // The place of a shape, behind those of its children. Shapes have one place if all their numbers
  // are the same, or they share a geometry.
  size_t add(const Shape& shape);

  size_t size() const { return shapes_.size(); }
  const Shape& operator[](size_t place) const { return shapes_[place]; }

 private:
  std::vector<Shape> shapes_;
  std::unordered_map<std::string, size_t> places_;  // by kind and numbers, as bytes
};

}  // namespace carom::cli
