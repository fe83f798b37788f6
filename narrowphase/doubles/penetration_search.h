// The penetration search for two cores that overlap or touch: it finds the face of the difference B
// - A that is nearest to zero. A polytope inside B - A grows at its nearest face (EPA).
//
// The polytope need not contain zero at the start: a face with zero in front of it has a negative
// height, so it is the nearest face and grows first.
//
// Source: G. van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game
// Objects", Game Developers Conference, 2001.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/doubles/gjk.h"

namespace carom {

// The penetration direction. `normal` is unit and leads from A to B. `gap` is the gap of the
// projections on it: negative by the depth if the cores overlap.
struct WayOut {
  CoreVector normal{1, 0, 0};
  double gap = -HUGE_VAL;
  bool is_flat = false;    // B - A has no volume: -normal is as good
  bool has_ended = true;   // false: there may be a direction with less depth
  bool has_point = false;  // of A, where it meets B: of round cores
  CoreVector of_a{};
};

class WayOutSearch {
 public:
  WayOutSearch(const Core& a, const Core& b, FurthestPoint furthest)
      : a_(a),
        b_(b),
        furthest_(furthest),
        same_(a.is_round() || b.is_round() ? kSameRoundWayOut : kSameWayOut) {}

  // Starts from the corners that nearest_way() found.
  WayOut run(const NearestPoint::Corners& known) {
    for (const CoreVector& corner : known) add_if_beside({corner, {}});
    if (!complete_tetrahedron()) return best_;
    make_faces();
    while (true) {
      const size_t nearest = nearest_face();
      if (is_shortest(nearest)) return best_;
      const DifferencePoint point = try_way(faces_[nearest].normal);
      if (is_shortest(nearest)) return best_;
      if (!grow_or_lift(nearest, point)) return best_;
    }
  }

  // Calls use(normal) for the directions in which there may be less depth than the search found.
  template <class Use>
  void for_each_open_way(const Use& use) const {
    for (size_t face = 0; face < faces_.size(); ++face) {
      if (height_[face] < -best_.gap - same_) use(-faces_[face].normal);
    }
  }

  // For round cores: ends at a face that is as near as the difference in the direction of that very
  // face, so that its corners tell where the cores meet.
  WayOut run_round(const NearestWay& known) {
    for (size_t i = 0; i < known.corners.size(); ++i) {
      add_if_beside({known.corners[i], known.of_a[i]});
    }
    if (!complete_tetrahedron()) return best_;
    make_faces();
    while (true) {
      const size_t nearest = nearest_face();
      const CoreVector normal = faces_[nearest].normal;
      const DifferencePoint point = try_way(normal);
      const double over = dot(normal, point.point) - height_[nearest];
      if (over <= same_) {
        WayOut out;
        const double aside = find_out(nearest, point, out);
        if (aside <= kRoundAside || over <= kFlatDifference) return out;
      }
      if (!grow_or_lift(nearest, point)) return best_;
    }
  }

 private:
  static constexpr size_t kMostCorners = 256;
  // A polytope of triangles has fewer than 2 * kMostCorners; the rest is room during growth.
  static constexpr size_t kMostFaces = 2 * kMostCorners + 64;

  // An edge as a side of a face: from the face's corner number `side` to the next one.
  struct Side {
    uint16_t face;
    uint8_t side;
  };
  struct Face {
    CoreVector normal;               // unit, outwards; zero if the face has no area
    std::array<uint16_t, 3> corner;  // counter-clockwise seen from outside
    std::array<Side, 3> across;      // the neighbour across each side
    bool is_seen;                    // from the point that is being added
  };

  static double length(const CoreVector& v) { return std::sqrt(dot(v, v)); }
  static CoreVector unit(const CoreVector& v) { return v * (1 / length(v)); }

  // A unit vector perpendicular to u.
  static CoreVector perpendicular(const CoreVector& u) {
    const double x = std::fabs(u.x), y = std::fabs(u.y), z = std::fabs(u.z);
    const CoreVector least = x <= y && x <= z ? CoreVector{1, 0, 0}
                             : y <= z         ? CoreVector{0, 1, 0}
                                              : CoreVector{0, 0, 1};
    return unit(cross(u, least));
  }

  // Adds the point that is furthest along the normal of a face. False if the search has to end.
  bool grow_or_lift(size_t nearest, const DifferencePoint& point) {
    if (is_corner(point.point)) {
      // Rounding had put the face too low.
      height_[nearest] = dot(faces_[nearest].normal, point.point);
      return true;
    }
    best_.has_ended = !corners_.is_full() && grow(nearest, point);
    return best_.has_ended;
  }

