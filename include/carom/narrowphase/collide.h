/// @file
/// The narrow phase on the caller's own arrays: pairs and shapes in, results out.
#pragma once

#include <concepts>
#include <span>

#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/results/contact_regions.h"
#include "carom/results/pair.h"
#include "carom/results/result_columns.h"
#include "carom/results/tier.h"
#include "carom/shapes/views.h"

namespace carom {

/// Whether a kernel exists for these two kinds, in either order.
CAROM_EXPORT bool supports(ShapeKind a, ShapeKind b);

/// Whether Tier::exact decides overlaps of this shape: not if it is a cylinder, a cone or an
/// ellipsoid, or a compound with such a part.
CAROM_EXPORT bool is_decided_exactly(const Shape& shape);

/// What collide() and collide_rows() may be asked for beside their results.
struct CollideOptions {
  WitnessFrame frame = WitnessFrame::world;     ///< of witness and manifold points
  Parallelism parallelism = Parallelism::none;  ///< which threads the call may use
  Measured measured = Measured::all;            ///< which pairs are measured
  Accuracy accuracy = {};                       ///< the tier
  /// Metres, finite, >= 0. Separate pairs with at most this separation have contacts, too: they are
  /// measured, whatever `measured` says, and get manifold points and regions at details that have
  /// them. In every manifold, points may be this far from B. Overlaps do not change.
  float contact_distance = 0;
  /// One distance a pair instead of `contact_distance`; nullptr: that one for all.
  const float* contact_distances = nullptr;
  /// Receives all contacts of all pairs at Detail::regions; nullptr: nothing is collected.
  ContactRegions* regions = nullptr;
  RegionLimits region_limits = {};  ///< read at Detail::regions
};

/// Tests pair i = (a[pairs[i].a], b[pairs[i].b]) and writes row i of `out`. `a` and `b` may be the
/// same set. Columns of `out` hold pairs.size() entries. At Detail::overlap only overlap and status
/// are written, at Detail::contact all but the manifolds, at Detail::pairs nothing; at
/// Detail::regions the same columns as at Detail::manifold, and CollideOptions::regions. Indices
/// must lie inside their sets. A body behind a one-sided triangle is separate from it by +infinity,
/// with NaN as normal and points; an invalid pair has NaN in all of these.
///
/// A mesh or a compound overlaps a body if one of its parts does. The contact is that of the pair
/// of parts with the least separation (the deepest one, or else the nearest); among equal ones it
/// is the first by indices. `sub_a` and `sub_b` name the two parts. The manifold joins the points
/// of all parts whose contacts have about the same normal. Bodies without parts (a mesh in which no
/// triangle has an area) are separate by +infinity. A contact over an inner edge of a mesh counts
/// only if the bodies have no other, since the neighbouring triangle has the correct normal; its
/// normal is then one that the triangle allows.
///
/// All arithmetic is float32 after one subtraction of the positions in their own type, so the error
/// does not depend on the distance from the origin. Results have the same bits on every instruction
/// set and for any number of threads, and do not depend on a pair's place in the list. Differences
/// of positions are clamped to the largest float: shapes of about that size may be reported as
/// overlapping from further away.
///
/// At Tier::certified and Tier::exact `overlap` is right for the shapes as they are stored
/// (carom/results/tier.h), and the sign of the separation agrees with it: 0 or less for overlapping
/// pairs, more than 0 for separate ones. Undecided pairs have the separation of the standard tier,
/// and no manifold points.
///
/// At Detail::regions the row of a pair holds its first contact. `regions` has all of them: none
/// for a pair that neither overlaps nor is within its contact distance. The parts of a mesh or a
/// compound whose normals are within an angle (RegionLimits) share a contact, the deepest of which
/// gives the normal. A contact over an inner edge makes none of its own.
///
/// Fails, and writes nothing, if no kernel exists for the kinds of a pair (supports()), if a
/// contact distance is not a finite number >= 0, or if Tier::exact is asked for and one of the
/// bodies has a shape that it does not decide (is_decided_exactly()).
CAROM_EXPORT Result<void> collide(const Collidables& a, const Collidables& b,
                                  std::span<const Pair> pairs, Detail detail,
                                  const ResultColumns& out, const CollideOptions& options = {});

/// Does the same for pair i = (a[i], b[i]), i < a.count == b.count, without a list of pairs.
CAROM_EXPORT Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                                       const ResultColumns& out,
                                       const CollideOptions& options = {});

/// The form of version 0.2. A template, so that `{}` in the last place is CollideOptions.
template <std::same_as<WitnessFrame> Frame>
[[deprecated("pass CollideOptions")]] Result<void> collide(
    const Collidables& a, const Collidables& b, std::span<const Pair> pairs, Detail detail,
    const ResultColumns& out, Frame frame, Parallelism parallelism = Parallelism::none,
    Measured measured = Measured::all, const Accuracy& accuracy = {}) {
  return collide(
      a, b, pairs, detail, out,
      CollideOptions{
          .frame = frame, .parallelism = parallelism, .measured = measured, .accuracy = accuracy});
}

/// The form of version 0.2. A template, so that `{}` in the last place is CollideOptions.
template <std::same_as<WitnessFrame> Frame>
[[deprecated("pass CollideOptions")]] Result<void> collide_rows(
    const Collidables& a, const Collidables& b, Detail detail, const ResultColumns& out,
    Frame frame, Parallelism parallelism = Parallelism::none, Measured measured = Measured::all,
    const Accuracy& accuracy = {}) {
  return collide_rows(
      a, b, detail, out,
      CollideOptions{
          .frame = frame, .parallelism = parallelism, .measured = measured, .accuracy = accuracy});
}

}  // namespace carom
