// Directions from which searches for the widest gap start, in lanes (start_directions_scalar.h is
// the scalar form).
#if defined(CAROM_NARROWPHASE_FEATURES_START_DIRECTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_START_DIRECTIONS_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_START_DIRECTIONS_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_START_DIRECTIONS_INL_H_
#endif

#include <array>

#include "narrowphase/features/round_tolerances.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <size_t kCount>
class StartDirections {
 public:
  HWY_INLINE F3 take_best(float cosine) {
    F3 best = n_[0];
    F most = gap_[0];
    for (size_t i = 1; i < kCount; ++i) {
      const Mask wider = hn::Gt(gap_[i], most);
      most = hn::IfThenElse(wider, gap_[i], most);
      best = select(wider, n_[i], best);
    }
    for (size_t i = 0; i < kCount; ++i) {
      const Mask is_near = hn::Gt(dot(n_[i], best), splat(cosine));
      gap_[i] = hn::IfThenElse(is_near, splat(-FLT_MAX), gap_[i]);
    }
    return best;
  }

 protected:
  template <class Gap>
  HWY_INLINE void add(const F3& way, F sign, Mask may, const Gap& gap) {
    const F squared = dot(way, way), least = splat(kLeastWay);
    const F to_unit = hn::Div(splat(1), hn::Sqrt(max(squared, least)));
    n_[count_] = way * hn::CopySign(to_unit, sign);
    const Mask exists = hn::And(may, hn::Gt(squared, least));
    gap_[count_] = hn::IfThenElse(exists, gap(n_[count_]), splat(-FLT_MAX));
    ++count_;
  }

 private:
  std::array<F3, kCount> n_;
  std::array<F, kCount> gap_;
  size_t count_ = 0;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_START_DIRECTIONS_INL_H_
