// FastKnobs::proxy_spheres: bodies as balls about their positions.
#pragma once

#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/shapes/views.h"
#include "world/store/body_store.h"
#include "world/store/columns.h"

namespace carom {

class ProxySpheres {
 public:
  // Writes the radius of every body that is neither sphere nor half-space to the fourth number of
  // its record, which nothing else uses: kernels read balls in place, then.
  void update(BodyStore& bodies, std::span<const float> radii, Parallelism parallelism);

  // The bodies as they were at the last update, all spheres but the half-spaces.
  Collidables view(const BodyStore& bodies) const;

  size_t bytes() const { return bytes_of(kind_); }

 private:
  std::vector<ShapeKind> kind_;  // empty unless there are half-spaces among others
};

}  // namespace carom
