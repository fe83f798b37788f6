#include "world/results/identity_stage.h"

#include <cmath>
#include <vector>

namespace carom {
namespace {

// Points that continue each other are no further apart than this share of the shorter arm.
constexpr float kSamePointShare = 0.25f;

size_t point_count(const PairHistory& history, size_t contact) {
  return history.manifolds.empty() ? 1 : history.contacts[contact].manifold_count;
}

Eigen::Vector3f point_at(const PairHistory& history, size_t contact, size_t k) {
  if (history.manifolds.empty()) return history.contacts[contact].arm_a;
  const std::array<float, 3>& p = history.manifolds[contact].point[k];
  return {p[0], p[1], p[2]};
}

ContactIdentity without_previous(const PointNames& names) {
  return {names, {kNoPrevious, kNoPrevious, kNoPrevious, kNoPrevious}, kNoPrevious, 0};
}

// The contacts of one pair in two steps.
class PairMatch {
 public:
  // `scratch` is kept from pair to pair.
  PairMatch(const PairHistory& last, size_t last_first, PairHistory& now, size_t now_first,
            std::vector<uint8_t>& scratch)
      : last_(last),
        now_(now),
        last_first_(last_first),
        last_count_(contact_run(last.contacts, last_first).size()),
        now_first_(now_first),
        now_count_(contact_run(now.contacts, now_first).size()),
        is_continued_(scratch) {}

  void run() {
    is_continued_.assign(4 * last_count_, 0);
    for_each_point([&](ContactIdentity& identity, size_t, size_t k) {
      const auto is_same = [&](size_t old, size_t old_k) {
        return last_.identities[old].names.point[old_k] == identity.names.point[k];
      };
      take(first_left(is_same), identity.previous_point[k]);
    });
    for_each_point([&](ContactIdentity& identity, size_t contact, size_t k) {
      if (identity.previous_point[k] == kNoPrevious) {
        take(nearest_left(contact, k), identity.previous_point[k]);
      }
    });
    for (size_t c = now_first_; c < now_first_ + now_count_; ++c) set_previous(c);
  }

 private:
  template <class Use>
  void for_each_point(const Use& use) {
    for (size_t c = now_first_; c < now_first_ + now_count_; ++c) {
      for (size_t k = 0; k < point_count(now_, c); ++k) use(now_.identities[c], c, k);
    }
  }

  // Calls use(contact, point, place among the old points) for each old point that is left.
  template <class Use>
  void for_each_left(const Use& use) const {
    for (size_t i = 0; i < last_count_; ++i) {
      for (size_t k = 0; k < point_count(last_, last_first_ + i); ++k) {
        if (!is_continued_[4 * i + k]) use(last_first_ + i, k, 4 * i + k);
      }
    }
  }

  template <class Wanted>
  size_t first_left(const Wanted& wanted) const {
    size_t found = kNone;
    for_each_left([&](size_t contact, size_t k, size_t place) {
      if (found == kNone && wanted(contact, k)) found = place;
    });
    return found;
  }

  size_t nearest_left(size_t contact, size_t k) const {
    const Contact& c = now_.contacts[contact];
    const float arm = kSamePointShare * std::sqrt(std::min(squared(c.arm_a), squared(c.arm_b)));
    const Eigen::Vector3f point = point_at(now_, contact, k);
    size_t found = kNone;
    float least = arm * arm;
    for_each_left([&](size_t old, size_t old_k, size_t place) {
      const float distance = squared(point_at(last_, old, old_k) - point);
      if (!(distance <= least) || (found != kNone && distance == least)) return;
      least = distance;
      found = place;
    });
    return found;
  }

  static float squared(const Eigen::Vector3f& v) {
    return (v.x() * v.x() + v.y() * v.y()) + v.z() * v.z();
  }

  void take(size_t place, uint32_t& previous) {
    if (place == kNone) return;
    is_continued_[place] = 1;
    previous = static_cast<uint32_t>(4 * last_first_ + place);
  }

  // The first of the contacts that most points continue.
  void set_previous(size_t contact) {
    ContactIdentity& identity = now_.identities[contact];
    size_t most = 0;
    for (const uint32_t candidate : identity.previous_point) {
      if (candidate == kNoPrevious) continue;
      size_t count = 0;
      for (const uint32_t other : identity.previous_point) {
        count += other != kNoPrevious && other / 4 == candidate / 4;
      }
      if (count <= most) continue;
      most = count;
      identity.previous = candidate / 4;
    }
  }

  static constexpr size_t kNone = ~size_t{0};

  const PairHistory& last_;
  PairHistory& now_;
  const size_t last_first_, last_count_;
  const size_t now_first_, now_count_;
  std::vector<uint8_t>& is_continued_;  // one an old point
};

}  // namespace

void find_previous(const PairHistory& last, const BodyStore& bodies, Parallelism parallelism,
                   PairHistory& now) {
  const auto is_replaced = [&](uint32_t body) {
    return (bodies.touched(body) & BodyStore::kReplaced) != 0;
  };
  for_each_merge_block(now.pairs.size(), parallelism, [&](size_t, size_t begin, size_t end) {
    static thread_local std::vector<uint8_t> scratch;
    const auto there = [&](size_t i, size_t before) {
      if (!now.has_contact(i)) return;
      const Pair pair = now.pairs[i];
      const size_t first = now.contact[i];
      const size_t count = contact_run(now.contacts, first).size();
      for (size_t c = first; c < first + count; ++c) {
        now.identities[c] = without_previous(now.identities[c].names);
      }
      const bool continues = before != kNotThere && last.has_contact(before) &&
                             !is_replaced(pair.a) && !is_replaced(pair.b);
      if (continues) PairMatch(last, last.contact[before], now, first, scratch).run();
    };
    merge_block(
        last.pairs, now.pairs, begin, end, [](size_t) {}, there);
  });
}

void repeat_identities(Parallelism parallelism, PairHistory& now) {
  for_each_block(now.contacts.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t c = begin; c < end; ++c) {
                     const auto contact = static_cast<uint32_t>(c);
                     ContactIdentity& identity = now.identities[c];
                     identity = without_previous(identity.names);
                     for (uint32_t k = 0; k < point_count(now, c); ++k) {
                       identity.previous_point[k] = point_place(contact, k);
                     }
                     identity.previous = contact;
                   }
                 });
}

}  // namespace carom
