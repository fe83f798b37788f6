// Compares the answers of a library with Carom's.
#pragma once

#include <span>
#include <vector>

#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/mesh_stream.h"
#include "bench/support/motion_stream.h"
#include "bench/support/pair_stream.h"

namespace carom::bench {

// Carom's answer for a pair; errors are shares of the mean bounding radius.
struct Truth {
  float separation;
  double radius;
};

double mean_radius(const PlacedShape& a, const PlacedShape& b);

std::vector<Truth> truths_of(const PairStream& stream);
std::vector<Truth> truths_of(const MeshStream& stream);
// Separations below zero stand for impacts. The radius is 0, so that no pair is too near touch.
std::vector<Truth> truths_of(const MotionStream& stream);

// How a library's answers compare with Carom's.
struct Agreement {
  size_t pairs = 0;
  size_t excluded = 0;   // pairs too near touch for a decision to be compared
  size_t different = 0;  // of the others, those that it decides otherwise
  size_t measured = 0;   // pairs for which it reports a separation or depth
  double median_error = 0;
  double worst_error = 0;
};

Agreement agreement(std::span<const Truth> truths, const PairAnswers& answers);

}  // namespace carom::bench
