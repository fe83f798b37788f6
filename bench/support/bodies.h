// Random bodies, and bodies in the arrays that the library reads.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/shapes/views.h"
#include "oracle/random.h"
#include "tests/support/pairs.h"

namespace carom::bench {

using test::PlacedShape;

// How bodies' positions are stored.
enum class Storage {
  f32,    // positions float32
  f64,    // positions float64
  world,  // no positions: boxes in world coordinates
};

const char* name(Storage storage);
PositionType position_type(Storage storage);

// A random body of 0.25 to 2 metres about its origin, within 100 m of the world's origin, with a
// random orientation. Capsules are along their y axis. A hull is one of `hulls`, which then must
// not be empty.
PlacedShape draw_body(ShapeKind kind, oracle::Random& random, std::span<const Hull> hulls = {});

// Different hulls in a stream of pairs.
inline constexpr size_t kHulls = 64;

// `count` hulls, each of `vertices` points on an ellipsoid.
std::vector<Hull> draw_hulls(size_t count, size_t vertices, oracle::Random& random);

// Bounds relative to the body's position.
Eigen::AlignedBox3d local_bounds(const PlacedShape& body);

// The body with its position (or its corners in world coordinates) rounded as stored.
PlacedShape as_stored(PlacedShape body, Storage storage);

// Bodies of one kind in dense arrays.
class DenseBodies {
 public:
  DenseBodies(ShapeKind kind, std::span<const PlacedShape> bodies, Storage storage);
  DenseBodies(const DenseBodies&) = delete;
  DenseBodies& operator=(const DenseBodies&) = delete;

  const Collidables& view() const { return view_; }
  // Bytes of a body in the arrays that tests read: record, corners, orientation and rows.
  // Geometries that rows refer to do not count.
  size_t bytes_per_body() const;

 private:
  template <class T>
  void store_records(std::span<const PlacedShape> bodies, std::vector<T>& records);
  void store_boxes(std::span<const PlacedShape> bodies);
  void store_rows(std::span<const PlacedShape> bodies);
  void store_geometries(std::span<const PlacedShape> bodies);

  std::vector<float> records32_;
  std::vector<double> records64_;
  std::vector<float> boxes_;  // six columns
  std::vector<float> orientations_;
  std::vector<std::array<float, 4>> rows_;
  std::vector<std::shared_ptr<const DopGeometry>> dop_geometries_;
  std::vector<const DopGeometry*> dops_;
  Collidables view_;
};

// -0 is not 0, and NaN equals itself.
inline bool same_bits(float x, float y) {
  return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
}

}  // namespace carom::bench
