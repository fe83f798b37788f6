#include "midphase/part_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/few_of.h"
#include "base/outward.h"
#include "geometries/near_points.h"

namespace carom {
namespace {

constexpr double kGreatestOffset = 0x1p1000;

// Beyond the range of the search every part is near. The clamp keeps sums finite.
Double3 place_in_frame(const PlacedPart& frame, const PlacedPart& part) {
  Double3 way = minus(part.position, frame.position);
  for (double& x : way) x = std::clamp(x, -kGreatestOffset, kGreatestOffset);
  return turned_back(frame.turn, way);
}

FrameChange to_frame_of(const PlacedPart& frame, const PlacedPart& part) {
  FrameChange change;
  for (size_t i = 0; i < 3; ++i) {
    const Double3 axis = {part.turn[0][i], part.turn[1][i], part.turn[2][i]};
    const Double3 seen = turned_back(frame.turn, axis);
    for (size_t k = 0; k < 3; ++k) change.turn[k][i] = seen[k];
  }
  change.offset = place_in_frame(frame, part);
  return change;
}

// The greatest coordinate of the tree's boxes.
double size_of(const PlacedPart& tree) {
  const auto largest = [](const auto& parts) {
    return std::max(parts.lower().cwiseAbs().maxCoeff(), parts.upper().cwiseAbs().maxCoeff());
  };
  return tree.kind() == ShapeKind::mesh ? largest(tree.mesh()) : largest(tree.compound());
}

double with_slack(double reach, double lengths) {
  if (!(lengths < kBeyondSearch)) return std::numeric_limits<double>::infinity();
  return reach + kSearchSlack * lengths;
}

TriangleArrays arrays_of(const MeshGeometry& mesh) {
  return {mesh.vertices().data()->data(), mesh.triangles().data(), mesh.triangles().size()};
}

// A part in the frame of a tree.
class SeenPart {
 public:
  SeenPart(const PlacedPart& tree, const PlacedPart& part)
      : change_(to_frame_of(tree, part)), size_(size_of(tree)) {
    if (part.kind() == ShapeKind::triangle) {
      see_triangle(part);
    } else if (part.kind() == ShapeKind::capsule) {
      const std::array<Row, kMostRows>& rows = part.part->rows;
      see_points(std::array{vector_of(rows[0]), vector_of(rows[1])}, rows[0][3]);
    } else if (part.kind() == ShapeKind::hull) {
      see_points_of(*geometry_at<HullGeometry>(part.part->rows[0]), *part.part);
    } else {
      see_box(box_of(*part.part));
    }
  }

  TreeBox box() const {
    return rounded_outwards(box_.middle, plus(box_.half, {radius_, radius_, radius_}));
  }
  // The box, and all within `reach` of it.
  RoundedBox surroundings(double reach) const {
    return rounded_outwards(box_.middle, box_.half, with_slack(radius_ + reach, lengths()));
  }

  // All lengths that go into a test with a part of the tree. Points far from the part's own origin
  // are about as far from there as that is from the tree's.
  double lengths() const {
    return size_ + greatest(change_.offset) + greatest(box_.middle) + greatest(box_.half) + radius_;
  }
  double radius() const { return radius_; }
  // The core of the part, or what contains it.
  const SeenPoints& points() {
    if (!points_.empty()) seen_points_.set(points_, box_.middle, greatest(box_.half) + radius_);
    return seen_points_;
  }

 private:
  Double3 seen(const Double3& point) const {
    return plus(turned(change_.turn, point), change_.offset);
  }

  void see_triangle(const PlacedPart& part) {
    if (part.triangle == PlacedPart::kWhole) {
      const std::array<Row, kMostRows>& rows = part.part->rows;
      see_points(std::array{vector_of(rows[0]), vector_of(rows[1]), vector_of(rows[2])},
                 rows[0][3]);
    } else {
      const MeshGeometry& mesh = part.mesh();
      see_points(std::array{corner(mesh, part.triangle, 0), corner(mesh, part.triangle, 1),
                            corner(mesh, part.triangle, 2)},
                 mesh.rules().thickness);
    }
  }

