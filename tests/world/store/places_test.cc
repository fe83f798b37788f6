// Shapes that lie in the places of their bodies need no index, and results do not depend on where
// shapes lie.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "carom/world/world.h"
#include "shapes/body_reader.h"
#include "world/store/body_store.h"

namespace carom::test {
namespace {

constexpr uint32_t kBodies = 40;

Box box_of(uint32_t i) { return {{0.25f + static_cast<float>(i % 7) / 8, 0.5f, 0.75f}}; }
Capsule capsule_of(uint32_t i) {
  return {{0, 0, -0.5f}, {0, 0, 0.5f}, 0.25f + static_cast<float>(i % 5) / 8};
}

BodyDesc body_of(uint32_t i, const Shape& shape) {
  return {.shape = shape, .position = {0.4 * i, 0.1 * (i % 3), 0}};
}

BodyStore boxes() {
  BodyStore store(PositionType::float32);
  for (uint32_t i = 0; i < kBodies; ++i) store.add(body_of(i, box_of(i)));
  return store;
}

void expect_boxes(const BodyStore& store) {
  const BodyReader reader{store.view()};
  for (uint32_t i = 0; i < kBodies; ++i) {
    if (!store.contains(store.id_of(i))) continue;
    EXPECT_EQ(reader.row(i, 0)[0], box_of(i).half.x()) << i;
  }
}

TEST(PlacesOfShapes, NeedNoIndexWhereEachIsThatOfItsBody) {
  const BodyStore store = boxes();
  EXPECT_EQ(store.view().rows.first, nullptr);
  expect_boxes(store);
  BodyStore capsules(PositionType::float32);
  for (uint32_t i = 0; i < kBodies; ++i) capsules.add(body_of(i, capsule_of(i)));
  EXPECT_EQ(capsules.view().rows.first, nullptr);
  EXPECT_EQ(BodyReader{capsules.view()}.row(kBodies - 1, 0)[3], capsule_of(kBodies - 1).radius);
}

TEST(PlacesOfShapes, NeedOneForBodiesOfSeveralKinds) {
  BodyStore store = boxes();
  store.add({.shape = Sphere{1}});
  EXPECT_NE(store.view().rows.first, nullptr);
  expect_boxes(store);
}

TEST(PlacesOfShapes, NeedOneWhileSomeShapeLiesElsewhere) {
  BodyStore store = boxes();
  // Rows are taken from the lowest place that is free.
  store.set_shape(3, Sphere{1});
  store.set_shape(7, Sphere{1});
  store.set_shape(7, box_of(7));
  store.set_shape(3, box_of(3));
  EXPECT_NE(store.view().rows.first, nullptr);
  expect_boxes(store);
  for (const uint32_t i : {3, 7}) store.set_shape(i, Sphere{1});
  for (const uint32_t i : {3, 7}) store.set_shape(i, box_of(i));
  EXPECT_EQ(store.view().rows.first, nullptr);
  expect_boxes(store);
}

TEST(PlacesOfShapes, NeedNoIndexWhereBodiesWereRemoved) {
  BodyStore store = boxes();
  for (const uint32_t i : {1, 2, 11, 38, 39}) store.remove(store.id_of(i));
  EXPECT_EQ(store.view().rows.first, nullptr);
  expect_boxes(store);
  for (const uint32_t i : {1, 2, 11}) EXPECT_EQ(store.add(body_of(i, box_of(i))).index, i);
  EXPECT_EQ(store.view().rows.first, nullptr);
  expect_boxes(store);
}

// All results of a step, as bytes.
std::string results_of(const World& world) {
  std::string bytes;
  const auto append = [&](const auto& list) {
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  append(world.pairs());
  append(world.overlaps());
  append(world.contacts());
  append(world.manifolds());
  return bytes;
}

// Two worlds of the same boxes, of which one has changed the places of its shapes.
TEST(PlacesOfShapes, ChangeNoResult) {
  for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
    World plain({.detail = detail}), other({.detail = detail});
    std::vector<BodyId> ids;
    for (uint32_t i = 0; i < kBodies; ++i) {
      plain.add(body_of(i, box_of(i)));
      ids.push_back(other.add(i % 2 ? body_of(i, capsule_of(i)) : body_of(i, Sphere{1})));
    }
    for (uint32_t i = 0; i < kBodies; ++i) {
      const uint32_t k = i * 7 % kBodies;
      other.set_shape(ids[k], box_of(k));
    }
    size_t elsewhere = 0;
    for (const BodyId id : ids) elsewhere += other.first_row(id) != id.index;
    EXPECT_GT(elsewhere, kBodies / 2);
    plain.step();
    other.step();
    EXPECT_GT(plain.report().overlaps, kBodies / 2);
    EXPECT_EQ(results_of(plain), results_of(other));
  }
}

}  // namespace
}  // namespace carom::test
