// Every tolerance of a decision, with its reason. All are relative, or in scaled units (see Units
// in narrowphase/batch/kernel_policy.h). Bounds on rounding errors stand beside the arithmetic that
// rounds.
#pragma once

#include <cstddef>

namespace carom {

// A separation below this share of the pair's size is computed again in double precision: float32
// rounding is at most 5 units of 2^-24 there, a third of this.
inline constexpr float kNearTouch = 0x1p-20f;

// The same for turned shapes, in scaled units (coordinates up to two): rotations and the products
// that follow round to at most 30 units of 2^-24, a quarter of this.
inline constexpr float kNearTouchScaled = 0x1p-17f;

// Double precision proves the sign of a squared distance less the square of a reach where it is
// more than this share of both: the first has five roundings of 2^-53, the second three.
inline constexpr double kSureOfSquares = 0x1p-48;

// A gap of two boxes along the cross product of edges, times the length of that product, says
// nothing below this: products in it may have vanished. Edges so nearly parallel leave the decision
// to the faces.
inline constexpr float kLeastEdgeGap = 0x1p-100f;

// A remembered direction decides a pair only if it separates the shapes by more than this, in
// scaled units. Every test then finds them separate: its best axis shows a good part of that gap,
// which is eight times the error of a test.
inline constexpr float kClearlyApart = 0x1p-14f;

// Points nearer to each other than this, in scaled units, count as one: the square of their
// distance would soon underflow in float32.
inline constexpr float kCoincident = 0x1p-50f;

// Distance of a point from the inside of a segment, in scaled units, below which the vector to the
// nearest point has no reliable direction: the component along the segment that rounding leaves is
// no longer small beside the component across.
template <class Real>
inline constexpr Real kNearSegment = Real(0x1p-16);
template <>
inline constexpr double kNearSegment<double> = 0x1p-44;

// A quaternion whose squared norm lies between these is used as it is; any other is first scaled by
// a power of two.
inline constexpr float kLeastSquaredNorm = 0x1p-60f;
inline constexpr float kGreatestSquaredNorm = 0x1p60f;

// --- Cores (segments, triangles): when they count as parallel, flat or touching; in scaled units
// or relative, by the precision of the test ---

template <class Real>
struct CoreTolerance;

template <>
struct CoreTolerance<float> {
  // sin^2 of the angle between two edges below which their cross product has lost half of its
  // digits.
  static constexpr float kParallel = 0x1p-24f;
  // sin^2 below which the cross product says nothing at all, even after it was made perpendicular
  // to one of the two edges.
  static constexpr float kSameDirection = 0x1p-40f;
  // A triangle counts as its longest edge if (height / longest edge)^2 is below this: the height is
  // then below four roundings.
  static constexpr float kFlat = 0x1p-44f;
  // A cross product whose square is below this is about to underflow; features so small count as
  // degenerate.
  static constexpr float kVanishing = 0x1p-100f;
  // How much less than the distance the gap along the normal may be; beyond that the normal is
  // tilted. Several times what rounding takes from a good normal, and below the accuracy that is
  // asked for, which is 5e-6.
  static constexpr float kTilt = 0x1p-18f;
  // Edges nearer than this may already have passed each other: rounding hides it.
  static constexpr float kNearEdges = 0x1p-10f;
  // Squared distances within this factor of each other count as equal.
  static constexpr float kTie = 1 + 0x1p-21f;
  // Cores that overlap by less than this may only touch: the overlap may be rounding.
  static constexpr float kShallow = 0x1p-20f;
};

template <>
struct CoreTolerance<double> {
  static constexpr double kParallel = 0x1p-50;
  static constexpr double kSameDirection = 0x1p-96;
  static constexpr double kFlat = 0x1p-96;
  static constexpr double kVanishing = 0x1p-800;
  static constexpr double kTilt = 0x1p-44;
  static constexpr double kNearEdges = 0x1p-40;
  static constexpr double kTie = 1 + 0x1p-50;
  static constexpr double kShallow = 0x1p-46;
};

// --- Boxes against segments and triangles, in scaled units ---

// sin^2 of the angle between two edges below which their cross product is no candidate axis: the
// axis of a face differs from it by no more than rounding.
inline constexpr float kParallelSquared = 0x1p-48f;

// The separating axis is the normal if axis * gap equals the vector between the nearest points up
// to this: rounding of coordinates below two is a quarter of it.
inline constexpr float kSameWay = 0x1p-21f;

// Otherwise the direction between the nearest points is the normal if the gap along it is less than
// their distance by no more than this: a fifth of the error that the normal may have.
inline constexpr float kCertain = 0x1p-19f;

// The same in double precision.
inline constexpr double kSameWayDouble = 0x1p-40;
inline constexpr double kCertainDouble = 0x1p-30;

// --- Boxes against boxes, in scaled units ---

// Two edges whose cross product has a squared length below this are parallel to rounding: the axes
// of the faces replace it.
template <class Real>
inline constexpr Real kLeastCross = Real(0x1p-46);
template <>
inline constexpr double kLeastCross<double> = 0x1p-100;

// An axis whose cosine with the normal is at most this is perpendicular to it, to rounding: the
// feature that faces the other box extends along that axis.
template <class Real>
inline constexpr Real kAcross = Real(0x1p-19);
template <>
inline constexpr double kAcross<double> = 0x1p-26;

// Squared distance across the normal between the two contact points beyond which they do not face
// each other.
inline constexpr float kOffAxisSquared = 0x1p-36f;

// --- Half-spaces, in scaled units ---

// A face, an edge or a capsule lies flat if the heights of its ends differ by less than this share
// of the shape's size: rotations round to at most 8 units of 2^-24. The contact point is then its
// middle, which stays put from frame to frame.
inline constexpr float kLyingFlat = 0x1p-21f;

// A row is unsure if the numbers that place the plane are this many times greater than the shape
// and its distance: their rounding in float32 (at most 6 units of 2^-24 in tests) then exceeds 2e-6
// of the shape. This concerns bodies far from the position of a turned half-space, and half-spaces
// with a great offset.
inline constexpr float kFarPlane = 5.0f;

// --- Polytopes in double precision, in scaled units (coordinates up to two, so that rounding is
// 2^-52 an operation) ---

// A point within this distance of a plane lies in it: some thousand roundings.
inline constexpr double kInPlane = 0x1p-40;

// Cores nearer than this touch: the vector from one to the other has no direction.
inline constexpr double kTouchingCores = 0x1p-40;

// Gaps that differ by no more than this are equal. The search then keeps the direction that it
// tried first, which is the simplest.
inline constexpr double kTieOfGaps = 0x1p-48;

// A gap is the distance if it is less than the length of the nearest vector by no more than this.
inline constexpr double kSameDistance = 0x1p-34;

// Points whose squared distance is at most this are one.
inline constexpr double kTouchingSquared = 0x1p-80;

// The direction of the nearest vector may be off by kWayTilt, plus kWayRounding (of its ends) over
// its length.
inline constexpr double kWayTilt = 0x1p-20;
inline constexpr double kWayRounding = 0x1p-50;

// Edges whose squared sine is at most this are parallel: the normals of their faces replace their
// cross product.
inline constexpr double kParallelEdges = 0x1p-50;

// A cross product of at most this share of the product of its two sides may be rounding: the
// triangle has no area.
inline constexpr double kWithoutArea = 0x1p-48;

// --- Cores (GJK, and the polytope of the penetration search), in scaled units ---

// Cores nearer than this may as well touch: the direction of the nearest vector is off by up to
// 2^-52 over its length, and the nearest face of the Minkowski difference gives a better normal.
inline constexpr double kTouchingWay = 0x1p-24;

// If the cores are further apart than this, the nearest vector is exact enough to say which corners
// it ends at.
inline constexpr double kFarFromTouching = 0x1p-6;

// The contact location needs two points that face each other up to kFacing. The search for them
// also takes points that lie less far along the normal than the support point, by a slack that
// grows up to kMostSlack.
inline constexpr double kFacing = 0x1p-26;
inline constexpr double kMostSlack = 0x1p-16;

// The length of GJK's nearest vector is the distance if the gap along the vector is less by no more
// than this: more than rounding leaves where GJK has ended at the right corners.
inline constexpr double kSameGap = 0x1p-40;

// A penetration depth is the shortest if it exceeds the lower bound by no more than this.
inline constexpr double kSameWayOut = 0x1p-42;

// The same of round cores, whose surface no number of faces reaches. GJK ends where the gap is less
// than the distance by no more than kSameRoundGap of the cores' size; what it found is the distance
// if the gap is less by no more than kSameRoundWay of it, and rounding has not turned it: if it is
// above kTouchingRound. A depth may exceed its lower bound by kSameRoundWayOut, and its witness
// points may miss each other by kRoundAside.
inline constexpr double kSameRoundGap = 0x1p-40;
inline constexpr double kSameRoundWay = 0x1p-20;
inline constexpr double kTouchingRound = 0x1p-34;
inline constexpr double kSameRoundWayOut = 0x1p-28;
inline constexpr double kRoundAside = 0x1p-19;

// A point of a Minkowski difference that is no further than this from a plane, line or point lies
// in it.
inline constexpr double kFlatDifference = 0x1p-36;

// A point sees a face if it is further than this in front of it: some dozen roundings.
inline constexpr double kInFace = 0x1p-47;

// A gap or depth above this exceeds all rounding: the decision is proven. That holds for cores, and
// for spheres, half-spaces and pairs of boxes in lanes of doubles (30 units of 2^-53).
inline constexpr double kProvenGap = 0x1p-36;

// Rounding of a volume of three differences of points, each below 2^5, stays below this.
inline constexpr double kProvenVolume = 0x1p-34;

// The square of a unit vector of doubles is no further than this from one.
inline constexpr double kUnitSquare = 0x1p-40;

// --- Cores in float32, in scaled units: what GJK in lanes may decide. Coordinates of a difference
// reach nine; rotated points and their products round to 30 units of 2^-24 ---

// Cores whose gap or depth exceeds this are surely separate, or surely overlap: four times that
// rounding.
inline constexpr float kSureGap = 0x1p-16f;

// Zero is surely inside a tetrahedron, deeper than kSureGap, if the volumes that it spans with the
// corners all exceed this share of the squared distance of the furthest corner.
inline constexpr float kSureVolume = 0x1p-14f;

// GJK's vector is the shortest if the gap along it is less than its length by no more than this
// share.
inline constexpr float kLeastProgress = 0x1p-21f;

// How much less than their distance the gap of the cores along the normal may be: the rounding of
// both.
inline constexpr float kSameGapInFloat = 0x1p-19f;

// Shells (narrowphase/hulls/shell.h), by the greatest squared distance M of a triangle's corners
// from zero. The length of a product of two sides is at most 2.6 M. It rounds by less than
// 1.1 x 2^-20 M, so that the volume, a corner times this normal, rounds by less than
// 1.6 x 2^-20 M^1.5. A product of two corners rounds by less than 2^-22 M, a difference of two
// scalar products, or of two products of these, by less than kShellSure M.
inline constexpr float kShellSure = 0x1p-20f;

// A triangle's plane is no nearer to zero than the volume, less kShellHeight M (M + 1), over the
// length of the normal: both together round by less than 3.2 x 2^-20 M^1.5, the quotient included,
// and M + 1 is at least twice the root of M.
inline constexpr float kShellHeight = 0x1p-19f;

// Squares count as this share of themselves, which is less than sums of products round. It pays for
// (a - b)^2 >= (1 - 2^-12) a^2 - 2^12 b^2, too, with b^2 = 2^-44 M^2 of a product of two corners:
// the squared product, less kShellEdgeRest M^2, over the squared length is a bound of the distance
// of the line through both.
inline constexpr float kShellShare = 1 - 0x1p-11f;
inline constexpr float kShellEdgeRest = 0x1p-31f;

// Zero projects beside an edge if the normal and the product of the edge's corners point apart by
// more than this share of M^2: 2.1 x 2^-20 of it is rounding.
inline constexpr float kShellBeside = 0x1p-18f;

// Placed points round by a quarter of this, and so do the corners of a shell and the depth that it
// confirms.
inline constexpr float kShellRounding = 0x1p-17f;

// Between cores nearer than this float32 finds no reliable direction.
inline constexpr float kNearCores = 0x1p-12f;

// Points within this of the support point, along the normal, face the other core as well.
inline constexpr float kFacingSlack = 0x1p-16f;

// Points that face the other core count as one if they are nearer to each other than this: some
// roundings of the corners of k-DOPs, of which many are such groups.
inline constexpr float kOneCorner = 0x1p-19f;

// Squared sine below which two crossing edges do not locate the contact: rounding moves the
// crossing by eight times as much.
inline constexpr float kSmallCrossing = 0x1p-6f;

// Squared sine at a corner of a triangle that is too flat for the search over separating axes.
inline constexpr double kFlatTriangle = 0x1p-30;

// A shorter segment of a capsule is a point for the same search: its square may be subnormal, and
// its direction rounding.
inline constexpr float kShortestSegment = 0x1p-40f;

// How far a corner of a hull's face may lie behind the face's plane, as a share of the hull's size.
inline constexpr double kBehindFace = 0x1p-20;

// Squared sine below which two edges of hulls are so nearly parallel that float32 does not know
// their cross product.
inline constexpr float kAlongEachOther = 0x1p-16f;

// float32 tests no pair whose scale (a power of two) is above this, or below its inverse.
inline constexpr float kGreatestScale = 0x1p90f;

// The most rounds of GJK in lanes, and the most points of a core there. Pairs that need more are
// tested in double precision.
inline constexpr size_t kMostLaneRounds = 20;
inline constexpr size_t kMostLanePoints = 128;

// --- Meshes and compounds ---

// Two faces of a mesh that meet at an angle with a smaller tangent bend neither way: a twentieth of
// a degree.
inline constexpr double kFlatEdge = 0x1p-10;

// How much the rounding of corners to float32 may change their height over a plane, as a share of
// their coordinates.
inline constexpr double kRoundedCorner = 0x1p-22;

// Corners of a triangle touch together if their heights along a normal differ by less than this
// share of its size: several times what the tests leave to rounding.
inline constexpr double kSameHeight = 0x1p-15;

// Points of a manifold whose depths differ by no more than this share of its extent are equally
// deep.
inline constexpr double kSameDepth = 0x1p-18;

// A point within this share of a shape's size of a feature lies on it: points of manifolds are off
// by much less.
inline constexpr double kOnFeature = 0x1p-14;

// If the lengths of a search reach this, every part counts as near.
inline constexpr double kBeyondSearch = 0x1p120;

// A merged manifold uses the contacts of at most this many parts, the deepest ones.
inline constexpr size_t kMostPartsOfManifold = 4096;

// The search for parts widens its boxes by this share of all lengths that go in: four times the
// error of the tests.
inline constexpr double kSearchSlack = 0x1p-17;

// Heights of points over the planes of triangles are wrong by less than this share of the lengths
// between them.
inline constexpr float kPlaneSlack = 0x1p-18f;

// Bodies are placed beside the planes of triangles, and tested in double precision, with errors
// below this share of all lengths.
inline constexpr double kPlacedSlack = 0x1p-36;

// Depths that tests find differ from the true ones by less than this share of all lengths.
inline constexpr double kDepthSlack = 0x1p-16;

// Boxes of two trees are compared in float32 after they are widened by this share of all lengths.
// Points that turn are wrong by less, and so are heights of triangles over each other.
inline constexpr double kTreeSlack = 0x1p-18;

// Parts share a manifold if the cosine between their normals and the deepest contact's is at least
// this (18 degrees).
inline constexpr double kSameManifold = 0.95;

// A volume of at most this share of the product of its three sides may be rounding: the points lie
// in one plane.
inline constexpr double kWithoutVolume = 0x1p-50;

// --- k-DOPs, as shares of their size ---

// A point within this distance of a plane lies in it.
inline constexpr double kInDopPlane = 0x1p-44;

// How far off the points of a k-DOP may be; a generous bound.
inline constexpr double kDopRounding = 0x1p-42;

// Corners nearer to each other than this are one: float32 gives no direction between them.
inline constexpr float kSameCorner = 0x1p-20f;

// --- Manifolds, in scaled units ---

// Points of a manifold may be separate by this much, which is what rounding does to them. A contact
// distance raises it, up to kGreatestReach.
inline constexpr float kTouchingPoint = 0x1p-18f;
inline constexpr float kGreatestReach = 0x1p20f;

// The gap at a point that does not exist.
inline constexpr float kNoPoint = 2 * kGreatestReach;

// Clipping moves the sides of a face outwards by this, so that an edge that lies on a side is kept.
inline constexpr float kClipSlack = 0x1p-20f;

// The least rate at which an edge crosses a line: below, the quotient would lose its meaning.
inline constexpr float kLeastCrossing = 0x1p-60f;

// Points whose squared distance is less are one; a point that near to a line lies on it.
inline constexpr float kSamePoint = 0x1p-32f;

// A face is seen edge-on if the cosine between its normal and the view is less than this.
inline constexpr float kEdgeOn = 0.05f;

// A special triangle shows its face if the cosine between its normal and the contact's is greater.
inline constexpr float kFront = 0.99f;

// A triangle counts as a segment if (height / longest edge)^2 is below this.
inline constexpr float kSliver = 0x1p-40f;

// A capsule touches with an end if the squared sine between its axis and the contact's normal is
// less.
inline constexpr float kEndOn = 0x1p-10f;

// Two capsules touch along a line if the squared sine between their axes is at most this.
inline constexpr float kSameDirection = 0x1p-12f;

// A capsule counts as a cylinder up to this share of its radius beyond its ends: the error is half
// the square of that share.
inline constexpr float kOverhang = 0x1p-9f;

}  // namespace carom
