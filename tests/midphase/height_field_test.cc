// Height fields: results equal those of a mesh of the same triangles to the bit, sub-shapes too.
#include <gtest/gtest.h>

#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr ShapeKind kSimpleKinds[] = {
    ShapeKind::sphere,      ShapeKind::capsule, ShapeKind::aabb,      ShapeKind::box,
    ShapeKind::dop,         ShapeKind::hull,    ShapeKind::halfspace, ShapeKind::triangle,
    ShapeKind::cylinder,    ShapeKind::cone,    ShapeKind::ellipsoid, ShapeKind::rounded_box,
    ShapeKind::rounded_hull};
constexpr ShapeKind kKindsOfParts[] = {ShapeKind::mesh, ShapeKind::compound,
                                       ShapeKind::height_field};

// A field and the mesh like it.
struct Ground {
  HeightField field;
  Mesh mesh;

  explicit Ground(std::shared_ptr<const HeightFieldGeometry> geometry)
      : field{std::move(geometry)}, mesh(mesh_like(*field.geometry)) {}
};

// Bodies about a ground, near its surface and further off.
std::vector<TestPair> pairs_on(const Ground& ground, ShapeKind kind, PositionType positions,
                               size_t count, double size, bool ground_first, uint64_t seed) {
  Composites composites(seed);
  oracle::Random& random = composites.random();
  std::vector<TestPair> pairs;
  const Eigen::Vector3d upper = ground.field.geometry->upper().cast<double>();
  for (size_t i = 0; i < count; ++i) {
    const PlacedShape field = {
        ground.field, stored(random.direction() * random.uniform(0, 10), positions),
        random.chance(0.5) ? Eigen::Quaternionf::Identity() : composites.orientation()};
    const Eigen::Vector3d at(random.uniform(-1.2, 1.2) * upper.x(),
                             random.uniform(-1.2, 1.2) * upper.y(), random.uniform(-3, 3) * size);
    const PlacedShape body = {
        composites.shape(kind, size),
        stored(field.position + field.orientation.cast<double>() * at, positions),
        composites.orientation()};
    pairs.push_back(ground_first ? TestPair{field, body} : TestPair{body, field});
  }
  return pairs;
}

// The same pairs with the mesh in place of the field.
std::vector<TestPair> with_mesh(std::vector<TestPair> pairs, const Ground& ground) {
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      const auto* field = std::get_if<HeightField>(&body->shape);
      if (field && field->geometry == ground.field.geometry) body->shape = ground.mesh;
    }
  }
  return pairs;
}

void expect_like_mesh(const std::vector<TestPair>& pairs, const Ground& ground, const Call& call) {
  const std::vector<TestPair> expected = with_mesh(pairs, ground);
  for_each_isa([&] {
    EXPECT_TRUE(same_rows(run_rows(expected, call), run_rows(pairs, call), pairs));
    EXPECT_TRUE(same_rows(run_list(expected, call), run_list(pairs, call), pairs));
    if (has_contacts(call.detail)) {
      EXPECT_EQ(run_sub_shapes(expected, call), run_sub_shapes(pairs, call));
    }
  });
}

// The same of the pairs that touch. Where no distance is measured, that of the others depends on
// the parts that a search comes to.
void expect_contacts_like_mesh(const std::vector<TestPair>& pairs, const Ground& ground,
                               const Call& call) {
  const std::vector<TestPair> meshes = with_mesh(pairs, ground);
  for_each_isa([&] {
    std::vector<Row> expected = run_rows(meshes, call), found = run_rows(pairs, call);
    for (size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(expected[i].overlap, found[i].overlap);
      const bool is_contact =
          has_contacts(call.detail) && expected[i].separation <= call.contact_distance;
      if (expected[i].overlap == 0 && !is_contact) expected[i] = found[i];
    }
    EXPECT_TRUE(same_rows(expected, found, pairs));
  });
}

std::vector<Ground> grounds() {
  oracle::Random random(1);
  std::vector<Ground> all;
  all.emplace_back(geometry_of(random_heights(13, 9, 0.5, 0, random)));
  all.emplace_back(geometry_of(random_heights(2, 2, 0.5, 0, random)));
  all.emplace_back(geometry_of(random_heights(2, 11, 0.3, 0, random)));
  all.emplace_back(geometry_of(random_heights(20, 2, 0.3, 0.1, random)));
  all.emplace_back(geometry_of(random_heights(16, 17, 0.5, 0.1, random)));
  all.emplace_back(geometry_of(random_heights(10, 10, 0, 0, random)));
  all.emplace_back(geometry_of(random_heights(70, 40, 0.3, 0.01, random)));
  return all;
}

