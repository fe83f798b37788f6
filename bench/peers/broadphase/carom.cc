// Carom's PairFinder with the method that it chooses itself.
#include "bench/peers/broadphase/peer.h"
#include "carom/base/thread_arena.h"
#include "carom/broadphase/find_pairs.h"

namespace carom::bench {
namespace {

template <int kThreads>
class CaromPeer final : public Peer {
 public:
  CaromPeer(const FrameBounds& /*first*/, const Box& /*world*/) {}

  void update(const FrameBounds& frame) override {
    bounds_.lower = frame.lower;
    bounds_.upper = frame.upper;
    bounds_.count = frame.boxes.size();
  }

  void find(std::vector<Pair>& pairs) override {
    arena_.run([&] {
      finder_.find(bounds_, {}, pairs, BroadphaseMethod::automatic, arena_.parallelism());
    });
  }

 private:
  ThreadArena arena_{kThreads};
  PairFinder finder_;
  BoundsView bounds_;
};

template <int kThreads>
std::unique_ptr<Peer> make(const FrameBounds& first, const Box& world) {
  return std::make_unique<CaromPeer<kThreads>>(first, world);
}

}  // namespace

std::vector<PeerKind> carom_kinds() {
  return {{"carom", 1, kAnyNumber, make<1>}, {"carom", 2, kAnyNumber, make<2>}};
}

}  // namespace carom::bench
