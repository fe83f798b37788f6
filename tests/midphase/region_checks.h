// All contacts of pairs, and their comparison with those of the reference.
#pragma once

#include <span>

#include "carom/results/result_arrays.h"
#include "carom/results/result_row.h"
#include "tests/support/run.h"

namespace carom::test {

struct Listed {
  ContactRegions regions;
  ResultArrays rows;
};

Listed list_contacts(std::span<const TestPair> pairs, PositionType positions,
                     const CollideOptions& asked);

// How many pairs had several contacts, and how many contacts were left out.
struct RegionCounts {
  size_t several = 0, left_out = 0;
};

// `options` are those of the call that listed the contacts.
void expect_reference_contacts(std::span<const TestPair> pairs, PositionType positions,
                               const ContactRegions& got, const CollideOptions& options,
                               RegionCounts& counts);

}  // namespace carom::test
