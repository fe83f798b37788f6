// Height fields: which grids are refused, where their triangles lie, which edges are inner ones,
// what an update changes, and which triangles searches find.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>

#include "geometries/height_search.h"
#include "tests/support/height_fields.h"
#include "tests/support/rounds.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using testing::HasSubstr;
using TriangleSet = std::set<uint32_t>;

constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

std::string refusal(const HeightGrid& grid) {
  const auto field = make_height_field(grid);
  return field ? "" : field.error().message;
}

const MeshGeometry& geometry(const Mesh& mesh) { return *mesh.geometry; }

// Bounds, corners and inner edges are those of a mesh of the same triangles.
void expect_like_mesh(const HeightFieldGeometry& field) {
  const Mesh made = mesh_like(field);
  const MeshGeometry& mesh = geometry(made);
  EXPECT_EQ(field.lower(), mesh.lower());
  EXPECT_EQ(field.upper(), mesh.upper());
  ASSERT_EQ(field.triangle_count(), mesh.triangles().size());
  for (uint32_t t = 0; t < field.triangle_count(); ++t) {
    SCOPED_TRACE(t);
    const uint32_t cell = t / 2;
    ASSERT_EQ(field.is_hole(cell % field.cells_x(), cell / field.cells_x()), mesh.is_degenerate(t));
    if (mesh.is_degenerate(t)) continue;
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(field.corners(t)[i], mesh.vertices()[mesh.triangles()[t][i]]);
    }
    for (const bool from_front : {false, true}) {
      EXPECT_EQ(field.inner_edges(t, from_front), mesh.inner_edges(t, from_front));
    }
  }
}

TriangleSet touching(const HeightFieldGeometry& field, const RoundedBox& box) {
  TriangleSet all;
  find_touching(field, box, [&](std::span<const uint32_t> triangles) {
    EXPECT_LE(triangles.size(), BoxTree::kMostAtOnce);
    for (const uint32_t t : triangles) EXPECT_TRUE(all.insert(t).second);
  });
  return all;
}

TriangleSet touching(const MeshGeometry& mesh, const RoundedBox& box) {
  TriangleSet all;
  mesh.tree().find_touching(box, [&](std::span<const uint32_t> triangles) {
    all.insert(triangles.begin(), triangles.end());
  });
  return all;
}

TEST(HeightField, BadGridsAreRefused) {
  const std::vector<float> heights(12);
  const HeightGrid good{.nx = 4, .ny = 3, .dx = 1, .dy = 2, .samples = {.data = heights.data()}};
  EXPECT_EQ(refusal(good), "");
  const auto changed = [&](const auto& change) {
    HeightGrid grid = good;
    change(grid);
    return refusal(grid);
  };
  for (const uint32_t bad : {0u, 1u, kMostHeightSamples + 1, 0xffffffffu}) {
    EXPECT_THAT(changed([&](HeightGrid& g) { g.nx = bad; }), HasSubstr("samples"));
    EXPECT_THAT(changed([&](HeightGrid& g) { g.ny = bad; }), HasSubstr("samples"));
  }
  EXPECT_THAT(changed([](HeightGrid& g) { g.nx = g.ny = kMostHeightSamples; }),
              HasSubstr("too many cells"));
  for (const float bad : {0.0f, -1.0f, kNoHeight, INFINITY, FLT_TRUE_MIN}) {
    EXPECT_THAT(changed([&](HeightGrid& g) { g.dx = bad; }), HasSubstr("spacing"));
    EXPECT_THAT(changed([&](HeightGrid& g) { g.dy = bad; }), HasSubstr("spacing"));
  }
  EXPECT_THAT(changed([](HeightGrid& g) { g.dx = 1e15f; }), HasSubstr("narrow"));
  EXPECT_THAT(changed([](HeightGrid& g) { g.dx = g.dy = 3e38f; }), HasSubstr("range"));
  EXPECT_THAT(changed([](HeightGrid& g) { g.samples.data = nullptr; }), HasSubstr("no samples"));
  for (const ptrdiff_t bad : {ptrdiff_t{4}, ptrdiff_t{15}, ptrdiff_t{-15}, PTRDIFF_MIN}) {
    EXPECT_THAT(changed([&](HeightGrid& g) { g.samples.row_stride = bad; }), HasSubstr("stride"));
  }
  for (const float bad : {0.0f, -1.0f, kNoHeight, INFINITY}) {
    EXPECT_THAT(changed([&](HeightGrid& g) {
                  g.samples.type = HeightType::int16;
                  g.scale = bad;
                }),
                HasSubstr("scale"));
  }
}