  // A box around the turned points has half the faces of a box around the turned box.
  void see_points_of(const HullGeometry& hull, const Part& part) {
    if (hull.points().size() > SeenPoints::kMost) return see_box(box_of(part));
    box_ = see_hull(hull, change_, seen_points_);
  }

  template <class Points>
  void see_points(const Points& points, double radius) {
    Double3 lower = seen(points[0]), upper = lower;
    points_.push_back(lower);
    for (size_t i = 1; i < points.size(); ++i) {
      const Double3 point = seen(points[i]);
      points_.push_back(point);
      for (size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], point[axis]);
        upper[axis] = std::max(upper[axis], point[axis]);
      }
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      // Halved first, since sums of the greatest doubles are infinite.
      box_.middle[axis] = lower[axis] / 2 + upper[axis] / 2;
      box_.half[axis] = upper[axis] / 2 - lower[axis] / 2;
    }
    radius_ = radius;
  }

  void see_box(const PartBox& box) {
    box_.middle = seen(box.middle);
    for (size_t axis = 0; axis < 3; ++axis) {
      const Double3& r = change_.turn[axis];
      box_.half[axis] = dot({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])}, box.half);
    }
    for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
      Double3 corner = box.middle;
      for (size_t axis = 0; axis < 3; ++axis) {
        corner[axis] += (i >> axis & 1) != 0 ? box.half[axis] : -box.half[axis];
      }
      points_.push_back(seen(corner));
    }
  }

  const FrameChange change_;
  const double size_;
  PartBox box_;
  double radius_ = 0;  // around the box, and around the points
  FewOf<Double3, 8> points_;
  SeenPoints seen_points_;  // of a hull, or once they are asked for
};

// A sphere in the frame of a tree. Many are asked about, and it has no orientation.
struct SeenSphere {
  Double3 middle;
  double radius;
  double lengths;  // all that go into a test with a part of the tree

  SeenSphere(const PlacedPart& tree, const PlacedPart& sphere)
      : middle(place_in_frame(tree, sphere)),
        radius(sphere.part->radius),
        lengths(size_of(tree) + 2 * greatest(middle) + radius) {}

  TreeBox box() const { return rounded_outwards(middle, {radius, radius, radius}); }
  // The box around all within `reach` of it.
  RoundedBox surroundings(double reach) const {
    return rounded_outwards(middle, {}, with_slack(radius + reach, lengths));
  }
};

// A half-space in the frame of a tree: all x with normal . x <= limit.
struct SeenPlane {
  Double3 normal;  // unit
  double limit;
  double lengths;

  SeenPlane(const PlacedPart& tree, const PlacedPart& halfspace) {
    const Row& row = halfspace.part->rows[0];
    const double scale = 1 / std::sqrt(dot(vector_of(row), vector_of(row)));
    const FrameChange change = to_frame_of(tree, halfspace);
    normal = turned(change.turn, vector_of(row));
    for (double& n : normal) n *= scale;
    limit = dot(normal, change.offset) + row[3] * scale;
    lengths = size_of(tree) + greatest(change.offset) + std::fabs(row[3]) * scale;
  }
};

bool is_plane(const PlacedPart& part) { return part.kind() == ShapeKind::halfspace; }

// Gives the parts of a body one at a time. For a mesh only the triangle changes.
class PartOf {
 public:
  explicit PartOf(const PlacedPart& whole) : whole_(whole), part_(whole) {}

