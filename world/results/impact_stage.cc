#include "world/results/impact_stage.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <tuple>

#include "base/parallel.h"

namespace carom {
namespace {

constexpr size_t kImpactFloats = 10;

bool is_before(const Impact& x, const Impact& y) {
  return std::tie(x.toi, x.a, x.b) < std::tie(y.toi, y.a, y.b);
}

// A sensor stops nobody, and a present overlap is a matter for contacts.
bool stops(const Impact& impact) { return !impact.sensor && !impact.overlap; }

// `contact`: nullptr if there is none, as at Detail::overlap and for sensors.
Impact overlap_of(Pair pair, const Contact* contact) {
  Impact impact{.a = pair.a, .b = pair.b, .overlap = true};
  if (!contact) return impact;
  impact.sub_a = contact->sub_a;
  impact.sub_b = contact->sub_b;
  impact.normal = contact->normal;
  impact.arm_a = contact->arm_a;
  impact.arm_b = contact->arm_b;
  impact.separation = contact->separation;
  impact.status = contact->status;
  return impact;
}

}  // namespace

void ImpactStage::run(const LookAhead& ahead) {
  clear();
  if (!ahead.sweeps.any_continuous()) return;
  find_candidates(ahead);
  sort_out(ahead);
  test(ahead);
  add_met(ahead);
  std::sort(impacts_.begin(), impacts_.end(), is_before);
  find_first(ahead.bodies.rows());
  if (ahead.settings.impacts == Impacts::all) return;
  keep_earliest();
  find_first(ahead.bodies.rows());
}

void ImpactStage::clear() {
  impacts_.clear();
  first_.clear();
}

void ImpactStage::find_candidates(const LookAhead& ahead) {
  const std::vector<Pair>& pairs = ahead.now.pairs;
  lists_.reset(block_count(pairs.size(), kPairsPerMergeBlock));
  for_each_block(pairs.size(), kPairsPerMergeBlock, ahead.settings.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) {
                     if (!ahead.is_continuous(pairs[i]) || !ahead.may_meet(pairs[i])) continue;
                     lists_[block].push_back(static_cast<uint32_t>(i));
                   }
                 });
  lists_.concatenate(candidates_, ahead.settings.parallelism);
}

// Takes present overlaps over from the step; all other pairs go to the test.
void ImpactStage::sort_out(const LookAhead& ahead) {
  const PairHistory& now = ahead.now;
  pairs_.clear();
  for (const uint32_t i : candidates_) {
    if (now.overlaps[i] != 1) {
      pairs_.push_back(now.pairs[i]);
      continue;
    }
    const uint32_t contact = now.contact[i];
    const bool has_contact = contact < now.contacts.size();
    impacts_.push_back(overlap_of(now.pairs[i], has_contact ? &now.contacts[contact] : nullptr));
    impacts_.back().sensor = ahead.has_sensor(now.pairs[i]);
  }
}

void ImpactStage::test(const LookAhead& ahead) {
  const ImpactColumns out = columns(has_contacts(ahead.settings.detail), ahead.has_parts());
  const SweepView sweeps = ahead.sweeps.view();
  [[maybe_unused]] const Result<void> done =
      time_of_impact(ahead.shapes, sweeps, ahead.shapes, sweeps, pairs_, out,
                     {.frame = WitnessFrame::body, .parallelism = ahead.settings.parallelism});
  assert(done);  // the kinds were checked when the bodies were added
}

ImpactColumns ImpactStage::columns(bool contacts, bool sub_shapes) {
  const size_t rows = pairs_.size();
  toi_.resize(rows);
  status_.resize(rows);
  floats_.resize(contacts ? kImpactFloats * rows : 0);
  sub_shape_.resize(contacts && sub_shapes ? 2 * rows : 0);
  ImpactColumns out = {.toi = toi_.data(), .status = status_.data()};
  if (!floats_.empty()) {
    const auto column = [&](size_t i) { return floats_.data() + i * rows; };
    out.separation = column(0);
    out.normal = {column(1), column(2), column(3)};
    out.point_a = {column(4), column(5), column(6)};
    out.point_b = {column(7), column(8), column(9)};
  }
  if (!sub_shape_.empty()) {
    out.sub_a = sub_shape_.data();
    out.sub_b = sub_shape_.data() + rows;
  }
  return out;
}

