// Reads the shapes and poses of a row for tests in lanes of doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>

#include "narrowphase/batch/single_pair.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {

// The corners of a triangle, and whether it is special.
struct ExactTriangle {
  std::array<scalar::Vector3<double>, 3> corners;
  double is_special;  // 1 or 0

  double size() const {
    const auto largest = [this](size_t i) { return scalar::largest_component(corners[i]); };
    return scalar::max(scalar::max(largest(0), largest(1)), largest(2));
  }
  ExactTriangle scaled(double s) const {
    return {{corners[0] * s, corners[1] * s, corners[2] * s}, is_special};
  }
};

template <ShapeKind kKind>
auto exact_shape(const BodyReader& body, size_t i) {
  using scalar::Vector3;
  const auto vector = [&](size_t row) -> Vector3<double> {
    const Row numbers = body.row(i, row);
    return {numbers[0], numbers[1], numbers[2]};
  };
  if constexpr (kKind == ShapeKind::sphere) {
    return scalar::SphereShape<double>{body.radius(i)};
  } else if constexpr (kKind == ShapeKind::capsule) {
    return scalar::CapsuleShape<double>{vector(0), vector(1), body.row(i, 0)[3]};
  } else if constexpr (kKind == ShapeKind::box) {
    return scalar::BoxShape<double>{vector(0)};
  } else if constexpr (kKind == ShapeKind::triangle) {
    const bool is_special =
        body.row(i, 0)[3] != 0 || body.row(i, 1)[3] != 0 || body.row(i, 2)[3] != 0;
    return ExactTriangle{{vector(0), vector(1), vector(2)}, is_special ? 1.0 : 0.0};
  } else {
    static_assert(kKind == ShapeKind::aabb);
    return scalar::AabbShape<double>{{body.lower(0, i), body.lower(1, i), body.lower(2, i)},
                                     {body.upper(0, i), body.upper(1, i), body.upper(2, i)}};
  }
}

template <ShapeKind kKind>
inline constexpr size_t kExactNumbers = sizeof(exact_shape<kKind>(std::declval<BodyReader>(), 0)) /
                                        sizeof(double);

// The numbers of a row, in scaled units: d, the orientations of A and B (x, y, z, w; the identity
// of a shape that has none), the shapes.
template <ShapeKind kKindA, ShapeKind kKindB>
class ExactPairReader {
 public:
  static constexpr size_t kOfA = 11;  // where the numbers of shape A begin
  static constexpr size_t kOfB = kOfA + kExactNumbers<kKindA>;
  static constexpr size_t kNumbers = kOfB + kExactNumbers<kKindB>;

  explicit ExactPairReader(const Batch& batch)
      : pairs_(batch.pairs),
        view_a_(view_of(batch.a, batch.layout, kKindA)),
        view_b_(view_of(batch.b, batch.layout, kKindB)) {}

  // Reads row + lane for each of the lanes: number c of the k-th to numbers[c * stride + k], and
  // the metres in its unit to up[k]. Not inlined: a kernel with wide vectors waits at every change
  // to code that has none.
  [[gnu::noinline]] void read(size_t row, std::span<const size_t> lanes, size_t stride,
                              double* numbers, double* up) const {
    for (size_t k = 0; k < lanes.size(); ++k) up[k] = read(row + lanes[k], stride, numbers + k);
  }

 private:
  [[gnu::always_inline]] double read(size_t row, size_t stride, double* numbers) const {
    const auto [a, b] = pairs_[row];
    const Position<double> at_a = a_.position<double>(a), at_b = b_.position<double>(b);
    const scalar::Vector3<double> d(at_b.x - at_a.x, at_b.y - at_a.y, at_b.z - at_a.z);
    const auto shape_a = exact_shape<kKindA>(a_, a);
    const auto shape_b = exact_shape<kKindB>(b_, b);
    const scalar::DoubleScale scale = scalar::scale_of(
        scalar::max(scalar::largest_component(d), scalar::max(shape_a.size(), shape_b.size())));
    const auto add = [&](const auto& part) {
      std::array<double, sizeof(part) / sizeof(double)> those;
      std::memcpy(those.data(), &part, sizeof(part));
      for (const double number : those) *std::exchange(numbers, numbers + stride) = number;
    };
    add(scalar::Vector3<double>(d * scale.down));
    add(turn<kKindA>(a_, a));
    add(turn<kKindB>(b_, b));
    add(shape_a.scaled(scale.down));
    add(shape_b.scaled(scale.down));
    return scale.up;
  }

  template <ShapeKind kKind>
  static std::array<double, 4> turn(const BodyReader& body, size_t i) {
    if constexpr (kKind == ShapeKind::sphere || kKind == ShapeKind::aabb) return {0, 0, 0, 1};
    const scalar::Quaternion<double> q = orientation_of(body, i);
    return {q.v.x(), q.v.y(), q.v.z(), q.w};
  }

  const Pair* pairs_;
  Collidables view_a_, view_b_;
  BodyReader a_{view_a_}, b_{view_b_};
};

}  // namespace carom
