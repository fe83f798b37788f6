// The tolerances and steps of the kernels of round shapes, in scaled units (see Units in
// narrowphase/batch/kernel_policy.h). Those of all kernels are in base/tolerances.h.
#pragma once

#include <cstddef>

namespace carom {

// Near the axis of a cylinder or cone the direction away from it is rounding. A normal with less
// than this share across the axis does not need it.
inline constexpr float kAlongAxis = 0x1p-12f;

// float32 does not know the slope of a cone whose coordinates are all below this, in scaled units:
// the squares of its sizes would vanish. Squares of lengths of sides count as kLeastSlant at least.
inline constexpr float kSmallProfile = 0x1p-40f;
inline constexpr float kLeastSlant = 0x1p-100f;

// The search for the nearest point of an ellipsoid: the least value of its unknown, how near the
// sum is to one before the last step (what is left is some squares of this), and the most steps.
inline constexpr float kLeastShift = 0x1p-60f;
inline constexpr float kNearSurface = 0x1p-9f;
inline constexpr size_t kMostEllipsoidSteps = 8;

// Near the rim of a thin ellipsoid the unknown is a difference of squares that rounding has left
// few digits: it is a smaller share of them than this, and they make most of the sum.
inline constexpr float kThinRim = 0x1p-12f;
inline constexpr float kMostOfSum = 0.75f;

// Cylinders, in scaled units. The sine between two axes below which they are parallel, that below
// which lines of their sides are, and that below which the rims of caps that face each other cross
// as circles in one plane do, about.
inline constexpr float kParallelAxes = 0x1p-21f;
inline constexpr float kCrossingLines = 0x1p-10f;
inline constexpr float kNearAxes = 0x1p-5f;

// Where nearly parallel cylinders are as far along a direction, but for this, discs or lines touch.
inline constexpr float kFlatTogether = 0x1p-19f;

// A shorter half of a segment has no direction in float32.
inline constexpr float kShortAxis = 0x1p-12f;

// Both points of a contact may lie beside the shapes by this: some roundings of their places.
inline constexpr float kBesideCore = 0x1p-18f;

// A point of a contact may lie beside a solid or a cylinder by this: half a dozen roundings of
// coordinates below four. In front of a face at a sharp corner it may be far from the solid: a hull
// is blunt enough if a ball of this share of its size lies inside, and a triangle if the sine at
// each of its corners is as great.
inline constexpr float kBesideSolid = 0x1p-19f;
inline constexpr float kBlunt = 0x1p-3f;

// Bounds of edges beside cylinders, from heights of faces in float32: by how much they are off at
// most, if the square of the sine between the middle direction and the axis, and the cosine of half
// the angle between the normals, are no less than these.
inline constexpr float kEdgeBoundSlack = 0x1p-16f;
inline constexpr float kEdgeBoundSine = 0x1p-6f;
inline constexpr float kEdgeBoundCosine = 0x1p-3f;
// The greatest such cosine of an arc whose peak float32 knows as well.
inline constexpr float kWideArc = 0.99f;

// Searches on arcs: samples of a quarter, their cosines, the steps of Newton's method, the longest
// of them (two thirds of a sample), one where the curve is no peak, and one that is short
// enough to be the last: the gap is then off by the square of what is left, the square of this. A
// search that has not ended counts less by kNotEnded.
inline constexpr size_t kArcSamples = 9;
inline constexpr float kArcCosines[kArcSamples] = {1.0f,         0.980785280f, 0.923879533f,
                                                   0.831469612f, 0.707106781f, 0.555570233f,
                                                   0.382683432f, 0.195090322f, 0.0f};
inline constexpr size_t kArcSteps = 4;
inline constexpr size_t kSolidArcSteps = 5;
inline constexpr float kLongArc = 0x1p-3f;
inline constexpr float kShortArc = 0x1p-4f;
inline constexpr float kLastArc = 0x1p-11f;
inline constexpr float kNotEnded = 0x1p-20f;

// Searches for two rims: from how many starts, with a smaller cosine between them than kRimApart;
// the steps from each, those from the best of their ends, and the longest of them as a share of the
// sine between the direction and the nearer axis; the least distance from an axis, and the least
// square of a direction's length.
inline constexpr size_t kRimStarts = 3;
inline constexpr float kRimApart = 0.98f;
inline constexpr size_t kRimFirstSteps = 4;
inline constexpr size_t kRimLastSteps = 4;
inline constexpr float kRimStep = 0.6f;
inline constexpr float kLeastRim = 0x1p-20f;
inline constexpr float kLeastWay = 0x1p-60f;

// Searches for the widest gap of two ellipsoids: from how many directions, with a smaller cosine
// between them than kEllipsoidsApart; the steps from each, those from the best of their ends, the
// longest of them, and by how much a step at a saddle lowers the greater curvature below zero, as a
// share of the difference of both and in scaled units (of two rims as well).
inline constexpr size_t kEllipsoidStarts = 4;
inline constexpr float kEllipsoidsApart = 0.8f;
inline constexpr size_t kEllipsoidFirstSteps = 5;
inline constexpr size_t kEllipsoidLastSteps = 2;
inline constexpr float kLongTurn = 0.4f;
inline constexpr float kSaddleShare = 0.2f;
inline constexpr float kSaddle = 0.01f;

// Whether a point lies in an ellipsoid rounds by less than this share, if no axis is shorter than
// kThinEllipsoid: a place rounds by some units of 2^-24.
inline constexpr float kSureShare = 0x1p-6f;
inline constexpr float kThinEllipsoid = 0x1p-10f;

}  // namespace carom
