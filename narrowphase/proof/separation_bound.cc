#include "narrowphase/proof/separation_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/narrowphase/collide.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/stated_body.h"

namespace carom {
namespace {

bool is_upright(ShapeKind kind) { return kind == ShapeKind::sphere || kind == ShapeKind::aabb; }

double size_of(const StatedBody& a, const StatedBody& b) {
  const auto way = [](double from, double to) { return std::fabs(to - from); };
  return std::max({size_of(a.shape), size_of(b.shape), way(a.position.x, b.position.x),
                   way(a.position.y, b.position.y), way(a.position.z, b.position.z)});
}

float rounded_up(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, HUGE_VALF) : rounded;
}

}  // namespace

// Unrotated shapes: differences, a root, and one or two more differences make 5 roundings of 2^-24
// of numbers below three times the size. Rotated shapes: rotations and the rest make 30 roundings
// of numbers below twice the size (base/tolerances.h). The result is rounded to float once more.
double separation_share(ShapeKind a, ShapeKind b) {
  return is_upright(a) && is_upright(b) ? 0x1p-20 : 0x1p-18;
}

void bound_separations(const PairKind& kind, const Batch& batch) {
  const Collidables view_a = view_of(batch.a, batch.layout, kind.a);
  const Collidables view_b = view_of(batch.b, batch.layout, kind.b);
  const double share = separation_share(kind.a, kind.b);
  for (size_t row = 0; row < batch.count; ++row) {
    const Pair pair = batch.pairs[row];
    const bool is_valid = batch.out.status[row] != static_cast<uint8_t>(Status::invalid);
    const double size = is_valid ? size_of(stated_body(BodyReader{view_a}, pair.a),
                                           stated_body(BodyReader{view_b}, pair.b))
                                 : std::numeric_limits<double>::quiet_NaN();
    batch.out.separation_bound[row] =
        rounded_up(share * size + std::numeric_limits<float>::denorm_min());
  }
}

}  // namespace carom
