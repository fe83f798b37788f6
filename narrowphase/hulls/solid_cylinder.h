// The widest gaps between solids and cylinders, found in lanes: the features of one pair at a time,
// but the edges that need a search of many pairs together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "narrowphase/hulls/solid_cylinder_scalar.h"

namespace carom {

// Edges of a vector of pairs that wait for a search on the side of one cap.
struct WaitingEdges {
  static constexpr size_t kPairs = 16;
  static constexpr size_t kMost = 3 * Solid::kMostEdges;
  static constexpr size_t kPadding = 16;  // a vector is stored as a whole

  // The edge, in the low bits, the pair and, as the sign of a float, the cap.
  static constexpr int kPairBits = 16;
  std::array<uint32_t, kMost + kPadding> item;
  size_t count = 0;

  uint32_t edge(size_t i) const { return item[i] & 0xffff; }
  uint32_t pair(size_t i) const { return item[i] >> kPairBits & (kPairs - 1); }

  // Each pair has these. Numbers of cylinders: axis, middle, half length, rim.
  std::array<const Solid*, kPairs> solid;
  std::array<float, kPairs> scale;
  std::array<std::array<float, kPairs>, 8> cylinder;
};

// A pair, and what is found of it.
struct SolidCylinderPair {
  const Solid* solid;
  scalar::PlacedCylinder cylinder;
  bool is_blunt;
  scalar::SolidWay way;
  scalar::SolidContact contact;
  bool is_found;
};

// scalar::find_solid_contact() for a vector of pairs.
using FindSolidContacts = void (*)(SolidCylinderPair* pairs, size_t count);

// On the ISA in use. Takes no more pairs than a vector has lanes.
FindSolidContacts find_solid_contacts_in_lanes();

}  // namespace carom