class HeightFieldKinds : public testing::TestWithParam<ShapeKind> {};

TEST_P(HeightFieldKinds, EqualMesh) {
  uint64_t seed = 1;
  for (const Ground& ground : grounds()) {
    for (const double size : {0.2, 1.5, 8.0}) {
      for (const bool first : {true, false}) {
        if (GetParam() == ShapeKind::halfspace && !first) continue;
        const auto positions = first ? PositionType::float32 : PositionType::float64;
        const auto pairs = pairs_on(ground, GetParam(), positions, rounds(6), size, first, ++seed);
        for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
          Call call = call_with(positions);
          call.detail = detail;
          expect_like_mesh(pairs, ground, call);
          call.contact_distance = 0.3f;
          expect_like_mesh(pairs, ground, call);
          call.measured = Measured::overlapping;
          expect_contacts_like_mesh(pairs, ground, call);
          call.contact_distance = 0;
          expect_contacts_like_mesh(pairs, ground, call);
        }
      }
    }
  }
}

TEST_P(HeightFieldKinds, EqualMeshInAllTiers) {
  uint64_t seed = 100;
  for (const Ground& ground : grounds()) {
    const auto pairs =
        pairs_on(ground, GetParam(), PositionType::float64, rounds(6), 1.5, true, ++seed);
    for (const Tier tier : {Tier::certified, Tier::exact}) {
      if (tier == Tier::exact && is_round(GetParam())) continue;
      Call call = call_with(PositionType::float64);
      call.accuracy.tier = tier;
      expect_like_mesh(pairs, ground, call);
    }
  }
}

TEST_P(HeightFieldKinds, EqualReference) {
  Composites composites(7);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < rounds(40); ++i) {
    TestPair pair =
        composites.pair(ShapeKind::height_field, ShapeKind::sphere, PositionType::float32, 1, 10);
    pair.b.shape = composites.shape(GetParam(), 1);
    pairs.push_back(pair);
  }
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    Call call = call_with(PositionType::float32);
    call.detail = detail;
    expect_reference(pairs, call);
  }
}

std::string kind_name(const testing::TestParamInfo<ShapeKind>& info) { return name(info.param); }

INSTANTIATE_TEST_SUITE_P(Simple, HeightFieldKinds, testing::ValuesIn(kSimpleKinds), kind_name);
INSTANTIATE_TEST_SUITE_P(OfParts, HeightFieldKinds, testing::ValuesIn(kKindsOfParts), kind_name);

TEST(HeightFieldPairs, EqualMeshAfterAnUpdate) {
  oracle::Random random(9);
  const auto field = geometry_of(random_heights(40, 30, 0.5, 0.02, random));
  const HeightTable patch = random_heights(12, 7, 3, 0.1, random);
  ASSERT_TRUE(field->update({17, 9, 12, 7}, {.data = patch.heights.data()}));
  const Ground ground(field);
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::hull}) {
    Call call = call_with(PositionType::float32);
    call.detail = Detail::manifold;
    expect_like_mesh(pairs_on(ground, kind, PositionType::float32, rounds(200), 1, false, 3),
                     ground, call);
  }
}

TEST(HeightFieldPairs, EqualMeshAsChildrenOfCompounds) {
  oracle::Random random(10);
  const Ground ground(geometry_of(random_heights(12, 14, 0.5, 0.05, random)));
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::compound}) {
    const auto pairs = pairs_on(ground, kind, PositionType::float32, rounds(30), 1, false, 3);
    std::vector<TestPair> fields = pairs, meshes = pairs;
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto as_child = [](const Shape& shape) {
        return compound_of({{shape, {0.1f, 0.2f, 0.3f}, Eigen::Quaternionf(1, 0.1f, 0, 0)}});
      };
      fields[i].b.shape = as_child(ground.field);
      meshes[i].b.shape = as_child(ground.mesh);
    }
    Call call = call_with(PositionType::float32);
    call.detail = Detail::manifold;
    for_each_isa(
        [&] { EXPECT_TRUE(same_rows(run_rows(meshes, call), run_rows(fields, call), fields)); });
  }
}

}  // namespace
}  // namespace carom::test