  const PlacedPart& item(uint32_t index) {
    if (whole_.kind() == ShapeKind::mesh) {
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

// Whether A is taken apart before B: a compound goes before a mesh. Two of a kind are taken apart
// together.
bool takes_apart_first(const PlacedPart& a, const PlacedPart& b) {
  if (!a.has_parts()) return false;
  return !b.has_parts() || a.kind() == ShapeKind::compound;
}

class PartSearch {
 public:
  PartSearch(double reach, Apart apart, NearPartsFound found)
      : reach_(reach), apart_(apart), found_(found) {}

  void run(const PlacedPart& a, const PlacedPart& b) const {
    if (!a.has_parts() && !b.has_parts()) {
      found_({a, b});
    } else if (a.kind() == b.kind()) {
      take_apart_both(a, b);
    } else if (takes_apart_first(a, b)) {
      take_apart(a, b, [&](const PlacedPart& part) { run(part, b); }, {a, b});
    } else {
      take_apart(b, a, [&](const PlacedPart& part) { run(a, part); }, {a, b});
    }
  }

 private:
  // Goes on with each part of `tree` that is near the other one. The triangles of a mesh, which
  // need no more searching, are found some at a time: those of `both`.
  template <class GoOn>
  void take_apart(const PlacedPart& tree, const PlacedPart& other, const GoOn& go_on,
                  const NearParts& both) const {
    if (tree.kind() == ShapeKind::mesh && !other.has_parts()) {
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
  void find_triangles_touching(const PlacedPart& mesh, const PlacedPart& other,
                               const NearParts& both) const {
    for_each_near(mesh, other, [&](std::span<const uint32_t> triangles) {
      found_({both.a, both.b, triangles});
    });
  }

  // Triangles whose planes keep them apart are left out. Tests of triangles with rules may find
  // greater depths than the planes say.
  void find_triangles_near(const PlacedPart& mesh, const PlacedPart& other,
                           const NearParts& both) const {
    SeenPart seen(mesh, other);
    const double lengths = seen.lengths();
    const MeshRules& rules = mesh.mesh().rules();
    const bool has_rules = rules.thickness > 0 || mesh.one_sided.value_or(rules.one_sided) ||
                           other.kind() == ShapeKind::triangle;
    const bool is_bounded = lengths < kBeyondSearch && (!has_rules || apart_ == Apart::by_planes);
    if (!is_bounded) {
      return mesh.tree().find_touching(seen.surroundings(reach_),
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
    mesh.tree().find_touching(seen.surroundings(reach_), [&](std::span<const uint32_t> triangles) {
      NearPoints near;
      keep_near_points(arrays_of(mesh.mesh()), points, most, triangles, near);
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
    const double lengths = size_of(a) + size_of(b) + greatest(change.offset);
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
    const PairScale scale(size_of(a), size_of(b), b_to_a.offset, reach + thickness);
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
      return mesh.mesh().rules().thickness > 0 ||
             mesh.one_sided.value_or(mesh.mesh().rules().one_sided);
    };
    const bool is_bounded = !has_rules(a) && !has_rules(b) && std::isfinite(reach);
    const double lengths = size_of(a) + size_of(b) + greatest(b_to_a.offset);
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
      tree.tree().find_below(plane.normal, plane.limit + with_slack(reach_, plane.lengths),
                             [&](uint32_t item) {
                               use({&item, 1});
                             });
    } else if (other.kind() == ShapeKind::sphere) {
      tree.tree().find_touching(SeenSphere(tree, other).surroundings(reach_), use);
    } else {
      tree.tree().find_touching(SeenPart(tree, other).surroundings(reach_), use);
    }
  }

  const double reach_;
  const Apart apart_;
  const NearPartsFound found_;
};

uint32_t near_item(const PlacedPart& tree, const PlacedPart& other) {
  if (is_plane(other)) return tree.tree().low_item(SeenPlane(tree, other).normal);
  if (other.kind() == ShapeKind::sphere) {
    return tree.tree().near_item(SeenSphere(tree, other).box());
  }
  return tree.tree().near_item(SeenPart(tree, other).box());
}

}  // namespace

void find_part_pairs(const PlacedPart& a, const PlacedPart& b, double reach, Apart apart,
                     NearPartsFound found) {
  PartSearch(reach, apart, found).run(a, b);
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
    if (a.kind() == b.kind()) {
      if (a.tree().is_empty() || b.tree().is_empty()) return;
      const ItemPair near = near_items(a.tree(), b.tree(), to_frame_of(a, b));
      a = a.item(near.a);
      b = b.item(near.b);
      continue;
    }
    const bool is_first = takes_apart_first(a, b);
    PlacedPart& tree = is_first ? a : b;
    if (tree.tree().is_empty()) return;
    tree = tree.item(near_item(tree, is_first ? b : a));
  }
  found({a, b});
}

}  // namespace carom
