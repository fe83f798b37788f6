// Meshes and height fields with a scale: results equal those of meshes of the scaled triangles to
// the bit, sub-shapes too.
#include <gtest/gtest.h>

#include "carom/shapes/scaled.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

// A surface with a scale, and a mesh of the same triangles that shares nothing.
struct Instance {
  Shape scaled_one;
  Mesh own;
  double reach;

  explicit Instance(const std::shared_ptr<const MeshGeometry>& mesh)
      : scaled_one(Mesh{mesh}), own{*unshared(*mesh)}, reach(reach_of(*mesh)) {
    EXPECT_TRUE(mesh->is_scaled());
    EXPECT_FALSE(own.geometry->is_scaled());
  }
  explicit Instance(const std::shared_ptr<const HeightFieldGeometry>& field)
      : scaled_one(HeightField{field}), own(mesh_like(*field)), reach(reach_of(*field)) {
    EXPECT_TRUE(field->is_scaled());
  }

 private:
  template <class Geometry>
  static double reach_of(const Geometry& geometry) {
    return std::max(geometry.lower().cwiseAbs().maxCoeff(), geometry.upper().cwiseAbs().maxCoeff());
  }
};

std::vector<Instance> instances() {
  const Vector3f kScales[] = {
      {2, 2, 2},       {-1, 1, 1}, {0.3f, 0.7f, 1.9f},    {1, -0.25f, -1.5f},
      {-3, -0.4f, -1}, {1, 1, 5},  {1e-6f, 1e-6f, 1e-6f}, {1e6f, 1e6f, -1e6f}};
  Composites composites(11);
  oracle::Random random(5);
  std::vector<Instance> all;
  for (const Vector3f& scale : kScales) {
    for (const MeshRules rules : {MeshRules{}, MeshRules{.one_sided = true},
                                  MeshRules{.one_sided = false, .thickness = 0.4f}}) {
      const auto rough = grid_mesh(
          5, 0.8f, [&](float, float) { return random.uniform(-0.4, 0.4); }, rules);
      all.emplace_back(*scaled(rough.geometry, scale));
    }
    all.emplace_back(*scaled(flat_grid(4, 1).geometry, scale));
    all.emplace_back(*scaled(std::shared_ptr<const HeightFieldGeometry>(
                                 geometry_of(random_heights(9, 7, 0.5, 0.1, random))),
                             scale));
  }
  return all;
}

// Bodies about the surface, of which the first or the second is the surface.
std::vector<TestPair> pairs_on(const Instance& instance, ShapeKind kind, PositionType positions,
                               size_t count, bool surface_first, uint64_t seed) {
  Composites composites(seed);
  oracle::Random& random = composites.random();
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    const double size = instance.reach * random.uniform(0.1, 0.8);
    const PlacedShape surface = {
        instance.scaled_one, stored(random.direction() * random.uniform(0, 2) * size, positions),
        random.chance(0.4) ? Eigen::Quaternionf::Identity() : composites.orientation()};
    const PlacedShape body = {
        composites.shape(kind, size),
        stored(surface.position + random.direction() * random.uniform(0, 1.2) * instance.reach,
               positions),
        composites.orientation()};
    pairs.push_back(surface_first ? TestPair{surface, body} : TestPair{body, surface});
  }
  return pairs;
}

bool is_of(const Shape& shape, const Instance& instance) {
  return shape.index() == instance.scaled_one.index() &&
         shape_rows(shape)[0] == shape_rows(instance.scaled_one)[0];
}

std::vector<TestPair> with_own(std::vector<TestPair> pairs, const Instance& instance) {
  for (TestPair& pair : pairs) {
    for (PlacedShape* body : {&pair.a, &pair.b}) {
      if (is_of(body->shape, instance)) body->shape = instance.own;
    }
  }
  return pairs;
}

void expect_like_own(const std::vector<TestPair>& pairs, const Instance& instance,
                     const Call& call) {
  const std::vector<TestPair> expected = with_own(pairs, instance);
  for_each_isa([&] {
    EXPECT_TRUE(same_rows(run_rows(expected, call), run_rows(pairs, call), pairs));
    EXPECT_TRUE(same_rows(run_list(expected, call), run_list(pairs, call), pairs));
    if (has_contacts(call.detail)) {
      EXPECT_EQ(run_sub_shapes(expected, call), run_sub_shapes(pairs, call));
    }
  });
}

class ScaledSurfaceKinds : public testing::TestWithParam<ShapeKind> {};

TEST_P(ScaledSurfaceKinds, EqualOwnMeshes) {
  uint64_t seed = 1;
  for (const Instance& instance : instances()) {
    for (const bool first : {true, false}) {
      if (GetParam() == ShapeKind::halfspace && !first) continue;
      const auto positions = first ? PositionType::float32 : PositionType::float64;
      const auto pairs = pairs_on(instance, GetParam(), positions, rounds(8), first, ++seed);
      for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
        Call call = call_with(positions);
        call.detail = detail;
        expect_like_own(pairs, instance, call);
        call.contact_distance = 0.3f;
        expect_like_own(pairs, instance, call);
      }
    }
  }
}

TEST_P(ScaledSurfaceKinds, EqualOwnMeshesInAllTiers) {
  uint64_t seed = 100;
  for (const Instance& instance : instances()) {
    const auto pairs =
        pairs_on(instance, GetParam(), PositionType::float64, rounds(4), true, ++seed);
    for (const Tier tier : {Tier::certified, Tier::exact}) {
      if (tier == Tier::exact && is_round(GetParam())) continue;
      Call call = call_with(PositionType::float64);
      call.accuracy.tier = tier;
      expect_like_own(pairs, instance, call);
    }
  }
}

TEST_P(ScaledSurfaceKinds, EqualReference) {
  uint64_t seed = 200;
  for (const Instance& instance : instances()) {
    if (!(instance.reach < 100 && instance.reach > 0.01)) continue;
    const auto pairs =
        pairs_on(instance, GetParam(), PositionType::float32, rounds(4), true, ++seed);
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      Call call = call_with(PositionType::float32);
      call.detail = detail;
      expect_reference(pairs, call);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ScaledSurfaceKinds, testing::ValuesIn(kEveryKind),
                         [](const auto& kind) { return std::string(name(kind.param)); });

}  // namespace
}  // namespace carom::test
