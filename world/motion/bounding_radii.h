// The radius of a ball about each body's position that holds its shape.
#pragma once

#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "world/changes/change_tracker.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

struct BodyReader;

// An upper bound for any orientation, but at most the largest float. For spheres their own radius;
// infinite for half-spaces; zero for shapes that are not valid.
float bounding_radius(const BodyReader& reader, size_t i);

class BoundingRadii {
 public:
  // Updates the radii of the bodies whose shape has changed by `changes`; nullptr: of all bodies.
  void update(const BodyStore& bodies, const ChangeTracker* changes, Parallelism parallelism);

  // One radius a body index.
  std::span<const float> radii() const { return radii_; }

  void give_back() { carom::give_back(radii_); }
  size_t bytes() const { return bytes_of(radii_); }

 private:
  std::vector<float> radii_;
};

}  // namespace carom
