#include "cli/page/shape_table.h"

#include <array>
#include <utility>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/views.h"

namespace carom::cli {
namespace {

template <class T>
void append_bytes(const T& numbers, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()),
               sizeof(numbers[0]) * static_cast<size_t>(numbers.size()));
}

std::string bytes_of(const Shape& shape) {
  std::string bytes(1, static_cast<char>(kind_of(shape)));
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
    append_bytes(std::array{sphere->radius}, bytes);
  } else if (const Aabb* box = std::get_if<Aabb>(&shape)) {
    append_bytes(box->lower, bytes);
    append_bytes(box->upper, bytes);
  } else {
    append_bytes(shape_rows(shape), bytes);
  }
  return bytes;
}

}  // namespace

size_t ShapeTable::add(const Shape& shape) {
  std::string bytes = bytes_of(shape);
  if (const auto known = places_.find(bytes); known != places_.end()) return known->second;
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    for (const CompoundChild& child : compound->geometry->children()) add(child.shape);
  }
  shapes_.push_back(shape);
  places_.emplace(std::move(bytes), shapes_.size() - 1);
  return shapes_.size() - 1;
}

}  // namespace carom::cli
