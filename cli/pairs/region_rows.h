// The contacts of pairs as the arrays of a file.
#pragma once

#include "carom/results/contact_regions.h"
#include "cli/pairs/pair_set.h"
#include "io/region_arrays.h"

namespace carom::cli {

// `regions`: those of the rows of `pairs`.
io::RegionArrays region_arrays(const ContactRegions& regions, const PairSet& pairs);

}  // namespace carom::cli
