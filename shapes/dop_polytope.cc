// Clips every plane by all others.
//
// Source of the clipping: I. E. Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping", CACM
// 17(1), 1974.
#include "shapes/dop_polytope.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

using Direction = std::array<int8_t, 3>;

// A corner of a face while planes clip it.
struct ClippedCorner {
  Double3 point;
  uint8_t edge;  // the other plane of the edge from here to the next corner
};
using Corners = FewOf<ClippedCorner, DopFace::kMostCorners>;

double along(const Double3& d, const Double3& x) {
  return (d[0] * x[0] + d[1] * x[1]) + d[2] * x[2];
}

// factor * axis = direction j + sign * direction k.
struct Relation {
  uint8_t axis, j, k;
  int8_t sign, factor;
};

// Tables that all k-DOPs of a kind share.
struct KindTables {
  FewOf<Double3, kMostSlabs> directions;
  FewOf<Relation, 64> relations;

  explicit KindTables(DopKind kind) {
    for (const Direction& d : slab_directions(kind)) {
      directions.push_back({double(d[0]), double(d[1]), double(d[2])});
    }
    for (uint8_t j = 0; j < directions.size(); ++j) {
      for (uint8_t k = 0; k < j; ++k) {
        for (const int sign : {1, -1}) add_relation(j, k, static_cast<int8_t>(sign));
      }
    }
  }

 private:
  void add_relation(uint8_t j, uint8_t k, int8_t sign) {
    Double3 sum;
    for (size_t i = 0; i < 3; ++i) sum[i] = directions[j][i] + sign * directions[k][i];
    for (uint8_t axis = 0; axis < 3; ++axis) {
      const bool is_along = sum[axis] != 0 && sum[(axis + 1) % 3] == 0 && sum[(axis + 2) % 3] == 0;
      if (is_along) relations.push_back({axis, j, k, sign, static_cast<int8_t>(sum[axis])});
    }
  }
};

const KindTables& tables_of(DopKind kind) {
  static const std::array<KindTables, 4> kTables = {
      KindTables(DopKind::k6), KindTables(DopKind::k14), KindTables(DopKind::k18),
      KindTables(DopKind::k26)};
  return kTables[kind == DopKind::k6 ? 0 : kind == DopKind::k14 ? 1 : kind == DopKind::k18 ? 2 : 3];
}

double height_of(const DopSlabs& slabs, size_t plane) {
  const size_t slab = slab_of_plane(plane);
  return plane % 2 == 0 ? slabs.upper[slab] : slabs.lower[slab];
}

// Clips one plane by all slabs; corners() is the polygon that remains.
class PlaneClipper {
 public:
  PlaneClipper(const DopSlabs& slabs, size_t plane)
      : slabs_(slabs),
        directions_(tables_of(slabs.kind).directions),
        plane_(plane),
        tolerance_(kInDopPlane * slabs.size()) {
    start();
    for (size_t slab = 0; slab < directions_.size() && !corners_->empty(); ++slab) {
      if (slab != slab_of_plane(plane)) clip(slab);
    }
    drop_short_edges();
  }

  const Corners& corners() const { return *corners_; }

 private:
  // Starts with the rectangle within the slabs of two axes; the third coordinate follows from the
  // plane.
  void start() {
    const Double3& d = directions_[slab_of_plane(plane_)];
    const size_t axis = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
    size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (d[axis] * sign_of_plane(plane_) < 0) std::swap(u, v);
    const auto add = [&](bool upper_u, bool upper_v, size_t edge) {
      Double3 x{};
      x[u] = upper_u ? slabs_.upper[u] : slabs_.lower[u];
      x[v] = upper_v ? slabs_.upper[v] : slabs_.lower[v];
      x[axis] = d[axis] * (height_of(slabs_, plane_) - along(d, x));
      corners_->push_back({x, static_cast<uint8_t>(edge)});
    };
    add(true, false, 2 * u);
    add(true, true, 2 * v);
    add(false, true, 2 * u + 1);
    add(false, false, 2 * v + 1);
  }

  void clip(size_t slab) {
    Range range = measure(slab);
    if (range.most > slabs_.upper[slab] + tolerance_) {
      clip(2 * slab, slabs_.upper[slab]);
      range = measure(slab);
    }
    if (range.least < slabs_.lower[slab] - tolerance_) clip(2 * slab + 1, slabs_.lower[slab]);
  }

