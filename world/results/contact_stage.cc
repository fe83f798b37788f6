#include "world/results/contact_stage.h"

#include <atomic>
#include <utility>

#include "base/parallel.h"
#include "carom/results/tier.h"
#include "world/store/columns.h"

namespace carom {
namespace {

constexpr size_t kContactFloats = 10;

}  // namespace

ResultColumns ResultBuffer::prepare(size_t pairs, Detail detail, bool sub_shapes) {
  rows_ = pairs;
  overlap_.resize(pairs + 1);
  overlap_.back() = 0;
  status_.resize(pairs);
  if (detail == Detail::overlap) return {.overlap = overlap_.data(), .status = status_.data()};
  floats_.resize(pairs * kContactFloats);
  ResultColumns columns = {.overlap = overlap_.data(),
                           .status = status_.data(),
                           .separation = column(0),
                           .normal = {column(1), column(2), column(3)},
                           .point_a = {column(4), column(5), column(6)},
                           .point_b = {column(7), column(8), column(9)}};
  sub_shape_.resize(sub_shapes ? 2 * pairs : 0);
  if (sub_shapes) {
    columns.sub_a = sub_shape_.data();
    columns.sub_b = sub_shape_.data() + pairs;
  }
  if (detail != Detail::manifold) return columns;
  manifold_count_.resize(pairs);
  manifold_.resize(pairs);
  columns.manifold_count = manifold_count_.data();
  columns.manifold = manifold_.data();
  return columns;
}

void ResultBuffer::reject_apart(const std::vector<Pair>& pairs, const PresentBounds& bounds,
                                Parallelism parallelism) {
  for_each_block(rows_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (overlap_[i] && !bounds.meet(pairs[i])) overlap_[i] = 0;
    }
  });
}

Eigen::Vector3f ResultBuffer::vector(size_t column, size_t row) const {
  const float* first = floats_.data() + column * rows_ + row;
  return {first[0], first[rows_], first[2 * rows_]};
}

Contact ResultBuffer::contact(size_t row, Pair pair) const {
  return {.a = pair.a,
          .b = pair.b,
          .sub_a = sub_shape_.empty() ? 0 : sub_shape_[row],
          .sub_b = sub_shape_.empty() ? 0 : sub_shape_[rows_ + row],
          .normal = vector(1, row),
          .separation = floats_[row],
          .arm_a = vector(4, row),
          .normal_velocity = 0,
          .arm_b = vector(7, row),
          .status = static_cast<Status>(status_[row]),
          .manifold_count = manifold_count_.empty() ? uint8_t{0} : manifold_count_[row]};
}

void ResultBuffer::give_back_beyond(size_t pairs) {
  give_back_scratch(overlap_, pairs);
  give_back_scratch(status_, pairs);
  give_back_scratch(floats_, kContactFloats * pairs);
  give_back_scratch(sub_shape_, sub_shape_.empty() ? 0 : 2 * pairs);
  give_back_scratch(manifold_count_, pairs);
  give_back_scratch(manifold_, pairs);
}

size_t ResultBuffer::bytes() const {
  return bytes_of(overlap_) + bytes_of(status_) + bytes_of(floats_) + bytes_of(sub_shape_) +
         bytes_of(manifold_count_) + bytes_of(manifold_);
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
