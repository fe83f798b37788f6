// Boxes -> pairs by brute force: every box against every later one, and against half-spaces.
//
// Source of the tests: C. Ericson, Real-Time Collision Detection, 2005, sections 4.2.1 and 5.2.3;
// of the bound for rounding: N. J. Higham, Accuracy and Stability of Numerical Algorithms, section
// 3.1.
#include "reference/pairs.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "base/float_environment.h"
#include "reference/vectors.h"

namespace carom::reference {
namespace {

bool is_empty(const Box& box) { return !(box.lower.array() <= box.upper.array()).all(); }

uint32_t intervals_overlap(float lower_a, float upper_a, float lower_b, float upper_b) {
  return uint32_t{lower_a <= upper_b} & uint32_t{lower_b <= upper_a};
}

// One array for each coordinate, so that the loop reads neighbours in order.
struct Columns {
  explicit Columns(std::span<const Box> boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const Box& box : boxes) {
        lower[axis].push_back(box.lower[axis]);
        upper[axis].push_back(box.upper[axis]);
      }
    }
  }

  std::array<std::vector<float>, 3> lower;
  std::array<std::vector<float>, 3> upper;
};

// 32 units in the last place; the rounding in world_plane() and may_reach() adds up to less than 16
// of the sizes involved.
constexpr double kPlaneRounding = 0x1p-48;

double sum_of_magnitudes(const Eigen::Vector3d& v) {
  return (std::abs(v.x()) + std::abs(v.y())) + std::abs(v.z());
}

// The rotation of a quaternion times its squared norm.
Eigen::Matrix3d scaled_rotation(double x, double y, double z, double w) {
  const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  Eigen::Matrix3d m;
  m << (ww + xx) - (yy + zz), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), (ww + yy) - (xx + zz), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), (ww + zz) - (xx + yy);
  return m;
}

constexpr size_t kBlock = 128;

// Sets hits[k] to whether `box` overlaps box first + k, for k < count <= kBlock. Returns whether
// any does. It has no branches and uses local names, so that compilers can test several boxes at
// once.
uint32_t test_block(const Box& box, const Columns& boxes, size_t first, size_t count,
                    uint32_t* __restrict hits) {
  const float lower_x = box.lower.x(), upper_x = box.upper.x();
  const float lower_y = box.lower.y(), upper_y = box.upper.y();
  const float lower_z = box.lower.z(), upper_z = box.upper.z();
  const float* others_lower_x = boxes.lower[0].data() + first;
  const float* others_upper_x = boxes.upper[0].data() + first;
  const float* others_lower_y = boxes.lower[1].data() + first;
  const float* others_upper_y = boxes.upper[1].data() + first;
  const float* others_lower_z = boxes.lower[2].data() + first;
  const float* others_upper_z = boxes.upper[2].data() + first;
  uint32_t any = 0;
  for (size_t k = 0; k < count; ++k) {
    const uint32_t hit = intervals_overlap(lower_x, upper_x, others_lower_x[k], others_upper_x[k]) &
                         intervals_overlap(lower_y, upper_y, others_lower_y[k], others_upper_y[k]) &
                         intervals_overlap(lower_z, upper_z, others_lower_z[k], others_upper_z[k]);
    hits[k] = hit;
    any |= hit;
  }
  return any;
}

}  // namespace

bool overlap(const Box& a, const Box& b) {
  const FloatEnvironment environment;
  if (is_empty(a) || is_empty(b)) return false;
  return intervals_overlap(a.lower.x(), a.upper.x(), b.lower.x(), b.upper.x()) &&
         intervals_overlap(a.lower.y(), a.upper.y(), b.lower.y(), b.upper.y()) &&
         intervals_overlap(a.lower.z(), a.upper.z(), b.lower.z(), b.upper.z());
}

std::vector<Pair> overlapping_pairs(std::span<const Box> boxes) {
  const Columns columns(boxes);
  std::vector<Pair> pairs;
  std::array<uint32_t, kBlock> hits{};
  for (size_t a = 0; a < boxes.size(); ++a) {
    for (size_t first = a + 1; first < boxes.size(); first += kBlock) {
      const size_t count = std::min(kBlock, boxes.size() - first);
      if (!test_block(boxes[a], columns, first, count, hits.data())) continue;
      for (size_t k = 0; k < count; ++k) {
        if (hits[k]) pairs.push_back({static_cast<uint32_t>(a), static_cast<uint32_t>(first + k)});
      }
    }
  }
  return pairs;
}

// With M the rotation R of the body times |q|^2 and p its position, n . (R^T (x - p)) <= offset is
// (M n) . x <= offset |q|^2 + (M n) . p. In double precision products of two floats are exact.
Plane world_plane(const Halfspace& halfspace, const Pose& pose, PositionType positions) {
  const Eigen::Vector3d n = halfspace.normal.cast<double>();
  const Eigen::Quaterniond q = pose.orientation.cast<double>();
  const Eigen::Matrix3d m = scaled_rotation(q.x(), q.y(), q.z(), q.w());
  const Eigen::Vector3d normal(inner_product(m.row(0), n), inner_product(m.row(1), n),
                               inner_product(m.row(2), n));
  const double scale = (q.x() * q.x() + q.y() * q.y()) + (q.z() * q.z() + q.w() * q.w());
  const double size = scale * sum_of_magnitudes(n);
  Eigen::Vector3d p = pose.position;
  if (positions == PositionType::float32) p = p.cast<float>().cast<double>();

  const double offset = halfspace.offset;
  const double limit = offset * scale + inner_product(normal, p);
  const double error = kPlaneRounding * (std::abs(offset) * scale + size * sum_of_magnitudes(p));
  // DBL_MIN covers what underflows.
  return {normal, (limit + error) + DBL_MIN, kPlaneRounding * size};
}

bool may_reach(const Box& box, const Plane& plane) {
  Eigen::Vector3d lowest;  // the corner that is lowest along the normal
  for (int i = 0; i < 3; ++i) lowest[i] = plane.normal[i] >= 0 ? box.lower[i] : box.upper[i];
  const double error = plane.slack * sum_of_magnitudes(lowest);
  // Infinite corners give NaN, for which the answer is true.
  return !(inner_product(plane.normal, lowest) - error > plane.limit);
}

}  // namespace carom::reference
