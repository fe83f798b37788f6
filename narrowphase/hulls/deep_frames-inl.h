// The frames of the penetration search from the poses of its pairs, a pair a lane.
// deep_frames_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_HULLS_DEEP_FRAMES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_DEEP_FRAMES_INL_H_
#undef CAROM_NARROWPHASE_HULLS_DEEP_FRAMES_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_DEEP_FRAMES_INL_H_
#endif

#include "narrowphase/hulls/deep_frames.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

static_assert(kMostDeepPairs % kLanes == 0);

HWY_INLINE F load_column(const DeepFrames::Column& column, size_t i) {
  return hn::LoadU(FloatTag(), column.data() + i);
}
HWY_INLINE F3 load_vectors(const DeepFrames::Vectors& columns, size_t i) {
  return {load_column(columns[0], i), load_column(columns[1], i), load_column(columns[2], i)};
}
HWY_INLINE void store_vectors(const F3& v, DeepFrames::Vectors& columns, size_t i) {
  const FloatTag tag;
  hn::StoreU(v.x, tag, columns[0].data() + i);
  hn::StoreU(v.y, tag, columns[1].data() + i);
  hn::StoreU(v.z, tag, columns[2].data() + i);
}
HWY_INLINE void store_rotation(const Rotation& r, std::array<DeepFrames::Vectors, 3>& columns,
                               size_t i) {
  store_vectors(r.x, columns[0], i);
  store_vectors(r.y, columns[1], i);
  store_vectors(r.z, columns[2], i);
}

// Lanes behind the last pair compute on an earlier pair's numbers, or on zeros.
inline void set_up_frames(DeepFrames& frames) {
  const auto quaternion = [](const std::array<DeepFrames::Column, 4>& columns, size_t i)
                              HWY_ATTR -> Quaternion {
    return {{load_column(columns[0], i), load_column(columns[1], i), load_column(columns[2], i)},
            load_column(columns[3], i)};
  };
  for (size_t i = 0; i < frames.count; i += kLanes) {
    const Quaternion a = quaternion(frames.turn_a, i);
    const Rotation to_world = rotation_of(a);
    const Rotation turn = rotation_of(relative_rotation(a, quaternion(frames.turn_b, i)));
    const F3 centre = rotate_back(to_world, load_vectors(frames.d, i));
    store_rotation(to_world, frames.to_world, i);
    store_rotation(turn, frames.b_to_a, i);
    store_vectors(centre, frames.b_from_a, i);
    store_vectors(-rotate_back(turn, centre), frames.a_from_b, i);
    store_vectors(rotate_back(turn, load_vectors(frames.middle_a, i) - centre),
                  frames.middle_a_in_b, i);
    store_vectors(rotate(turn, load_vectors(frames.middle_b, i)) + centre, frames.middle_b_in_a, i);
  }
}

inline void finish_frames(DeepFrames& frames) {
  for (size_t i = 0; i < frames.count; i += kLanes) {
    const Rotation to_world{load_vectors(frames.to_world[0], i),
                            load_vectors(frames.to_world[1], i),
                            load_vectors(frames.to_world[2], i)};
    const F3 normal = rotate(to_world, load_vectors(frames.normal, i));
    const F3 arm_a = rotate(to_world, load_vectors(frames.arm_a, i));
    store_vectors(normal, frames.normal, i);
    store_vectors(arm_a, frames.arm_a, i);
    store_vectors((arm_a + normal * load_column(frames.gap, i)) - load_vectors(frames.d, i),
                  frames.arm_b, i);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_DEEP_FRAMES_INL_H_
