// Runs one verifier on every engine until results differ.
#pragma once

#include <string>
#include <utility>

#include "cli/support/console.h"
#include "cli/support/progress.h"
#include "cli/verify/verify_outcome.h"

namespace carom::cli {

// The names of the variants, joined for "compared: ...".
template <class Variants>
std::string compared_text(const Variants& variants) {
  std::string text;
  for (const auto& variant : variants) {
    text += (text.empty() ? "" : ", ") + std::string(variant.name);
  }
  return text;
}

// `Verifier::verify(row, progress)` returns false at a difference; take_difference() then returns
// it.
template <class Verifier, class Variants>
Result<VerifyOutcome> verify_engines(Verifier verifier, const Variants& variants,
                                     const Engines& engines, const std::string& source,
                                     const Console& console) {
  VerifyOutcome outcome{source, compared_text(variants), {}, {}};
  Progress progress(console, source + ": run", engines.list().size() * variants.size());
  for (const Engine& engine : engines.list()) {
    outcome.rows.push_back({.engine = engine, .frames = 1});
    Result<bool> same = verifier.verify(outcome.rows.back(), progress);
    unforce_isa();
    if (!same) return Error{source + ": " + same.error().message};
    if (!*same) break;
  }
  outcome.difference = verifier.take_difference();
  return outcome;
}

}  // namespace carom::cli
