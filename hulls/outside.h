// Hulls of few points that contain others.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "hulls/surface.h"
#include "hulls/unit_points.h"

namespace carom::hulls {

using Corners = std::vector<Eigen::Vector3d>;

// The corners scaled about the middle of `inner` until their hull contains the points with
// `margin` to spare, as little as that takes. Nothing if they have no volume. All have size about
// one.
std::optional<Corners> scaled_around(const Corners& corners, std::span<const Eigen::Vector3d> inner,
                                     double margin);

// At most `most` corners of an intersection of half-spaces that contain the points with `margin` to
// spare. `surface` is that of their hull; all have size about one. Starts with the box or the
// tetrahedron whose error is least in the end. Nothing if the points have no volume.
std::optional<Corners> cut_around(std::span<const Eigen::Vector3d> inner, const Surface& surface,
                                  size_t most, double margin);

}  // namespace carom::hulls
