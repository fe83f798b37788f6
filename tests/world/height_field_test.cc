// Worlds with height fields, with and without a scale: steps equal those of worlds with meshes of
// the same triangles, and an update counts from when the world is told.
#include <gtest/gtest.h>

#include "carom/shapes/scaled.h"
#include "carom/world/world.h"
#include "tests/support/height_fields.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;

// Bodies of many kinds over a ground, the same for every ground.
class Crowd {
 public:
  Crowd(const WorldSettings& settings, const Shape& ground) : world_(settings) {
    BodyDesc fixed;
    fixed.shape = ground;
    fixed.motion = Motion::fixed;
    ground_ = world_.add(fixed);
    Composites shapes(1);
    for (int i = 0; i < 120; ++i) {
      static constexpr ShapeKind kKinds[] = {
          ShapeKind::sphere,   ShapeKind::box,  ShapeKind::capsule,  ShapeKind::hull,
          ShapeKind::compound, ShapeKind::mesh, ShapeKind::cylinder, ShapeKind::ellipsoid};
      BodyDesc body;
      body.shape = shapes.shape(kKinds[i % std::size(kKinds)], 0.6);
      body.orientation = shapes.orientation();
      body.position = Vector3d(shapes.random().uniform(-9, 9), shapes.random().uniform(-9, 9),
                               shapes.random().uniform(-0.8, 1.5));
      bodies_.push_back(world_.add(body));
    }
  }

  World& world() { return world_; }
  BodyId ground() const { return ground_; }

  void move(oracle::Random& random) {
    for (const BodyId body : bodies_) {
      if (random.chance(0.5)) continue;
      world_.set_position(body, world_.position(body) + random.direction() * 0.1);
    }
  }

 private:
  World world_;
  BodyId ground_;
  std::vector<BodyId> bodies_;
};

void expect_same_step(World& a, World& b) {
  a.step();
  b.step();
  ASSERT_EQ(a.contacts().size(), b.contacts().size());
  EXPECT_GT(a.contacts().size(), 20u);
  EXPECT_TRUE(as_bytes(a.contacts()) == as_bytes(b.contacts()));
}

void expect_same_steps(const Shape& ground, const Mesh& mesh) {
  for (const Detail detail : {Detail::contact, Detail::manifold, Detail::regions}) {
    for (const float distance : {0.0f, 0.2f}) {
      const WorldSettings settings = {.detail = detail, .contact_distance = distance};
      Crowd grounds(settings, ground), meshes(settings, mesh);
      oracle::Random first(3), second(3);
      for (int step = 0; step < 6; ++step) {
        SCOPED_TRACE(step);
        expect_same_step(grounds.world(), meshes.world());
        grounds.move(first);
        meshes.move(second);
      }
    }
  }
}

TEST(HeightFieldWorld, StepsEqualThoseOfMeshes) {
  oracle::Random random(2);
  const auto field = geometry_of(random_heights(21, 19, 0.4, 0.02, random));
  expect_same_steps(HeightField{field}, mesh_like(*field));
}

// Names of points too, which are part of a contact.
TEST(HeightFieldWorld, StepsOnGroundWithAScaleEqualThoseOfMeshes) {
  oracle::Random random(2);
  const std::shared_ptr<const HeightFieldGeometry> field =
      geometry_of(random_heights(21, 19, 0.4, 0.02, random));
  for (const Eigen::Vector3f& scale : {Eigen::Vector3f(-1, 0.9f, 1.2f), {1.1f, 1.1f, 1.1f}}) {
    const auto with_scale = *scaled(field, scale);
    expect_same_steps(HeightField{with_scale}, mesh_like(*with_scale));
    const auto mesh = *scaled(mesh_like(*field).geometry, scale);
    expect_same_steps(Mesh{mesh}, Mesh{*unshared(*mesh)});
  }
}

TEST(HeightFieldWorld, IsToldOfUpdates) {
  const HeightTable flat{.nx = 40, .ny = 40, .heights = std::vector<float>(1600)};
  const auto field = geometry_of(flat);
  World world;
  const BodyId ground = world.add({.shape = HeightField{field}, .motion = Motion::fixed});
  const BodyId ball = world.add({.shape = Sphere{0.5f}, .position = Vector3d(3.2, 4.1, 3)});
  world.step();
  EXPECT_TRUE(world.contacts().empty());

  const std::vector<float> hill(25, 2.75f);
  ASSERT_TRUE(field->update({21, 21, 5, 5}, {.data = hill.data()}));
  world.set_shape(ground, HeightField{field});
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_EQ(world.contacts()[0].separation, -0.25f);

  const std::vector<float> plain(25, 0.0f);
  ASSERT_TRUE(field->update({21, 21, 5, 5}, {.data = plain.data()}));
  world.set_shape(ground, HeightField{field});
  world.step();
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_EQ(std::get<HeightField>(world.shape(ground)).geometry, field);
  EXPECT_TRUE(world.contains(ball));
}

TEST(HeightFieldWorld, WithoutGeometryIsNotValid) {
  World world;
  world.add({.shape = HeightField{}, .motion = Motion::fixed});
  world.add({.shape = Sphere{1}});
  world.step();
  EXPECT_TRUE(world.contacts().empty());
}

}  // namespace
}  // namespace carom::test
