#include "midphase/part_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/outward.h"
#include "geometries/height_search.h"
#include "geometries/near_points.h"
#include "midphase/field_search.h"
#include "midphase/seen_part.h"

namespace carom {
namespace {

// Gives the parts of a body one at a time. For a surface only the triangle changes.
class PartOf {
 public:
  explicit PartOf(const PlacedPart& whole) : whole_(whole), part_(whole) {}

  const PlacedPart& item(uint32_t index) {
    if (is_surface(whole_.kind())) {
      part_.triangle = index;
    } else {
      part_ = whole_.item(index);
    }
    return part_;
  }

 private:
  const PlacedPart& whole_;
  PlacedPart part_;
};

// Whether two bodies with trees are taken apart together.
bool are_of_one_tree_kind(const PlacedPart& a, const PlacedPart& b) {
  return a.kind() == b.kind() && a.kind() != ShapeKind::height_field && !a.is_scaled() &&
         !b.is_scaled();
}

// Whether A is taken apart before B: a compound goes before a surface, and a mesh before a height
// field.
bool takes_apart_first(const PlacedPart& a, const PlacedPart& b) {
  if (!a.has_parts()) return false;
  return !b.has_parts() || a.kind() == ShapeKind::compound || b.kind() == ShapeKind::height_field;
}

class PartSearch {
 public:
  // `are_whole`: no compound is among the bodies.
  PartSearch(const PartsWanted& wanted, bool are_whole, NearPartsFound found)
      : reach_(wanted.reach),
        apart_(wanted.apart),
        deepest_alone_(wanted.deepest_alone),
        are_whole_(are_whole),
        found_(found) {}

  void run(const PlacedPart& a, const PlacedPart& b) const {
    if (!a.has_parts() && !b.has_parts()) {
      found_({a, b});
    } else if (are_of_one_tree_kind(a, b)) {
      take_apart_both(a, b);
    } else if (takes_apart_first(a, b)) {
      take_apart(a, b, [&](const PlacedPart& part) { run(part, b); }, {a, b});
    } else {
      take_apart(b, a, [&](const PlacedPart& part) { run(a, part); }, {a, b});
    }
  }

 private:
  // Goes on with each part of `tree` that is near the other one. The triangles of a surface, which
  // need no more searching, are found some at a time: those of `both`.
  template <class GoOn>
  void take_apart(const PlacedPart& tree, const PlacedPart& other, const GoOn& go_on,
                  const NearParts& both) const {
    if (tree.kind() == ShapeKind::height_field && SolidOverField::serves(other) &&
        !tree.is_scaled() && find_cells_near(tree, other, both)) {
      return;
    }
    if (is_surface(tree.kind()) && !other.has_parts()) {
      // A sphere is tested sooner than bounded.
      is_plane(other) || other.kind() == ShapeKind::sphere
          ? find_triangles_touching(tree, other, both)
          : find_triangles_near(tree, other, both);
    } else {
      PartOf part(tree);
      for_each_near(tree, other, [&](std::span<const uint32_t> items) {
        for (const uint32_t item : items) go_on(part.item(item));
      });
    }
  }

  // Triangles whose boxes are near the other part.
  void find_triangles_touching(const PlacedPart& surface, const PlacedPart& other,
                               const NearParts& both) const {
    for_each_near(surface, other, [&](std::span<const uint32_t> triangles) {
      found_({both.a, both.b, triangles});
    });
  }

  // False if the cells are too many. Where distances are asked for, the search goes as far as the
  // surface is over or under the solid, so that it holds the nearest triangles.
  bool find_cells_near(const PlacedPart& field, const PlacedPart& other,
                       const NearParts& both) const {
    const SolidOverField solid(field, other, place_in_frame(field, other));
    double reach = reach_;
    bool holds_nearest = false;
    if (apart_ == Apart::by_boxes && are_whole_) {
      const std::optional<double> distance = solid.distance_along_z();
      holds_nearest = distance.has_value();
      reach = std::max(reach, distance.value_or(0));
    }
    // Overlaps are sure to rounding in double precision, distances only as tests measure them.
    const double slack = reach > 0 || holds_nearest ? kSearchSlack : kPlacedSlack;
    const double most = solid.radius() + reach + slack * solid.lengths();
    const double deeper = solid.radius() + kDepthSlack * solid.lengths();
    // Two tests may differ by what each of them may err.
    const double ties = deepest_alone_ && are_whole_ ? 2 * kDepthSlack * solid.lengths() : HUGE_VAL;
    return solid.find_near({most, ties}, [&](const NearPoints& near) {
      std::array<float, BoxTree::kMostAtOnce> least;
      for (size_t i = 0; i < near.count; ++i) least[i] = static_cast<float>(near.gap[i] - deeper);
      found_({both.a,
              both.b,
              std::span(near.triangle).first(near.count),
              {},
              std::span(least).first(near.count),
              holds_nearest});
    });
  }

