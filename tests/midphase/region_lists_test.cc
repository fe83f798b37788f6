// Long lists of pairs at detail regions: contacts, rows and names of points are those of calls with
// one pair, wherever the pair stands in the list and on however many threads.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "carom/base/thread_arena.h"
#include "carom/results/result_arrays.h"
#include "tests/support/composites.h"

namespace carom::test {
namespace {

constexpr std::initializer_list<ColumnRole> kOptionalColumns = {
    ColumnRole::bound, ColumnRole::sub_shape, ColumnRole::name};

// Bodies of all kinds but half-spaces, most of which are composites, in a small space. One is not
// valid.
std::vector<PlacedShape> crowded_bodies(size_t count) {
  Composites composites(21);
  oracle::Random& random = composites.random();
  std::vector<PlacedShape> bodies;
  for (size_t i = 0; i < count; ++i) {
    const ShapeKind kind = i % 3 == 0   ? ShapeKind::mesh
                           : i % 3 == 1 ? ShapeKind::compound
                                        : kEveryKind[random.below(6)];
    bodies.push_back({composites.shape(kind, 0.8), random.direction() * random.uniform(0, 1.5),
                      composites.orientation()});
    bodies.back().position = stored(bodies.back().position, kFloat32);
  }
  bodies[7].position.x() = NAN;
  return bodies;
}

// A pair in a list, with its contact distance.
struct ListedPair {
  Pair pair;
  float distance;
};

// Pairs of different bodies in either order, most of them more than once, later ones with lower
// indices.
std::vector<ListedPair> mixed_list(uint32_t bodies, size_t count) {
  oracle::Random random(22);
  std::vector<ListedPair> list;
  while (list.size() < count) {
    const auto a = static_cast<uint32_t>(random.below(bodies));
    const auto b = static_cast<uint32_t>(random.below(bodies));
    if (a != b) list.push_back({{a, b}, random.chance(0.5) ? 0.1f : 0.0f});
  }
  std::sort(list.begin(), list.end(), [](const ListedPair& x, const ListedPair& y) {
    return std::tie(y.pair.a, y.pair.b) < std::tie(x.pair.a, x.pair.b);
  });
  return list;
}

// The results of a list.
struct RegionLists {
  ContactRegions regions;
  ResultArrays rows;

  void find(const Collidables& bodies, std::span<const ListedPair> list, WitnessFrame frame,
            Parallelism parallelism) {
    std::vector<Pair> pairs;
    std::vector<float> distances;
    for (const ListedPair& each : list) {
      pairs.push_back(each.pair);
      distances.push_back(each.distance);
    }
    rows.resize(pairs.size(), Detail::manifold, kOptionalColumns);
    // The call must replace all that the lists hold.
    for_each_column(
        [&](const ColumnInfo&, auto* column) {
          if (column) std::memset(column, 0xa5, pairs.size() * sizeof *column);
        },
        rows.columns());
    ASSERT_TRUE(bool(collide(bodies, bodies, pairs, Detail::regions, rows.columns(),
                             {.frame = frame,
                              .parallelism = parallelism,
                              .contact_distances = distances.data(),
                              .regions = &regions,
                              .region_limits = {.most = 3}})));
  }
};

// The results of each pair in a call of its own.
class PairByPair {
 public:
  PairByPair(const Collidables& bodies, WitnessFrame frame) : bodies_(bodies), frame_(frame) {}

  const RegionLists& of(const ListedPair& pair) {
    const auto [found, is_new] =
        lists_.try_emplace({pair.pair.a, pair.pair.b, pair.distance}, RegionLists());
    if (is_new) found->second.find(bodies_, {&pair, 1}, frame_, Parallelism::none);
    return found->second;
  }

  size_t size() const { return lists_.size(); }

