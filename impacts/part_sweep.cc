#include "impacts/part_sweep.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "impacts/slack.h"

namespace carom {
namespace {

double length(const Double3& v) { return std::sqrt(dot(v, v)); }

Double3 scaled(const Double3& v, double s) { return {v[0] * s, v[1] * s, v[2] * s}; }

template <class Parts>
PartBox box_around(const Parts& parts) {
  const Double3 lower = vector_of({parts.lower().x(), parts.lower().y(), parts.lower().z(), 0});
  const Double3 upper = vector_of({parts.upper().x(), parts.upper().y(), parts.upper().z(), 0});
  return {scaled(plus(lower, upper), 0.5), scaled(minus(upper, lower), 0.5)};
}

// A box in the part's own frame; for a triangle of a surface, that of the triangle.
PartBox own_box(const PlacedPart& placed) {
  if (placed.kind() == ShapeKind::compound) return box_around(placed.compound());
  if (placed.triangle == PlacedPart::kWhole) return box_of(*placed.part);
  Part triangle;
  triangle.kind = ShapeKind::triangle;
  put_triangle_rows(placed.surface(), placed.triangle, triangle.rows.data());
  return box_of(triangle);
}

// A moving part.
struct SweptPart {
  const PlacedPart& placed;
  const BodySweep& sweep;

  Double3 pivot() const { return minus(placed.position, placed.arm); }
};

// The region that a part sweeps during the interval, in the frame of another part, `tree`.
class SweptRegion {
 public:
  SweptRegion(const SweptPart& tree, const SweptPart& part)
      : frame_(tree.placed.turn), way_(minus(part.sweep.displacement, tree.sweep.displacement)) {
    if (tree.sweep.is_turning() || part.sweep.is_turning()) {
      see_ball(tree, part);
    } else {
      see_box(tree, part);
    }
    sweep();
  }

  // A box around it.
  TreeBox box() const { return rounded_outwards(middle_, half_); }

  // Whether the moving box of the part crosses a box; the region is long where that travels far.
  bool crosses(const TreeBox& other) const {
    double first = 0, last = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double half = own_half_[axis] + slack_;
      const double to_lower = other.lower[axis] - half - start_[axis];
      const double to_upper = other.upper[axis] + half - start_[axis];
      if (std::fabs(moves_[axis]) <= slack_) {  // hardly
        if (to_lower > slack_ || to_upper < -slack_) return false;
        continue;
      }
      const auto [entry, exit] = std::minmax({to_lower / moves_[axis], to_upper / moves_[axis]});
      first = std::max(first, entry);
      last = std::min(last, exit);
    }
    return first <= last;
  }

 private:
  void see_box(const SweptPart& tree, const SweptPart& part) {
    const PartBox own = own_box(part.placed);
    const Double3 at = plus(part.placed.position, turned(part.placed.turn, own.middle));
    middle_ = turned_back(frame_, minus(at, tree.placed.position));
    half_ = {};
    for (size_t i = 0; i < 3; ++i) {
      const Turn& turn = part.placed.turn;
      const Double3 axis = turned_back(frame_, {turn[0][i], turn[1][i], turn[2][i]});
      for (size_t k = 0; k < 3; ++k) half_[k] += std::fabs(axis[k]) * own.half[i];
    }
  }

  // A rotating part stays in a ball about its pivot. In the frame of a tree that rotates by an
  // angle, every point moves by at most that angle times its distance from the tree's pivot.
  void see_ball(const SweptPart& tree, const SweptPart& part) {
    const PartBox own = own_box(part.placed);
    const double own_reach = length(part.placed.arm) + (length(own.middle) + length(own.half));
    const Double3 from = minus(part.pivot(), tree.pivot());
    const double furthest = std::max(length(from), length(plus(from, way_))) + own_reach;
    const double turning = std::min(length(tree.sweep.rotation), 2.0) * furthest;
    middle_ = turned_back(frame_, minus(from, tree.placed.arm));
    half_ = {own_reach + turning, own_reach + turning, own_reach + turning};
  }

