// What a program and the library must agree on: how the types of the public interface lie in
// memory.
#pragma once

#include <carom/carom.h>
#include <carom/hulls/build_hull.h>
#include <carom/hulls/simplify_hull.h>
#include <carom/reference/reference.h>

#include <cstddef>
#include <type_traits>

namespace carom::abi {

// No type needs more than its numbers and pointers do. So Eigen and the compiler find no vector of
// 16, 32 or 64 bytes in it that they could align differently under other flags.
template <class... T>
inline constexpr bool kNaturallyAligned = ((alignof(T) <= alignof(double)) && ...);

static_assert(kNaturallyAligned<Orientation, Eigen::Vector3f, Eigen::Vector3d>);
static_assert(kNaturallyAligned<Sphere, Aabb, Capsule, Box, Triangle, Halfspace, Dop, Hull, Mesh,
                                Compound, Shape>);
static_assert(kNaturallyAligned<HullGeometry, HullGeometry::Face, MeshRules, MeshGeometry,
                                CompoundChild, CompoundGeometry>);
static_assert(kNaturallyAligned<BodyId, Pose, BodyDesc, Sweep, SweepView, PositionView, AabbColumns,
                                OrientationView, ShapeRows, Collidables, BoundsView>);
static_assert(kNaturallyAligned<BoundsColumns, DopRecords, PairFilter, PairSearch, PairFinder,
                                ResultColumns, ImpactColumns, Accuracy>);
static_assert(kNaturallyAligned<Pair, Contact, ManifoldPoints, Event, Impact, CastHit, OverlapHit,
                                NearestHit, PointHit, Rays>);
static_assert(
    kNaturallyAligned<CollideOptions, CastOptions, QueryOptions, QueryFilter, ImpactOptions,
                      RegionLimits, ContactRegions, PointNames, ContactIdentity>);
static_assert(kNaturallyAligned<BuiltHull, SimplifyOptions, SimplifiedHull>);
static_assert(kNaturallyAligned<WorldSettings, BodyArrays, BoxArrays, ShapeRowArrays, WorldMemory,
                                StepReport, World, ThreadArena, Error, Result<void>>);
static_assert(kNaturallyAligned<reference::Box, reference::PairResult, reference::Impact,
                                reference::Body, reference::Frame, reference::Ahead>);

// The vectors are their numbers alone, and so are the structs of them.
static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Vector3d) == 24);
static_assert(sizeof(Orientation) == 16 && sizeof(Pose) == 40);
static_assert(offsetof(Pose, position) == 0 && offsetof(Pose, orientation) == 24);
static_assert(sizeof(Sphere) == 4 && sizeof(Aabb) == 24 && sizeof(Capsule) == 28);
static_assert(sizeof(Box) == 16 && sizeof(Triangle) == 44 && sizeof(Halfspace) == 16);
static_assert(sizeof(Dop) == 112 + 2 * sizeof(void*) && sizeof(Sweep) == 24);
static_assert(offsetof(Capsule, b) == 12 && offsetof(Capsule, radius) == 24);
static_assert(offsetof(Triangle, thickness) == 36 && offsetof(Halfspace, offset) == 12);
static_assert(offsetof(Dop, lower) == 4 && offsetof(Dop, upper) == 4 + 4 * kMostSlabs);
static_assert(offsetof(Dop, geometry) == 112);
static_assert(sizeof(BodyId) == 8 && sizeof(Pair) == 8);
static_assert(offsetof(Contact, normal) == 16 && offsetof(Contact, arm_b) == 48);
static_assert(sizeof(ManifoldPoints) == 64 && sizeof(PointNames) == 32);
static_assert(offsetof(ManifoldPoints, separation) == 48);
static_assert(offsetof(CompoundChild, position) == sizeof(Shape));
static_assert(offsetof(CompoundChild, orientation) == sizeof(Shape) + 12);
static_assert(offsetof(BodyDesc, position) == sizeof(Shape));
static_assert(offsetof(BodyDesc, orientation) == sizeof(Shape) + 24);

}  // namespace carom::abi
