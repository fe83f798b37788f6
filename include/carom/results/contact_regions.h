/// @file
/// All contacts of pairs that stateless calls test.
#pragma once

#include <cstdint>
#include <vector>

#include "carom/results/contact.h"

namespace carom {

/// The contacts of a list of pairs at Detail::regions, pair after pair, the deepest first.
struct ContactRegions {
  std::vector<uint64_t> first;    ///< contacts first[i] to first[i + 1] - 1 are those of pair i
  std::vector<Contact> contacts;  ///< a and b: the indices in the pair
  /// One a contact; points are relative to the position of A, world axes.
  std::vector<ManifoldPoints> manifolds;
  /// One a contact, if ResultColumns::point_names was asked for, else none.
  std::vector<PointNames> point_names;
};

}  // namespace carom
