// Parts in the frame of the part whose items are searched.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/few_of.h"
#include "geometries/seen_points.h"
#include "midphase/placed_part.h"

namespace carom {

// Beyond the range of the search every part is near. The clamp keeps sums finite.
inline Double3 place_in_frame(const PlacedPart& frame, const PlacedPart& part) {
  constexpr double kGreatestOffset = 0x1p1000;
  Double3 way = minus(part.position, frame.position);
  for (double& x : way) x = std::clamp(x, -kGreatestOffset, kGreatestOffset);
  return turned_back(frame.turn, way);
}

inline FrameChange to_frame_of(const PlacedPart& frame, const PlacedPart& part) {
  FrameChange change;
  for (size_t i = 0; i < 3; ++i) {
    const Double3 axis = {part.turn[0][i], part.turn[1][i], part.turn[2][i]};
    const Double3 seen = turned_back(frame.turn, axis);
    for (size_t k = 0; k < 3; ++k) change.turn[k][i] = seen[k];
  }
  change.offset = place_in_frame(frame, part);
  return change;
}

inline double with_slack(double reach, double lengths) {
  if (!(lengths < kBeyondSearch)) return std::numeric_limits<double>::infinity();
  return reach + kSearchSlack * lengths;
}

// A part in the frame of a tree.
class SeenPart {
 public:
  SeenPart(const PlacedPart& tree, const PlacedPart& part)
      : change_(to_frame_of(tree, part)), size_(tree.size()) {
    if (part.kind() == ShapeKind::triangle) {
      see_triangle(part);
    } else if (part.kind() == ShapeKind::capsule) {
      const std::array<Row, kMostRows>& rows = part.part->rows;
      see_points(std::array{vector_of(rows[0]), vector_of(rows[1])}, rows[0][3]);
    } else if (part.kind() == ShapeKind::hull) {
      see_points_of(*geometry_at<HullGeometry>(part.part->rows[0]), *part.part);
    } else if (part.kind() == ShapeKind::rounded_box || part.kind() == ShapeKind::rounded_hull) {
      see_rounded(*part.part);
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
      const Surface surface = part.surface();
      see_points(wide_corners(surface, part.triangle), surface.rules().thickness);
    }
  }

  // The core, with a radius about it.
  void see_rounded(const Part& part) {
    Part core = part;
    core.kind = core_kind(part.kind);
    if (core.kind == ShapeKind::hull) {
      see_points_of(*geometry_at<HullGeometry>(core.rows[0]), core);
    } else {
      see_box(box_of(core));
    }
    radius_ = part.rows[0][3];
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
        lengths(tree.size() + 2 * greatest(middle) + radius) {}

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
    lengths = tree.size() + greatest(change.offset) + std::fabs(row[3]) * scale;
  }
};

inline bool is_plane(const PlacedPart& part) { return part.kind() == ShapeKind::halfspace; }

}  // namespace carom
