// Lays out bodies in a caller's arrays, in every way that the views allow, in guarded memory.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "carom/shapes/views.h"
#include "tests/support/guarded.h"
#include "tests/support/pairs.h"

namespace carom::test {

// How the rows of the bodies' parameters are ordered.
enum class RowOrder : uint8_t {
  dense,      // in the order of bodies; without `first` if all bodies have one kind
  backwards,  // in reverse order, with `first`
  shared,     // with `first`; equal shapes share their rows
};

struct Layout {
  PositionType positions = PositionType::float32;
  RadiusLayout radius = RadiusLayout::fourth;
  size_t stride = 0;  // 0: dense
  size_t radius_stride = sizeof(float);
  size_t box_stride = sizeof(float);              // 0: in records (box_records())
  bool box_slots = false;                         // box rows in an order of their own
  bool always_kinds = false;                      // one kind a body even if all are the same
  size_t orientation_stride = 4 * sizeof(float);  // 0: absent if no body is turned
  RowOrder rows = RowOrder::dense;

  size_t component() const { return positions == PositionType::float32 ? 4 : 8; }
  size_t record() const { return (radius == RadiusLayout::fourth ? 4 : 3) * component(); }
};

std::string show(const Layout& layout);

// The kinds of a set, or the one kind of all.
class LaidOutKinds {
 public:
  LaidOutKinds(std::span<const PlacedShape> bodies, bool always);

  bool are_mixed() const { return are_mixed_; }
  void add_to(Collidables& view) const;

 private:
  GuardedArray kinds_;
  ShapeKind first_ = ShapeKind::sphere;
  bool are_mixed_ = false;
  bool is_given_ = false;
};

// Positions and radii.
class LaidOutPositions {
 public:
  LaidOutPositions(std::span<const PlacedShape> bodies, const Layout& layout);

  void add_to(Collidables& view) const;

 private:
  void set_component(size_t i, int component, double value);

  void set_radius(size_t i, float radius);

  Layout layout_;
  GuardedArray records_;
  GuardedArray radii_;
};

// Corners of aabbs.
class LaidOutAabbs {
 public:
  LaidOutAabbs(std::span<const PlacedShape> bodies, const Layout& layout);

  void add_to(Collidables& view) const;

 private:
  static bool is_box(const PlacedShape& body) { return kind_of(body.shape) == ShapeKind::aabb; }

  static constexpr size_t kRecord = 8 * sizeof(float);

  void set(size_t row, const Aabb& box);

  Layout layout_;
  GuardedArray slots_;
  std::vector<GuardedArray> columns_;
};

// Orientations of all bodies; those of spheres and aabbs are copied, too.
class LaidOutOrientations {
 public:
  LaidOutOrientations(std::span<const PlacedShape> bodies, size_t stride);

  void add_to(Collidables& view) const;

 private:
  static constexpr size_t kSize = 4 * sizeof(float);

  static bool is_turned(const PlacedShape& body);

  bool is_given_;
  size_t stride_;
  GuardedArray quaternions_;
};

// Parameters of the kinds that have rows.
class LaidOutRows {
 public:
  LaidOutRows(std::span<const PlacedShape> bodies, RowOrder order, bool is_first_given);

  void add_to(Collidables& view) const;

 private:
  static constexpr size_t kRowSize = 4 * sizeof(float);

  // The first row of each body. Bodies without rows get an index that must never be read.
  static std::vector<uint32_t> places(std::span<const PlacedShape> bodies, RowOrder order);

  static std::string bytes_of(const Shape& shape);

  void find_geometries(std::span<const PlacedShape> bodies, RowOrder order);

  static size_t rows_in(std::span<const PlacedShape> bodies, const std::vector<uint32_t>& places);

  bool is_first_given_;
  std::vector<uint32_t> places_;
  GuardedArray rows_;
  GuardedArray first_;
  std::vector<Shape> alive_;  // owns the geometries whose addresses are in the rows

  // Those of the shapes; unless rows are dense, of k-DOPs without one every third has its own, and
  // every third that of another k-DOP.
  std::vector<std::shared_ptr<const DopGeometry>> geometries_;
  std::vector<const DopGeometry*> dops_;
};

class LaidOut {
 public:
  LaidOut(std::span<const PlacedShape> bodies, const Layout& layout);

  const Collidables& view() const { return view_; }

 private:
  LaidOutKinds kinds_;
  LaidOutPositions positions_;
  LaidOutAabbs boxes_;
  LaidOutOrientations orientations_;
  LaidOutRows rows_;
  Collidables view_;
};

}  // namespace carom::test
