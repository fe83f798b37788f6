// The settings that are compared with each other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/pairs/pair_set.h"
#include "accuracy/tiers/answers.h"
#include "carom/results/tier.h"

namespace carom::accuracy {

// What a setting promises of its answers; each promise from `finite` on includes the ones before.
enum class Promise {
  none,      // another library
  finite,    // finite numbers, right or wrong
  standard,  // decisions right up to rounding, separations within the bound
  proven,    // and every given decision is right
  exact,     // and every pair gets a decision
};

class Contender {
 public:
  virtual ~Contender() = default;

  virtual const char* setting() const = 0;
  virtual const char* tier() const = 0;
  virtual Promise promise() const = 0;
  // Whether it supports these kinds; the fast tier: whether it changes their results.
  virtual bool serves(const KindPair& kinds) const = 0;
  // Preparation of the pairs that is not timed as part of run().
  virtual void prepare(const PairSet& /*pairs*/) {}
  virtual void run(const PairSet& pairs, Detail detail, Answers& out) = 0;
};

// A setting of the library.
class LibrarySetting final : public Contender {
 public:
  LibrarySetting(const char* setting, const char* tier, Promise promise, const Accuracy& accuracy)
      : setting_(setting), tier_(tier), promise_(promise), accuracy_(accuracy) {}

  const char* setting() const override { return setting_; }
  const char* tier() const override { return tier_; }
  Promise promise() const override { return promise_; }
  bool serves(const KindPair& kinds) const override;
  void run(const PairSet& pairs, Detail detail, Answers& out) override;

 private:
  const char* setting_;
  const char* tier_;
  Promise promise_;
  Accuracy accuracy_;
};

LibrarySetting standard_setting();
LibrarySetting certified_setting();
LibrarySetting exact_setting();
LibrarySetting single_precision_setting();

// All contenders that serve the kinds: the scalar reference, the tiers, and Bullet if
// the program was built with it.
std::vector<std::unique_ptr<Contender>> contenders_for(const KindPair& kinds);

}  // namespace carom::accuracy
