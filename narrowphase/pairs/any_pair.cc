#include "narrowphase/pairs/any_pair.h"

#include <variant>

#include "narrowphase/pairs/all_pairs.h"
#include "narrowphase/pairs/round/round_scalar.h"
#include "narrowphase/pairs/rounded/rounded_scalar.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {
namespace {

// Whether a test exists for the shapes in this order.
template <class A, class B, class Real>
concept HasSeparation = requires(A a, B b, PairPose<Real> pose) {
  separation(a, b, pose);
};

}  // namespace

// Tests are written, and compiled, for one order of the kinds alone: see comes_after().
template <class Real>
SeparationAs<Real> separation_of(const Shape& a, const Shape& b, const PairPose<Real>& pose) {
  if (comes_after(kind_of(a), kind_of(b))) {
    return flipped(separation_of<Real>(b, a, flipped(pose)));
  }
  if (is_rounded_pair(a, b)) {
    if constexpr (std::is_same_v<Real, float>) return not_in_float<float>();
    // Tests of special triangles know of the rounding.
    if constexpr (std::is_same_v<Real, double>) {
      if (!is_special_triangle(b)) return rounded_separation(a, b, pose);
    }
  }
  if (const auto* dop = std::get_if<Dop>(&b)) return separation_of<Real>(a, hull_of(*dop), pose);
  if (const auto* dop = std::get_if<Dop>(&a)) return separation_of<Real>(hull_of(*dop), b, pose);
  const auto separate = [](const auto& x, const auto& y, const PairPose<Real>& p) {
    return separation(x, y, p);
  };
  return std::visit(
      [&](const auto& x, const auto& y) -> SeparationAs<Real> {
        const auto shape_x = shape_as<Real>(x);
        const auto shape_y = shape_as<Real>(y);
        if constexpr (HasSeparation<decltype(shape_x), decltype(shape_y), Real>) {
          return in_scaled_units<Real>(shape_x, shape_y, pose, separate);
        } else {
          return {};  // carom::supports() says which pairs there are
        }
      },
      a, b);
}

template SeparationAs<float> separation_of(const Shape& a, const Shape& b,
                                           const PairPose<float>& pose);
template SeparationAs<double> separation_of(const Shape& a, const Shape& b,
                                            const PairPose<double>& pose);

}  // namespace carom::scalar
