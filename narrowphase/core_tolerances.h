// When cores (segments, triangles) count as parallel, flat or touching, by the precision of the
// test. All in scaled units or relative.
#pragma once

namespace carom {

template <class Real>
struct CoreTolerance;

template <>
struct CoreTolerance<float> {
  // sin^2 of the angle of two edges below which their cross product has lost half of its digits.
  static constexpr float kParallel = 0x1p-24f;
  // The same where it says nothing at all, even after it was made perpendicular to one of the two.
  static constexpr float kSameDirection = 0x1p-40f;
  // (height / longest edge)^2 of a triangle that is taken for its longest edge: the height is below
  // four roundings.
  static constexpr float kFlat = 0x1p-44f;
  // Cross products whose squares are below this are about to vanish, and features so small with
  // them.
  static constexpr float kVanishing = 0x1p-100f;
  // How much less than the distance the gap along a normal may be: several times what rounding of a
  // good normal makes of it, less than the least that is asked for, which is 5e-6.
  static constexpr float kTilt = 0x1p-18f;
  // Edges nearer than this may have passed each other for all that rounding tells.
  static constexpr float kNearEdges = 0x1p-10f;
  // Squared distances that differ by this factor only may be equal.
  static constexpr float kTie = 1 + 0x1p-21f;
  // Overlap of cores that is none: it may be rounding.
  static constexpr float kShallow = 0x1p-20f;
};

template <>
struct CoreTolerance<double> {
  static constexpr double kParallel = 0x1p-50;
  static constexpr double kSameDirection = 0x1p-96;
  static constexpr double kFlat = 0x1p-96;
  static constexpr double kVanishing = 0x1p-800;
  static constexpr double kTilt = 0x1p-44;
  static constexpr double kNearEdges = 0x1p-40;
  static constexpr double kTie = 1 + 0x1p-50;
  static constexpr double kShallow = 0x1p-46;
};

}  // namespace carom
