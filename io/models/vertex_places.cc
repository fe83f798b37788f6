#include "io/models/vertex_places.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace carom::io {

using Eigen::Vector3f;

std::vector<uint32_t> first_at_place(std::span<const Vector3f> vertices) {
  // Puts vertices that are not finite first, because NaN has no order.
  const auto is_before = [&](uint32_t i, uint32_t j) {
    const Vector3f &u = vertices[i], &v = vertices[j];
    const bool is_finite_u = u.allFinite(), is_finite_v = v.allFinite();
    if (!is_finite_u || !is_finite_v || u == v) {
      return std::pair(is_finite_u, i) < std::pair(is_finite_v, j);
    }
    return std::lexicographical_compare(u.data(), u.data() + 3, v.data(), v.data() + 3);
  };
  std::vector<uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), is_before);
  std::vector<uint32_t> first(vertices.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same =
        i > 0 && vertices[order[i]].allFinite() && vertices[order[i]] == vertices[order[i - 1]];
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace carom::io
