#include "cli/pairs/region_rows.h"

#include <limits>

#include "shapes/body_reader.h"

namespace carom::cli {
namespace {

uint32_t part_of(const BodyReader& bodies, size_t body, uint32_t sub_shape) {
  return is_composite(bodies.kind(body)) ? sub_shape : io::RegionArrays::kNoParts;
}

}  // namespace

io::RegionArrays region_arrays(const ContactRegions& regions, const PairSet& pairs) {
  const Collidables view_a = pairs.a.view(), view_b = pairs.b.view();
  const BodyReader a{view_a}, b{view_b};
  io::RegionArrays arrays;
  if (!regions.first.empty()) arrays.first = regions.first;
  for (size_t i = 0; i < regions.contacts.size(); ++i) {
    const Contact& contact = regions.contacts[i];
    const ManifoldPoints& manifold = regions.manifolds[i];
    const Position<double> at = a.position<double>(contact.a);
    const std::array<double, 3> position = {at.x, at.y, at.z};
    arrays.normal.push_back({contact.normal.x(), contact.normal.y(), contact.normal.z()});
    arrays.separation.push_back(contact.separation);
    arrays.part.push_back(
        {part_of(a, contact.a, contact.sub_a), part_of(b, contact.b, contact.sub_b)});
    arrays.point_count.push_back(contact.manifold_count);
    arrays.point.emplace_back().fill(std::numeric_limits<float>::quiet_NaN());
    arrays.point_separation.emplace_back().fill(std::numeric_limits<float>::quiet_NaN());
    for (size_t k = 0; k < contact.manifold_count; ++k) {
      for (size_t axis = 0; axis < 3; ++axis) {
        arrays.point.back()[3 * k + axis] =
            static_cast<float>(position[axis] + manifold.point[k][axis]);
      }
      arrays.point_separation.back()[k] = manifold.separation[k];
    }
  }
  return arrays;
}

}  // namespace carom::cli
