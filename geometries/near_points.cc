// Projects points on the normals of as many triangles as there are lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometries/near_points.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <cmath>

#include "base/tolerances.h"
#include "geometries/near_points.h"
#include "simd/compress-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A body meets some six triangles, so that wider vectors would be half empty.
using FewTag = hn::CappedTag<float, NearPoints::kRoom>;
using Few = hn::Vec<FewTag>;
using Few3 = Lanes3<Few>;
inline constexpr size_t kFewLanes = hn::MaxLanes(FewTag());

// A normal whose square is less may have lost digits. Triangles that reach further than the second,
// in units, might have one whose square overflows.
constexpr float kLeastNormal = 0x1p-100f;
constexpr float kFurthestCorner = 0x1p16f;

// Squared sine between a unit normal and a side, from which on rounding leaves the way across both
// perpendicular to the normal.
constexpr float kLeastSine = 0x1p-6f;

// Directions between the normals of a triangle and of a side: 22.5, 45 and 67.5 degrees.
constexpr size_t kTilts = 3;
constexpr float kTangent[kTilts] = {0.41421356f, 1, 2.4142136f};
constexpr float kCosine[kTilts] = {0.92387953f, 0.70710678f, 0.38268343f};

HWY_INLINE Few splat_few(float value) { return hn::Set(FewTag(), value); }

