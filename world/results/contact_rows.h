// Rows of results -> contacts, four pairs at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/result_columns.h"

namespace carom {

// Contacts and manifolds are asked for in the cache so long before they are written: 4 KiB of
// either.
inline constexpr size_t kContactsAhead = 64;

// Pairs that follow one another, with their results in as many rows of the columns, and what each
// has: PairHistory::contact.
struct PairRows {
  const ResultColumns& columns;
  size_t first_row;
  std::span<const Pair> pairs;
  std::span<uint32_t> contact;
};

// Writes the first contact of each pair that has one, as contact_of_row() makes it, to
// contacts[next] and behind, and notes its place in `contact`. Returns the place after the last
// one.
size_t write_contact_rows(const PairRows& rows, size_t next, std::span<Contact> contacts);

// Writes the first contact of each pair that has one to the place that `contact` says.
void overwrite_contact_rows(const PairRows& rows, std::span<Contact> contacts);

}  // namespace carom
