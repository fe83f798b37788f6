// Queries of a world with owners, layers, predicates and backfaces: hits equal brute force over all
// bodies.
#include <gtest/gtest.h>

#include <algorithm>

#include "carom/base/thread_arena.h"
#include "carom/results/result_arrays.h"
#include "carom/results/result_row.h"
#include "carom/shapes/scaled.h"
#include "tests/support/cast_checks.h"
#include "tests/support/rounds.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

constexpr size_t kFilterQueries = 60;

// One-sided and two-sided meshes, alone and in compounds.
Shape mesh_shape(size_t i, Composites& composites) {
  const auto bumps = [&](float, float) { return composites.random().uniform(-0.3, 0.3); };
  const Mesh mesh = grid_mesh(4, 0.5f, bumps, {.one_sided = i % 2 == 0});
  if (i % 3 != 0) return mesh;
  return compound_of({{mesh, {0.1f, 0, 0.2f}}, {Sphere{0.2f}, {0, 0.5f, 0}}});
}

// A world with filters of all kinds, some of whose indices are free, and queries. `bodies` have the
// layers, masks and owners, by index.
struct FilteredWorld {
  World world;
  std::vector<BodyDesc> bodies;
  std::vector<Pair> pairs;  // of queries and living bodies
  std::vector<PlacedShape> queries, placed;
  Sweeps sweeps;

  explicit FilteredWorld(PositionType positions) : world({.positions = positions}) {
    bodies = make_crowd({.count = 150, .side = 6, .oriented = true, .halfspaces = 2});
    Composites composites(5);
    Random& random = composites.random();
    for (size_t i = 0; i < 40; ++i) {
      bodies.push_back({.shape = mesh_shape(i, composites),
                        .position = random_position(random, 6),
                        .orientation = composites.orientation()});
    }
    for (BodyDesc& body : bodies) {
      body.layer = 1u << random.below(4);
      body.mask = static_cast<uint32_t>(random.below(16));
      body.owner = static_cast<uint32_t>(random.below(4));
    }
    std::vector<BodyId> ids;
    world.add(bodies, ids);
    for (size_t i = 0; i < ids.size(); i += 3) {
      world.set_space(ids[i], 2);
      bodies[i].space = 2;
    }
    for (size_t i = 0; i < ids.size(); i += 5) {
      world.set_group(ids[i], -1);
      bodies[i].group = -1;
    }
    // Other properties of bodies do not count.
    for (size_t i = 0; i < ids.size(); i += 7) world.set_motion(ids[i], Motion::fixed);
    for (size_t i = 0; i < ids.size(); i += 11) world.set_sensor(ids[i], true);
    world.set_filter(ids[20], 2, 15, 3);
    bodies[20].layer = 2, bodies[20].mask = 15, bodies[20].owner = 3;
    for (const size_t i : {3, 60, 159}) world.remove(ids[i]);
    world.step();

    queries = make_bodies({.count = kFilterQueries, .side = 6, .positions = positions}, 3);
    sweeps = make_sweeps(kFilterQueries, 5, true, 4);
    for (const BodyDesc& body : bodies) {
      placed.push_back({body.shape, body.position, body.orientation});
    }
    pairs = all_pairs(queries, placed);
    std::erase_if(pairs, [&](const Pair& pair) { return !world.is_alive(pair.b); });
  }
};

// A predicate's rule.
bool is_wanted(const Pair& pair) { return (5 * pair.a + pair.b) % 3 != 0; }

void drop_unwanted(std::span<const Pair> pairs, std::span<uint8_t> keep) {
  for (size_t i = 0; i < pairs.size(); ++i) keep[i] = is_wanted(pairs[i]);
}

// Filters, and which bodies of a query they keep.
struct NamedFilter {
  QueryFilter filter;
  bool asks = false;  // the predicate above

  bool keeps(const Pair& pair, const BodyDesc& body) const {
    return (body.layer & filter.mask) != 0 && (!filter.layer || (body.mask & filter.layer) != 0) &&
           (!filter.owner || body.owner != filter.owner) &&
           (!filter.space || body.space == *filter.space) &&
           (filter.group >= 0 || body.group != filter.group) && (!asks || is_wanted(pair));
  }
};

