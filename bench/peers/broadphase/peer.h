// The interface of a broadphase in the comparison. Nothing here includes Eigen, because some
// including files have their own compiler flags.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "carom/results/pair.h"

namespace carom::bench {

// A closed box in the layout of recordings of bounds; the fourth components are zero.
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

// The boxes of a frame, both as an array of boxes and as six columns; every peer reads the form
// that suits it.
struct FrameBounds {
  std::span<const Box> boxes;
  std::array<const float*, 3> lower;
  std::array<const float*, 3> upper;
};

// A peer is made from the first frame. The time of a frame is update() plus find(): from new boxes
// to pairs. Peers that keep state get only the changed boxes, as from a user of the library. Peers
// with margins or quantised coordinates find too many pairs; overlap() tests these again, and the
// time counts because users need the test too.
class Peer {
 public:
  virtual ~Peer() = default;
  // Takes the next frame, with the same number of boxes; it is valid until the next call.
  virtual void update(const FrameBounds& frame) = 0;
  // Replaces `pairs` by the pairs of closed boxes that overlap, each once, in any order.
  virtual void find(std::vector<Pair>& pairs) = 0;
};

struct PeerKind {
  const char* name;
  int threads;
  size_t most_bodies;  // more take minutes or do not fit into memory
  std::unique_ptr<Peer> (*make)(const FrameBounds& first, const Box& world);
};

inline constexpr size_t kAnyNumber = ~size_t{0};

// The peer whose time the others are compared with.
inline constexpr char kYardstick[] = "cgal";

// Each is defined in NAME.cc.
std::vector<PeerKind> carom_kinds();
std::vector<PeerKind> cgal_kinds();
std::vector<PeerKind> bullet_kinds();
std::vector<PeerKind> fcl_kinds();
std::vector<PeerKind> ode_kinds();

}  // namespace carom::bench
