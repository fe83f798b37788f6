// Finds vertices at the same place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::io {

// For every vertex the index of the first one at its place. A vertex that is not finite gets its
// own index.
std::vector<uint32_t> first_at_place(std::span<const Eigen::Vector3f> vertices);

}  // namespace carom::io