TEST(HeightField, InfiniteAndTooGreatHeightsAreRefused) {
  for (const float bad : {INFINITY, -INFINITY, 1e20f, -1e20f}) {
    for (const uint32_t at : {0u, 77u, 299u}) {
      HeightTable table{.nx = 100, .ny = 3, .heights = std::vector<float>(300)};
      table.heights[at] = bad;
      const auto field = make_height_field(table.grid());
      ASSERT_FALSE(field);
      EXPECT_THAT(field.error().message, HasSubstr("(" + std::to_string(at % 100) + ", " +
                                                   std::to_string(at / 100) + ")"));
    }
  }
}

TEST(HeightField, SamplesLieAroundTheOrigin) {
  const HeightTable table{.nx = 3, .ny = 2, .dx = 2, .dy = 3, .heights = {1, 2, 3, 4, 5, 6}};
  const auto field = geometry_of(table);
  EXPECT_EQ(field->point(0, 0), Vector3f(-2, -1.5f, 1));
  EXPECT_EQ(field->point(2, 1), Vector3f(2, 1.5f, 6));
  EXPECT_EQ(field->triangle_count(), 4u);
  const std::array<Vector3f, 3> below = {Vector3f(0, -1.5f, 2), {2, -1.5f, 3}, {2, 1.5f, 6}};
  const std::array<Vector3f, 3> above = {Vector3f(0, -1.5f, 2), {2, 1.5f, 6}, {0, 1.5f, 5}};
  EXPECT_EQ(field->corners(2), below);
  EXPECT_EQ(field->corners(3), above);
  expect_like_mesh(*field);
}

TEST(HeightField, EqualsMesh) {
  oracle::Random random(1);
  for (const uint32_t nx : {2u, 3u, 9u, 10u, 40u}) {
    for (const uint32_t ny : {2u, 5u, 33u}) {
      for (const double holes : {0.0, 0.03, 0.5}) {
        SCOPED_TRACE(std::to_string(nx) + " " + std::to_string(ny));
        for (const double bumps : {0.0, 0.001, 2.0}) {
          HeightTable table = random_heights(nx, ny, bumps, holes, random);
          table.dx = 0.3f;
          expect_like_mesh(*geometry_of(table));
        }
      }
    }
  }
}

TEST(HeightField, OfHolesAloneIsEmpty) {
  const HeightTable table{
      .nx = 3, .ny = 3, .heights = {1, kNoHeight, 1, kNoHeight, 1, kNoHeight, 1, kNoHeight, 1}};
  const auto field = geometry_of(table);
  EXPECT_TRUE(is_empty(*field));
  EXPECT_EQ(field->lower(), Vector3f(-1, -1, 0));
  EXPECT_EQ(field->upper(), Vector3f(1, 1, 0));
  EXPECT_TRUE(touching(*field, {{{-9, -9, -9}, {9, 9, 9}}, 0}).empty());
}

TEST(HeightField, ReadsAnyStrideAndType) {
  oracle::Random random(2);
  constexpr uint32_t kX = 19, kY = 12;
  std::vector<int16_t> samples(kX * kY);
  for (int16_t& sample : samples) {
    sample = random.chance(0.1) ? kHoleSample : static_cast<int16_t>(random.uniform(-9000, 9000));
  }
  HeightGrid of_steps{.nx = kX,
                      .ny = kY,
                      .dx = 1,
                      .dy = 1,
                      .samples = {.data = samples.data(), .type = HeightType::int16},
                      .scale = 0.001f,
                      .offset = 17.3f};
  const auto steps = *make_height_field(of_steps);
  expect_like_mesh(*steps);

  HeightTable table{.nx = kX, .ny = kY, .heights = std::vector<float>(kX * kY)};
  for (size_t i = 0; i < samples.size(); ++i) {
    table.heights[i] = samples[i] == kHoleSample
                           ? kNoHeight
                           : static_cast<float>(samples[i] * double{0.001f} + double{17.3f});
  }
  const auto dense = geometry_of(table);
  expect_like_mesh(*dense);

  // Rows at odd addresses, from the last to the first.
  constexpr ptrdiff_t kStride = kX * sizeof(float) + 3;
  std::vector<std::byte> memory(kStride * kY + 1);
  std::byte* const last = memory.data() + 1 + kStride * (kY - 1);
  for (uint32_t j = 0; j < kY; ++j) {
    std::memcpy(last - kStride * j, &table.heights[size_t{j} * kX], kX * sizeof(float));
  }
  HeightGrid strided = table.grid();
  strided.samples = {.data = last, .row_stride = -kStride};
  const auto copied = *make_height_field(strided);
  strided.borrow = true;
  const auto borrowed = *make_height_field(strided);
  for (const auto& field : {dense, copied, borrowed}) {
    for (uint32_t t = 0; t < field->triangle_count(); ++t) {
      for (size_t i = 0; i < 3; ++i) {
        const Vector3f expected = steps->corners(t)[i], found = field->corners(t)[i];
        EXPECT_EQ(expected.head(2), found.head(2));
        if (!std::isnan(expected.z())) {
          EXPECT_EQ(expected.z(), found.z());
        }
      }
      EXPECT_EQ(steps->inner_edges(t, true), field->inner_edges(t, true));
    }
    EXPECT_EQ(field->lower(), steps->lower());
    EXPECT_EQ(field->upper(), steps->upper());
  }
}

