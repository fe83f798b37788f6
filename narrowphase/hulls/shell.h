// The shell of a pair of hulls: a closed surface of triangles inside of A - B, with zero inside of
// the surface. If no triangle is nearer to zero than `reach`, a ball of that radius around zero
// lies in A - B, so the hulls overlap by at least `reach` along every axis.
//
// A corner of the surface is a point of A less a point of B. Where the hulls move, their points
// move, and the surface with them: whatever became of its shape, it is still closed, and its
// corners are still in A - B. So the shell of the last step bounds the depth of this step from
// below, and needs a new corner now and then. The shell grows as the polytope does in G. van den
// Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", GDC 2001, but
// it does not have to be convex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/scalar/vector.h"

namespace carom {

// By numbers of points, so that it moves with the hulls.
struct Shell {
  static constexpr size_t kMostCorners = 32;
  static constexpr size_t kMostTriangles = 64;
  static constexpr size_t kGroup = 16;  // the numbers of so many triangles lie together

  uint32_t corners = 0;                          // a bit for each place of a corner that is in use
  uint8_t triangle_count = 0;                    // 0: there is no shell
  uint8_t most_corners = 0;                      // a shell that needs more is made anew
  bool is_new = false;                           // made in this step, or tried in vain
  uint8_t points_of_a = 0, points_of_b = 0;      // of the hulls
  std::array<uint8_t, kMostCorners> of_a, of_b;  // each corner's points
  // The corners of the triangles, seen from outside against the clock. A number for each triangle,
  // then the next corner's.
  std::array<std::array<std::array<uint8_t, kGroup>, 3>, kMostTriangles / kGroup> corner;

  // Whether these are numbers of points of two hulls with so many.
  bool is_of(size_t points_a, size_t points_b) const {
    return triangle_count > 0 && points_of_a == points_a && points_of_b == points_b;
  }
  // No shell was found in this step.
  void end_in_vain() {
    triangle_count = 0;
    is_new = true;
  }
  bool was_in_vain() const { return is_new && triangle_count == 0; }
  // Makes this shell that of another step. Copies what is in use alone.
  void take(const Shell& from) {
    corners = from.corners;
    triangle_count = from.triangle_count;
    most_corners = from.most_corners;
    is_new = false;
    points_of_a = from.points_of_a;
    points_of_b = from.points_of_b;
    of_a = from.of_a;
    of_b = from.of_b;
    for (size_t i = 0; i * kGroup < triangle_count; ++i) corner[i] = from.corner[i];
  }
  size_t corner_of(size_t triangle, size_t k) const {
    return corner[triangle / kGroup][k][triangle % kGroup];
  }
};

// A search computes these numbers of a shell, in scaled units and the frame of A.
struct ShellSpace {
  static constexpr size_t kPlaces = 32;  // for corners: what two vectors of 16 lanes hold

  alignas(64) std::array<std::array<float, kPlaces>, 3> corner;
  // Each triangle has a normal, with twice its area as length, and a volume: six times that which
  // it spans with zero.
  alignas(64) std::array<std::array<float, Shell::kMostTriangles>, 3> normal;
  alignas(64) std::array<float, Shell::kMostTriangles> volume;

  scalar::Vector3<float> corner_at(size_t i) const {
    return {corner[0][i], corner[1][i], corner[2][i]};
  }
  scalar::Vector3<float> normal_at(size_t triangle) const {
    return {normal[0][triangle], normal[1][triangle], normal[2][triangle]};
  }
};

// The ray that tells whether zero is inside goes along the product of these two, which are shorter
// than 1: it is skew to what shapes are parallel to.
inline constexpr std::array<std::array<float, 3>, 2> kShellAcross = {
    {{0.447f, -0.644f, -0.571f}, {-0.016f, 0.637f, -0.732f}}};

// A point is in front of a triangle if the volumes differ by more than this: points of one face
// would be in front of each other by what rounds, and cut a surface to pieces.
inline constexpr float kShellInFront = 0x1p-20f;

// A check knows this for certain of the surface of a shell.
struct ShellCheck {
  float least_squared = 0;  // no triangle is nearer to zero than the root of this
  size_t nearest = 0;       // the triangle of which this is so, the first of equals
  bool is_around = false;   // zero is inside
};

}  // namespace carom