  void sweep() {
    moves_ = turned_back(frame_, way_);
    start_ = middle_;
    own_half_ = half_;
    middle_ = plus(middle_, scaled(moves_, 0.5));
    slack_ = kSearchSlack * (greatest(middle_) + greatest(half_) + greatest(moves_));
    for (size_t k = 0; k < 3; ++k) half_[k] += std::fabs(moves_[k]) * 0.5 + slack_;
  }

  const Turn& frame_;
  const Double3 way_;
  Double3 middle_, half_;
  Double3 start_, moves_, own_half_;  // of the part's box
  double slack_;
};

// Calls use() for the items of a tree that a half-space may reach: those with a corner below a
// plane.
template <class Use>
void for_each_below(const SweptPart& tree, const SweptPart& halfspace, const Use& use) {
  constexpr double kEverything = HUGE_VAL;
  const Row& row = halfspace.placed.part->rows[0];
  const Double3 direction = vector_of(row);
  const double scale = 1 / length(direction);
  const Double3 normal = scaled(turned(halfspace.placed.turn, direction), scale);
  const Double3 from = minus(halfspace.placed.position, tree.placed.position);
  const Double3 way = minus(halfspace.sweep.displacement, tree.sweep.displacement);
  const double offset = row[3] * scale;
  const double lengths = greatest(from) + greatest(way) + std::fabs(offset);
  double limit = (dot(normal, from) + std::max(dot(normal, way), 0.0)) + offset;
  limit += kSearchSlack * (lengths + greatest(own_box(tree.placed).half));
  if (tree.sweep.is_turning() || halfspace.sweep.is_turning()) limit = kEverything;
  tree.placed.find_below(turned_back(tree.placed.turn, normal), limit, use);
}

class PartSweep {
 public:
  explicit PartSweep(PartPairMet met) : met_(met) {}

  void run(const SweptPart& a, const SweptPart& b) const {
    if (takes_apart(a, b)) {
      for_each_met(a, b, [&](const PlacedPart& item) { run({item, a.sweep}, b); });
    } else if (b.placed.has_parts()) {
      for_each_met(b, a, [&](const PlacedPart& item) { run(a, {item, b.sweep}); });
    } else {
      met_(a.placed, b.placed);
    }
  }

 private:
  // Takes compounds apart before meshes, because meshes have many triangles; A first on a tie.
  static bool takes_apart(const SweptPart& a, const SweptPart& b) {
    if (!a.placed.has_parts()) return false;
    return !b.placed.has_parts() || a.placed.kind() == b.placed.kind() ||
           a.placed.kind() == ShapeKind::compound || (b.placed.kind() == ShapeKind::height_field);
  }

  template <class Use>
  static void for_each_met(const SweptPart& tree, const SweptPart& other, const Use& use) {
    const auto met = [&](uint32_t item) { use(tree.placed.item(item)); };
    if (other.placed.kind() == ShapeKind::halfspace) {
      for_each_below(tree, other, met);
    } else {
      const SweptRegion region(tree, other);
      const auto met_all = [&](std::span<const uint32_t> items) {
        std::for_each(items.begin(), items.end(), met);
      };
      // Those that MeshPath does not serve.
      if (tree.placed.kind() == ShapeKind::height_field || tree.placed.is_scaled()) {
        tree.placed.find_admitted([&](const TreeBox& box) { return region.crosses(box); }, met_all);
      } else {
        tree.placed.find_touching({region.box()}, met_all);
      }
    }
  }

  const PartPairMet met_;
};

}  // namespace

void find_swept_part_pairs(const PlacedPart& a, const BodySweep& sweep_a, const PlacedPart& b,
                           const BodySweep& sweep_b, PartPairMet met) {
  PartSweep(met).run({a, sweep_a}, {b, sweep_b});
}

}  // namespace carom
