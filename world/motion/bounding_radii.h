// The ball about each body's position that holds its shape.
#pragma once

#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "world/changes/change_tracker.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

struct BodyReader;

// At least as large as it must be, whatever the orientation, but at most the largest float. Of
// spheres their own; infinite for half-spaces; zero for shapes that are not valid.
float bounding_radius(const BodyReader& reader, size_t i);

class BoundingRadii {
 public:
  // Brings the radii up to date: of the bodies whose shape `changes` saw change, or of all if it is
  // nullptr.
  void update(const BodyStore& bodies, const ChangeTracker* changes, Parallelism parallelism);

  // One a body index.
  std::span<const float> radii() const { return radii_; }

  size_t bytes() const { return bytes_of(radii_); }

 private:
  std::vector<float> radii_;
};

}  // namespace carom
