// Bodies as the library reads them, and random ones.
#pragma once

#include <span>
#include <vector>

#include "carom/kernel/views.h"
#include "tests/support/pairs.h"
#include "tests/support/random.h"

namespace carom::bench {

using test::PlacedShape;

// How the places of bodies are stored.
enum class Storage {
  f32,    // positions float32
  f64,    // positions float64
  world,  // none: boxes in world coordinates
};

const char* name(Storage storage);
PositionType position_type(Storage storage);

// Sizes from 0.5 to 2 metres about the origin.
Shape draw_shape(ShapeKind kind, test::Random& random);
// Anywhere within 100 m of the origin.
Eigen::Vector3d draw_position(test::Random& random);

// Half the extents of the shape's bounds.
Eigen::Vector3d half_extents(const Shape& shape);

// The body with its position, or its corners in world coordinates, rounded as stored.
PlacedShape as_stored(PlacedShape body, Storage storage);

// Bodies of one kind in dense arrays.
class DenseBodies {
 public:
  DenseBodies(ShapeKind kind, std::span<const PlacedShape> bodies, Storage storage);
  DenseBodies(const DenseBodies&) = delete;
  DenseBodies& operator=(const DenseBodies&) = delete;

  const Collidables& view() const { return view_; }

 private:
  template <class T>
  void store_records(std::span<const PlacedShape> bodies, std::vector<T>& records);
  void store_boxes(std::span<const PlacedShape> bodies);

  std::vector<float> records32_;
  std::vector<double> records64_;
  std::vector<float> boxes_;  // six columns
  Collidables view_;
};

}  // namespace carom::bench
