// GJK in float32 and scaled units: distances that are sure, and decisions; all else is left to
// searches in double precision. The kernels in lanes do the same, operation for operation.
//
// Sources: as of nearest_way.h. Of a simplex every point, side and face with the last corner is
// tried, and the nearest kept: lanes have no branches to save.
#pragma once

#include <array>

#include "kernel/few_of.h"
#include "kernel/tolerances.h"
#include "narrowphase/convex_ref.h"
#include "narrowphase/separation_ref.h"
#include "narrowphase/shapes_ref.h"

namespace carom::reference {

using Eigen::Vector3f;

// Points in world axes, relative to the position of A.
struct FloatCore {
  FewOf<Vector3f, kMostLanePoints> points;
  float radius = 0;
  Vector3f middle = Vector3f::Zero();
  bool has_space = true;  // for all points; and there are no rules
};

inline FloatCore float_core(const SphereShape<float>& sphere, const Quaternion<float>&,
                            const Vector3f& offset) {
  return {{offset}, sphere.radius, offset};
}

inline FloatCore float_core(const CapsuleShape<float>& capsule, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = rotation_of(q);
  const Vector3f a = rotate(turn, capsule.a) + offset, b = rotate(turn, capsule.b) + offset;
  return {{a, b}, capsule.radius, (a + b) * 0.5f};
}

inline FloatCore float_core_of_box(const Vector3f& lower, const Vector3f& upper,
                                   const Rotation<float>& turn, const Vector3f& offset) {
  FloatCore core;
  for (size_t i = 0; i < 8; ++i) {
    const Vector3f corner((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                          (i & 4 ? upper : lower).z());
    core.points.push_back(rotate(turn, corner) + offset);
  }
  core.middle = rotate(turn, Vector3f((lower + upper) * 0.5f)) + offset;
  return core;
}

inline FloatCore float_core(const AabbShape<float>& box, const Quaternion<float>&,
                            const Vector3f& offset) {
  const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  return float_core_of_box(box.lower, box.upper, unturned, offset);
}

inline FloatCore float_core(const BoxShape<float>& box, const Quaternion<float>& q,
                            const Vector3f& offset) {
  return float_core_of_box(-box.half, box.half, rotation_of(q), offset);
}

inline FloatCore float_core(const TriangleShape<float>& triangle, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = rotation_of(q);
  FloatCore core;
  for (const Vector3f& corner : triangle.corners) {
    core.points.push_back(rotate(turn, corner) + offset);
  }
  core.middle = core.points[0];
  core.has_space = !triangle.is_special();
  return core;
}

// Turns and scales: by a power of two, so that it does not matter which factor it goes with.
inline Rotation<float> placing_turn(const HullShape<float>& hull, const Quaternion<float>& q) {
  Rotation<float> turn = rotation_of(q);
  for (Vector3f* column : {&turn.x, &turn.y, &turn.z}) *column *= static_cast<float>(hull.scale);
  return turn;
}

inline FloatCore float_core(const HullShape<float>& hull, const Quaternion<float>& q,
                            const Vector3f& offset) {
  const Rotation<float> turn = placing_turn(hull, q);
  const auto placed = [&](const std::array<float, 4>& p) -> Vector3f {
    return rotate(turn, Vector3f(p[0], p[1], p[2])) + offset;
  };
  const size_t count = hull.geometry->points().size();
  FloatCore core;
  core.has_space = count <= kMostLanePoints;
  for (size_t i = 0; core.has_space && i < count; ++i) {
    core.points.push_back(placed(hull.geometry->records()[i]));
  }
  core.middle = placed(hull.geometry->records()[count]);
  return core;
}

inline Vector3f furthest_point(const FloatCore& core, const Vector3f& way) {
  Vector3f best = core.points[0];
  float most = dot(way, best);
  for (size_t i = 1; i < core.points.size(); ++i) {
    const float height = dot(way, core.points[i]);
    if (!(height > most)) continue;
    most = height;
    best = core.points[i];
  }
  return best;
}

// Along a way: how high the furthest point is, and how many are as high as `height` up to a slack.
struct FacingCount {
  float most = -kLargest;
  size_t count = 0;
};

inline FacingCount count_facing(const FloatCore& core, const Vector3f& way, float height) {
  const float limit = height - kFacingSlack;
  FacingCount facing;
  for (const Vector3f& p : core.points) {
    const float h = dot(way, p);
    facing.most = max(facing.most, h);
    facing.count += h >= limit;
  }
  return facing;
}

// A corner of B - A, and the point of A that it belongs to.
struct Corner {
  Vector3f point, on_a;
};

inline Corner difference_corner(const FloatCore& a, const FloatCore& b, const Vector3f& way) {
  const Vector3f on_a = furthest_point(a, way);
  return {furthest_point(b, -way) - on_a, on_a};
}

// Up to three corners, in any of the places.
struct Simplex {
  std::array<Corner, 3> corner;
  std::array<bool, 3> is_used{};
};

// Whether zero is inside of four corners: if its coordinates in them have one sign.
struct ZeroInside {
  bool is_inside;
  bool is_sure;  // and deep enough to be sure

  // `of`: of zero with all corners but the first, the second, the third; `volume`: of the sides
  // from the last one.
  ZeroInside(const std::array<float, 3>& of, float volume, const std::array<Vector3f, 4>& corner) {
    const float of_last = -(volume + ((of[0] + of[1]) + of[2]));
    const float least = min(min(of[0], of[1]), min(of[2], of_last));
    const float most = max(max(of[0], of[1]), max(of[2], of_last));
    const float depth = max(least, -most);
    const auto squared = [&](size_t i) { return dot(corner[i], corner[i]); };
    const float size = max(max(squared(0), squared(1)), max(squared(2), squared(3)));
    is_inside = depth > 0;
    is_sure = is_inside && depth > size * kSureVolume;
  }
};

// Of a simplex and one more corner: the point nearest to zero, if the new corner is among those
// that span it, and which others do.
class NearestOfCorners {
 public:
  NearestOfCorners(const Simplex& simplex, const Vector3f& last)
      : last_(last), point(last), squared(dot(last, last)) {
    const auto& used = simplex.is_used;
    std::array<Side, 3> side;
    for (size_t i = 0; i < 3; ++i) side[i] = side_to(simplex.corner[i].point, used[i]);
    const Triangle pq = triangle_of(side[0], side[1]), pr = triangle_of(side[0], side[2]),
                   qr = triangle_of(side[1], side[2]);
    try_sides(side, {pq.is_towards_second || pr.is_towards_second,
                     pq.is_towards_first || qr.is_towards_second,
                     pr.is_towards_first || qr.is_towards_first});
    try_triangle(pq, 0, 1);
    try_triangle(pr, 0, 2);
    try_triangle(qr, 1, 2);
    if (used[0] && used[1] && used[2]) {
      const auto& corner = simplex.corner;
      const ZeroInside zero({qr.height, -pr.height, pq.height}, dot(pq.normal, side[2].way),
                            {corner[0].point, corner[1].point, corner[2].point, last});
      is_around = zero.is_inside;
      is_sure_around = zero.is_sure;
    }
  }

 private:
  // From the last corner to another.
  struct Side {
    Vector3f way;
    float along;  // how far zero is along it, times its length
    float squared;
    bool is_used;
  };

  // Of the last corner and two others.
  struct Triangle {
    Vector3f normal;
    float height;  // of the last corner, from zero
    float squared_normal;
    bool is_towards_first, is_towards_second;  // zero is on that corner's side of the other's side
    bool is_over;                              // zero is over the triangle, or below it
  };

  Vector3f last_;

 public:
  Vector3f point;
  float squared;
  std::array<bool, 3> is_kept{};
  bool is_around = false;       // zero lies inside of all four
  bool is_sure_around = false;  // and deep enough to be sure

 private:
  Side side_to(const Vector3f& corner, bool is_used) const {
    const Vector3f way = corner - last_;
    return {way, -dot(last_, way), dot(way, way), is_used};
  }

  // By Lagrange's identity: no more products than dot products of the sides.
  Triangle triangle_of(const Side& p, const Side& q) const {
    if (!p.is_used || !q.is_used) return {};
    const float pq = dot(p.way, q.way);
    const float of_p = q.squared * p.along - q.along * pq;
    const float of_q = p.squared * q.along - p.along * pq;
    Triangle t;
    t.normal = cross<float>(p.way, q.way);
    t.height = dot(t.normal, last_);
    t.squared_normal = dot(t.normal, t.normal);
    t.is_towards_first = of_p > 0;
    t.is_towards_second = of_q > 0;
    t.is_over = t.is_towards_first && t.is_towards_second && t.squared_normal > of_p + of_q;
    return t;
  }

  // `is_left_out`: zero is nearer to triangles at the side.
  void try_sides(const std::array<Side, 3>& sides, const std::array<bool, 3>& is_left_out) {
    for (size_t i = 0; i < 3; ++i) {
      const Side& s = sides[i];
      if (!s.is_used || is_left_out[i] || !(s.along > 0 && s.along < s.squared)) continue;
      keep(last_ + s.way * (s.along / s.squared), i);
      return;
    }
  }

  void keep(const Vector3f& p, size_t other) {
    const float square = dot(p, p);
    if (!(square < squared)) return;
    squared = square;
    point = p;
    is_kept[other] = true;
  }

  void try_triangle(const Triangle& t, size_t one, size_t other) {
    if (!t.is_over) return;
    const float share = t.height / t.squared_normal, square = share * t.height;
    if (!(square < squared)) return;
    squared = square;
    point = t.normal * share;
    for (size_t i = 0; i < 3; ++i) is_kept[i] = i == one || i == other;
  }
};

struct Gjk {
  Vector3f way;  // from A to B
  float squared;
  Simplex ends;            // the corners that span it
  bool is_around = false;  // zero is surely inside of B - A
  bool has_ended = false;
};

inline Gjk run_gjk(const FloatCore& a, const FloatCore& b) {
  const Corner first = difference_corner(a, b, b.middle - a.middle);
  Gjk gjk{first.point, dot(first.point, first.point), {{first, first, first}, {true}}};
  for (size_t round = 0; round < kMostLaneRounds; ++round) {
    if (!(gjk.squared > kNearCores * kNearCores)) return gjk;
    const Corner next = difference_corner(a, b, gjk.way);
    const float gap = dot(gjk.way, next.point);
    const bool is_shortest = gjk.squared - gap <= gjk.squared * kLeastProgress;
    const NearestOfCorners nearest(gjk.ends, next.point);
    gjk.is_around = nearest.is_sure_around;
    if (nearest.is_around) return gjk;
    gjk.has_ended = is_shortest || !(nearest.squared < gjk.squared);
    if (gjk.has_ended) return gjk;
    gjk.way = nearest.point;
    gjk.squared = nearest.squared;
    gjk.ends.is_used = nearest.is_kept;
    size_t place = 0;
    while (gjk.ends.is_used[place]) ++place;
    gjk.ends.corner[place] = next;
    gjk.ends.is_used[place] = true;
  }
  return gjk;
}

// Where the cores are nearest to each other.
struct NearestCores {
  float distance;
  Vector3f normal;  // unit, from A to B
  Vector3f on_a;
  bool is_sure;
};

// One to three corners, and the way to their difference.
class SpannedWay {
 public:
  explicit SpannedWay(const FewOf<Corner, 3>& ends) : p_(ends[0]) {
    Vector3f way = p_.point;
    on_a_ = p_.on_a;
    if (ends.size() == 2) {  // across the side between them
      const Corner& q = ends[1];
      const Vector3f u = q.point - p_.point;
      const float uu = dot(u, u), along = -dot(p_.point, u) / uu;
      const Vector3f on_side = p_.point + u * along;
      way = on_side - u * (dot(on_side, u) / uu);
      on_a_ = p_.on_a + (q.on_a - p_.on_a) * along;
      ends_inside_ = along > 0 && along < 1;
    }
    if (ends.size() == 3) {  // across their plane
      const Corner &q = ends[1], &r = ends[2];
      const Vector3f u = q.point - p_.point, v = r.point - p_.point, n = cross(u, v);
      const float nn = dot(n, n);
      way = n * (dot(n, p_.point) / nn);
      const Vector3f along_plane = way - p_.point;
      const float of_q = dot(n, cross(along_plane, v)) / nn;
      const float of_r = dot(n, cross(u, along_plane)) / nn;
      on_a_ = (p_.on_a + (q.on_a - p_.on_a) * of_q) + (r.on_a - p_.on_a) * of_r;
      is_wide_ = nn > kSmallCrossing * (dot(u, u) * dot(v, v));
      ends_inside_ = min(of_q, of_r) > 0 && of_q + of_r < 1;
    }
    distance_ = std::sqrt(dot(way, way));
    normal_ = way * (1 / distance_);
    // Rounding tilts the plane of a needle: its corners are not equally far then.
    const auto is_level = [&](const Corner& corner) {
      return std::fabs(dot(normal_, corner.point - p_.point)) <= kSameGapInFloat;
    };
    is_tilted_ = ends.size() == 3 && !(is_level(ends[1]) && is_level(ends[2]));
  }

  float distance() const { return distance_; }
  const Vector3f& normal() const { return normal_; }  // unit, from A to B
  bool ends_inside() const { return ends_inside_; }   // of the span of the corners
  // Of a corner's points, along the normal of either.
  float height_of_a() const { return dot(normal_, p_.on_a); }
  float height_of_b() const { return -dot(normal_, on_b()); }

  // Where the cores are nearest to each other, if they are nowhere nearer; of_a along the normal,
  // of_b against it.
  NearestCores confirmed_by(const FacingCount& of_a, const FacingCount& of_b) const {
    const float gap = -(of_a.most + of_b.most);
    const bool is_shortest = std::fabs(distance_ - gap) <= kSameGapInFloat;
    // One point faces the other core, or two edges cross: there is no other place to meet.
    const bool crosses = is_wide_ && of_a.count <= 2 && of_b.count <= 2;
    const bool is_unique = of_a.count <= 1 || of_b.count <= 1 || crosses;
    Vector3f on_a = on_a_;
    if (of_a.count <= 1) on_a = p_.on_a;
    if (of_b.count <= 1) on_a = on_b() - normal_ * distance_;
    const bool is_sure = distance_ > kNearCores && is_shortest && is_unique && !is_tilted_;
    return {distance_, normal_, on_a, is_sure};
  }

 private:
  Vector3f on_b() const { return p_.point + p_.on_a; }

  Corner p_;
  Vector3f on_a_, normal_;
  float distance_;
  bool is_wide_ = false, is_tilted_ = false, ends_inside_ = true;
};

inline NearestCores nearest_cores(const FloatCore& a, const FloatCore& b, const Gjk& gjk) {
  FewOf<Corner, 3> ends;
  for (size_t i = 0; i < 3; ++i) {
    if (gjk.ends.is_used[i]) ends.push_back(gjk.ends.corner[i]);
  }
  const SpannedWay way(ends);
  return way.confirmed_by(count_facing(a, way.normal(), way.height_of_a()),
                          count_facing(b, -way.normal(), way.height_of_b()));
}

inline Separation separation_of(const NearestCores& nearest, float radius_a, float radius_b,
                                const Vector3f& d) {
  Separation result = not_in_float<float>();
  result.separation = nearest.distance - (radius_a + radius_b);
  result.is_unsure = !(nearest.is_sure && std::fabs(result.separation) > kSureGap);
  result.normal = nearest.normal;
  result.arm_a = nearest.on_a + nearest.normal * radius_a;
  result.arm_b = (result.arm_a + nearest.normal * result.separation) - d;
  return result;
}

// Scales at which float32 may decide. `up`: metres a unit.
inline bool is_usual_scale(double up) { return up >= 1 / kGreatestScale && up <= kGreatestScale; }

struct FloatTest {
  Separation separation;
  bool is_deep = false;  // surely: the cores themselves overlap
};

// `up`: metres a unit.
inline FloatTest nearest_separation(const FloatCore& a, const FloatCore& b, const Vector3f& d,
                                    float up) {
  FloatTest test{not_in_float<float>()};
  if (!a.has_space || !b.has_space || !is_usual_scale(up)) return test;
  const Gjk gjk = run_gjk(a, b);
  test.is_deep = gjk.is_around;
  NearestCores nearest = nearest_cores(a, b, gjk);
  nearest.is_sure = nearest.is_sure && gjk.has_ended;
  test.separation = separation_of(nearest, a.radius, b.radius, d);
  return test;
}

}  // namespace carom::reference
