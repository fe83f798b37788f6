#include "narrowphase/blocks/pass_plan.h"

namespace carom {
namespace {

PassPlan::Points points_of(const PairKind& kind, Detail detail, Measured measured) {
  if (detail < Detail::manifold) return PassPlan::Points::none;
  if (measured == Measured::separate) return PassPlan::Points::zero;
  return kind.has_manifold_pass() ? PassPlan::Points::clipped : PassPlan::Points::witnesses;
}

}  // namespace

PassPlan plan_passes(const PairKind& kind, const Batch& batch, Measured wanted, bool has_directions,
                     const Accuracy& accuracy) {
  PassPlan plan;
  plan.proves = has_proofs(accuracy.tier);
  plan.bounds = batch.out.separation_bound != nullptr;
  // A proof may turn an overlapping row into a separate one, so overlapping rows need contact
  // columns, too.
  const Measured measured = plan.proves && wanted == Measured::separate ? Measured::all : wanted;
  const bool is_wide = measured != Measured::overlapping || batch.reach;
  const bool measures = has_contacts(batch.detail) && kind.has_distance_pass() && is_wide;
  const bool at_once = measures && kind.measures_at_once();

  if (has_directions && kind.has_direction_pass() && has_contacts(batch.detail)) {
    plan.known = PassPlan::Known::directions;
  } else if (at_once && batch.out.features && kind.has_recall_pass() && !plan.proves) {
    plan.known = PassPlan::Known::features;
  }

  plan.search_detail = batch.detail;
  if (kind.measures_in_test()) {
    plan.measures_in_test = measures;
  } else if (at_once) {
    plan.search = measured == Measured::separate ? Pass::clearance : Pass::distance;
  } else if (measures && measured == Measured::separate) {
    plan.search_detail = Detail::overlap;
  }
  plan.measures_separate = measures && !at_once && !plan.measures_in_test;
  plan.measures_invalid = measured == Measured::separate;

  plan.points = points_of(kind, batch.detail, measured);
  plan.clears_separate = measured == Measured::all;
  plan.single_precision = accuracy.tier == Tier::fast;
  return plan;
}

}  // namespace carom
