#include "world/results/speculative_stage.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"
#include "carom/narrowphase/collide.h"
#include "world/store/columns.h"

namespace carom {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// The displacement over the interval of the point at `arm` from the body's position, as if it went
// on straight.
Vector3d motion_of(const Sweep& sweep, const Vector3f& arm) {
  const Vector3d motion = sweep.displacement.cast<double>();
  return motion + sweep.rotation.cast<double>().cross(arm.cast<double>());
}

// How much the separation grows over the interval if both witness points go on straight.
double opening(const Sweeps& sweeps, const Contact& contact) {
  const Vector3d motion = motion_of(sweeps.sweep(contact.b), contact.arm_b) -
                          motion_of(sweeps.sweep(contact.a), contact.arm_a);
  const Vector3d n = contact.normal.cast<double>();
  return (motion.x() * n.x() + motion.y() * n.y()) + motion.z() * n.z();
}

}  // namespace

void SpeculativeStage::run(const LookAhead& ahead) {
  clear();
  const double dt = ahead.settings.dt;
  if (!ahead.sweeps.any_merely_swept() || !has_contacts(ahead.settings.detail) || dt == 0) return;
  find_candidates(ahead);
  measure(ahead);
  contact_lists_.reset(block_count(pairs_.size(), kPairsPerMergeBlock));
  for_each_block(pairs_.size(), kPairsPerMergeBlock, ahead.settings.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) {
                     Contact contact = results_.contact(i, pairs_[i]);
                     // The pair is separate by its bounds; a test that rounds to an overlap does
                     // not count.
                     contact.separation = std::max(contact.separation, 0.0f);
                     const double opens = opening(ahead.sweeps, contact);
                     if (!(double{contact.separation} + opens <= 0)) continue;
                     contact.normal_velocity = static_cast<float>(opens / dt);
                     contact_lists_[block].push_back(contact);
                   }
                 });
  contact_lists_.concatenate(contacts_, ahead.settings.parallelism);
}

// Lists separate pairs with a swept body that have no contact, and no continuous body; the latter
// have impacts.
void SpeculativeStage::find_candidates(const LookAhead& ahead) {
  const PairHistory& now = ahead.now;
  const auto is_candidate = [&](size_t i) {
    const Pair pair = now.pairs[i];
    const bool is_swept = ahead.sweeps.looks_ahead(pair.a) || ahead.sweeps.looks_ahead(pair.b);
    return now.overlaps[i] == 0 && !now.has_contact(i) && is_swept && !ahead.is_continuous(pair) &&
           !ahead.has_sensor(pair) && ahead.may_meet(pair);
  };
  pair_lists_.reset(block_count(now.pairs.size(), kPairsPerMergeBlock));
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, ahead.settings.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) {
                     if (is_candidate(i)) pair_lists_[block].push_back(now.pairs[i]);
                   }
                 });
  pair_lists_.concatenate(pairs_, ahead.settings.parallelism);
}

// The step's narrow phase has only decided these pairs, so this measures them.
void SpeculativeStage::measure(const LookAhead& ahead) {
  constexpr ColumnRole kParts[] = {ColumnRole::sub_shape};
  const auto wanted = std::span(kParts).first(ahead.has_parts() ? 1 : 0);
  const ResultColumns out =
      results_.prepare({0, pairs_.size(), 0, pairs_.size()}, Detail::contact, wanted);
  [[maybe_unused]] const Result<void> done =
      collide(ahead.shapes, ahead.shapes, pairs_, Detail::contact, out,
              {.frame = WitnessFrame::body,
               .parallelism = ahead.settings.parallelism,
               .accuracy = ahead.settings.accuracy});
  assert(done);  // the kinds were checked when the bodies were added
}

void SpeculativeStage::give_back() {
  carom::give_back(contacts_);
  give_back_scratch(pair_lists_, pairs_, results_, contact_lists_);
}

size_t SpeculativeStage::bytes() const {
  return pair_lists_.bytes() + bytes_of(pairs_) + results_.bytes() + contact_lists_.bytes() +
         bytes_of(contacts_);
}

}  // namespace carom