  struct Range {
    double least = HUGE_VAL, most = -HUGE_VAL;
  };
  Range measure(size_t slab) {
    Range range;
    for (size_t i = 0; i < corners_->size(); ++i) {
      heights_[i] = along(directions_[slab], (*corners_)[i].point);
      range = {std::min(range.least, heights_[i]), std::max(range.most, heights_[i])};
    }
    return range;
  }

  void clip(size_t plane, double limit) {
    const double sign = sign_of_plane(plane);
    const auto is_inside = [&](size_t i) { return (heights_[i] - limit) * sign <= tolerance_; };
    const Corners& all = *corners_;
    Corners& left = cleared_spare();
    const size_t count = all.size();
    bool inside = count > 0 && is_inside(0);
    for (size_t i = 0; i < count; ++i) {
      const size_t next = i + 1 < count ? i + 1 : 0;
      const bool was_inside = std::exchange(inside, is_inside(next));
      if (was_inside) left.push_back(all[i]);
      if (was_inside == inside) continue;
      const uint8_t edge = was_inside ? static_cast<uint8_t>(plane) : all[i].edge;
      left.push_back({crossing(i, next, limit), edge});
    }
    std::swap(corners_, spare_);
  }

  Corners& cleared_spare() {
    spare_->clear();
    return *spare_;
  }

  Double3 crossing(size_t i, size_t next, double limit) const {
    const double share = (limit - heights_[i]) / (heights_[next] - heights_[i]);
    const double t = std::clamp(share, 0.0, 1.0);
    const Double3 &from = (*corners_)[i].point, &to = (*corners_)[next].point;
    Double3 x;
    for (size_t axis = 0; axis < 3; ++axis) x[axis] = from[axis] + (to[axis] - from[axis]) * t;
    return x;
  }

  // Drops the corners whose edge to the next corner has no length. One corner always stays.
  void drop_short_edges() {
    const Corners& all = *corners_;
    Corners& left = cleared_spare();
    for (size_t i = 0; i < all.size(); ++i) {
      const bool is_last = i + 1 == all.size();
      const Double3& next = !is_last       ? all[i + 1].point
                            : left.empty() ? all[i].point
                                           : left[0].point;
      const bool is_long = greatest(minus(next, all[i].point)) > tolerance_;
      if (is_long || (is_last && left.empty())) left.push_back(all[i]);
    }
    std::swap(corners_, spare_);
  }

  const DopSlabs& slabs_;
  const FewOf<Double3, kMostSlabs>& directions_;
  const size_t plane_;
  const double tolerance_;
  std::array<Corners, 2> buffers_;
  Corners *corners_ = &buffers_[0], *spare_ = &buffers_[1];
  std::array<double, DopFace::kMostCorners> heights_;
};

// Points in the order in which they are found. Those within a tolerance of each other are one.
class PointList {
 public:
  explicit PointList(double tolerance) : tolerance_(tolerance) {}

  uint8_t find_or_add(const Double3& point) {
    for (size_t i = 0; i < points_.size(); ++i) {
      if (is_near(points_[i], point)) return static_cast<uint8_t>(i);
    }
    if (points_.is_full()) return nearest(point);
    points_.push_back(point);
    return static_cast<uint8_t>(points_.size() - 1);
  }

  size_t size() const { return points_.size(); }
  const Double3& operator[](size_t i) const { return points_[i]; }

 private:
  // Most points differ in x already.
  bool is_near(const Double3& a, const Double3& b) const {
    return std::fabs(a[0] - b[0]) <= tolerance_ && std::fabs(a[1] - b[1]) <= tolerance_ &&
           std::fabs(a[2] - b[2]) <= tolerance_;
  }

  uint8_t nearest(const Double3& point) const {
    const auto distance = [&](const Double3& x) { return greatest(minus(x, point)); };
    const auto* least = std::min_element(
        points_.begin(), points_.end(),
        [&](const Double3& x, const Double3& y) { return distance(x) < distance(y); });
    return static_cast<uint8_t>(least - points_.begin());
  }

  FewOf<Double3, DopPolytope::kMostPoints> points_;
  const double tolerance_;
};

// Moves both ends of every slab outwards by half a unit in the last place of a float.
DopSlabs widened(DopSlabs slabs) {
  for (size_t i = 0; i < slab_count(slabs.kind); ++i) {
    slabs.lower[i] -= 0x1p-24 * std::fabs(slabs.lower[i]);
    slabs.upper[i] += 0x1p-24 * std::fabs(slabs.upper[i]);
  }
  return slabs;
}

