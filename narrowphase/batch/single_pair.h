// The rare paths of a batch, one pair at a time: validity, unsure rows in double precision, and
// manifold points that a kernel defers.
#pragma once

#include <array>

#include "base/tolerances.h"
#include "carom/shapes/shape.h"
#include "narrowphase/batch/batch.h"
#include "narrowphase/scalar/vector.h"
#include "shapes/body_reader.h"

namespace carom {

// One side as a set of bodies.
Collidables view_of(const BatchSide& side, PositionLayout layout, ShapeKind kind);

// For the tests in double precision.
scalar::Quaternion<double> orientation_of(const BodyReader& body, size_t index);

// The pose as the kernels see it, from one subtraction in the type of the positions.
scalar::PairPose<float> rounded_pose(const BodyReader& a, const BodyReader& b, Pair pair);

// Whether both bodies of row `row` are valid.
bool is_valid_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row);

// The whole answer of row `row` in double precision, rounded once: separation, normal, arm_a,
// arm_b, and 1 if the status is degenerate. Both bodies are valid.
std::array<float, 11> exact_answer(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b,
                                   size_t row);

// As much of that as the test pass needs, of two boxes (B is turned): of separate ones the gap
// along the best axis and its normal, of overlapping ones the points as well if the batch has
// contacts.
std::array<float, 11> exact_box_test(const Batch& batch, ShapeKind kind_a, size_t row);

// Writes the manifold points of row `row`, relative to A, and returns their number. `batch.tested`
// has the contact. Both bodies are valid.
uint8_t manifold_answer(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row,
                        ManifoldPoints& points);

}  // namespace carom
