// What a broadphase has to do to be compared. Nothing here includes Eigen: some of the files that
// include this one have compiler flags of their own.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "carom/results/pair.h"

namespace carom::bench {

// A closed box, laid out as recordings of bounds store it; the fourth components are zero.
struct Box {
  std::array<float, 4> lower;
  std::array<float, 4> upper;

  friend bool operator==(const Box&, const Box&) = default;
};

inline bool overlap(const Box& a, const Box& b) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  }
  return true;
}

// The boxes of a frame twice, as an array of boxes and as six columns: every peer reads what suits
// it.
struct FrameBounds {
  std::span<const Box> boxes;
  std::array<const float*, 3> lower;
  std::array<const float*, 3> upper;
};

// Made from the first frame. The time of a frame is that of update() and find(): from new boxes to
// pairs. Peers that keep state are told of the boxes that changed alone, as their users would do.
// Those that yield too many pairs, because they keep margins or quantise, have each pair tested
// again with overlap(): their users need that, too, so it counts.
class Peer {
 public:
  virtual ~Peer() = default;
  // The next frame, of as many boxes; valid until the next call.
  virtual void update(const FrameBounds& frame) = 0;
  // Replaces `pairs` by the pairs of closed boxes that overlap, each once, in any order.
  virtual void find(std::vector<Pair>& pairs) = 0;
};

struct PeerKind {
  const char* name;
  int threads;
  size_t most_bodies;  // with more it takes minutes or does not fit into memory
  std::unique_ptr<Peer> (*make)(const FrameBounds& first, const Box& world);
};

inline constexpr size_t kAnyNumber = ~size_t{0};

// The yardstick.
inline constexpr char kYardstick[] = "cgal";

// NAME.cc
std::vector<PeerKind> carom_kinds();
std::vector<PeerKind> cgal_kinds();
std::vector<PeerKind> bullet_kinds();
std::vector<PeerKind> fcl_kinds();
std::vector<PeerKind> ode_kinds();

}  // namespace carom::bench
