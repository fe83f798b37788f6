// A copy of the poses of a few bodies, which says whether enough of them are slow for a tolerance.
#pragma once

#include <cstdint>
#include <vector>

#include "world/store/body_store.h"

namespace carom {

class PaceSample {
 public:
  static constexpr size_t kFewBodies = 1024;  // so few are not worth a sample

  // Remembers the poses; call it a step before slow_share().
  void take(const BodyStore& bodies);
  bool is_taken() const { return !poses_.empty(); }
  void forget() { poses_.clear(); }

  // Which share of the bodies of the sample moved so little since then that results or bounds might
  // hold for some steps.
  float slow_share(const BodyStore& bodies, float tolerance) const;

 private:
  struct Pose {
    uint32_t body;
    Eigen::Vector3d position;
    Orientation orientation;
  };

  std::vector<Pose> poses_;
};

}  // namespace carom