// Whether no slab has its ends exchanged, beyond rounding.
bool are_ordered(const DopSlabs& slabs) {
  const double tolerance = kInDopPlane * slabs.size();
  for (size_t i = 0; i < slab_count(slabs.kind); ++i) {
    if (slabs.lower[i] > slabs.upper[i] + tolerance) return false;
  }
  return true;
}

bool contains(const DopSlabs& slabs, const Double3& x) {
  const auto& directions = tables_of(slabs.kind).directions;
  for (size_t i = 0; i < directions.size(); ++i) {
    const double height = along(directions[i], x);
    if (height < slabs.lower[i] || height > slabs.upper[i]) return false;
  }
  return true;
}

}  // namespace

DopSlabs::DopSlabs(const Dop& dop) : kind(dop.kind) {
  std::copy(dop.lower.begin(), dop.lower.end(), lower.begin());
  std::copy(dop.upper.begin(), dop.upper.end(), upper.begin());
}

DopSlabs DopSlabs::with_tight_axes() const {
  DopSlabs tight = *this;
  for (const Relation& r : tables_of(kind).relations) {
    const double low = r.sign > 0 ? lower[r.k] : -upper[r.k];
    const double high = r.sign > 0 ? upper[r.k] : -lower[r.k];
    const double from = (tight.lower[r.j] + low) / r.factor;
    const double to = (tight.upper[r.j] + high) / r.factor;
    tight.lower[r.axis] = std::max(tight.lower[r.axis], std::min(from, to));
    tight.upper[r.axis] = std::min(tight.upper[r.axis], std::max(from, to));
  }
  return tight;
}

double DopSlabs::size() const {
  double most = 0;
  for (size_t i = 0; i < 3; ++i) {
    most = std::max({most, std::fabs(lower[i]), std::fabs(upper[i])});
  }
  return most;
}

DopPolytope::DopPolytope(const DopSlabs& slabs) {
  build(slabs.with_tight_axes());
  if (is_empty()) build(widened(slabs).with_tight_axes());
}

void DopPolytope::build(const DopSlabs& slabs) {
  if (!are_ordered(slabs)) return;
  PointList points(kInDopPlane * slabs.size());
  for (uint8_t plane = 0; plane < 2 * slab_count(slabs.kind); ++plane) {
    const PlaneClipper clipper(slabs, plane);
    const Corners& corners = clipper.corners();
    if (corners.empty()) continue;
    faces_.push_back(
        {plane, static_cast<uint16_t>(corners_.size()), static_cast<uint16_t>(corners.size())});
    for (const ClippedCorner& corner : corners) {
      corners_.push_back({points.find_or_add(corner.point), corner.edge});
    }
  }
  count_ = points.size();
  lines_.resize(3 * lines_of_column());
  for (size_t k = 0; k < lines_.size(); ++k) {
    const size_t axis = k / lines_of_column(), first = k % lines_of_column() * kPadding;
    for (size_t i = 0; i < kPadding; ++i) {
      lines_[k][i] = points[std::min(first + i, count_ - 1)][axis];
    }
  }
  add_edges();
}

// Both faces of an edge list it, but rounding may drop it from one. So the face with the lower
// plane adds the edge, or the other one if the lower one does not list it.
void DopPolytope::add_edges() {
  std::array<uint32_t, 2 * kMostSlabs> neighbours{};
  for (const DopFace& face : faces_) {
    if (face.count < 2) continue;
    for (const DopCorner& corner : corners(face)) neighbours[face.plane] |= 1u << corner.edge;
  }
  for (const DopFace& face : faces_) {
    if (face.count < 2) continue;
    for (const DopCorner& corner : corners(face)) {
      const bool is_other = corner.edge < face.plane && (neighbours[corner.edge] >> face.plane & 1);
      if (is_other || edges_.size() == kMostEdges) continue;
      edges_.push_back({corner.point, {face.plane, corner.edge}});
    }
  }
}

size_t DopPolytope::bytes() const {
  return lines_.capacity() * sizeof(Line) + faces_.capacity() * sizeof(DopFace) +
         corners_.capacity() * sizeof(DopCorner) + edges_.capacity() * sizeof(DopEdge);
}

bool has_points(const DopSlabs& slabs) {
  const DopSlabs tight = slabs.with_tight_axes();
  const Double3 middle = {(tight.lower[0] + tight.upper[0]) / 2,
                          (tight.lower[1] + tight.upper[1]) / 2,
                          (tight.lower[2] + tight.upper[2]) / 2};
  return contains(tight, middle) || !DopPolytope(slabs).is_empty();
}

}  // namespace carom