  // The way out through a face, beyond which no point is further than `point`. Zero need not
  // project onto that face: where the difference is flat, several faces share a plane. One of them
  // holds the polytope's nearest point. Returns how far beside zero's projection that is.
  double find_out(size_t nearest, const DifferencePoint& point, WayOut& out) const {
    const CoreVector& normal = faces_[nearest].normal;
    out = {.normal = -normal, .gap = -dot(normal, point.point), .has_point = true};
    double least = HUGE_VAL, aside = HUGE_VAL;
    for (size_t face = 0; face < faces_.size(); ++face) {
      if (!(height_[face] <= height_[nearest] + same_)) continue;
      for (size_t last = 0; last < 3; ++last) {  // a corner that spans the point comes last
        NearestPoint::Corners corners, of_a;
        for (size_t i = 1; i <= 3; ++i) {
          const uint16_t corner = faces_[face].corner[(last + i) % 3];
          corners.push_back(corners_[corner]);
          of_a.push_back(of_a_[corner]);
        }
        const NearestPoint found(corners);
        const bool is_in_plane = dot(normal, found.point()) >= height_[nearest] - same_;
        if (!is_in_plane || !(found.squared() < least)) continue;
        least = found.squared();
        aside = length(found.point() - normal * dot(normal, found.point()));
        out.of_a = spanned_of_a(found.corners(), found.point(), spanning(found, of_a));
      }
    }
    return aside;
  }

  // The point of B - A that is furthest along n. Keeps the gap along -n if it is the best.
  DifferencePoint try_way(const CoreVector& n) {
    const DifferencePoint point = find_difference_point(a_, b_, -n, furthest_);
    const double gap = -dot(n, point.point);
    if (gap > best_.gap) {
      best_.normal = -n;
      best_.gap = gap;
    }
    return point;
  }

  // B - A has no face nearer to zero than the nearest face of the polytope inside it.
  bool is_shortest(size_t nearest) const { return -best_.gap - height_[nearest] <= same_; }

  bool is_corner(const CoreVector& point) const {
    return std::any_of(corners_.begin(), corners_.end(), [&](const CoreVector& corner) {
      return corner.x == point.x && corner.y == point.y && corner.z == point.z;
    });
  }

  // --- The first tetrahedron ---

  CoreVector edge(size_t i) const { return corners_[i] - corners_[0]; }

  // Adds the point unless it lies in the point, line or plane of the present corners.
  bool add_if_beside(const DifferencePoint& point) {
    if (distance_from_corners(point.point) <= kFlatDifference) return false;
    add_corner(point);
    return true;
  }

  void add_corner(const DifferencePoint& point) {
    corners_.push_back(point.point);
    of_a_.push_back(point.of_a);
  }

  double distance_from_corners(const CoreVector& point) const {
    if (corners_.empty()) return HUGE_VAL;
    const CoreVector way = point - corners_[0];
    if (corners_.size() == 1) return length(way);
    if (corners_.size() == 2) return length(cross(unit(edge(1)), way));
    return std::fabs(dot(unit(cross(edge(1), edge(2))), way));
  }

  // Adds the furthest point of B - A along `way`, or else along -way.
  bool add_towards(const CoreVector& way) {
    return add_if_beside(try_way(way)) || add_if_beside(try_way(-way));
  }

  bool complete_tetrahedron() {
    if (corners_.size() == 1) {
      const bool has_length =
          add_towards({1, 0, 0}) || add_towards({0, 1, 0}) || add_towards({0, 0, 1});
      if (!has_length) return flat_across({1, 0, 0});
    }
    if (corners_.size() == 2) {
      const CoreVector u = perpendicular(edge(1));
      if (!add_towards(u) && !add_towards(unit(cross(edge(1), u)))) return flat_across(u);
    }
    if (corners_.size() == 3) {
      const CoreVector n = unit(cross(edge(1), edge(2)));
      if (!add_towards(n)) return flat_across(n);
    }
    return true;
  }

  bool flat_across(const CoreVector& n) {
    best_ = WayOut();
    try_way(-n);
    try_way(n);
    best_.is_flat = true;
    return false;
  }

