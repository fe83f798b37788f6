#include "carom/broadphase/find_pairs.h"

#include <algorithm>
#include <array>

#include "broadphase/box_columns.h"
#include "broadphase/scan.h"
#include "broadphase/sort_pairs.h"
#include "broadphase/sweep_order.h"
#include "kernel/block_lists.h"
#include "kernel/float_environment.h"

namespace carom {
namespace {

constexpr size_t kRowsPerBlock = 256;

// Below this count every box against every other is as fast as sorting.
constexpr size_t kBruteForceLimit = 128;

// Turns hits into pairs of bodies that may meet.
class PairSink final : public HitSink {
 public:
  PairSink(const BoxColumns& columns, const PairFilter& filter, std::vector<Pair>& out)
      : columns_(columns), filter_(filter), out_(out) {}

  void add(size_t box_row, const uint32_t* rows, size_t count) override {
    const uint32_t body = columns_.body[box_row];
    for (size_t i = 0; i < count; ++i) {
      const uint32_t other = columns_.body[rows[i]];
      if (may_meet(body, other)) out_.push_back({std::min(body, other), std::max(body, other)});
    }
  }

 private:
  bool may_meet(uint32_t a, uint32_t b) const {
    const PairFilter& f = filter_;
    if (f.motion && f.motion[a] == Motion::fixed && f.motion[b] == Motion::fixed) return false;
    if (f.layer && (!(f.layer[a] & f.mask[b]) || !(f.layer[b] & f.mask[a]))) return false;
    return !f.owner || f.owner[a] == 0 || f.owner[a] != f.owner[b];
  }

  const BoxColumns& columns_;
  const PairFilter& filter_;
  std::vector<Pair>& out_;
};

}  // namespace

const char* name(BroadphaseMethod method) {
  static constexpr std::array<const char*, 3> kNames = {"auto", "brute", "sweep"};
  return kNames[static_cast<size_t>(method)];
}

struct PairFinder::State {
  SweepOrder order;
  BoxColumns columns;
  BlockLists<Pair> found;
  PairSorter sorter;
  BroadphaseMethod last_method = BroadphaseMethod::automatic;

  void order_for_brute_force(const BoundsView& bounds) {
    order.forget();
    columns.body.clear();
    for (size_t i = 0; i < bounds.count; ++i) {
      if (takes_part(bounds, i)) columns.body.push_back(static_cast<uint32_t>(i));
    }
  }

  void find(const BoundsView& bounds, const PairFilter& filter, std::vector<Pair>& out,
            BroadphaseMethod method, Parallelism parallelism) {
    const bool sweep = method == BroadphaseMethod::sweep;
    const size_t axis = sweep ? axis_of_largest_spread(bounds) : 0;
    if (sweep) {
      order.update(bounds, axis, parallelism, columns.body);
    } else {
      order_for_brute_force(bounds);
    }
    columns.fill(bounds, axis, parallelism);
    found.reset(block_count(columns.count, kRowsPerBlock));
    for_each_block(columns.count, kRowsPerBlock, parallelism,
                   [&](size_t block, size_t begin, size_t end) {
                     PairSink sink(columns, filter, found[block]);
                     (sweep ? sweep_rows : test_rows)(columns, begin, end, sink);
                   });
    if (sweep) {
      sorter.sort(found, bounds.count, parallelism, out);
    } else {
      found.concatenate(out, parallelism);  // sorted as found: rows ascend by body
    }
  }
};

PairFinder::PairFinder() : state_(std::make_unique<State>()) {}
PairFinder::~PairFinder() = default;
PairFinder::PairFinder(PairFinder&&) noexcept = default;
PairFinder& PairFinder::operator=(PairFinder&&) noexcept = default;

void PairFinder::find(const BoundsView& bounds, const PairFilter& filter, std::vector<Pair>& out,
                      BroadphaseMethod method, Parallelism parallelism) {
  const FloatEnvironment environment;
  if (method == BroadphaseMethod::automatic) {
    method = bounds.count <= kBruteForceLimit ? BroadphaseMethod::brute : BroadphaseMethod::sweep;
  }
  state_->last_method = method;
  state_->find(bounds, filter, out, method, parallelism);
}

void PairFinder::forget() { state_->order.forget(); }

BroadphaseMethod PairFinder::last_method() const { return state_->last_method; }

size_t PairFinder::bytes() const {
  return state_->order.bytes() + state_->columns.bytes() + state_->found.bytes() +
         state_->sorter.bytes();
}

size_t find_pairs(const BoundsView& bounds, const PairFilter& filter, std::span<Pair> out,
                  BroadphaseMethod method, Parallelism parallelism) {
  PairFinder finder;
  std::vector<Pair> pairs;
  finder.find(bounds, filter, pairs, method, parallelism);
  if (pairs.size() <= out.size()) std::copy(pairs.begin(), pairs.end(), out.begin());
  return pairs.size();
}

}  // namespace carom
