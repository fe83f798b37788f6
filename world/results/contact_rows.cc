// Columns become rows by transposing four of each. Whether a pair has a contact cannot be
// predicted: all pairs up to the last contact are written, and the next contact overwrites a pair
// that has none.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/results/contact_rows.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <cstddef>

#include "base/fetch_ahead.h"
#include "midphase/contact_of_row.h"
#include "simd/compress-inl.h"
#include "trees/box_rows-inl.h"
#include "world/pairs/pair_history.h"
#include "world/results/contact_rows.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

#if HWY_TARGET != HWY_SCALAR
using QuadOfInts = hn::FixedTag<uint32_t, 4>;
using Ints = hn::Vec<QuadOfInts>;

static_assert(offsetof(Contact, sub_a) == 8 && offsetof(Contact, normal) == 16 &&
              offsetof(Contact, separation) == 28 && offsetof(Contact, arm_a) == 32 &&
              offsetof(Contact, normal_velocity) == 44 && offsetof(Contact, arm_b) == 48 &&
              offsetof(Contact, status) == 60 && offsetof(Contact, manifold_count) == 61);

HWY_INLINE Ints load_or_zero(const uint32_t* column, size_t row) {
  const QuadOfInts tag;
  return column ? hn::LoadU(tag, column + row) : hn::Zero(tag);
}

HWY_INLINE Ints load_bytes(const uint8_t* column, size_t row) {
  const hn::FixedTag<uint8_t, 4> bytes;
  return hn::PromoteTo(QuadOfInts(), hn::LoadU(bytes, column + row));
}

// The last number of a contact: status, and how many points the manifold has.
HWY_INLINE RowOfFour load_marks(const ResultColumns& columns, size_t row) {
  Ints marks = load_bytes(columns.status, row);
  if (columns.manifold_count) {
    marks = hn::Or(marks, hn::ShiftLeft<8>(load_bytes(columns.manifold_count, row)));
  }
  return hn::BitCast(Quad(), marks);
}

// The four rows of four contacts: part[p][k] holds the numbers 4 p to 4 p + 3 of contact k.
struct FourContacts {
  RowOfFour part[4][4];

  HWY_INLINE void load(const PairRows& rows, size_t i) {
    const ResultColumns& columns = rows.columns;
    const size_t row = rows.first_row + i;
    load_indices(columns, row, &rows.pairs[i]);
    load_vector(columns.normal, row, hn::LoadU(Quad(), columns.separation + row), part[1]);
    load_vector(columns.point_a, row, hn::Zero(Quad()), part[2]);
    load_vector(columns.point_b, row, load_marks(columns, row), part[3]);
  }

  HWY_INLINE void store(size_t k, Contact& to) const {
    auto* const numbers = reinterpret_cast<float*>(&to);
    for (size_t p = 0; p < 4; ++p) hn::StoreU(part[p][k], Quad(), numbers + 4 * p);
  }

 private:
  HWY_INLINE void load_indices(const ResultColumns& columns, size_t row, const Pair* pairs) {
    const QuadOfInts tag;
    const auto* const indices = reinterpret_cast<const uint32_t*>(pairs);
    const Ints sub_a = load_or_zero(columns.sub_a, row), sub_b = load_or_zero(columns.sub_b, row);
    const Ints subs[2] = {hn::InterleaveLower(tag, sub_a, sub_b),
                          hn::InterleaveUpper(tag, sub_a, sub_b)};
    for (size_t half = 0; half < 2; ++half) {
      const Ints bodies = hn::LoadU(tag, indices + 4 * half);
      part[0][2 * half] = hn::BitCast(Quad(), hn::ConcatLowerLower(tag, subs[half], bodies));
      part[0][2 * half + 1] = hn::BitCast(Quad(), hn::ConcatUpperUpper(tag, subs[half], bodies));
    }
  }

  static HWY_INLINE void load_vector(const std::array<float*, 3>& columns, size_t row,
                                     RowOfFour fourth, RowOfFour (&out)[4]) {
    for (size_t axis = 0; axis < 3; ++axis) out[axis] = hn::LoadU(Quad(), columns[axis] + row);
    out[3] = fourth;
    transpose(out);
  }
};

size_t count_places(std::span<const uint32_t> contact) {
  const IndexTag tag;
  const Indices first_mark = hn::Set(tag, PairHistory::kSensor);
  size_t count = 0, i = 0;
  for (; i + kLanes <= contact.size(); i += kLanes) {
    count += hn::CountTrue(tag, hn::Lt(hn::LoadU(tag, contact.data() + i), first_mark));
  }
  for (; i < contact.size(); ++i) count += PairHistory::is_place(contact[i]);
  return count;
}
#endif  // HWY_TARGET

size_t write(const PairRows& rows, size_t next, std::span<Contact> contacts) {
  const std::span<uint32_t> contact = rows.contact;
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const size_t end = next + count_places(contact);
  for (; i + 4 <= contact.size() && next + 4 <= end; i += 4) {
    FourContacts four;
    four.load(rows, i);
    // The places of up to four contacts.
    for (size_t k = 0; k < 4; ++k) fetch_to_write(contacts.data() + next, kContactsAhead + k);
    for (size_t k = 0; k < 4; ++k) {
      uint32_t& place = contact[i + k];
      const bool has_one = PairHistory::is_place(place);
      four.store(k, contacts[next]);
      const uint32_t choice = 0u - has_one;  // a mask, since compilers make branches
      place = (static_cast<uint32_t>(next) & choice) | (place & ~choice);
      next += has_one;
    }
  }
#endif  // HWY_TARGET
  for (; i < contact.size(); ++i) {
    if (!PairHistory::is_place(contact[i])) continue;
    contacts[next] = contact_of_row(rows.columns, rows.first_row + i, rows.pairs[i]);
    contact[i] = static_cast<uint32_t>(next++);
  }
  return next;
}

// Places lie anywhere in the list.
void overwrite(const PairRows& rows, std::span<Contact> contacts) {
  const std::span<uint32_t> contact = rows.contact;
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  constexpr size_t kAhead = 16;
  Contact none;
  for (; i + 4 <= contact.size(); i += 4) {
    FourContacts four;
    four.load(rows, i);
    for (size_t k = 0; k < 4; ++k) {
      const uint32_t later = contact[std::min(i + kAhead + k, contact.size() - 1)];
      if (PairHistory::is_place(later)) fetch_to_write(contacts.data() + later, 0);
      const uint32_t place = contact[i + k];
      four.store(k, PairHistory::is_place(place) ? contacts[place] : none);
    }
  }
#endif  // HWY_TARGET
  for (; i < contact.size(); ++i) {
    if (!PairHistory::is_place(contact[i])) continue;
    contacts[contact[i]] = contact_of_row(rows.columns, rows.first_row + i, rows.pairs[i]);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(write);
HWY_EXPORT(overwrite);

}  // namespace

size_t write_contact_rows(const PairRows& rows, size_t next, std::span<Contact> contacts) {
  return CAROM_DISPATCH(write)(rows, next, contacts);
}

void overwrite_contact_rows(const PairRows& rows, std::span<Contact> contacts) {
  CAROM_DISPATCH(overwrite)(rows, contacts);
}

}  // namespace carom
#endif  // HWY_ONCE
