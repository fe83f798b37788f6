#include "queries/query_rounds.h"

#include <algorithm>
#include <utility>

#include "base/block_lists.h"
#include "queries/query_filter.h"
#include "shapes/body_reader.h"

namespace carom {
namespace {

constexpr size_t kQueriesPerBlock = 64;

bool may_reach(const MovingBox& moving, const WorldHalfspace& halfspace) {
  const TreeBox box = moving.swept();
  std::array<double, 3> lowest;
  for (size_t axis = 0; axis < 3; ++axis) {
    lowest[axis] = halfspace.normal[axis] >= 0 ? box.lower[axis] : box.upper[axis];
  }
  return may_hold(halfspace, lowest[0], lowest[1], lowest[2]);
}

class Rounds {
 public:
  Rounds(QueryBoxes& queries, const SearchedBodies& bodies, SearchFor what, size_t first,
         std::span<const float> limit, Parallelism parallelism, SearchMemory& memory)
      : queries_(queries),
        bodies_(bodies),
        what_(what),
        first_(first),
        limit_(limit),
        parallelism_(parallelism),
        searches_(memory) {}

  Result<void> run(RoundSizes sizes, TestCandidates test) {
    start();
    size_t most = sizes.first;
    for (bool first = true; count_ > 0; first = false) {
      for_each_search([&](QuerySearch& search, std::vector<Pair>& found) {
        if (first) find_halfspaces(search, found);
        find(search, most, found);
      });
      most = std::min(2 * most, sizes.most);
      if (Result<void> tested = test_all(test); !tested) return tested;
      drop_done();
    }
    return {};
  }

 private:
  void start() {
    queries_.find(first_, limit_.size(), parallelism_);
    for (size_t i = 0; i < limit_.size(); ++i) {
      if (count_ == searches_.size()) searches_.emplace_back();
      QuerySearch& search = searches_[count_];
      if (!queries_.set_box(first_ + i, search.box)) continue;
      ++count_;
      search.query = static_cast<uint32_t>(first_ + i);
      search.walk.start(bodies_.index.tree());
    }
  }

  // Keeps the order of the others, and the memory of all.
  void drop_done() {
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i) {
      if (searches_[i].walk.is_done()) continue;
      if (kept != i) std::swap(searches_[kept], searches_[i]);
      ++kept;
    }
    count_ = kept;
  }

  template <class Find>
  void for_each_search(const Find& find) {
    found_.reset(block_count(count_, kQueriesPerBlock));
    for_each_block(count_, kQueriesPerBlock, parallelism_,
                   [&](size_t block, size_t begin, size_t end) {
                     std::vector<Pair>& found = found_[block];
                     for (size_t i = begin; i < end; ++i) find(searches_[i], found);
                     ask_predicate(bodies_.filter, found);
                   });
  }

  void find_halfspaces(const QuerySearch& search, std::vector<Pair>& found) const {
    const BodyReader reader{queries_.queries()};
    if (reader.kind(search.query) == ShapeKind::halfspace) return;
    for (const WorldHalfspace& halfspace : bodies_.index.halfspaces()) {
      const bool reaches = what_ == SearchFor::near || may_reach(search.box, halfspace);
      const Pair candidate = {search.query, halfspace.body};
      if (reaches && keeps(bodies_.filter, candidate)) found.push_back(candidate);
    }
  }

  void find(QuerySearch& search, size_t most, std::vector<Pair>& found) const {
    static thread_local std::vector<uint32_t> items;
    items.clear();
    const float limit = limit_[search.query - first_];
    const BoxTree& tree = bodies_.index.tree();
    if (what_ == SearchFor::met) {
      walk_met(tree, search.box, limit, most, search.walk, items);
    } else {
      walk_near(tree, search.box.box, limit, most, search.walk, items);
    }
    for (const uint32_t body : items) {
      const Pair candidate = {search.query, body};
      if (keeps(bodies_.filter, candidate)) found.push_back(candidate);
    }
  }

  Result<void> test_all(TestCandidates test) {
    found_.concatenate(candidates_, parallelism_);
    return candidates_.empty() ? Result<void>{} : test(candidates_);
  }

  QueryBoxes& queries_;
  const SearchedBodies& bodies_;
  const SearchFor what_;
  const size_t first_;
  const std::span<const float> limit_;
  const Parallelism parallelism_;
  SearchMemory& searches_;  // the first count_ are in use
  size_t count_ = 0;
  BlockLists<Pair> found_;
  std::vector<Pair> candidates_;
};

}  // namespace

Result<void> search_in_rounds(QueryBoxes& queries, const SearchedBodies& bodies, SearchFor what,
                              RoundSizes sizes, size_t first, std::span<const float> limit,
                              Parallelism parallelism, SearchMemory& memory, TestCandidates test) {
  return Rounds(queries, bodies, what, first, limit, parallelism, memory).run(sizes, test);
}

}  // namespace carom
