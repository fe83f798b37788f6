#include "world/results/contact_stage.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "carom/results/tier.h"
#include "shapes/point_velocity.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// Lists the pairs of [begin, end) that have contacts, without branches, and returns their number.
size_t list_contacts(const PairHistory& now, size_t begin, size_t end,
                     std::array<uint32_t, kPairsPerMergeBlock>& listed) {
  size_t count = 0;
  for (size_t i = begin; i < end; ++i) {
    listed[count] = static_cast<uint32_t>(i);
    count += now.has_contact(i);
  }
  return count;
}

}  // namespace

const ResultColumns& ResultBuffer::prepare(const PairRange& range, Detail detail,
                                           std::span<const ColumnRole> wanted) {
  first_row_ = range.first_row;
  rows_ = range.rows;
  arrays_.resize(rows_ + 1, detail, wanted);
  columns().overlap[rows_] = 0;
  near_.clear();
  extra_.clear();
  return columns();
}

const float* ResultBuffer::prepare_distances(std::span<const Pair> pairs,
                                             const ContactDistances& distances,
                                             Parallelism parallelism) {
  distances_.resize(pairs.size());
  near_.assign(pairs.size() + 1, 0);
  for_each_block(pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) distances_[i] = distances.of(pairs[i]);
                 });
  return distances_.data();
}

void ResultBuffer::reject_apart(std::span<const Pair> pairs, const PresentBounds& bounds,
                                Parallelism parallelism) {
  uint8_t* const overlap = columns().overlap;
  for_each_block(rows_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (overlap[i] && !bounds.meet(pairs[i])) overlap[i] = 0;
    }
  });
}

void ResultBuffer::find_near(std::span<const Pair> pairs, const PresentBounds& grown,
                             Parallelism parallelism) {
  for_each_block(rows_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      float& separation = columns().separation[i];
      near_[i] = columns().overlap[i] == 0 && separation <= distances_[i] && grown.meet(pairs[i]);
      // A test may have rounded the gap of separate bounds to zero.
      if (near_[i]) separation = std::max(separation, std::numeric_limits<float>::min());
    }
  });
}

size_t ResultBuffer::bytes() const {
  return arrays_.bytes() + bytes_of(distances_) + bytes_of(near_) + extra_.bytes();
}

void ContactStage::start(bool reads_last, PairHistory& last, PairHistory& now) {
  overlaps_ = undecided_ = left_out_ = 0;
  now.overlaps.resize(now.pairs.size());
  now.contact.resize(now.pairs.size());
  now.clear_contacts();
  const auto take_memory = [reads_last](auto& before, auto& list) {
    if (reads_last || list.capacity() >= before.capacity()) return;
    before.clear();
    list.swap(before);
  };
  take_memory(last.contacts, now.contacts);
  take_memory(last.manifolds, now.manifolds);
  take_memory(last.identities, now.identities);
}

size_t ContactStage::add(const PairRange& range, const CarryPlan& plan, const PairHistory& last,
                         const ResultBuffer& results, const BodyStore& bodies,
                         const WorldSettings& settings, PairHistory& now) {
  // First find the result of every pair, and how many contacts each block has ...
  find_results(range, plan, last, results, bodies, settings, now);
  const size_t first = now.contacts.size();
  if (!has_contacts(settings.detail)) return first;

  // ... then write every contact to its place.
  size_t contacts = first;
  for (size_t& block : block_first_) contacts += std::exchange(block, contacts);
  const auto resize = [&](auto& list) {
    reserve_at_rate(list, contacts, range.begin, now.pairs.size());
    list.resize(contacts);
  };
  resize(now.contacts);
  if (has_manifolds(settings.detail)) resize(now.manifolds);
  if (settings.identities) resize(now.identities);
  write_contacts(range, plan, last, results, settings, now);
  return first;
}

void ContactStage::find_results(const PairRange& range, const CarryPlan& plan,
                                const PairHistory& last, const ResultBuffer& results,
                                const BodyStore& bodies, const WorldSettings& settings,
                                PairHistory& now) {
  constexpr uint32_t kToBeWritten = 0;
  // What `contact` says of a pair without a contact, with one, and of an overlap with a sensor.
  const uint32_t kinds[] = {PairHistory::kNone,
                            has_contacts(settings.detail) ? kToBeWritten : PairHistory::kNone,
                            PairHistory::kSensor};
  const size_t pairs = range.end - range.begin;
  const bool regions = settings.detail == Detail::regions;
  block_first_.assign(block_count(pairs, kPairsPerMergeBlock), 0);
  if (plan.tests_all() && !regions && !results.has_near() && !bodies.knows_sensors()) {
    return read_decisions(range, results, settings, now);
  }
  std::atomic<size_t> overlaps{0}, undecided{0}, left_out{0};
  for_each_block(pairs, kPairsPerMergeBlock, settings.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   size_t overlapping = 0, unknown = 0, contacts = 0, unlisted = 0;
                   for (size_t i = range.begin + begin; i < range.begin + end; ++i) {
                     const uint32_t row = plan.test_row(i);
                     const bool carried = row == CarryPlan::kCarried;
                     const size_t before = carried ? plan.last_index(i) : 0;
                     const uint8_t decision =
                         carried ? last.overlaps[before] : results.overlap(row);
                     // Whether a pair overlaps cannot be predicted, so there is no branch on it.
                     const bool overlap = decision == 1;
                     const bool touches =
                         overlap | (carried ? last.has_contact(before) : results.is_near(row));
                     const Pair pair = now.pairs[i];
                     const bool sensor = bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b);
                     const bool listed = touches & !sensor;
                     now.overlaps[i] = decision;
                     now.contact[i] = kinds[listed | (overlap & sensor) << 1];
                     overlapping += overlap;
                     unknown += decision == kUndecided;
                     contacts += listed;
                     if (!regions || !listed) continue;
                     if (carried) {
                       const auto run = contact_run(last.contacts, last.contact[before]);
                       contacts += run.size() - 1;
                       unlisted += run[0].left_out;
                     } else {
                       contacts += results.extra(row).size();
                       unlisted += results.left_out(row);
                     }
                   }
                   block_first_[block] = contacts;
                   overlaps += overlapping;
                   undecided += unknown;
                   left_out += unlisted;
                 });
  overlaps_ += overlaps;
  undecided_ += undecided;
  left_out_ += left_out;
}