std::vector<NamedFilter> filters_to_try() {
  std::vector<NamedFilter> filters;
  for (const uint32_t mask : {~0u, 5u}) {
    for (const uint32_t layer : {0u, 2u, 12u}) {
      for (const uint32_t owner : {0u, 3u}) {
        for (const bool asks : {false, true}) {
          NamedFilter each{{.mask = mask, .layer = layer, .owner = owner}, asks};
          if (asks) each.filter.predicate = drop_unwanted;
          filters.push_back(each);
          if (layer != 0) continue;
          each.filter.space = owner == 0 ? 0 : 2;
          each.filter.group = asks ? -1 : 0;
          filters.push_back(each);
        }
      }
    }
  }
  filters.resize(rounds(static_cast<uint32_t>(filters.size()), 10));
  return filters;
}

template <class Hit>
std::vector<Hit> hits_kept(std::vector<Hit> hits, const NamedFilter& filter,
                           const FilteredWorld& scene) {
  std::erase_if(hits, [&](const Hit& hit) {
    return !filter.keeps({hit.query, hit.body}, scene.bodies[hit.body]);
  });
  return hits;
}

TEST(WorldQueryFilters, OfCasts) {
  for (const PositionType positions : kPositionTypes) {
    const FilteredWorld scene(positions);
    const LaidOut a(scene.queries, {.positions = positions});
    const LaidOut b(scene.placed, {.positions = positions});
    const std::vector<CastHit> everything =
        brute_force(a.view(), scene.sweeps.view(), b.view(), scene.pairs);
    EXPECT_GT(everything.size(), 500u);
    for (const NamedFilter& filter : filters_to_try()) {
      const std::vector<CastHit> expected = hits_kept(everything, filter, scene);
      EXPECT_GT(expected.size(), 20u);
      const auto hits_of = [&](CastHits which) {
        std::vector<CastHit> hits(1);
        scene.world.cast(a.view(), scene.sweeps.view(), hits,
                         {.hits = which, .filter = filter.filter});
        return hits;
      };
      EXPECT_EQ(bits_of(hits_of(CastHits::all)), bits_of(expected));
      EXPECT_EQ(bits_of(hits_of(CastHits::closest)), bits_of(closest_of(expected)));
      std::vector<uint32_t> hit, expected_hit;
      for (const CastHit& each : hits_of(CastHits::any)) hit.push_back(each.query);
      for (const CastHit& each : closest_of(expected)) expected_hit.push_back(each.query);
      EXPECT_EQ(hit, expected_hit);
    }
  }
}

TEST(WorldQueryFilters, OfOverlapsAndNearestBodies) {
  for (const PositionType positions : kPositionTypes) {
    const FilteredWorld scene(positions);
    const LaidOut a(scene.queries, {.positions = positions});
    const LaidOut b(scene.placed, {.positions = positions});
    const ResultArrays rows(scene.pairs.size(), Detail::contact);
    ASSERT_TRUE(bool(collide(a.view(), b.view(), scene.pairs, Detail::contact, rows.columns(),
                             {.frame = WitnessFrame::body})));
    size_t overlaps = 0, not_the_nearest = 0;
    for (const NamedFilter& filter : filters_to_try()) {
      std::vector<OverlapHit> expected, overlapping(1);
      std::vector<size_t> nearest;  // rows
      for (size_t i = 0; i < scene.pairs.size(); ++i) {
        const Pair pair = scene.pairs[i];
        const ResultRow row = result_row(rows.columns(), i);
        if (!filter.keeps(pair, scene.bodies[pair.b])) continue;
        if (row.overlap) expected.push_back({pair.a, pair.b});
        if (!(row.separation <= 1)) continue;
        const bool is_first = nearest.empty() || scene.pairs[nearest.back()].a != pair.a;
        if (is_first) {
          nearest.push_back(i);
        } else if (row.separation < rows.columns().separation[nearest.back()]) {
          nearest.back() = i;
        }
      }
      const QueryOptions options{.filter = filter.filter};
      scene.world.find_overlaps(a.view(), overlapping, options);
      EXPECT_TRUE(overlapping == expected);
      overlaps += expected.size();
      std::vector<NearestHit> hits(1), unfiltered;
      scene.world.find_nearest(a.view(), 1, hits, options);
      scene.world.find_nearest(a.view(), 1, unfiltered);
      ASSERT_EQ(hits.size(), nearest.size());
      for (size_t i = 0; i < hits.size(); ++i) {
        const ResultRow row = result_row(rows.columns(), nearest[i]);
        EXPECT_EQ(hits[i].query, scene.pairs[nearest[i]].a);
        EXPECT_EQ(hits[i].body, scene.pairs[nearest[i]].b);
        EXPECT_EQ(hits[i].separation, row.separation);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(hits[i].normal[axis], row.normal[axis]);
          EXPECT_EQ(hits[i].point_query[axis], row.point_a[axis]);
          EXPECT_EQ(hits[i].point_body[axis], row.point_b[axis]);
        }
        not_the_nearest += std::none_of(unfiltered.begin(), unfiltered.end(), [&](const auto& hit) {
          return hit.query == hits[i].query && hit.body == hits[i].body;
        });
      }
    }
    EXPECT_GT(overlaps, 1000u);
    EXPECT_GT(not_the_nearest, 200u);
  }
}

