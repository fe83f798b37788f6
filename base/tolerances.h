// Every tolerance of a decision, with its reason. All are relative, or in scaled units (see Units
// in narrowphase/batch/kernel_policy.h). What arithmetic rounds at most stands beside that
// arithmetic.
#pragma once

#include <cstddef>

namespace carom {

// Separations below this share of the pair's size are computed again in double precision: float32
// rounding is at most 5 units of 2^-24 there, a third of this.
inline constexpr float kNearTouch = 0x1p-20f;

// The same for shapes that are turned, in scaled units (coordinates up to two): rotations and the
// products that follow round to at most 30 units of 2^-24, a quarter of this.
inline constexpr float kNearTouchScaled = 0x1p-17f;

// Shapes further apart than this along some direction, in scaled units, are found to be apart by
// every test: the best separating axis shows a good part of it, eight times what a test may err.
inline constexpr float kClearlyApart = 0x1p-14f;

// Points nearer than this in scaled units are taken for one: the square of their distance is about
// to vanish in float32.
inline constexpr float kCoincident = 0x1p-50f;

// Nearer than this to the inside of a segment, what rounding leaves along it counts beside the way
// across.
template <class Real>
inline constexpr Real kNearSegment = Real(0x1p-16);
template <>
inline constexpr double kNearSegment<double> = 0x1p-44;

// Quaternions whose squares neither vanish nor overflow are used as they are; others are scaled by
// a power of two first.
inline constexpr float kLeastSquaredNorm = 0x1p-60f;
inline constexpr float kGreatestSquaredNorm = 0x1p60f;

// --- Cores (segments, triangles): when they count as parallel, flat or touching; in scaled units
// or relative, by the precision of the test ---

template <class Real>
struct CoreTolerance;

template <>
struct CoreTolerance<float> {
  // sin^2 of the angle of two edges below which their cross product has lost half of its digits.
  static constexpr float kParallel = 0x1p-24f;
  // The same where it says nothing at all, even after it was made perpendicular to one of the two.
  static constexpr float kSameDirection = 0x1p-40f;
  // (height / longest edge)^2 of a triangle that is taken for its longest edge: the height is below
  // four roundings.
  static constexpr float kFlat = 0x1p-44f;
  // Cross products whose squares are below this are about to vanish, and features so small with
  // them.
  static constexpr float kVanishing = 0x1p-100f;
  // How much less than the distance the gap along a normal may be: several times what rounding of a
  // good normal makes of it, less than the least that is asked for, which is 5e-6.
  static constexpr float kTilt = 0x1p-18f;
  // Edges nearer than this may have passed each other for all that rounding tells.
  static constexpr float kNearEdges = 0x1p-10f;
  // Squared distances that differ by this factor only may be equal.
  static constexpr float kTie = 1 + 0x1p-21f;
  // Overlap of cores that is none: it may be rounding.
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

// Two edges, or an edge and a face, whose sine is below the root of this have no axis across both:
// the faces' axes differ from it by no more than rounding.
inline constexpr float kParallelSquared = 0x1p-48f;

// A separating axis that leads from one nearest point to the other up to this is the normal:
// rounding of coordinates below two is a quarter of it.
inline constexpr float kSameWay = 0x1p-21f;

// The direction between the nearest points is the normal if it parts the cores by their distance up
// to this; a fifth of what the normal's error may be.
inline constexpr float kCertain = 0x1p-19f;

// The same in double precision.
inline constexpr double kSameWayDouble = 0x1p-40;
inline constexpr double kCertainDouble = 0x1p-30;

// --- Boxes against boxes, in scaled units ---

// Squared length of a cross product of edges that are parallel to rounding: faces do for them.
template <class Real>
inline constexpr Real kLeastCross = Real(0x1p-46);
template <>
inline constexpr double kLeastCross<double> = 0x1p-100;

// Axes across a normal, to rounding: the feature that faces the other box runs along them.
template <class Real>
inline constexpr Real kAcross = Real(0x1p-19);
template <>
inline constexpr double kAcross<double> = 0x1p-26;

// Points that should face each other are further from that than this, squared.
inline constexpr float kOffAxisSquared = 0x1p-36f;

// --- Half-spaces, in scaled units ---

// Faces, edges and capsules whose ends differ in height by less than this share of the shape's size
// lie flat: rotations round to at most 8 units of 2^-24. Their middle is a point that stays put.
inline constexpr float kLyingFlat = 0x1p-21f;

// How many times greater than a shape the numbers may be that place the plane, before their
// rounding in float32 (6 units of 2^-24 at the most that was found) is more than 2e-6 of the shape:
// bodies far from the position of a turned half-space, and half-spaces with a great offset.
inline constexpr float kFarPlane = 5.0f;

// --- Polytopes in double precision, in scaled units (coordinates up to two, so that rounding is
// 2^-52 an operation) ---

// Points within this of a plane are in it: some thousand roundings.
inline constexpr double kInPlane = 0x1p-40;

// Cores that are nearer touch: there is no way from one to the other to go by.
inline constexpr double kTouchingCores = 0x1p-40;

// Gaps closer than this are equal, so that the simplest direction is kept.
inline constexpr double kTieOfGaps = 0x1p-48;

// How much less than the length of the nearest way a gap may be to be the distance.
inline constexpr double kSameDistance = 0x1p-34;

// Points of a Minkowski difference that are nearer to zero than this factor says are no nearer.
inline constexpr double kNoNearer = 1 - 0x1p-44;

// Squared distance of points that are one.
inline constexpr double kTouchingSquared = 0x1p-80;

// The nearest way may be off by this angle, and by the rounding of its ends over its length.
inline constexpr double kWayTilt = 0x1p-20;
inline constexpr double kWayRounding = 0x1p-50;

// Squared sine of edges that are parallel: their faces' normals do for them.
inline constexpr double kParallelEdges = 0x1p-50;

// Of the product of two sides: a cross product that may be rounding, of a triangle without area.
inline constexpr double kWithoutArea = 0x1p-48;

// --- Cores (GJK, and the polytope that finds ways out), in scaled units ---

// Cores nearer than this may as well touch: the direction from one to the other is off by up to
// 2^-52 over it, and the nearest face of their difference does better.
inline constexpr double kTouchingWay = 0x1p-24;

// Between cores further apart than this the way is exact enough to say which corners it ends at.
inline constexpr double kFarFromTouching = 0x1p-6;

// Points of two cores that are further from facing each other than this do not stand for where they
// meet; and how much less far than the furthest points those may be that do.
inline constexpr double kFacing = 0x1p-26;
inline constexpr double kMostSlack = 0x1p-16;

// How much less than its length the cores may be apart along the nearest way: more than rounding,
// where GJK has ended at the right corners.
inline constexpr double kSameGap = 0x1p-40;

// A way out that is longer than the shortest by no more than this is the shortest.
inline constexpr double kSameWayOut = 0x1p-42;

// Points of a difference that are no further from a plane, line or point lie in it.
inline constexpr double kFlatDifference = 0x1p-36;

// A face is seen from points that are further than this in front of it: some dozen roundings.
inline constexpr double kInFace = 0x1p-47;

// Of gaps between cores, and depths, this is more than all rounding: such decisions are proven.
inline constexpr double kProvenGap = 0x1p-36;

// --- Cores in float32, in scaled units: what GJK in lanes may decide. Coordinates of a difference
// reach nine, rotated points and their products round to 30 units of 2^-24 ---

// Further apart, or deeper in each other, than this they surely are: four times that rounding.
inline constexpr float kSureGap = 0x1p-16f;

// Volumes of a tetrahedron's corners with zero, over the squared distance of the furthest corner,
// that surely put zero inside, deeper than kSureGap.
inline constexpr float kSureVolume = 0x1p-14f;

// The way is the shortest if the projections on it lie apart by no less than this share of it.
inline constexpr float kLeastProgress = 0x1p-21f;

// How much less than their distance the cores may be apart along the normal: rounding of both.
inline constexpr float kSameGapInFloat = 0x1p-19f;

// Cores nearer than this have no good way between them in float32.
inline constexpr float kNearCores = 0x1p-12f;

// Points that reach as far as the furthest up to this face the other core as well.
inline constexpr float kFacingSlack = 0x1p-16f;

// Squared sine of edges that cross at too small an angle to say where: rounding moves the crossing
// by eight times as much.
inline constexpr float kSmallCrossing = 0x1p-6f;

// Squared sine at a corner of a triangle that is too flat for the search over separating axes.
inline constexpr double kFlatTriangle = 0x1p-30;

// Corners of a face of a hull may be so much behind its plane, as a share of the hull's size.
inline constexpr double kBehindFace = 0x1p-20;

// Squared sine of edges of hulls that are so nearly parallel that float32 does not know the axis
// across both.
inline constexpr float kAlongEachOther = 0x1p-16f;

// Pairs whose scale is a greater power of two, or a smaller one, are not tested in float32.
inline constexpr float kGreatestScale = 0x1p90f;

// Rounds of GJK in lanes, and points of a core there: who needs more goes on in double precision.
inline constexpr size_t kMostLaneRounds = 20;
inline constexpr size_t kMostLanePoints = 128;

// --- Meshes and compounds ---

// Faces that meet at a smaller angle (its tangent) bend neither way: a twentieth of a degree.
inline constexpr double kFlatEdge = 0x1p-10;

// What rounding of corners to float32 may make of their height over a plane, as a share of their
// coordinates.
inline constexpr double kRoundedCorner = 0x1p-22;

// Corners of a triangle whose heights along a normal differ by less, as a share of its size, are
// met together: some times what the tests leave to rounding.
inline constexpr double kSameHeight = 0x1p-15;

// Points of a manifold that are this share of its extent deeper than others are as deep.
inline constexpr double kSameDepth = 0x1p-18;

// Beyond such lengths positions count as the largest float, and every part as near.
inline constexpr double kBeyondSearch = 0x1p120;

// A manifold of several parts is made of the points of so many at most.
inline constexpr size_t kMostPartsOfManifold = 4096;

// So much further than its bounds reach a part is looked for, as a share of all lengths that go in:
// four times what the tests may err by.
inline constexpr double kSearchSlack = 0x1p-17;

// Parts whose normals are within this cosine of the contact's (18 degrees) share its manifold.
inline constexpr double kSameManifold = 0.95;

// Of the product of three sides: the volume of points in one plane may be as much.
inline constexpr double kWithoutVolume = 0x1p-50;

// --- k-DOPs, as shares of their size ---

// Points within this of a plane are in it.
inline constexpr double kInDopPlane = 0x1p-44;

// How far the points of a k-DOP may be off; generously.
inline constexpr double kDopRounding = 0x1p-42;

// Corners that are nearer to each other are one: between them there is no direction in float.
inline constexpr float kSameCorner = 0x1p-20f;

// --- Manifolds, in scaled units ---

// Points of a manifold may be as far apart as this, which is what rounding does to them.
inline constexpr float kTouchingPoint = 0x1p-18f;

// Sides of faces count as so much farther out: edges that lie on one another stay in sight.
inline constexpr float kClipSlack = 0x1p-20f;

// Slower than this an edge does not cross a line: the quotient would lose its meaning.
inline constexpr float kLeastCrossing = 0x1p-60f;

// Points whose squared distance is less are one; so are lines and points so near to them.
inline constexpr float kSamePoint = 0x1p-32f;

// A face whose normal is at a greater angle to the view (the cosine is less) is seen from the edge.
inline constexpr float kEdgeOn = 0.05f;

// Special triangles show their front if its normal is at a smaller angle to the contact's.
inline constexpr float kFront = 0.99f;

// Triangles whose longest edge has a smaller squared sine with another are segments.
inline constexpr float kSliver = 0x1p-40f;

// Capsules that the contact's normal meets at a smaller squared sine touch with an end.
inline constexpr float kEndOn = 0x1p-10f;

// Capsules touch along a line if the squared sine of their angle is less.
inline constexpr float kSameDirection = 0x1p-12f;

// So much of the radius beyond its end a capsule is still a cylinder: off by half the square.
inline constexpr float kOverhang = 0x1p-9f;

}  // namespace carom
