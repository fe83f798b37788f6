// The pairs of swept bodies -> contacts that may come into being before the interval ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/block_lists.h"
#include "carom/results/contact.h"
#include "world/motion/look_ahead.h"
#include "world/results/contact_stage.h"

namespace carom {

class SpeculativeStage {
 public:
  // Replaces the contacts by those of the step.
  void run(const LookAhead& ahead);

  // For a step without such contacts.
  void clear() { contacts_.clear(); }

  std::span<const Contact> contacts() const { return contacts_; }

  void give_back();
  size_t bytes() const;

 private:
  void find_candidates(const LookAhead& ahead);
  void measure(const LookAhead& ahead);

  BlockLists<Pair> pair_lists_;
  std::vector<Pair> pairs_;
  ResultBuffer results_;
  BlockLists<Contact> contact_lists_;
  std::vector<Contact> contacts_;
};

}  // namespace carom
