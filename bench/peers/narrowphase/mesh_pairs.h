// Pairs of bumpy balls, meshes of 10,000 triangles; half of them touch, each over some 35.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/narrowphase/answers.h"
#include "bench/peers/narrowphase/pair_peer.h"
#include "bench/support/bodies.h"
#include "carom/base/result.h"

namespace carom::bench {

class MeshPairs {
 public:
  struct Spec {
    size_t count = 0;
  };

  explicit MeshPairs(const Spec& spec);

  const Spec& spec() const { return spec_; }
  double hit_percent() const { return 50; }
  const std::vector<Truth>& truths() const { return truths_; }
  PeerBodies peer_a() const { return peer_meshes(bodies_a_); }
  PeerBodies peer_b() const { return peer_meshes(bodies_b_); }

  // Runs one pass.
  Result<void> run(Detail detail, const ResultColumns& out,
                   Measured measured = Measured::all) const;
  // Why the bits of the instruction sets differ; empty if they do not. The reference would try a
  // hundred million pairs of triangles.
  std::string difference(Detail detail) const;

 private:
  void draw_some(oracle::Random& random, std::array<size_t, 2>& left);
  PeerBodies peer_meshes(const std::vector<PlacedShape>& bodies) const;

  Spec spec_;
  std::shared_ptr<const MeshGeometry> ball_;
  std::vector<PlacedShape> bodies_a_, bodies_b_;
  std::unique_ptr<DenseBodies> a_, b_;
  std::vector<Truth> truths_;
};

}  // namespace carom::bench
