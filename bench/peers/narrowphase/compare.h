// The comparisons of the kinds of streams, and what they share.
#pragma once

#include "bench/peers/narrowphase/comparison.h"
#include "bench/peers/narrowphase/turns.h"
#include "bench/support/pair_stream.h"
#include "carom/results/result_arrays.h"

namespace carom::bench {

StreamResult compare_pairs(const PeerStreamSpec& spec, size_t pairs, double budget);
StreamResult compare_on_terrain(const PeerStreamSpec& spec, size_t pairs, double budget);
StreamResult compare_meshes(const PeerStreamSpec& spec, size_t pairs, double budget);
StreamResult compare_motions(const PeerStreamSpec& spec, size_t pairs, double budget);

// Everything but difference and times. Bullet is the first library.
template <class Stream>
StreamResult describe(const PeerStreamSpec& spec, const Stream& stream, const Library& bullet) {
  return {.pair = spec.name(),
          .output = spec.output(),
          .pairs = stream.spec().count,
          .hit_percent = stream.hit_percent(),
          .wrong = "",
          .is_cast = spec.moving != Moving::no,
          .bullet = bullet.agreement,
          .runners = {}};
}

// Why Carom's results differ from its reference; empty if they do not.
template <class Stream>
std::string difference(const Stream& stream, Detail detail) {
  ResultArrays results(stream.spec().count, Detail::manifold);
  for (const Isa isa : usable_isas()) {
    force_isa(isa);
    spoil(results);
    if (const Result<void> done = stream.run(detail, results.columns()); !done) {
      return done.error().message;
    }
    if (const auto found = stream.difference(detail, results.columns())) {
      return std::string(name(isa)) + ": " + *found;
    }
  }
  return "";
}

}  // namespace carom::bench