// Adds the pairs that meet within the interval. Pairs that do not meet, or have no answer, are no
// impacts.
void ImpactStage::add_met(const LookAhead& ahead) {
  for (size_t row = 0; row < pairs_.size(); ++row) {
    if (!(toi_[row] <= 1)) continue;
    const bool sensor = ahead.has_sensor(pairs_[row]);
    impacts_.push_back(sensor || floats_.empty() ? Impact{.a = pairs_[row].a, .b = pairs_[row].b}
                                                 : impact(row, pairs_[row]));
    impacts_.back().toi = toi_[row];
    impacts_.back().status = static_cast<Status>(status_[row]);
    impacts_.back().sensor = sensor;
  }
}

Eigen::Vector3f ImpactStage::vector(size_t column, size_t row) const {
  const size_t rows = pairs_.size();
  const float* first = floats_.data() + column * rows + row;
  return {first[0], first[rows], first[2 * rows]};
}

Impact ImpactStage::impact(size_t row, Pair pair) const {
  Impact impact{.a = pair.a, .b = pair.b};
  impact.sub_a = sub_shape_.empty() ? 0 : sub_shape_[row];
  impact.sub_b = sub_shape_.empty() ? 0 : sub_shape_[pairs_.size() + row];
  impact.normal = vector(1, row);
  impact.arm_a = vector(4, row);
  impact.arm_b = vector(7, row);
  impact.separation = floats_[row];
  return impact;
}

void ImpactStage::find_first(size_t bodies) {
  first_.assign(bodies, kNone);
  for (size_t i = 0; i < impacts_.size(); ++i) {
    const Impact& impact = impacts_[i];
    if (!stops(impact)) continue;
    for (const uint32_t body : {impact.a, impact.b}) {
      if (first_[body] == kNone) first_[body] = static_cast<uint32_t>(i);
    }
  }
}

float ImpactStage::first_time(uint32_t body) const {
  const Impact* first = first_of(body);
  return first ? first->toi : std::numeric_limits<float>::infinity();
}

void ImpactStage::keep_earliest() {
  const auto comes_too_late = [this](const Impact& impact) {
    if (impact.overlap) return false;
    const bool too_late_for_a = impact.toi > first_time(impact.a);
    const bool too_late_for_b = impact.toi > first_time(impact.b);
    return impact.sensor ? too_late_for_a || too_late_for_b : too_late_for_a && too_late_for_b;
  };
  // Not in place, since first_time() still reads impacts while others are dropped.
  kept_.clear();
  for (const Impact& impact : impacts_) {
    if (!comes_too_late(impact)) kept_.push_back(impact);
  }
  impacts_.swap(kept_);
}

const Impact* ImpactStage::first_of(uint32_t body) const {
  const bool is_there = body < first_.size() && first_[body] != kNone;
  return is_there ? &impacts_[first_[body]] : nullptr;
}

void ImpactStage::give_back() {
  if (impacts_.empty()) first_.clear();
  carom::give_back(impacts_, first_);
  give_back_scratch(lists_, candidates_, pairs_, toi_, status_, floats_, sub_shape_, kept_);
}

size_t ImpactStage::bytes() const {
  return lists_.bytes() + bytes_of(candidates_) + bytes_of(pairs_) + bytes_of(toi_) +
         bytes_of(status_) + bytes_of(floats_) + bytes_of(sub_shape_) + bytes_of(impacts_) +
         bytes_of(kept_) + bytes_of(first_);
}

}  // namespace carom
