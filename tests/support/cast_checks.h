// Casts by brute force: time_of_impact() of every query with every body.
#pragma once

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "carom/impacts/time_of_impact.h"
#include "carom/queries/cast.h"
#include "tests/support/query_bodies.h"

namespace carom::test {

struct Sweeps {
  std::vector<Eigen::Vector3f> displacement, rotation;

  SweepView view() const;
};

// Sweeps of up to `length`; some are zero, along an axis, far too long, or not valid.
Sweeps make_sweeps(size_t count, double length, bool turn, uint64_t seed);

// The hits in the order of cast().
std::vector<CastHit> brute_force(const Collidables& queries, const SweepView& sweep,
                                 const Collidables& bodies, const std::vector<Pair>& pairs);

std::vector<CastHit> closest_of(const std::vector<CastHit>& all);

// The bytes of all hits, without padding.
std::string bits_of(const std::vector<CastHit>& hits);

std::string show(const std::vector<CastHit>& hits, const std::vector<CastHit>& expected);

}  // namespace carom::test
