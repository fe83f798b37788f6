#include "accuracy/tiers/effort.h"

#include "accuracy/pairs/round_pair.h"

namespace carom::accuracy {

Effort effort_for(const KindPair& kinds, bool is_long) {
  constexpr Effort kShort = {.stream = 20'000,
                             .family = 160,
                             .gap = 80,
                             .distance = 200,
                             .angle = 150,
                             .scene = 50'000,
                             .rounds = 7};
  constexpr Effort kLong = {.stream = 100'000,
                            .family = 4'500,
                            .gap = 1'000,
                            .distance = 2'000,
                            .angle = 2'000,
                            .scene = 200'000,
                            .rounds = 15};
  constexpr Effort kShortPolytopes = {.stream = 2'000,
                                      .family = 16,
                                      .gap = 8,
                                      .distance = 20,
                                      .angle = 16,
                                      .scene = 2'000,
                                      .rounds = 5};
  constexpr Effort kLongPolytopes = {.stream = 10'000,
                                     .family = 250,
                                     .gap = 60,
                                     .distance = 100,
                                     .angle = 100,
                                     .scene = 20'000,
                                     .rounds = 7};
  // Random pairs alone; the oracle takes milliseconds for one.
  constexpr Effort kShortRound = {
      .stream = 60, .family = 0, .gap = 0, .distance = 0, .angle = 0, .scene = 0, .rounds = 5};
  constexpr Effort kLongRound = {
      .stream = 1'000, .family = 0, .gap = 0, .distance = 0, .angle = 0, .scene = 0, .rounds = 7};
  if (has_round(kinds)) return is_long ? kLongRound : kShortRound;
  if (oracle::is_slow(kinds)) return is_long ? kLongPolytopes : kShortPolytopes;
  return is_long ? kLong : kShort;
}

}  // namespace carom::accuracy
