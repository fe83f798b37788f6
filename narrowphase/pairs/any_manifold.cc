#include <variant>

#include "narrowphase/manifolds/round_manifold_scalar.h"
#include "narrowphase/pairs/any_pair.h"
#include "narrowphase/pairs/rounded/rounded_scalar.h"

namespace carom::scalar {

// As separation_of(): for one order of the kinds alone.
Manifold manifold_of(const Shape& shape_a, const Shape& shape_b, const PairPose<float>& pose,
                     const Separation& contact, float reach) {
  if (comes_after(kind_of(shape_a), kind_of(shape_b))) {
    const Separation other = flipped(contact);
    return flipped(manifold_of(shape_b, shape_a, flipped(pose), other, reach), pose.d, other);
  }
  // The one point of a sphere is the witness point.
  const bool has_sphere = std::holds_alternative<Sphere>(shape_a);
  if (!has_sphere && is_rounded_pair(shape_a, shape_b)) {
    const auto of_cores = [&](const Separation& core, float core_reach) {
      return manifold_of(core_of(shape_a), core_of(shape_b), pose, core, core_reach);
    };
    return rounded_manifold(growth_of(shape_a), growth_of(shape_b), contact, reach, of_cores);
  }
  if (const float a = rounding_of(shape_a), b = rounding_of(shape_b);
      !has_sphere && (a != 0 || b != 0)) {
    const auto of_cores = [&](const Separation& core, float core_reach) {
      return manifold_of(without_rounding(shape_a), without_rounding(shape_b), pose, core,
                         core_reach);
    };
    return rounded_manifold(a, b, contact, reach, of_cores);
  }
  if (const auto* dop = std::get_if<Dop>(&shape_b)) {
    return manifold_of(shape_a, hull_of(*dop), pose, contact, reach);
  }
  if (const auto* dop = std::get_if<Dop>(&shape_a)) {
    return manifold_of(hull_of(*dop), shape_b, pose, contact, reach);
  }
  return std::visit(
      [&](const auto& x, const auto& y) -> Manifold {
        const auto a = shape_as<float>(x);
        const auto b = shape_as<float>(y);
        if constexpr (HasManifold<decltype(a), decltype(b)>) {
          return manifold_in_order(a, b, pose, contact, reach);
        } else {
          return {};  // no such pair
        }
      },
      shape_a, shape_b);
}

}  // namespace carom::scalar
