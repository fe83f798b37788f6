#include "world/results/contact_stage.h"

#include <atomic>
#include <utility>

#include "base/parallel.h"
#include "carom/results/tier.h"
#include "world/store/columns.h"

namespace carom {
namespace {

Eigen::Vector3f vector_at(const std::array<float*, 3>& columns, size_t row) {
  return {columns[0][row], columns[1][row], columns[2][row]};
}

}  // namespace

const ResultColumns& ResultBuffer::prepare(size_t pairs, Detail detail, bool sub_shapes) {
  pairs_ = pairs;
  if (sub_shapes) {
    arrays_.resize(pairs + 1, detail, {ColumnRole::sub_shape});
  } else {
    arrays_.resize(pairs + 1, detail);
  }
  columns().overlap[pairs] = 0;
  return columns();
}

void ResultBuffer::reject_apart(const std::vector<Pair>& pairs, const PresentBounds& bounds,
                                Parallelism parallelism) {
  uint8_t* const overlap = columns().overlap;
  for_each_block(pairs_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (overlap[i] && !bounds.meet(pairs[i])) overlap[i] = 0;
    }
  });
}

Contact ResultBuffer::contact(size_t row, Pair pair) const {
  const ResultColumns& c = columns();
  return {.a = pair.a,
          .b = pair.b,
          .sub_a = c.sub_a ? c.sub_a[row] : 0,
          .sub_b = c.sub_b ? c.sub_b[row] : 0,
          .normal = vector_at(c.normal, row),
          .separation = c.separation[row],
          .arm_a = vector_at(c.point_a, row),
          .normal_velocity = 0,
          .arm_b = vector_at(c.point_b, row),
          .status = static_cast<Status>(c.status[row]),
          .manifold_count = c.manifold_count ? c.manifold_count[row] : uint8_t{0}};
}

void ContactStage::run(const CarryPlan& plan, const PairHistory& last, const ResultBuffer& results,
                       const BodyStore& bodies, Detail detail, Parallelism parallelism,
                       PairHistory& now) {
  // First find the result of every pair, and how many contacts each block has ...
  find_overlaps(plan, last, results, bodies, parallelism, now);
  now.contacts.clear();
  now.manifolds.clear();
  if (!has_contacts(detail)) return;

  // ... then write every contact to its place.
  const bool has_manifolds = detail == Detail::manifold;
  size_t contacts = 0;
  for (size_t& first : block_first_) contacts += std::exchange(first, contacts);
  now.contacts.resize(contacts);
  if (has_manifolds) now.manifolds.resize(contacts);
  for_each_block(now.pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   size_t next = block_first_[block];
                   for (size_t i = begin; i < end; ++i) {
                     if (now.overlaps[i] != 1 || now.contact[i] == PairHistory::kSensor) continue;
                     const uint32_t row = plan.test_row(i);
                     const bool carried = row == CarryPlan::kCarried;
                     const size_t old = carried ? last.contact[plan.last_index(i)] : 0;
                     now.contacts[next] =
                         carried ? last.contacts[old] : results.contact(row, now.pairs[i]);
                     if (has_manifolds) {
                       now.manifolds[next] = carried ? last.manifolds[old] : results.manifold(row);
                     }
                     now.contact[i] = static_cast<uint32_t>(next++);
                   }
                 });
}

void ContactStage::find_overlaps(const CarryPlan& plan, const PairHistory& last,
                                 const ResultBuffer& results, const BodyStore& bodies,
                                 Parallelism parallelism, PairHistory& now) {
  const size_t pairs = now.pairs.size();
  now.overlaps.resize(pairs);
  now.contact.resize(pairs);
  block_first_.assign(block_count(pairs, kPairsPerMergeBlock), 0);
  std::atomic<size_t> overlaps{0}, undecided{0};
  for_each_block(
      pairs, kPairsPerMergeBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
        size_t overlapping = 0, unknown = 0;
        for (size_t i = begin; i < end; ++i) {
          const uint32_t row = plan.test_row(i);
          const uint8_t decision =
              row == CarryPlan::kCarried ? last.overlaps[plan.last_index(i)] : results.overlap(row);
          const bool overlap = decision == 1;
          const Pair pair = now.pairs[i];
          const bool sensor = bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b);
          now.overlaps[i] = decision;
          now.contact[i] = overlap && sensor ? PairHistory::kSensor : PairHistory::kNone;
          overlapping += overlap;
          unknown += decision == kUndecided;
          block_first_[block] += overlap && !sensor;
        }
        overlaps += overlapping;
        undecided += unknown;
      });
  overlaps_ = overlaps;
  undecided_ = undecided;
}

void set_normal_velocities(std::span<const Eigen::Vector3f> velocities, Parallelism parallelism,
                           std::vector<Contact>& contacts) {
  for_each_block(
      contacts.size(), kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          Contact& c = contacts[i];
          const Eigen::Vector3f v = velocities[c.b] - velocities[c.a];
          c.normal_velocity = (v.x() * c.normal.x() + v.y() * c.normal.y()) + v.z() * c.normal.z();
        }
      });
}

}  // namespace carom