  // Triangles whose planes keep them apart are left out. Tests of triangles with rules may find
  // greater depths than the planes say.
  void find_triangles_near(const PlacedPart& surface, const PlacedPart& other,
                           const NearParts& both) const {
    SeenPart seen(surface, other);
    const double lengths = seen.lengths();
    const MeshRules rules = surface.rules();
    const bool has_rules =
        rules.thickness > 0 || rules.one_sided || other.kind() == ShapeKind::triangle;
    const bool is_bounded = lengths < kBeyondSearch && (!has_rules || apart_ == Apart::by_planes);
    if (!is_bounded) {
      return surface.find_touching(seen.surroundings(reach_),
                                   [&](std::span<const uint32_t> triangles) {
                                     found_({both.a, both.b, triangles});
                                   });
    }
    const SeenPoints& points = seen.points();
    const double radius = seen.radius() + rules.thickness;
    constexpr float kEverything = 0x1p100f;
    // Overlaps are sure to rounding in double precision, distances only as tests measure them.
    const double slack = (reach_ > 0 ? kSearchSlack : kPlacedSlack) * lengths;
    const double in_units = (radius + reach_ + slack) * points.down;
    const float most = apart_ == Apart::by_planes && in_units < kEverything
                           ? -round_downwards(-in_units)
                           : kEverything;
    const Surface geometry = surface.surface();
    surface.find_touching(seen.surroundings(reach_), [&](std::span<const uint32_t> triangles) {
      NearPoints near;
      keep_near_points(geometry, points, most, triangles, near);
      if (near.count == 0) return;
      const double deeper = radius + kDepthSlack * lengths;
      for (size_t i = 0; i < near.count; ++i) {
        near.gap[i] = static_cast<float>(near.gap[i] * points.up - deeper);
      }
      const std::span<const float> least(near.gap.data(), has_rules ? 0 : near.count);
      found_({both.a, both.b, {near.triangle.data(), near.count}, {}, least});
    });
  }

  void take_apart_both(const PlacedPart& a, const PlacedPart& b) const {
    const FrameChange change = to_frame_of(a, b);
    const double lengths = a.size() + b.size() + greatest(change.offset);
    const double reach = with_slack(reach_, lengths);
    if (a.kind() == ShapeKind::mesh) return find_triangles(a, b, change, reach);
    PartOf part_a(a), part_b(b);
    find_touching_items(a.tree(), b.tree(), change, reach, [&](std::span<const ItemPair> pairs) {
      for (const ItemPair& p : pairs) run(part_a.item(p.a), part_b.item(p.b));
      return reach;
    });
  }

  // Triangles are thick behind their planes.
  void find_triangles(const PlacedPart& a, const PlacedPart& b, const FrameChange& b_to_a,
                      double reach) const {
    const double thickness = double{a.mesh().rules().thickness} + b.mesh().rules().thickness;
    const PairScale scale(a.size(), b.size(), b_to_a.offset, reach + thickness);
    const TriangleArrays triangles_a = arrays_of(a.mesh()), triangles_b = arrays_of(b.mesh());
    const auto all = [&](std::span<ItemPair> pairs) {
      found_({a, b, {}, pairs});
      return reach;
    };
    if (apart_ == Apart::by_boxes) {
      return find_touching_items(a.tree(), b.tree(), b_to_a, reach, all);
    }
    // Tests of triangles with rules may find greater depths than the planes say.
    const auto has_rules = [](const PlacedPart& mesh) {
      return mesh.rules().thickness > 0 || mesh.rules().one_sided;
    };
    const bool is_bounded = !has_rules(a) && !has_rules(b) && std::isfinite(reach);
    const double lengths = a.size() + b.size() + greatest(b_to_a.offset);
    double most = reach;
    std::array<float, kMostItemPairs> gaps;
    find_touching_items(a.tree(), b.tree(), b_to_a, reach, [&](std::span<ItemPair> pairs) {
      const auto within = static_cast<float>(scale.grow_of(most + thickness));
      const size_t count =
          keep_near(triangles_a, triangles_b, b_to_a, scale, within, pairs, gaps.data());
      if (count == 0) return most;
      for (size_t i = 0; i < count; ++i) {
        const double least = (gaps[i] - scale.slack) * scale.up - kDepthSlack * lengths;
        // A gap that is not a number says nothing.
        gaps[i] = std::isnan(least) ? -HUGE_VALF : round_downwards(least);
      }
      const double matters = found_({a,
                                     b,
                                     {},
                                     pairs.first(count),
                                     std::span<const float>(gaps).first(is_bounded ? count : 0)});
      if (is_bounded) most = std::min(most, matters + kDepthSlack * lengths);
      return most;
    });
  }

