// The forms of version 0.2 do what those do that take options.
#include <gtest/gtest.h>

#include "carom/carom.h"
#include "tests/support/cast_checks.h"
#include "tests/support/results.h"
#include "tests/world/crowds.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

namespace carom::test {
namespace {

struct ManyBodies {
  std::vector<PlacedShape> shapes = make_bodies({.count = 120, .side = 9}, 3);
  Sweeps sweeps = make_sweeps(120, 6, true, 4);
  std::vector<PlacedShape> other_shapes =
      make_bodies({.count = 120, .side = 9, .halfspaces = 0}, 5);
  LaidOut laid_out = LaidOut(shapes, {});
  LaidOut others_laid_out = LaidOut(other_shapes, {});
  std::vector<Pair> pairs;

  ManyBodies() {
    for (uint32_t i = 0; i + 1 < shapes.size(); ++i) pairs.push_back({i, i + 1});
  }
  Collidables bodies() const { return laid_out.view(); }
  Collidables others() const { return others_laid_out.view(); }
};

std::string nearest_bits(const std::vector<NearestHit>& hits) {
  std::string bits;
  for (const NearestHit& hit : hits) {
    bits += as_bytes(std::span<const uint32_t>(&hit.query, 1)) +
            as_bytes(std::span<const uint32_t>(&hit.body, 1)) +
            as_bytes(std::span<const float>(&hit.separation, 1));
  }
  return bits;
}

std::string rows_as_text(const Columns& columns) {
  std::string text;
  for (const Row& row : columns.rows()) text += show(row) + "\n";
  return text;
}

TEST(Deprecated, Collide) {
  const ManyBodies scene;
  const Collidables bodies = scene.bodies();
  Columns expected(scene.pairs.size()), actual(scene.pairs.size());
  ASSERT_TRUE(bool(collide(bodies, bodies, scene.pairs, Detail::contact, expected.out(),
                           {.frame = WitnessFrame::body, .measured = Measured::overlapping})));
  ASSERT_TRUE(bool(collide(bodies, bodies, scene.pairs, Detail::contact, actual.out(),
                           WitnessFrame::body, Parallelism::none, Measured::overlapping)));
  EXPECT_EQ(rows_as_text(actual), rows_as_text(expected));
  Columns expected_rows(bodies.count), actual_rows(bodies.count);
  const Collidables others = scene.others();
  ASSERT_TRUE(bool(collide_rows(bodies, others, Detail::contact, expected_rows.out(),
                                {.frame = WitnessFrame::body})));
  ASSERT_TRUE(
      bool(collide_rows(bodies, others, Detail::contact, actual_rows.out(), WitnessFrame::body)));
  EXPECT_EQ(rows_as_text(actual_rows), rows_as_text(expected_rows));
}

TEST(Deprecated, StepOfTheReference) {
  const std::vector<reference::Body> bodies = {
      {{0, 0}, {.shape = Sphere{1}}}, {{1, 0}, {.shape = Sphere{1}, .position = {1, 0, 0}}}};
  const reference::Frame expected = reference::step(bodies);
  const reference::Frame actual =
      reference::step(bodies, PositionType::float32, Detail::contact, true, &expected);
  ASSERT_EQ(actual.contacts.size(), 1u);
  EXPECT_TRUE(as_bytes(std::span<const Contact>(actual.contacts)) ==
              as_bytes(std::span<const Contact>(expected.contacts)));
  ASSERT_EQ(actual.events.size(), 1u);
  EXPECT_EQ(actual.events[0].kind, EventKind::persist);
}

TEST(Deprecated, TimeOfImpact) {
  const ManyBodies scene;
  const Collidables bodies = scene.bodies();
  const SweepView sweep = scene.sweeps.view();
  std::vector<float> expected(scene.pairs.size()), actual(scene.pairs.size());
  ASSERT_TRUE(bool(time_of_impact(bodies, sweep, bodies, sweep, scene.pairs,
                                  {.toi = expected.data()}, {.frame = WitnessFrame::body})));
  ASSERT_TRUE(bool(time_of_impact(bodies, sweep, bodies, sweep, scene.pairs, {.toi = actual.data()},
                                  WitnessFrame::body)));
  EXPECT_EQ(as_bytes(std::span<const float>(actual)), as_bytes(std::span<const float>(expected)));
}

TEST(Deprecated, Queries) {
  const ManyBodies scene;
  const Collidables bodies = scene.bodies();
  for (const CastHits which : {CastHits::closest, CastHits::all, CastHits::any}) {
    std::vector<CastHit> old_form, new_form;
    ASSERT_TRUE(bool(cast(bodies, scene.sweeps.view(), bodies, which, old_form)));
    ASSERT_TRUE(bool(cast(bodies, scene.sweeps.view(), bodies, new_form, {.hits = which})));
    EXPECT_EQ(bits_of(old_form), bits_of(new_form));
    EXPECT_GT(new_form.size(), 20u);
  }
  std::vector<OverlapHit> old_overlaps, new_overlaps;
  ASSERT_TRUE(bool(find_overlaps(bodies, bodies, old_overlaps, Parallelism::none)));
  ASSERT_TRUE(bool(find_overlaps(bodies, bodies, new_overlaps, {})));
  EXPECT_EQ(as_bytes(std::span<const OverlapHit>(old_overlaps)),
            as_bytes(std::span<const OverlapHit>(new_overlaps)));
  std::vector<NearestHit> old_nearest, new_nearest;
  ASSERT_TRUE(bool(find_nearest(bodies, 3, bodies, old_nearest, Parallelism::none)));
  ASSERT_TRUE(bool(find_nearest(bodies, 3, bodies, new_nearest, {})));
  EXPECT_EQ(nearest_bits(old_nearest), nearest_bits(new_nearest));
}

TEST(Deprecated, QueriesOfAWorld) {
  World world({.parallelism = Parallelism::none});
  const ManyBodies scene;
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    world.add({.shape = scene.shapes[i].shape,
               .position = scene.shapes[i].position,
               .orientation = scene.shapes[i].orientation,
               .layer = 1u << (i % 2)});
  }
  world.step();
  std::vector<CastHit> old_hits, new_hits;
  world.cast(scene.bodies(), scene.sweeps.view(), CastHits::all, old_hits, 2);
  world.cast(scene.bodies(), scene.sweeps.view(), new_hits,
             {.hits = CastHits::all, .filter = {.mask = 2}});
  EXPECT_EQ(bits_of(old_hits), bits_of(new_hits));
  std::vector<OverlapHit> old_overlaps, new_overlaps, all;
  world.find_overlaps(scene.bodies(), old_overlaps, 2);
  world.find_overlaps(scene.bodies(), new_overlaps, {.filter = {.mask = 2}});
  world.find_overlaps(scene.bodies(), all, {});
  EXPECT_EQ(as_bytes(std::span<const OverlapHit>(old_overlaps)),
            as_bytes(std::span<const OverlapHit>(new_overlaps)));
  EXPECT_LT(old_overlaps.size(), all.size());
  std::vector<NearestHit> old_nearest, new_nearest;
  world.find_nearest(scene.bodies(), 3, old_nearest, 2);
  world.find_nearest(scene.bodies(), 3, new_nearest, {.filter = {.mask = 2}});
  EXPECT_EQ(nearest_bits(old_nearest), nearest_bits(new_nearest));
}

}  // namespace
}  // namespace carom::test

#pragma GCC diagnostic pop
