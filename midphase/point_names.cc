#include "midphase/point_names.h"

#include "midphase/body_pair.h"
#include "midphase/contact_of_row.h"

namespace carom {
namespace {

uint32_t name_on(const PlacedPart& placed, const Double3& point) {
  const Double3 local = turned_back(placed.turn, minus(point, placed.arm));
  return feature_of_child(placed.child, surface_feature(*placed.part, placed.triangle, local));
}

PointNames names_of_row(const PairBlock& block, size_t row, Pair pair, const BodyPair& bodies) {
  const ResultColumns& out = block.out;
  const PartsInTouch parts{bodies.a, bodies.b};
  const Double3 offset = minus(bodies.b.position, bodies.a.position);
  const Double3 normal = {out.normal[0][row], out.normal[1][row], out.normal[2][row]};
  const Double3 origin = block.frame == WitnessFrame::world
                             ? Double3{BodyReader{block.a}.position<double>(pair.a).x,
                                       BodyReader{block.a}.position<double>(pair.a).y,
                                       BodyReader{block.a}.position<double>(pair.a).z}
                             : Double3{};
  const auto name = [&](const Double3& point, float separation) {
    return parts.name_of(minus(point, origin), normal, separation, offset);
  };
  PointNames names{};
  if (!has_manifolds(block.detail)) {
    names.point[0] =
        name({out.point_a[0][row], out.point_a[1][row], out.point_a[2][row]}, out.separation[row]);
  } else {
    for (size_t k = 0; k < out.manifold_count[row]; ++k) {
      const std::array<float, 3>& point = out.manifold[row].point[k];
      names.point[k] = name({point[0], point[1], point[2]}, out.manifold[row].separation[k]);
    }
  }
  return names;
}

}  // namespace

uint64_t PartsInTouch::name_of(const Double3& point, const Double3& normal, double separation,
                               const Double3& offset) const {
  Double3 on_b;
  for (size_t i = 0; i < 3; ++i) on_b[i] = point[i] + separation * normal[i] - offset[i];
  return uint64_t{name_on(a, point)} << 32 | name_on(b, on_b);
}

void name_simple_points(const PairBlock& block) {
  const BodyReader a{block.a}, b{block.b};
  for (size_t row = 0; row < block.count; ++row) {
    const auto index = static_cast<uint32_t>(block.first + row);
    const Pair pair = block.pairs ? block.pairs[row] : Pair{index, index};
    if (is_composite(a.kind(pair.a)) || is_composite(b.kind(pair.b))) continue;
    const float reach = block.reach ? block.reach[row] : 0;
    block.out.point_names[row] = has_contact(block.out, row, reach)
                                     ? names_of_row(block, row, pair, BodyPair(a, b, pair))
                                     : PointNames{};
  }
}

}  // namespace carom