HWY_INLINE Few greatest_coordinate(const Few3& v) {
  return max(max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

// Corners relative to the middle of the points, in units.
HWY_INLINE void load_corners_of_few(const TriangleArrays& mesh, const SeenPoints& points,
                                    const uint32_t* triangles, Few3* corners) {
  const FewTag tag;
  HWY_ALIGN float column[9][kFewLanes];
  for (size_t i = 0; i < kFewLanes; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const float* const v = mesh.vertices + size_t{3} * mesh.triangles[triangles[i]][k];
      for (size_t axis = 0; axis < 3; ++axis) column[3 * k + axis][i] = v[axis];
    }
  }
  const Few3 middle = {splat_few(points.middle[0]), splat_few(points.middle[1]),
                       splat_few(points.middle[2])};
  const Few down = splat_few(static_cast<float>(points.down));
  for (size_t k = 0; k < 3; ++k) {
    const Few3 v = {hn::Load(tag, column[3 * k]), hn::Load(tag, column[3 * k + 1]),
                    hn::Load(tag, column[3 * k + 2])};
    corners[k] = (v - middle) * down;
  }
}

HWY_INLINE Few greatest_height(const Few3& way, const Few3* corners) {
  return max(max(dot(way, corners[0]), dot(way, corners[1])), dot(way, corners[2]));
}

HWY_INLINE Few3 point_of_few(const SeenPoints& points, size_t i) {
  return {splat_few(points.column[0][i]), splat_few(points.column[1][i]),
          splat_few(points.column[2][i])};
}

// The greatest gap along the normal of a side, in the plane of the triangle, and along directions
// between it and the triangle's unit normal, which has these heights of the points and the
// triangle.
HWY_INLINE Few gap_beside(const SeenPoints& points, const Few3& side, const Few3& normal,
                          const Few* heights, Few own_height, const Few3* corners) {
  // The normal of a sliver may be far from perpendicular to the side. Near the side it gives no
  // direction.
  const Few3 beside = cross(side, normal);
  const Few squared = dot(beside, beside);
  const Few3 way = beside * hn::Div(splat_few(1), hn::Sqrt(squared));
  Few low = splat_few(HUGE_VALF), tilted[kTilts];
  for (Few& each : tilted) each = low;
  for (size_t i = 0; i < points.count; ++i) {
    const Few beyond = dot(way, point_of_few(points, i));
    low = min(low, beyond);
    for (size_t k = 0; k < kTilts; ++k) {
      tilted[k] = min(tilted[k], hn::Add(heights[i], hn::Mul(splat_few(kTangent[k]), beyond)));
    }
  }
  const Few own = greatest_height(way, corners);
  Few gap = hn::Sub(low, own);
  for (size_t k = 0; k < kTilts; ++k) {
    const Few own_tilted = hn::Add(own_height, hn::Mul(splat_few(kTangent[k]), own));
    gap = max(gap, hn::Mul(hn::Sub(tilted[k], own_tilted), splat_few(kCosine[k])));
  }
  const Few least = max(splat_few(kLeastNormal), hn::Mul(splat_few(kLeastSine), dot(side, side)));
  return hn::IfThenElse(hn::Ge(squared, least), gap, splat_few(-HUGE_VALF));
}

// A lower bound of the gap of each triangle.
HWY_INLINE Few least_gaps(const TriangleArrays& mesh, const SeenPoints& points,
                          const uint32_t* triangles) {
  Few3 corners[3];
  load_corners_of_few(mesh, points, triangles, corners);
  const Few3 sides[3] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  Few3 normal = cross(sides[0], sides[1]);
  const Few squared = dot(normal, normal);
  const Few length = hn::Sqrt(squared);
  // Towards the middle of the points. The sides then turn the other way.
  const auto is_behind = hn::Gt(dot(normal, corners[0]), splat_few(0));
  const Few sign = hn::IfThenElse(is_behind, splat_few(-1), splat_few(1));
  normal = normal * hn::Div(sign, length);

  Few heights[SeenPoints::kMost];
  Few low = splat_few(HUGE_VALF);
  for (size_t i = 0; i < points.count; ++i) {
    heights[i] = dot(normal, point_of_few(points, i));
    low = min(low, heights[i]);
  }
  const Few own = greatest_height(normal, corners);
  Few gap = hn::Sub(low, own);
  for (const Few3& side : sides) {
    gap = max(gap, gap_beside(points, side * sign, normal, heights, own, corners));
  }

  const Few reach = max(max(greatest_coordinate(corners[0]), greatest_coordinate(corners[1])),
                        greatest_coordinate(corners[2]));
  const Few slack = hn::Mul(splat_few(kPlaneSlack), hn::Add(reach, splat_few(points.size)));
  const auto is_known =
      hn::And(hn::Ge(squared, splat_few(kLeastNormal)), hn::Le(reach, splat_few(kFurthestCorner)));
  return hn::IfThenElse(is_known, hn::Sub(gap, slack), splat_few(-HUGE_VALF));
}

// Those of a large mesh lie anywhere: a third of the time was waiting for them. A small one stays
// in the cache.
HWY_INLINE void fetch_corners(const TriangleArrays& mesh, std::span<const uint32_t> triangles) {
  constexpr size_t kFewTriangles = size_t{1} << 15;
  if (mesh.count <= kFewTriangles) return;
  for (const uint32_t triangle : triangles) __builtin_prefetch(&mesh.triangles[triangle]);
  for (const uint32_t triangle : triangles) {
    for (const uint32_t corner : mesh.triangles[triangle]) {
      __builtin_prefetch(mesh.vertices + size_t{3} * corner);
    }
  }
}

void keep_near_points(const TriangleArrays& mesh, const SeenPoints& points, float most,
                      std::span<const uint32_t> triangles, NearPoints& near) {
  const FewTag tag;
  const hn::RebindToUnsigned<FewTag> number_tag;
  size_t count = 0;
  fetch_corners(mesh, triangles);
  for (size_t first = 0; first < triangles.size(); first += kFewLanes) {
    const size_t some = std::min(triangles.size() - first, kFewLanes);
    HWY_ALIGN uint32_t numbers[kFewLanes];
    for (size_t i = 0; i < kFewLanes; ++i) numbers[i] = triangles[first + std::min(i, some - 1)];
    const Few gap = least_gaps(mesh, points, numbers);
    const auto kept =
        hn::RebindMask(number_tag, hn::And(hn::Le(gap, splat_few(most)), hn::FirstN(tag, some)));
    compress_store(number_tag, hn::BitCast(number_tag, gap), kept,
                   reinterpret_cast<uint32_t*>(near.gap.data() + count));
    count += compress_store(number_tag, hn::Load(number_tag, numbers), kept,
                            near.triangle.data() + count);
  }
  near.count = count;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(keep_near_points);

namespace {

// The triangles of a surface whose corners lie nowhere, for as long as they are looked at.
struct WrittenTriangles {
  std::array<float, 9 * BoxTree::kMostAtOnce + 1> vertices;
  std::array<uint32_t, BoxTree::kMostAtOnce> numbers;

  template <class Geometry>
  WrittenTriangles(const Geometry& surface, std::span<const uint32_t> triangles) {
    float* next = vertices.data();
    for (uint32_t i = 0; i < triangles.size(); ++i) {
      for (const Eigen::Vector3f& corner : corners_of(surface, triangles[i])) {
        for (int axis = 0; axis < 3; ++axis) *next++ = corner[axis];
      }
      numbers[i] = i;
    }
    *next = 0;
  }

  // Triangle i has the corners 3 i and the two that follow.
  static constexpr auto kCorners = [] {
    std::array<std::array<uint32_t, 3>, BoxTree::kMostAtOnce> corners{};
    for (uint32_t i = 0; i < corners.size(); ++i) corners[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    return corners;
  }();
};

}  // namespace

void keep_near_points(const TriangleArrays& mesh, const SeenPoints& points, float most,
                      std::span<const uint32_t> triangles, NearPoints& near) {
  CAROM_DISPATCH(keep_near_points)(mesh, points, most, triangles, near);
}

void keep_near_points(const Surface& surface, const SeenPoints& points, float most,
                      std::span<const uint32_t> triangles, NearPoints& near) {
  if (const MeshGeometry* mesh = surface.plain_mesh()) {
    return keep_near_points(arrays_of(*mesh), points, most, triangles, near);
  }
  const auto written =
      surface.visit([&](const auto& geometry) { return WrittenTriangles(geometry, triangles); });
  const TriangleArrays arrays = {written.vertices.data(), WrittenTriangles::kCorners.data(),
                                 triangles.size()};
  keep_near_points(arrays, points, most, std::span(written.numbers).first(triangles.size()), near);
  for (size_t i = 0; i < near.count; ++i) near.triangle[i] = triangles[near.triangle[i]];
}

}  // namespace carom
#endif  // HWY_ONCE
