#include "accuracy/pairs/pair_set.h"

#include <utility>

namespace carom::accuracy {
namespace {

std::vector<ConvexPair> as_stored(std::vector<ConvexPair> pairs, PositionType positions) {
  if (positions == PositionType::float64) return pairs;
  for (ConvexPair& pair : pairs) {
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
      pose->position = pose->position.cast<float>().cast<double>().eval();
    }
  }
  return pairs;
}

std::vector<Placed> side_a(const std::vector<ConvexPair>& pairs) {
  std::vector<Placed> bodies;
  for (const ConvexPair& pair : pairs) bodies.push_back({pair.shape_a, pair.pose_a});
  return bodies;
}

std::vector<Placed> side_b(const std::vector<ConvexPair>& pairs) {
  std::vector<Placed> bodies;
  for (const ConvexPair& pair : pairs) bodies.push_back({pair.shape_b, pair.pose_b});
  return bodies;
}

}  // namespace

PairSet::PairSet(std::vector<ConvexPair> pairs, PositionType positions)
    : pairs_(as_stored(std::move(pairs), positions)),
      positions_(positions),
      a_(side_a(pairs_), positions),
      b_(side_b(pairs_), positions) {}

}  // namespace carom::accuracy
