/// @file
/// A rule of the caller on which pairs are kept.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "carom/results/pair.h"

namespace carom {

/// Drops pairs. Called with a span of candidate pairs, at least one and at most some thousands,
/// sorted by (a, b), and as many flags, which are all 1: writes 0 for each pair to drop. It is
/// asked last, about pairs that all other filters allow. Calls come from any thread of the search,
/// several at once. The answer for a pair must depend on the pair alone, so that results are the
/// same for any number of threads. Must not throw.
using PairPredicate = std::function<void(std::span<const Pair> pairs, std::span<uint8_t> keep)>;

}  // namespace carom
