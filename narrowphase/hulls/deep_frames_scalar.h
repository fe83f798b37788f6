// The frames of the penetration search from the poses of its pairs: the scalar form of
// deep_frames-inl.h.
#pragma once

#include "narrowphase/hulls/deep_frames.h"

namespace carom::scalar {

inline Quaternion<float> quaternion_at(const std::array<DeepFrames::Column, 4>& columns, size_t i) {
  return {{columns[0][i], columns[1][i], columns[2][i]}, columns[3][i]};
}

inline void set_up_frames(DeepFrames& frames) {
  for (size_t i = 0; i < frames.count; ++i) {
    const Quaternion<float> a = quaternion_at(frames.turn_a, i);
    const Rotation<float> to_world = rotation_of(a);
    const Rotation<float> turn = rotation_of(relative_rotation(a, quaternion_at(frames.turn_b, i)));
    const Eigen::Vector3f centre = rotate_back(to_world, DeepFrames::vector(frames.d, i));
    const Eigen::Vector3f middle_a = DeepFrames::vector(frames.middle_a, i);
    const Eigen::Vector3f middle_b = DeepFrames::vector(frames.middle_b, i);
    DeepFrames::put(to_world, frames.to_world, i);
    DeepFrames::put(turn, frames.b_to_a, i);
    DeepFrames::put(centre, frames.b_from_a, i);
    DeepFrames::put(-rotate_back(turn, centre), frames.a_from_b, i);
    DeepFrames::put(rotate_back(turn, Eigen::Vector3f(middle_a - centre)), frames.middle_a_in_b, i);
    DeepFrames::put(rotate(turn, middle_b) + centre, frames.middle_b_in_a, i);
  }
}

inline void finish_frames(DeepFrames& frames) {
  for (size_t i = 0; i < frames.count; ++i) {
    Rotation<float> to_world;
    DeepFrames::get(frames.to_world, i, to_world);
    const Eigen::Vector3f normal = rotate(to_world, DeepFrames::vector(frames.normal, i));
    const Eigen::Vector3f arm_a = rotate(to_world, DeepFrames::vector(frames.arm_a, i));
    DeepFrames::put(normal, frames.normal, i);
    DeepFrames::put(arm_a, frames.arm_a, i);
    DeepFrames::put((arm_a + normal * frames.gap[i]) - DeepFrames::vector(frames.d, i),
                    frames.arm_b, i);
  }
}

}  // namespace carom::scalar
