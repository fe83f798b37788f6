// Collects the contacts of overlapping parts at detail manifold, pair after pair.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "narrowphase/manifolds/merge.h"

namespace carom {

class ContactRuns {
 public:
  void clear() {
    contacts_.clear();
    runs_.clear();
  }

  // `owner` never decreases from call to call. If an owner has very many contacts, only the deepest
  // are kept.
  void add(size_t owner, const PartContact& contact) {
    if (runs_.empty() || runs_.back().owner != owner) runs_.push_back({owner, contacts_.size(), 0});
    contacts_.push_back(contact);
    const size_t first = runs_.back().first;
    if (contacts_.size() - first < 2 * kMostPartsOfManifold) return;
    runs_.back().dropped += static_cast<uint32_t>(contacts_.size());
    contacts_.resize(first + deepest_of(std::span(contacts_).subspan(first)).size());
    runs_.back().dropped -= static_cast<uint32_t>(contacts_.size());
  }

  std::span<PartContact> of(size_t owner) {
    const auto run = find(owner);
    if (run == runs_.end()) return {};
    const size_t end = run + 1 == runs_.end() ? contacts_.size() : run[1].first;
    return std::span(contacts_).subspan(run->first, end - run->first);
  }

  // How many contacts of the owner were not kept.
  uint32_t dropped(size_t owner) const {
    const auto run = find(owner);
    return run == runs_.end() ? 0 : run->dropped;
  }

  void forget_before(size_t owner) {
    if (runs_.empty() || runs_.back().owner < owner) return clear();
    const Run last = runs_.back();
    contacts_.erase(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(last.first));
    runs_.assign(1, {last.owner, 0, last.dropped});
  }

 private:
  struct Run {
    size_t owner;
    size_t first;
    uint32_t dropped;
  };

  std::vector<Run>::const_iterator find(size_t owner) const {
    const auto run = std::lower_bound(runs_.begin(), runs_.end(), owner,
                                      [](const Run& r, size_t o) { return r.owner < o; });
    return run != runs_.end() && run->owner == owner ? run : runs_.end();
  }

  std::vector<PartContact> contacts_;
  std::vector<Run> runs_;
};

}  // namespace carom
