// CGAL: box_self_intersection_d(), a stateless hybrid of sweep and segment tree.
#include <CGAL/box_intersection_d.h>

#include "bench/peers/broadphase/peer.h"

namespace carom::bench {
namespace {

constexpr std::ptrdiff_t kCutoff = 64;

struct IndexedBox {
  std::array<float, 3> lower;
  std::array<float, 3> upper;
  uint32_t index;
};

struct BoxTraits {
  using Box_parameter = const IndexedBox&;
  using NT = float;
  using ID = uint32_t;

  static NT min_coord(Box_parameter box, int axis) { return box.lower[static_cast<size_t>(axis)]; }
  static NT max_coord(Box_parameter box, int axis) { return box.upper[static_cast<size_t>(axis)]; }
  static ID id(Box_parameter box) { return box.index; }
  static int dimension() { return 3; }
};

class CgalPeer final : public Peer {
 public:
  void update(const FrameBounds& frame) override {
    boxes_.resize(frame.boxes.size());
    for (uint32_t i = 0; i < boxes_.size(); ++i) {
      const auto& [lower, upper] = frame.boxes[i];
      boxes_[i] = {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}, i};
    }
  }

  // Boxes are closed; every pair is found once.
  void find(std::vector<Pair>& pairs) override {
    pairs.clear();
    const auto collect = [&](const IndexedBox& a, const IndexedBox& b) {
      pairs.push_back({a.index, b.index});
    };
    CGAL::box_self_intersection_d(boxes_.begin(), boxes_.end(), collect, BoxTraits(), kCutoff,
                                  CGAL::Box_intersection_d::CLOSED);
  }

 private:
  std::vector<IndexedBox> boxes_;
};

}  // namespace

std::vector<PeerKind> cgal_kinds() {
  return {{kYardstick, 1, kAnyNumber,
           [](const FrameBounds& /*first*/, const Box& /*world*/) -> std::unique_ptr<Peer> {
             return std::make_unique<CgalPeer>();
           }}};
}

}  // namespace carom::bench
