#include "tests/midphase/region_checks.h"

namespace carom::test {
namespace {

Contact contact_of(const reference::PairResult& result, uint32_t pair) {
  return {.a = pair,
          .b = pair,
          .sub_a = result.sub_a,
          .sub_b = result.sub_b,
          .normal = result.normal,
          .separation = result.separation,
          .arm_a = result.arm_a,
          .normal_velocity = 0,
          .arm_b = result.arm_b,
          .status = result.status,
          .manifold_count = result.manifold_count};
}

void expect_contact(const ContactRegions& got, size_t at, const reference::PairResult& expected,
                    uint32_t pair, uint16_t left_out) {
  Contact contact = contact_of(expected, pair);
  contact.left_out = left_out;
  ASSERT_EQ(std::memcmp(&got.contacts[at], &contact, sizeof contact), 0);
  ASSERT_EQ(std::memcmp(&got.manifolds[at], &expected.manifold, sizeof expected.manifold), 0);
}

}  // namespace

Listed list_contacts(std::span<const TestPair> pairs, PositionType positions,
                     const CollideOptions& asked) {
  const LaidOut a(side_a(pairs), {.positions = positions});
  const LaidOut b(side_b(pairs), {.positions = positions});
  Listed listed;
  listed.rows.resize(pairs.size(), Detail::manifold, {ColumnRole::sub_shape});
  CollideOptions options = asked;
  options.regions = &listed.regions;
  EXPECT_TRUE(
      bool(collide_rows(a.view(), b.view(), Detail::regions, listed.rows.columns(), options)));
  return listed;
}

void expect_reference_contacts(std::span<const TestPair> pairs, PositionType positions,
                               const ContactRegions& got, const CollideOptions& options,
                               RegionCounts& counts) {
  ASSERT_EQ(got.first.size(), pairs.size() + 1);
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    const TestPair& pair = pairs[i];
    const reference::PairContacts expected =
        reference::find_contacts(pair.a.shape, pair.a.pose(), pair.b.shape, pair.b.pose(),
                                 positions, options.contact_distance, options.region_limits);
    const bool touches =
        expected.first.overlap ||
        (options.contact_distance > 0 && expected.first.separation <= options.contact_distance);
    const size_t count = got.first[i + 1] - got.first[i];
    ASSERT_EQ(count, touches ? 1 + expected.others.size() : 0) << i;
    if (!touches) continue;
    expect_contact(got, got.first[i], expected.first, i, expected.left_out);
    for (size_t k = 1; k < count; ++k) {
      expect_contact(got, got.first[i] + k, expected.others[k - 1], i, 0);
    }
    counts.several += count > 1;
    counts.left_out += expected.left_out;
  }
}

}  // namespace carom::test
