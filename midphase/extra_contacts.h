// The contacts that pairs of bodies have beside their first one, at Detail::regions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "carom/results/contact.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {

struct ContactWithPoints {
  Contact contact;  // the caller of the narrow phase sets a and b
  ManifoldPoints points;
  PointNames names;  // zero unless they are asked for
};

// The contacts of one pair. Threads may add to pairs of different blocks at the same time.
class ExtraContacts {
 public:
  // Prepares for `pairs` pairs, of which none has any.
  void prepare(size_t pairs) {
    runs_.assign(pairs, {});
    // Lists that are not needed now keep their memory for the next call.
    const size_t blocks = (pairs + kPairsPerBlock - 1) / kPairsPerBlock;
    if (lists_.size() < blocks) lists_.resize(blocks);
    for (auto& list : lists_) list.clear();
  }
  // Without pairs: of() and left_out() then say that no pair has any.
  void clear() { runs_.clear(); }

  // Begins the contacts of a pair. `left_out`: see Contact.
  void begin(size_t pair, uint16_t left_out) {
    runs_[pair] = {static_cast<uint32_t>(lists_[pair / kPairsPerBlock].size()), 0, left_out};
  }
  // Adds a contact to the pair that was begun last in its block.
  void add(size_t pair, const ContactWithPoints& contact) {
    lists_[pair / kPairsPerBlock].push_back(contact);
    ++runs_[pair].count;
  }

  std::span<const ContactWithPoints> of(size_t pair) const {
    if (pair >= runs_.size()) return {};
    return std::span(lists_[pair / kPairsPerBlock]).subspan(runs_[pair].first, runs_[pair].count);
  }
  uint16_t left_out(size_t pair) const { return pair < runs_.size() ? runs_[pair].left_out : 0; }

  size_t bytes() const {
    size_t bytes = runs_.capacity() * sizeof(Run) + lists_.capacity() * sizeof(lists_[0]);
    for (const auto& list : lists_) bytes += list.capacity() * sizeof(ContactWithPoints);
    return bytes;
  }

 private:
  struct Run {
    uint32_t first = 0;
    uint16_t count = 0;
    uint16_t left_out = 0;
  };

  std::vector<Run> runs_;                              // one a pair
  std::vector<std::vector<ContactWithPoints>> lists_;  // one a block
};

// What to find beside the first contact of each pair.
struct ExtraRequest {
  ExtraContacts* found = nullptr;  // nullptr: nothing
  RegionLimits limits;
};

}  // namespace carom
