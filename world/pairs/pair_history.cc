#include "world/pairs/pair_history.h"

#include "world/store/columns.h"

namespace carom {

void PairHistory::clear() {
  pairs.clear();
  overlaps.clear();
  contact.clear();
  direction.clear();
  holds_until.clear();
  clear_contacts();
}

void PairHistory::clear_contacts() {
  contacts.clear();
  manifolds.clear();
  identities.clear();
}

void PairHistory::give_back() {
  carom::give_back(pairs, overlaps, contact, direction, holds_until, contacts, manifolds,
                   identities);
}

size_t PairHistory::bytes() const {
  return bytes_of(pairs) + bytes_of(overlaps) + bytes_of(contact) + bytes_of(direction) +
         bytes_of(holds_until) + bytes_of(contacts) + bytes_of(manifolds) + bytes_of(identities);
}

MergeRange matching_range(const std::vector<Pair>& last, const std::vector<Pair>& now, size_t begin,
                          size_t end) {
  const auto place = [&](size_t i) -> size_t {
    return std::lower_bound(last.begin(), last.end(), now[i]) - last.begin();
  };
  return {begin == 0 ? 0 : place(begin), end == now.size() ? last.size() : place(end)};
}

}  // namespace carom