 private:
  const Collidables& bodies_;
  WitnessFrame frame_;
  std::map<std::tuple<uint32_t, uint32_t, float>, RegionLists> lists_;
};

template <class T>
bool are_same_bytes(std::span<const T> x, std::span<const T> y) {
  return x.size() == y.size() &&
         (x.empty() || std::memcmp(x.data(), y.data(), x.size_bytes()) == 0);
}

void expect_pair_by_pair(std::span<const ListedPair> list, const RegionLists& got,
                         PairByPair& single) {
  ASSERT_EQ(got.regions.first.size(), list.size() + 1);
  ASSERT_EQ(got.regions.first[0], 0u);
  ASSERT_EQ(got.regions.contacts.size(), got.regions.first.back());
  ASSERT_EQ(got.regions.manifolds.size(), got.regions.first.back());
  ASSERT_EQ(got.regions.point_names.size(), got.regions.first.back());
  for (size_t i = 0; i < list.size(); ++i) {
    const RegionLists& expected = single.of(list[i]);
    const size_t first = got.regions.first[i], count = got.regions.first[i + 1] - first;
    const auto run_of = [&]<class T>(const std::vector<T>& all) {
      return std::span(all).subspan(first, count);
    };
    ASSERT_TRUE(are_same_bytes<Contact>(run_of(got.regions.contacts), expected.regions.contacts))
        << i;
    ASSERT_TRUE(
        are_same_bytes<ManifoldPoints>(run_of(got.regions.manifolds), expected.regions.manifolds))
        << i;
    ASSERT_TRUE(
        are_same_bytes<PointNames>(run_of(got.regions.point_names), expected.regions.point_names))
        << i;
    ASSERT_TRUE(
        same_bits(result_row(got.rows.columns(), i), result_row(expected.rows.columns(), 0)))
        << i;
  }
}

TEST(RegionLists, EqualCallsWithOnePair) {
  const LaidOut bodies(crowded_bodies(60), {});
  const std::vector<ListedPair> list = mixed_list(60, 10000);
  for (const WitnessFrame frame : {WitnessFrame::body, WitnessFrame::world}) {
    PairByPair single(bodies.view(), frame);
    RegionLists lists;  // one for all calls, which must replace what is in it
    lists.find(bodies.view(), list, frame, Parallelism::none);
    expect_pair_by_pair(list, lists, single);
    ThreadArena arena(2);
    arena.run([&] {
      lists.find(bodies.view(), list, frame, Parallelism::arena);
      expect_pair_by_pair(list, lists, single);
      const std::span<const ListedPair> half = std::span(list).first(list.size() / 2);
      lists.find(bodies.view(), half, frame, Parallelism::arena);
      expect_pair_by_pair(half, lists, single);
    });
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_LT(single.size(), list.size() * 3 / 4);  // pairs repeat
    EXPECT_GT(lists.regions.contacts.size(), 2000u);
    size_t several = 0, left_out = 0;
    for (const Contact& contact : lists.regions.contacts) left_out += contact.left_out;
    for (size_t i = 0; i < list.size() / 2; ++i) {
      several += lists.regions.first[i + 1] > lists.regions.first[i] + 1;
    }
    EXPECT_GT(several, 500u);
    EXPECT_GT(left_out, 500u);
  }
}

// --- Names ---

// The names of the first `count` points are none of them 0, and the others are.
void expect_names(const PointNames& names, size_t count) {
  for (size_t k = 0; k < 4; ++k) ASSERT_EQ(names.point[k] != 0, k < count) << k;
}

TEST(RegionLists, NamesOfRowsAreThoseOfFirstContacts) {
  const LaidOut bodies(crowded_bodies(60), {});
  const std::vector<ListedPair> list = mixed_list(60, 3000);
  RegionLists lists;
  lists.find(bodies.view(), list, WitnessFrame::body, Parallelism::none);
  size_t without = 0, unused = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const ResultRow row = result_row(lists.rows.columns(), i);
    const size_t first = lists.regions.first[i], end = lists.regions.first[i + 1];
    expect_names(row.point_names, row.manifold_count);
    ASSERT_EQ(row.manifold_count > 0, end > first);
    without += end == first;
    if (end > first) {
      ASSERT_EQ(row.point_names.point, lists.regions.point_names[first].point);
    }
    for (size_t k = first; k < end; ++k) {
      expect_names(lists.regions.point_names[k], lists.regions.contacts[k].manifold_count);
      unused += lists.regions.contacts[k].manifold_count < 4;
    }
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
  EXPECT_GT(without, 300u);
  EXPECT_GT(unused, 300u);
}

// The column of a call: with the default limits at detail regions as at detail manifold, and at
// detail contact one name, of the witness point. The column of a call without it is not touched.
TEST(RegionLists, NamesOfOtherDetails) {
  const LaidOut bodies(crowded_bodies(60), {});
  std::vector<Pair> pairs;
  for (const ListedPair& each : mixed_list(60, 2000)) pairs.push_back(each.pair);
  const auto names_at = [&](Detail detail, ContactRegions* regions) {
    const ResultArrays rows(pairs.size(), detail, {ColumnRole::name});
    std::memset(rows.columns().point_names, 0xa5, pairs.size() * sizeof(PointNames));
    EXPECT_TRUE(bool(collide(bodies.view(), bodies.view(), pairs, detail, rows.columns(),
                             {.frame = WitnessFrame::body, .regions = regions})));
    const PointNames* const names = rows.columns().point_names;
    return std::vector<PointNames>(names, names + pairs.size());
  };
  ContactRegions regions;
  const std::vector<PointNames> at_regions = names_at(Detail::regions, &regions);
  const std::vector<PointNames> without_list = names_at(Detail::regions, nullptr);
  const std::vector<PointNames> at_manifold = names_at(Detail::manifold, nullptr);
  const std::vector<PointNames> at_contact = names_at(Detail::contact, nullptr);
  size_t touching = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const bool touches = regions.first[i + 1] > regions.first[i];
    ASSERT_EQ(at_regions[i].point, at_manifold[i].point) << i;
    ASSERT_EQ(without_list[i].point, at_manifold[i].point) << i;
    expect_names(at_contact[i], touches ? 1 : 0);
    touching += touches;
  }
  EXPECT_GT(touching, 500u);
  EXPECT_LT(touching, 1500u);

  const ResultArrays plain(pairs.size(), Detail::manifold);
  ASSERT_TRUE(bool(collide(bodies.view(), bodies.view(), pairs, Detail::regions, plain.columns(),
                           {.regions = &regions})));
  EXPECT_TRUE(regions.point_names.empty());
  EXPECT_GT(regions.contacts.size(), touching);
}

}  // namespace
}  // namespace carom::test