  void make_faces() {
    // The fourth corner lies behind the first three.
    if (dot(cross(edge(1), edge(2)), edge(3)) > 0) {
      std::swap(corners_[0], corners_[1]);
      std::swap(of_a_[0], of_a_[1]);
    }
    static constexpr std::array<std::array<uint16_t, 3>, 4> kFaces = {
        {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    for (const auto& corners : kFaces) set_face(new_face(), corners);
    link({0, 0}, {1, 2});
    link({0, 1}, {2, 2});
    link({0, 2}, {3, 2});
    link({1, 0}, {3, 1});
    link({1, 1}, {2, 0});
    link({2, 1}, {3, 0});
  }

  // --- The polytope ---

  // A face without area is never the nearest, and no point sees it.
  void set_face(uint16_t face, const std::array<uint16_t, 3>& corner) {
    const CoreVector &p = corners_[corner[0]], &q = corners_[corner[1]], &r = corners_[corner[2]];
    const CoreVector u = q - p, v = r - p, n = cross(u, v);
    const double squared = dot(n, n), area = std::sqrt(squared);
    const bool has_area = squared > (kWithoutArea * kWithoutArea) * (dot(u, u) * dot(v, v));
    faces_[face].corner = corner;
    faces_[face].is_seen = false;
    faces_[face].normal = has_area ? n * (1 / area) : CoreVector{0, 0, 0};
    height_[face] = has_area ? dot(faces_[face].normal, p) : HUGE_VAL;
  }

  // The first of the least heights. The least of every fourth comes first, since these minima do
  // not wait for each other.
  size_t nearest_face() const {
    std::array<double, 4> least;
    least.fill(HUGE_VAL);
    size_t i = 0;
    for (; i + 4 <= height_.size(); i += 4) {
      for (size_t k = 0; k < 4; ++k) least[k] = std::min(least[k], height_[i + k]);
    }
    for (; i < height_.size(); ++i) least[0] = std::min(least[0], height_[i]);
    const double of_all = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
    const double* const first = std::find(height_.begin(), height_.end(), of_all);
    return first == height_.end() ? 0 : static_cast<size_t>(first - height_.begin());
  }

  // Replaces all faces that the point sees, `first` among them. False if there is no room, or if
  // rounding made the horizon something other than one ring.
  bool grow(size_t first, const DifferencePoint& point) {
    seen_.clear();
    horizon_.clear();
    see(static_cast<uint16_t>(first));
    for (const Side& beyond : faces_[first].across) look_across(beyond, point.point);
    return !horizon_.is_full() && close_horizon(point);
  }

  void see(uint16_t face) {
    faces_[face].is_seen = true;
    seen_.push_back(face);
  }

  // Walks from one seen face to the next, so that the sides of the horizon come in ring order.
  void look_across(const Side& into, const CoreVector& point) {
    const Face& face = faces_[into.face];
    if (face.is_seen || horizon_.is_full()) return;
    if (!(dot(face.normal, point) - height_[into.face] > kInFace)) {
      horizon_.push_back(into);
      return;
    }
    see(into.face);
    look_across(face.across[(into.side + 1) % 3], point);
    look_across(face.across[(into.side + 2) % 3], point);
  }

  // Adds a face from every side of the horizon to the point. The seen faces are reused; there are
  // always two more new faces than those.
  bool close_horizon(const DifferencePoint& point) {
    const auto apex = static_cast<uint16_t>(corners_.size());
    add_corner(point);
    ring_.clear();
    for (const Side& beyond : horizon_) {
      if (ring_.size() >= seen_.size() && faces_.is_full()) return false;
      const uint16_t face = ring_.size() < seen_.size() ? seen_[ring_.size()] : new_face();
      const std::array<uint16_t, 3>& corner = faces_[beyond.face].corner;
      set_face(face, {corner[(beyond.side + 1u) % 3], corner[beyond.side], apex});
      link({face, 0}, beyond);
      ring_.push_back(face);
    }
    if (ring_.size() < seen_.size()) return false;
    for (size_t i = 0; i < ring_.size(); ++i) {
      const uint16_t face = ring_[i], next = ring_[(i + 1) % ring_.size()];
      if (faces_[face].corner[1] != faces_[next].corner[0]) return false;
      link({face, 1}, {next, 2});
    }
    return true;
  }

  void link(const Side& one, const Side& other) {
    faces_[one.face].across[one.side] = other;
    faces_[other.face].across[other.side] = one;
  }

  uint16_t new_face() {
    faces_.push_back({});
    height_.push_back(0);
    return static_cast<uint16_t>(faces_.size() - 1);
  }

  const Core& a_;
  const Core& b_;
  const FurthestPoint furthest_;
  const double same_;
  WayOut best_;
  FewOf<CoreVector, kMostCorners> corners_, of_a_;  // points of B - A, and of A
  FewOf<Face, kMostFaces> faces_;
  FewOf<double, kMostFaces> height_;  // of each face's plane over zero
  FewOf<uint16_t, kMostFaces> seen_, ring_;
  FewOf<Side, kMostCorners> horizon_;
};

}  // namespace carom
