// Collects broken promises as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "accuracy/tiers/tally.h"

namespace carom::accuracy {

class Failures {
 public:
  // Notes the tally's count of broken promises and its examples, if there are any.
  void note(const std::string& where, const Tally& tally) {
    if (tally.broken == 0) return;
    const std::string share =
        " (" + std::to_string(tally.broken) + " of " + std::to_string(tally.pairs) + "): ";
    for (const std::string& example : tally.examples) texts_.push_back(where + share + example);
  }

  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

}  // namespace carom::accuracy
