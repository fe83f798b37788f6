// Vertices that lie in one place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::cli {

// Of every vertex the index of the first one at its place: its own, where it is that, or is not
// finite.
std::vector<uint32_t> first_at_place(std::span<const Eigen::Vector3f> vertices);

}  // namespace carom::cli
