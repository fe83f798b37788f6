// The greatest number of each of many vectors, as lanes.
#if defined(CAROM_SIMD_GREATEST_OF_EACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_GREATEST_OF_EACH_INL_H_
#undef CAROM_SIMD_GREATEST_OF_EACH_INL_H_
#else
#define CAROM_SIMD_GREATEST_OF_EACH_INL_H_
#endif

#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Four numbers, of which one is the greatest of the vector.
template <class Tag>
HWY_INLINE hn::Vec<Quad> greatest_in_quad(Tag, hn::Vec<Tag> v) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return v;
  } else {
    const hn::Half<Tag> half;
    return greatest_in_quad(half, max(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  }
}

// All vectors fold their last four numbers together, which takes a seventh of what each would take
// by itself.
class GreatestOfEach {
 public:
  // Takes vector i of kLanes.
  HWY_INLINE void put(size_t i, F v) {
    hn::Store(greatest_in_quad(FloatTag(), v), Quad(), quads_[i]);
  }
  // Lane i: the greatest of vector i.
  HWY_INLINE F lanes() const {
    F3 xyz;
    F w;
    transpose_records(*this, xyz, w);
    return max(max(xyz.x, xyz.y), max(xyz.z, w));
  }
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::Load(Quad(), quads_[i]); }

 private:
  HWY_ALIGN float quads_[kLanes][4];
};

#else

class GreatestOfEach {
 public:
  HWY_INLINE void put(size_t, F v) { greatest_ = v; }
  HWY_INLINE F lanes() const { return greatest_; }

 private:
  F greatest_;
};

#endif

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_GREATEST_OF_EACH_INL_H_
