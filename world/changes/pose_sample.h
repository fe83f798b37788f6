// A copy of the positions of a few bodies, which says whether nearly all bodies move.
#pragma once

#include <array>
#include <cstddef>

#include "world/store/body_store.h"

namespace carom {

class PoseSample {
 public:
  // Whether all sampled positions differ from those of the last call, by bits. False in the first
  // call, or if the number of rows has changed.
  bool all_moved(const BodyStore& bodies);

  void forget() { rows_ = 0; }

 private:
  static constexpr size_t kPoses = 256;

  std::array<Eigen::Vector3d, kPoses> positions_;
  size_t rows_ = 0;
};

}  // namespace carom