TEST(WorldQueryFilters, OnThreads) {
  const FilteredWorld scene(PositionType::float32);
  const LaidOut a(scene.queries, {});
  const NamedFilter filter{{.layer = 13, .owner = 1, .predicate = drop_unwanted}, true};
  const auto answers_on = [&](Parallelism parallelism) {
    std::vector<CastHit> casts;
    scene.world.cast(a.view(), scene.sweeps.view(), casts,
                     {.hits = CastHits::all, .filter = filter.filter, .parallelism = parallelism});
    std::vector<OverlapHit> overlaps;
    scene.world.find_overlaps(a.view(), overlaps,
                              {.filter = filter.filter, .parallelism = parallelism});
    EXPECT_GT(casts.size(), 100u);
    EXPECT_GT(overlaps.size(), 30u);
    return bits_of(casts) + as_bytes(std::span<const OverlapHit>(overlaps));
  };
  const std::string expected = answers_on(Parallelism::none);
  ThreadArena arena(2);
  arena.run([&] { EXPECT_EQ(answers_on(Parallelism::arena), expected); });
}

// --- Backfaces ---

// The shape with all its meshes made one-sided or two-sided.
Shape made(const Shape& shape, bool one_sided) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    const MeshGeometry& geometry = *mesh->geometry;
    MeshRules rules = geometry.rules();
    rules.one_sided = one_sided;
    const auto changed = make_mesh(geometry.vertices(), geometry.triangles(), rules);
    return Mesh{*scaled(*changed, geometry.scale())};
  }
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return shape;
  std::vector<CompoundChild> children(compound->geometry->children().begin(),
                                      compound->geometry->children().end());
  for (CompoundChild& child : children) child.shape = made(child.shape, one_sided);
  return compound_of(children);
}

// Hits are those of bodies whose meshes were made as the option says, with a filter as well.
TEST(WorldQueryFilters, WithBackfaces) {
  const FilteredWorld scene(PositionType::float32);
  // Queries that are no composites: backfaces are about bodies.
  std::vector<PlacedShape> queries;
  std::vector<Pair> pairs;
  Composites composites(9);
  for (size_t i = 0; i < 150; ++i) {
    const ShapeKind kind = i % 2 ? ShapeKind::capsule : ShapeKind::sphere;
    queries.push_back({composites.simple(kind, 0.1), random_position(composites.random(), 6),
                       composites.orientation()});
  }
  const Sweeps sweeps = make_sweeps(queries.size(), 5, false, 10);
  const LaidOut a(queries, {});
  pairs = all_pairs(queries, scene.placed);
  std::erase_if(pairs, [&](const Pair& pair) { return !scene.world.is_alive(pair.b); });
  const NamedFilter filters[] = {{{}, false}, {{.owner = 2, .predicate = drop_unwanted}, true}};
  std::vector<std::string> answers;
  for (const Backfaces backfaces : {Backfaces::as_made, Backfaces::hit, Backfaces::ignore}) {
    std::vector<PlacedShape> bodies = scene.placed;
    for (PlacedShape& body : bodies) {
      if (backfaces != Backfaces::as_made) {
        body.shape = made(body.shape, backfaces == Backfaces::ignore);
      }
    }
    const LaidOut b(bodies, {});
    const std::vector<CastHit> everything = brute_force(a.view(), sweeps.view(), b.view(), pairs);
    for (const NamedFilter& filter : filters) {
      const std::vector<CastHit> expected = hits_kept(everything, filter, scene);
      EXPECT_GT(expected.size(), 200u);
      for (const CastHits which : {CastHits::all, CastHits::closest}) {
        std::vector<CastHit> hits(1);
        scene.world.cast(a.view(), sweeps.view(), hits,
                         {.hits = which, .backfaces = backfaces, .filter = filter.filter});
        const std::vector<CastHit> wanted =
            which == CastHits::all ? expected : closest_of(expected);
        EXPECT_TRUE(bits_of(hits) == bits_of(wanted)) << show(hits, wanted);
      }
      answers.push_back(bits_of(expected));
    }
  }
  std::sort(answers.begin(), answers.end());
  EXPECT_EQ(std::unique(answers.begin(), answers.end()), answers.end());
}

}  // namespace
}  // namespace carom::test