void ContactStage::read_decisions(const PairRange& range, const ResultBuffer& results,
                                  const WorldSettings& settings, PairHistory& now) {
  const uint32_t listed = has_contacts(settings.detail) ? 0xffffffffu : 0;
  std::atomic<size_t> overlaps{0}, undecided{0};
  for_each_block(range.end - range.begin, kPairsPerMergeBlock, settings.parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   const size_t first = range.begin + begin;
                   const uint8_t* const decision = results.overlaps_from(first);
                   uint32_t* const contact = now.contact.data() + first;
                   uint32_t overlapping = 0, unknown = 0;
                   for (size_t i = 0; i < end - begin; ++i) {
                     const bool overlap = decision[i] == 1;
                     // Zero, which is to be written, or none.
                     contact[i] = ~((0u - overlap) & listed);
                     overlapping += overlap;
                     unknown += decision[i] == kUndecided;
                   }
                   std::copy_n(decision, end - begin, now.overlaps.data() + first);
                   block_first_[block] = listed ? overlapping : 0;
                   overlaps += overlapping;
                   undecided += unknown;
                 });
  overlaps_ += overlaps;
  undecided_ += undecided;
}

void ContactStage::write_contacts(const PairRange& range, const CarryPlan& plan,
                                  const PairHistory& last, const ResultBuffer& results,
                                  const WorldSettings& settings, PairHistory& now) {
  const bool manifolds = has_manifolds(settings.detail);
  const bool regions = settings.detail == Detail::regions;
  const bool named = settings.identities;
  for_each_block(
      range.end - range.begin, kPairsPerMergeBlock, settings.parallelism,
      [&](size_t block, size_t begin, size_t end) {
        size_t next = block_first_[block];
        const size_t first_pair = range.begin + begin, pairs = end - begin;
        // Where nothing is carried over, contacts are written in lanes; then what belongs to them.
        const bool in_lanes = plan.tests_all() && !regions;
        if (in_lanes) {
          write_contact_rows(
              results.rows_of(std::span(now.pairs).subspan(first_pair, pairs), first_pair,
                              std::span(now.contact).subspan(first_pair, pairs)),
              next, now.contacts);
          if (!manifolds && !named) return;
        }
        std::array<uint32_t, kPairsPerMergeBlock> listed;
        const size_t count = list_contacts(now, first_pair, first_pair + pairs, listed);
        for (size_t k = 0; k < count; ++k) {
          const size_t i = listed[k];
          const uint32_t row = plan.test_row(i);
          const bool carried = row == CarryPlan::kCarried;
          const size_t old = carried ? last.contact[plan.last_index(i)] : 0;
          if (!in_lanes) {
            now.contacts[next] = carried ? last.contacts[old] : results.contact(row, now.pairs[i]);
          }
          if (manifolds) {
            now.manifolds[next] = carried ? last.manifolds[old] : results.manifold(row);
          }
          if (named) {
            now.identities[next].names = carried ? last.identities[old].names : results.names(row);
          }
          now.contact[i] = static_cast<uint32_t>(next++);
          if (!regions) continue;
          if (carried) {
            const size_t more = contact_run(last.contacts, old).size() - 1;
            for (size_t each = old + 1; each <= old + more; ++each) {
              now.contacts[next] = last.contacts[each];
              if (named) now.identities[next].names = last.identities[each].names;
              now.manifolds[next++] = last.manifolds[each];
            }
          } else {
            now.contacts[next - 1].left_out = results.left_out(row);
            for (const ContactWithPoints& each : results.extra(row)) {
              now.contacts[next] = each.contact;
              if (named) now.identities[next].names = each.names;
              now.manifolds[next++] = each.points;
            }
          }
        }
      });
}

void set_normal_velocities(BodyStore& bodies, Parallelism parallelism,
                           std::span<Contact> contacts) {
  using Eigen::Vector3f;
  constexpr size_t kContactsAhead = 16;
  const std::span<const Vector3f> linear = bodies.linear_velocities();
  const std::span<const Vector3f> angular =
      bodies.has_angular_velocities() ? bodies.angular_velocities() : std::span<Vector3f>();
  const auto velocity = [&](uint32_t body, const Vector3f& arm) -> Vector3f {
    const bool turns = !angular.empty() && bodies.turns(body) && !angular[body].isZero(0);
    if (!turns) return linear[body];
    return point_velocity(linear[body], angular[body], arm);
  };
  for_each_block(
      contacts.size(), kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
          // Bodies lie anywhere; the contacts themselves are in the cache.
          const Contact& ahead = contacts[std::min(i + kContactsAhead, end - 1)];
          __builtin_prefetch(&linear[ahead.b]);
          Contact& c = contacts[i];
          const Vector3f v = velocity(c.b, c.arm_b) - velocity(c.a, c.arm_a);
          c.normal_velocity = (v.x() * c.normal.x() + v.y() * c.normal.y()) + v.z() * c.normal.z();
        }
      });
}

}  // namespace carom
