// FastKnobs::proxy_spheres: replaces bodies by balls about their positions.
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
  // its record. Nothing else uses that number, and kernels can then read the balls in place.
  void update(BodyStore& bodies, std::span<const float> radii, Parallelism parallelism);

  // The bodies as of the last update. All are spheres except half-spaces.
  Collidables view(const BodyStore& bodies) const;

  void give_back() { carom::give_back(kind_); }
  size_t bytes() const { return bytes_of(kind_); }

 private:
  std::vector<ShapeKind> kind_;  // empty unless there are half-spaces among others
};

}  // namespace carom
