#include "carom/shapes/dop.h"

#include <algorithm>
#include <cmath>

#include "base/float_environment.h"

namespace carom {
namespace {

using Direction = std::array<int8_t, 3>;

constexpr std::array<Direction, kMostSlabs> kAllDirections = {{{1, 0, 0},
                                                               {0, 1, 0},
                                                               {0, 0, 1},
                                                               {1, 1, 1},
                                                               {1, -1, 1},
                                                               {1, 1, -1},
                                                               {1, -1, -1},
                                                               {1, 1, 0},
                                                               {1, 0, 1},
                                                               {0, 1, 1},
                                                               {1, -1, 0},
                                                               {1, 0, -1},
                                                               {0, 1, -1}}};

// The directions of a cube's faces and edges.
constexpr std::array<Direction, 9> kFacesAndEdges = [] {
  std::array<Direction, 9> directions{};
  std::copy_n(kAllDirections.begin(), 3, directions.begin());
  std::copy_n(kAllDirections.begin() + 7, 6, directions.begin() + 3);
  return directions;
}();

}  // namespace

std::span<const Direction> slab_directions(DopKind kind) {
  if (kind == DopKind::k18) return kFacesAndEdges;
  return std::span(kAllDirections).first(slab_count(kind));
}

Dop Dop::of_points(std::span<const Eigen::Vector3f> points, DopKind kind) {
  const FloatEnvironment environment;
  Dop dop{.kind = kind};
  if (points.empty()) return dop;
  const std::span<const Direction> directions = slab_directions(kind);
  for (size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d direction(directions[i][0], directions[i][1], directions[i][2]);
    double lower = HUGE_VAL, upper = -HUGE_VAL;
    for (const Eigen::Vector3f& point : points) {
      const double height = direction.dot(point.cast<double>());
      if (std::isnan(height)) lower = upper = height;
      if (std::isnan(lower)) break;
      lower = std::min(lower, height);
      upper = std::max(upper, height);
    }
    dop.lower[i] = static_cast<float>(lower);
    dop.upper[i] = static_cast<float>(upper);
  }
  return dop;
}

}  // namespace carom
