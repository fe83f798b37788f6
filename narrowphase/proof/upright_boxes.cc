#include "narrowphase/proof/upright_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "base/dyadic.h"

namespace carom {
namespace {

// Relative to the position.
struct Extent {
  std::array<float, 3> lower, upper;
};

// The axis of the world along which each axis of a body lies, if it is turned by quarter turns. All
// components of its quaternion that are not zero are equal then, but for their signs; and there are
// one (no turn, or half a turn), two, or four.
std::optional<std::array<size_t, 3>> axes_of_quarter_turns(const Row& q) {
  std::array<int, 4> sign;
  float size = 0;
  for (const float c : q) size = std::max(size, std::fabs(c));
  for (size_t i = 0; i < 4; ++i) {
    if (q[i] != 0 && std::fabs(q[i]) != size) return std::nullopt;
    sign[i] = q[i] > 0 ? 1 : q[i] < 0 ? -1 : 0;
  }
  const auto [x, y, z, w] = sign;
  const int norm = x * x + y * y + z * z + w * w;
  if (norm == 0 || norm == 3) return std::nullopt;
  // Columns of the rotation, times the norm.
  const std::array<std::array<int, 3>, 3> turned = {{
      {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
      {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
      {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z},
  }};
  std::array<size_t, 3> axes{};
  for (size_t i = 0; i < 3; ++i) {
    while (turned[i][axes[i]] == 0) ++axes[i];
  }
  return axes;
}

std::optional<Extent> extent_of(const StatedBody& body) {
  if (const auto* const aabb = std::get_if<Aabb>(&body.shape)) {
    Extent extent;
    for (int i = 0; i < 3; ++i) {
      extent.lower[static_cast<size_t>(i)] = aabb->lower[i];
      extent.upper[static_cast<size_t>(i)] = aabb->upper[i];
    }
    return extent;
  }
  const auto* const box = std::get_if<Box>(&body.shape);
  if (!box) return std::nullopt;
  const auto axes = axes_of_quarter_turns(body.orientation);
  if (!axes) return std::nullopt;
  Extent extent;
  for (size_t i = 0; i < 3; ++i) {
    const float half = box->half[static_cast<int>(i)];
    extent.lower[(*axes)[i]] = -half;
    extent.upper[(*axes)[i]] = half;
  }
  return extent;
}

// Whether a + b is what rounding makes of it.
bool is_exact(double a, double b, double sum) {
  const double b_in_sum = sum - a;
  return (a - (sum - b_in_sum)) + (b - b_in_sum) == 0;
}

// Whether low + from <= high + to.
bool reaches(double from, float low, double to, float high) {
  const double way = from - to;
  const double size = double{high} - double{low};
  if (is_exact(from, -to, way) && is_exact(high, -double{low}, size)) return way <= size;
  return (((Dyadic(from) - Dyadic(to)) + Dyadic(low)) - Dyadic(high)).sign() <= 0;
}

}  // namespace

std::optional<bool> upright_boxes_overlap(const StatedBody& a, const StatedBody& b) {
  const std::optional<Extent> of_a = extent_of(a);
  if (!of_a) return std::nullopt;
  const std::optional<Extent> of_b = extent_of(b);
  if (!of_b) return std::nullopt;
  const double at_a[3] = {a.position.x, a.position.y, a.position.z};
  const double at_b[3] = {b.position.x, b.position.y, b.position.z};
  for (size_t i = 0; i < 3; ++i) {
    if (!reaches(at_b[i], of_b->lower[i], at_a[i], of_a->upper[i])) return false;
    if (!reaches(at_a[i], of_a->lower[i], at_b[i], of_b->upper[i])) return false;
  }
  return true;
}

}  // namespace carom
