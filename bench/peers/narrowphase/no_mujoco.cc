// In place of mujoco.cc where MuJoCo is not installed.
#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {

std::unique_ptr<PairPeer> make_mujoco_pairs(const PeerBodies& /*a*/, const PeerBodies& /*b*/,
                                            PeerDetail /*detail*/) {
  return nullptr;
}

}  // namespace carom::bench