  template <class Use>
  void for_each_near(const PlacedPart& tree, const PlacedPart& other, const Use& use) const {
    if (is_plane(other)) {
      const SeenPlane plane(tree, other);
      tree.find_below(plane.normal, plane.limit + with_slack(reach_, plane.lengths),
                      [&](uint32_t item) {
                        use({&item, 1});
                      });
    } else if (other.kind() == ShapeKind::sphere) {
      tree.find_touching(SeenSphere(tree, other).surroundings(reach_), use);
    } else if (other.kind() == ShapeKind::height_field && !other.is_scaled()) {
      find_items_near(tree, other, use);
    } else {
      tree.find_touching(SeenPart(tree, other).surroundings(reach_), use);
    }
  }

  // The items of a tree, or the triangles of a height field, that are near a block of cells of a
  // height field.
  template <class Use>
  void find_items_near(const PlacedPart& tree, const PlacedPart& field, const Use& use) const {
    const FrameChange change = to_frame_of(field, tree);
    const double reach = with_slack(reach_, tree.size() + field.size() + greatest(change.offset));
    tree.find_admitted(
        [&](const TreeBox& box) { return may_touch(field.field(), change.around(box, reach)); },
        use);
  }

  const double reach_;
  const Apart apart_;
  const bool deepest_alone_;
  const bool are_whole_;
  const NearPartsFound found_;
};

uint32_t near_item(const PlacedPart& tree, const PlacedPart& other) {
  if (is_plane(other)) return tree.low_item(SeenPlane(tree, other).normal);
  if (other.kind() == ShapeKind::sphere) return tree.near_item(SeenSphere(tree, other).box());
  return tree.near_item(SeenPart(tree, other).box());
}

// The items of two bodies, each about the nearest to the other one.
ItemPair near_items_of(const PlacedPart& a, const PlacedPart& b) {
  constexpr int kRounds = 3;
  ItemPair near = {near_item(a, b), 0};
  for (int i = 0; i < kRounds; ++i) {
    near.b = near_item(b, a.item(near.a));
    near.a = near_item(a, b.item(near.b));
  }
  return near;
}

}  // namespace

void find_part_pairs(const PlacedPart& a, const PlacedPart& b, const PartsWanted& wanted,
                     NearPartsFound found) {
  const bool are_whole = a.kind() != ShapeKind::compound && b.kind() != ShapeKind::compound;
  PartSearch(wanted, are_whole, found).run(a, b);
}

float least_separation(const PlacedPart& a, const PlacedPart& b) {
  const PartBall &ball_a = a.part->ball, &ball_b = b.part->ball;
  if (ball_a.radius < 0 || ball_b.radius < 0) return -std::numeric_limits<float>::infinity();
  const Double3 way = minus(plus(b.position, turned(b.turn, ball_b.middle)),
                            plus(a.position, turned(a.turn, ball_a.middle)));
  const double radii = ball_a.radius + ball_b.radius, distance = std::sqrt(dot(way, way));
  const double lengths = distance + radii + greatest(ball_a.middle) + greatest(ball_b.middle);
  const double least = distance - radii - kDepthSlack * lengths;
  return std::fabs(least) < kBeyondSearch ? round_downwards(least)
                                          : -std::numeric_limits<float>::infinity();
}

void find_near_part_pair(const PlacedPart& first, const PlacedPart& second, NearPartsFound found) {
  PlacedPart a = first, b = second;
  while (a.has_parts() || b.has_parts()) {
    if (are_of_one_tree_kind(a, b) || (is_surface(a.kind()) && is_surface(b.kind()))) {
      if (a.has_no_items() || b.has_no_items()) return;
      const ItemPair near = are_of_one_tree_kind(a, b)
                                ? near_items(a.tree(), b.tree(), to_frame_of(a, b))
                                : near_items_of(a, b);
      a = a.item(near.a);
      b = b.item(near.b);
      continue;
    }
    const bool is_first = takes_apart_first(a, b);
    PlacedPart& tree = is_first ? a : b;
    if (tree.has_no_items()) return;
    tree = tree.item(near_item(tree, is_first ? b : a));
  }
  found({a, b});
}

}  // namespace carom
