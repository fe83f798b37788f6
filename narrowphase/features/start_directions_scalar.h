// Directions from which a search for the widest gap starts: the best of some that lie apart, scalar
// form.
#pragma once

#include <array>

#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

template <size_t kCount>
class StartDirections {
 public:
  // The best that is left; those with a greater cosine between them and it are left out afterwards.
  Vector3<float> take_best(float cosine) {
    Vector3<float> best = n_[0];
    float most = gap_[0];
    for (size_t i = 1; i < kCount; ++i) {
      if (!(gap_[i] > most)) continue;
      most = gap_[i];
      best = n_[i];
    }
    for (size_t i = 0; i < kCount; ++i) {
      if (dot(n_[i], best) > cosine) gap_[i] = -kLargest;
    }
    return best;
  }

 protected:
  // Adds the unit vector along `way`, times `sign`, of which gap(n) is the gap. It is never the
  // best if the way vanishes, or without `may`.
  template <class Gap>
  void add(const Vector3<float>& way, float sign, bool may, const Gap& gap) {
    const float squared = dot(way, way);
    n_[count_] = way * std::copysign(1 / std::sqrt(max(squared, kLeastWay)), sign);
    gap_[count_] = may && squared > kLeastWay ? gap(n_[count_]) : -kLargest;
    ++count_;
  }

 private:
  std::array<Vector3<float>, kCount> n_;
  std::array<float, kCount> gap_;
  size_t count_ = 0;
};

}  // namespace carom::scalar
