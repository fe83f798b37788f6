#include <variant>

#include "narrowphase/manifolds/manifold_scalar.h"
#include "narrowphase/pairs/any_pair.h"

namespace carom::scalar {

Manifold manifold_of(const Shape& shape_a, const Shape& shape_b, const PairPose<float>& pose,
                     const Separation& contact, float reach) {
  return std::visit(
      [&](const auto& a, const auto& b) {
        return manifold_of_kinds(shape_as<float>(a), shape_as<float>(b), pose, contact, reach);
      },
      shape_a, shape_b);
}

}  // namespace carom::scalar
