// Overlaps of parts at detail manifold, pair after pair.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "narrowphase/merge_ref.h"

namespace carom {

class ContactRuns {
 public:
  void clear() {
    contacts_.clear();
    runs_.clear();
  }

  // Owners never descend. Of an owner that has very many the deepest are kept.
  void add(size_t owner, const PartContact& contact) {
    if (runs_.empty() || runs_.back().owner != owner) runs_.push_back({owner, contacts_.size()});
    contacts_.push_back(contact);
    const size_t first = runs_.back().first;
    if (contacts_.size() - first < 2 * kMostPartsOfManifold) return;
    contacts_.resize(first + deepest_of(std::span(contacts_).subspan(first)).size());
  }

  std::span<PartContact> of(size_t owner) {
    for (size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].owner != owner) continue;
      const size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : contacts_.size();
      return std::span(contacts_).subspan(runs_[i].first, end - runs_[i].first);
    }
    return {};
  }

  void forget_before(size_t owner) {
    if (runs_.empty() || runs_.back().owner < owner) return clear();
    const Run last = runs_.back();
    contacts_.erase(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(last.first));
    runs_.assign(1, {last.owner, 0});
  }

 private:
  struct Run {
    size_t owner;
    size_t first;
  };

  std::vector<PartContact> contacts_;
  std::vector<Run> runs_;
};

}  // namespace carom
