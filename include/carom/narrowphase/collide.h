// Pairs + shapes -> results, over the caller's own arrays.
#pragma once

#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/tier.h"
#include "carom/shapes/views.h"

namespace carom {

// Whether a kernel exists for these two kinds, in either order.
CAROM_EXPORT bool supports(ShapeKind a, ShapeKind b);

// Tests pair i = (a[pairs[i].a], b[pairs[i].b]) and writes row i of `out`; `a` and `b` may be the
// same set. Columns of `out` hold pairs.size() entries. At Detail::overlap only overlap and status
// are written, at Detail::contact all but the manifolds; Detail::pairs writes nothing. Indices must
// lie inside their sets. What comes from behind a one-sided triangle is separate by +infinity, with
// a normal and points that are not a number; so are all of these of invalid pairs.
//
// A mesh or a compound overlaps what one of its parts overlaps. The contact is that of the deepest
// pair of parts (the nearest, if they are apart), of equal ones the first by their indices, which
// sub_a and sub_b name. The manifold joins the points of all parts that are met in about the same
// direction. Bodies without parts (all triangles of the mesh have no area) are separate by
// +infinity. Parts that meet over an inner edge of a mesh come after all others: what lies across
// the edge is met as well. Where there are no others, the normal is one that the triangle allows.
//
// float32 throughout, after one subtraction of the positions in their own type: the error does not
// depend on the distance from the origin. Bits are the same on every instruction set and for any
// number of threads, and do not depend on a pair's place in the list. Distances between positions
// count as the largest float at most: shapes of about that size may be found to overlap from
// further away.
// At Tier::certified and Tier::exact `overlap` is right for the shapes as they are stored
// (carom/results/tier.h), and the sign of the separation goes with it: 0 or less of overlapping
// pairs, more than 0 of separate ones. Of undecided pairs the separation is the standard one, and
// there are no manifold points.
// Fails if a pair is of kinds that no kernel exists for; nothing is written then.
CAROM_EXPORT Result<void> collide(const Collidables& a, const Collidables& b,
                                  std::span<const Pair> pairs, Detail detail,
                                  const ResultColumns& out,
                                  WitnessFrame frame = WitnessFrame::world,
                                  Parallelism parallelism = Parallelism::none,
                                  Measured measured = Measured::all, const Accuracy& accuracy = {});

// The same for pair i = (a[i], b[i]), i < a.count == b.count: no list of pairs is read.
CAROM_EXPORT Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                                       const ResultColumns& out,
                                       WitnessFrame frame = WitnessFrame::world,
                                       Parallelism parallelism = Parallelism::none,
                                       Measured measured = Measured::all,
                                       const Accuracy& accuracy = {});

}  // namespace carom
