// Views of some bodies read what the view of all reads, in every layout.
#include "shapes/run_of_bodies.h"

#include <gtest/gtest.h>

#include <bit>

#include "shapes/body_reader.h"
#include "tests/support/query_bodies.h"

namespace carom::test {
namespace {

// A row may hold the address of a geometry, which is NaN where it is read as numbers.
auto bits_of(const std::array<float, 4>& row) {
  return std::bit_cast<std::array<uint32_t, 4>>(row);
}

void expect_same_body(const Collidables& run, size_t i, const Collidables& all, size_t body) {
  const BodyReader here{run}, there{all};
  ASSERT_EQ(here.kind(i), there.kind(body));
  const auto at = here.position<double>(i), where = there.position<double>(body);
  EXPECT_EQ(std::tie(at.x, at.y, at.z), std::tie(where.x, where.y, where.z));
  const ShapeKind kind = here.kind(i);
  if (kind == ShapeKind::sphere) {
    EXPECT_EQ(here.radius(i), there.radius(body));
  } else if (kind == ShapeKind::aabb) {
    for (size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(here.lower(axis, i), there.lower(axis, body));
      EXPECT_EQ(here.upper(axis, i), there.upper(axis, body));
    }
  } else {
    EXPECT_EQ(here.orientation(i), there.orientation(body));
    EXPECT_EQ(here.dop_geometry(i), there.dop_geometry(body));
    for (size_t k = 0; k < row_count(kind); ++k) {
      EXPECT_EQ(bits_of(here.row(i, k)), bits_of(there.row(body, k)));
    }
  }
}

void expect_runs(const std::vector<PlacedShape>& bodies, const Layout& layout) {
  const LaidOut laid_out(bodies, layout);
  const Collidables& all = laid_out.view();
  for (const size_t first : {size_t{0}, size_t{1}, bodies.size() / 2, bodies.size() - 1}) {
    const size_t count = bodies.size() - first;
    const Collidables run = run_of_bodies(all, first, count);
    ASSERT_EQ(run.count, count);
    for (size_t i = 0; i < count; ++i) {
      SCOPED_TRACE(show(layout) + ", body " + std::to_string(first + i));
      expect_same_body(run, i, all, first + i);
    }
  }
}

const std::vector<Layout> kLayouts = {
    {},
    {.always_kinds = true},
    {.positions = PositionType::float64, .radius = RadiusLayout::column, .stride = 40},
    {.radius = RadiusLayout::column, .stride = 28, .radius_stride = 12, .box_stride = 8},
    {.box_stride = 0},
    {.box_stride = 0, .box_slots = true, .orientation_stride = 24, .rows = RowOrder::backwards},
    {.orientation_stride = 0, .rows = RowOrder::shared},
};

TEST(RunOfBodies, ReadsBodiesOfAllKinds) {
  const std::vector<PlacedShape> bodies = make_bodies({.invalid = 0}, 1);
  for (const Layout& layout : kLayouts) expect_runs(bodies, layout);
}

// An address whose lower half is 0x7f800001 to 0x7fffffff is no number, and unequal to itself.
TEST(RunOfBodies, ReadsAddressesThatAreNotNumbers) {
  const auto address = geometry_row(std::bit_cast<const void*>(uint64_t{0x55557fc00010}));
  ASSERT_NE(address[0], address[0]);
  const std::array<std::array<float, 4>, 2> rows = {{{1, 2, 3, 4}, address}};
  Collidables all;
  all.count = 2;
  all.uniform_kind = ShapeKind::hull;
  all.rows.data = rows[0].data();
  const Collidables run = run_of_bodies(all, 1, 1);
  EXPECT_EQ(bits_of(BodyReader{run}.row(0, 0)), bits_of(address));
}

TEST(RunOfBodies, ReadsBodiesOfOneKind) {
  const std::vector<PlacedShape> mixed = make_bodies({.count = 400, .invalid = 0}, 2);
  for (int kind = 0; kind < kShapeKindCount; ++kind) {
    std::vector<PlacedShape> bodies;
    for (const PlacedShape& body : mixed) {
      if (kind_of(body.shape) == static_cast<ShapeKind>(kind)) bodies.push_back(body);
    }
    ASSERT_GE(bodies.size(), 3u) << kind;
    for (const Layout& layout : kLayouts) expect_runs(bodies, layout);
  }
}

}  // namespace
}  // namespace carom::test
