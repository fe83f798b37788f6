// Writes what was found of the parts of two bodies as the results of the bodies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/results/pair.h"
#include "midphase/extra_contacts.h"
#include "midphase/outcome.h"
#include "narrowphase/blocks/pair_block.h"
#include "narrowphase/manifolds/merge.h"
#include "shapes/body_reader.h"

namespace carom {

// A pair of bodies whose parts have been tested.
struct TestedPair {
  size_t row;  // of the block
  Pair pair;
  const Outcome& outcome;
  bool is_contact;                  // it overlaps, or is near enough for a contact
  std::span<PartContact> contacts;  // those of its parts, where there are manifolds
  uint32_t dropped;                 // how many contacts of parts there were beside them
};

class CompositeResults {
 public:
  CompositeResults(const PairBlock& block, const ExtraRequest& extra, RegionMerger& merger)
      : block_(block), extra_(extra), merger_(merger), a_{block.a}, b_{block.b} {}

  // Fills the row of all columns that are there, and adds the other contacts of the pair to the
  // extra ones.
  void write(const TestedPair& tested);

 private:
  void write_manifold(const TestedPair& tested);
  MergedManifold first_region(const TestedPair& tested);
  ContactWithPoints contact_of_region(Pair pair, const PartRegion& region) const;
  PointNames names_of(Pair pair, const MergedManifold& manifold) const;
  std::array<float, 3> in_frame(const BodyReader& reader, size_t body,
                                const std::array<float, 3>& arm) const;

  const PairBlock& block_;
  const ExtraRequest& extra_;
  RegionMerger& merger_;
  const BodyReader a_, b_;
};

}  // namespace carom