TEST(HeightField, HasMaterials) {
  const HeightTable table{.nx = 3, .ny = 3, .heights = std::vector<float>(9)};
  EXPECT_EQ(geometry_of(table)->material(5), 0);
  const std::array<uint8_t, 4> materials = {7, 8, 9, 200};
  HeightGrid grid = table.grid();
  grid.materials = materials.data();
  const auto field = *make_height_field(grid);
  for (uint32_t t = 0; t < 8; ++t) EXPECT_EQ(field->material(t), materials[t / 2]);
}

TEST(HeightField, SearchesFindWhatATreeFinds) {
  oracle::Random random(3);
  for (const uint32_t n : {2u, 9u, 70u, 200u}) {
    const HeightTable table = random_heights(n, n + 1, 1, n == 9 ? 0.2 : 0.01, random);
    const auto field = geometry_of(table);
    const Mesh made = mesh_like(*field);
    const MeshGeometry& mesh = geometry(made);
    const double half = n / 2.0;
    for (uint32_t k = 0; k < rounds(300); ++k) {
      const double size = std::pow(10, random.uniform(-2, 2.5));
      Double3 middle, its_half;
      for (size_t axis = 0; axis < 3; ++axis) {
        middle[axis] = random.uniform(-half - 2, half + 2) * (axis == 2 ? 1.5 / half : 1);
        its_half[axis] = size * random.uniform(0, 1);
      }
      if (random.chance(0.3)) its_half[2] = 0.1;
      for (const double radius : {0.0, size * random.uniform(0, 1)}) {
        const RoundedBox box = rounded_outwards(middle, its_half, radius);
        const TriangleSet found = touching(*field, box);
        ASSERT_EQ(found, touching(mesh, box));
        if (radius == 0 && !found.empty()) {
          EXPECT_TRUE(may_touch(*field, box.box));
        }
      }
      TriangleSet below, expected;
      const Double3 normal = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double limit = random.uniform(-half, half);
      find_below(*field, normal, limit, [&](uint32_t t) { below.insert(t); });
      mesh.tree().find_below(normal, limit, [&](uint32_t t) { expected.insert(t); });
      ASSERT_EQ(below, expected);
    }
  }
}

TEST(HeightField, NearTrianglesAreNoHoles) {
  oracle::Random random(4);
  for (int k = 0; k < 200; ++k) {
    const auto field = geometry_of(random_heights(30, 50, 1, k < 100 ? 0.5 : 0.02, random));
    if (is_empty(*field)) continue;
    const auto expect_no_hole = [&](uint32_t triangle) {
      const uint32_t cell = triangle / 2;
      EXPECT_FALSE(field->is_hole(cell % field->cells_x(), cell / field->cells_x()));
    };
    const auto x = static_cast<float>(random.uniform(-20, 20));
    const auto y = static_cast<float>(random.uniform(-20, 20));
    expect_no_hole(near_triangle(*field, {{x, y, 3}, {x + 1, y + 1, 4}}));
    expect_no_hole(low_triangle(*field, {x, y, 1}));
  }
}

TEST(HeightField, UpdatesEqualANewField) {
  oracle::Random random(5);
  for (int k = 0; k < 200; ++k) {
    const auto nx = static_cast<uint32_t>(2 + random.below(80));
    const auto ny = static_cast<uint32_t>(2 + random.below(80));
    HeightTable table = random_heights(nx, ny, 1, 0.02, random);
    HeightTable borrowed_table = table;
    HeightGrid grid = borrowed_table.grid();
    grid.borrow = true;
    const auto field = geometry_of(table), borrowed = *make_height_field(grid);
    HeightWindow window;
    window.i = static_cast<uint32_t>(random.below(nx));
    window.j = static_cast<uint32_t>(random.below(ny));
    window.ni = 1 + static_cast<uint32_t>(random.below(nx - window.i));
    window.nj = 1 + static_cast<uint32_t>(random.below(ny - window.j));
    const HeightTable patch = random_heights(window.ni, window.nj, 2, 0.05, random);
    for (uint32_t j = 0; j < window.nj; ++j) {
      for (uint32_t i = 0; i < window.ni; ++i) {
        table.at(window.i + i, window.j + j) = patch.heights[size_t{j} * window.ni + i];
      }
    }
    borrowed_table.heights = table.heights;
    ASSERT_EQ(grid.samples.data, borrowed_table.heights.data());
    ASSERT_TRUE(field->update(window, {.data = patch.heights.data()}));
    ASSERT_TRUE(borrowed->update(window));
    const auto expected = geometry_of(table);
    for (const auto& updated : {field, borrowed}) {
      const auto levels = updated->pyramid().levels(), fresh = expected->pyramid().levels();
      ASSERT_EQ(levels.size(), fresh.size());
      for (size_t level = 0; level < levels.size(); ++level) {
        for (size_t i = 0; i < levels[level].ranges.size(); ++i) {
          ASSERT_EQ(levels[level].ranges[i].low, fresh[level].ranges[i].low);
          ASSERT_EQ(levels[level].ranges[i].high, fresh[level].ranges[i].high);
        }
      }
      EXPECT_EQ(updated->lower(), expected->lower());
      EXPECT_EQ(updated->upper(), expected->upper());
    }
  }
}

TEST(HeightField, BadUpdatesChangeNothing) {
  const HeightTable table{.nx = 4, .ny = 3, .heights = std::vector<float>(12, 1)};
  const auto field = geometry_of(table);
  const std::vector<float> good(4, 5);
  const HeightSamples samples{.data = good.data()};
  const auto message = [&](const HeightWindow& window, const HeightSamples& given) {
    const Result<void> updated = field->update(window, given);
    return updated ? "" : updated.error().message;
  };
  for (const HeightWindow& bad :
       {HeightWindow{0, 0, 0, 1}, HeightWindow{0, 0, 1, 0}, HeightWindow{4, 0, 1, 1},
        HeightWindow{0, 3, 1, 1}, HeightWindow{3, 0, 2, 1}, HeightWindow{1, 1, 0xffffffffu, 1}}) {
    EXPECT_THAT(message(bad, samples), HasSubstr("window"));
  }
  EXPECT_THAT(message({1, 1, 2, 2}, {}), HasSubstr("no samples"));
  EXPECT_THAT(message({1, 1, 2, 2}, {.data = good.data(), .type = HeightType::int16}),
              HasSubstr("another type"));
  EXPECT_THAT(message({1, 1, 2, 2}, {.data = good.data(), .row_stride = 4}), HasSubstr("stride"));
  const std::vector<float> infinite = {5, 5, 5, INFINITY};
  EXPECT_THAT(message({1, 1, 2, 2}, {.data = infinite.data()}), HasSubstr("(2, 2)"));
  for (uint32_t i = 0; i < 12; ++i) EXPECT_EQ(field->height(i % 4, i / 4), 1);
  EXPECT_EQ(field->upper().z(), 1);

  HeightTable own = table;
  HeightGrid grid = own.grid();
  grid.borrow = true;
  const auto borrowed = *make_height_field(grid);
  EXPECT_FALSE(borrowed->update({0, 0, 1, 1}, samples));
  own.heights[5] = INFINITY;  // a hole from now on
  EXPECT_FALSE(borrowed->update({1, 1, 1, 1}));
  EXPECT_TRUE(borrowed->is_hole(0, 0) && borrowed->is_hole(1, 1));
  EXPECT_FALSE(borrowed->is_hole(2, 0));
  EXPECT_EQ(borrowed->upper().z(), 1);
}

TEST(HeightField, TakesLittleMoreMemoryThanItsHeights) {
  for (const HeightType type : {HeightType::float32, HeightType::int16}) {
    constexpr uint32_t kN = 1025;
    const size_t bytes = size_t{kN} * kN * (type == HeightType::float32 ? 4 : 2);
    const std::vector<std::byte> memory(bytes);
    HeightGrid grid{
        .nx = kN, .ny = kN, .dx = 1, .dy = 1, .samples = {.data = memory.data(), .type = type}};
    EXPECT_LT((*make_height_field(grid))->bytes(), bytes * 1.1);
    grid.borrow = true;
    EXPECT_LT((*make_height_field(grid))->bytes(), bytes * 0.1);
  }
}

}  // namespace
}  // namespace carom::test
