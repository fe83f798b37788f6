#include "impacts/composite_times.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "geometries/mesh_memory.h"
#include "impacts/mesh_path.h"
#include "impacts/moving_body.h"
#include "impacts/part_sweep.h"
#include "impacts/rays/point_times.h"
#include "midphase/part_batch.h"

namespace carom {
namespace {

using Float3 = std::array<float, 3>;

// One side of the pairs of parts, and the motion of each body.
struct MovingParts {
  PartColumns columns;
  std::array<Float3, kPairsPerBlock> displacement, rotation;
  std::array<Double3, kPairsPerBlock> arm;

  uint32_t put(size_t owner, const PlacedPart& part, const BodySweep& sweep) {
    const uint32_t body = columns.put(owner, part, {});
    for (size_t axis = 0; axis < 3; ++axis) {
      displacement[body][axis] = static_cast<float>(sweep.displacement[axis]);
      rotation[body][axis] = static_cast<float>(sweep.rotation[axis]);
    }
    arm[body] = part.arm;
    return body;
  }

  SweepView sweep() const {
    return {.displacement = displacement[0].data(), .rotation = rotation[0].data()};
  }
};

struct Scratch {
  MovingParts a, b;
  size_t count;
  std::array<Pair, kPairsPerBlock> pairs;
  std::array<uint16_t, kPairsPerBlock> owner;
  std::array<double, kPairsPerBlock> latest;  // of each owner
  std::array<double, kPairsPerBlock> time;
  std::array<uint8_t, kPairsPerBlock> status;

  void clear() {
    a.columns.clear(PartColumns::Corners::as_made);
    b.columns.clear(PartColumns::Corners::as_made);
    count = 0;
  }
};

BodySweep sweep_of(const MovingReader& side, size_t i) {
  const Position<float> d = side.displacement(i), w = side.rotation(i);
  return {{d.x, d.y, d.z}, {w.x, w.y, w.z}};
}

// Triangles per pair in the first round of a search along a path, and in the last ones.
constexpr size_t kFirstTriangles = 4, kMostTriangles = 32;

// Finds the first time among the pairs of parts of each pair of bodies. Pairs of parts of many
// bodies share a batch.
class CompositeTimes {
 public:
  CompositeTimes(std::span<FirstTime> times, Scratch& scratch) : times_(times), scratch_(scratch) {
    scratch_.clear();
  }

  void add(size_t owner, const PlacedPart& a, const BodySweep& sweep_a, const PlacedPart& b,
           const BodySweep& sweep_b) {
    if (scratch_.count == kPairsPerBlock) run();
    scratch_.owner[scratch_.count] = static_cast<uint16_t>(owner);
    scratch_.pairs[scratch_.count++] = {scratch_.a.put(owner, a, sweep_a),
                                        scratch_.b.put(owner, b, sweep_b)};
  }

  void run() {
    if (scratch_.count > 0) find_times();
    for (size_t i = 0; i < scratch_.count; ++i) {
      const Pair pair = scratch_.pairs[i];
      keep(scratch_.owner[i],
           {scratch_.time[i],
            static_cast<Status>(scratch_.status[i]),
            {scratch_.a.columns.order(pair.a), scratch_.b.columns.order(pair.b)}});
    }
    scratch_.clear();
  }

 private:
  void find_times() {
    const Collidables a = scratch_.a.columns.view(), b = scratch_.b.columns.view();
    for (size_t i = 0; i < scratch_.count; ++i) {
      const size_t owner = scratch_.owner[i];
      scratch_.latest[owner] = std::min(times_[owner].time, 1.0);
    }
    const GroupsOfRows of_owner = {scratch_.owner.data(), scratch_.latest.data()};
    find_simple_times({a, scratch_.a.sweep(), scratch_.a.arm.data()},
                      {b, scratch_.b.sweep(), scratch_.b.arm.data()}, scratch_.pairs.data(),
                      scratch_.count, {scratch_.time.data(), scratch_.status.data()}, &of_owner);
  }

  // Among equal times the parts with the lowest indices win, whatever the order of the search.
  void keep(size_t owner, const FirstTime& found) {
    FirstTime& first = times_[owner];
    const auto order = [](const FirstTime& t) { return std::tuple(t.time, t.parts); };
    if (order(found) < order(first)) first = found;
  }

  const std::span<FirstTime> times_;
  Scratch& scratch_;
};

// A pair of a mesh and a simple shape that move in straight lines, while its triangles are
// searched.
struct PathSearch {
  const size_t owner;
  const double limit;
  const PlacedBodies bodies;
  const BodySweep sweep_a, sweep_b;
  const bool mesh_is_a;
  std::optional<MeshPath> path;
  TreeWalk walk;

  PathSearch(const MovingSide& a, const MovingSide& b, Pair pair, size_t its_owner,
             double its_limit)
      : owner(its_owner),
        limit(its_limit),
        bodies(a, b, pair),
        sweep_a(sweep_of({a}, pair.a)),
        sweep_b(sweep_of({b}, pair.b)),
        mesh_is_a(bodies.a.kind() == ShapeKind::mesh) {
    if (!MeshPath::serves(mesh(), mesh_is_a ? sweep_a : sweep_b, shape(),
                          mesh_is_a ? sweep_b : sweep_a)) {
      return;
    }
    path.emplace(mesh(), mesh_is_a ? sweep_a : sweep_b, shape(), mesh_is_a ? sweep_b : sweep_a,
                 limit);
    if (!path->is_in_range()) path.reset();
    if (path && !path->is_empty()) walk.start(mesh().mesh().tree());
  }

  const PlacedPart& mesh() const { return mesh_is_a ? bodies.a : bodies.b; }
  const PlacedPart& shape() const { return mesh_is_a ? bodies.b : bodies.a; }

  // Calls use(part of A, part of B).
  template <class Use>
  void use(uint32_t triangle, const Use& use) const {
    const PlacedPart part = mesh().item(triangle);
    use(mesh_is_a ? part : shape(), mesh_is_a ? shape() : part);
  }
};

// The triangles that the searches of a round find.
class FoundTriangles {
 public:
  // At most `most` for each search, within its limit and up to its first time so far.
  void find(std::span<PathSearch* const> active, std::span<const FirstTime> times, size_t most) {
    if (triangles_.size() < active.size() * most) triangles_.resize(active.size() * most);
    searches_.clear();
    for (PathSearch* search : active) {
      const double latest = std::min(times[search->owner].time, search->limit);
      searches_.push_back(
          search->path->search(latest, search->walk, triangles_.data() + searches_.size() * most));
    }
    walk_met(searches_, most);
  }

  // Calls use(index of the search, triangle) for all.
  template <class Use>
  void for_each(const Use& use) const {
    for (size_t i = 0; i < searches_.size(); ++i) {
      for (size_t k = 0; k < searches_[i].count; ++k) use(i, searches_[i].items[k]);
    }
  }

 private:
  std::vector<uint32_t> triangles_;
  std::vector<MetSearch> searches_;
};

}  // namespace

PlacedBodies::PlacedBodies(const MovingSide& side_a, const MovingSide& side_b, Pair pair)
    : part_a(body_part({side_a.bodies}, pair.a)),
      part_b(body_part({side_b.bodies}, pair.b)),
      a(part_a, {}),
      b(part_b, {}) {
  b.position = place_between({side_a}, {side_b}, pair);
  a.one_sided = side_a.one_sided;
  b.one_sided = side_b.one_sided;
}

void find_composite_times(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          std::span<const uint16_t> rows, const TimesWanted& wanted,
                          std::span<FirstTime> times) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<Scratch>();
  static thread_local std::deque<PathSearch> searches;
  static thread_local std::vector<PathSearch*> active;
  static thread_local FoundTriangles found;
  searches.clear();
  active.clear();
  const MovingReader reader_a{a}, reader_b{b};
  CompositeTimes run(times, *scratch);
  PointTimes points(a, b, wanted.any, times);
  for (size_t owner = 0; owner < rows.size(); ++owner) {
    const Pair pair = pairs[rows[owner]];
    times[owner] = {scalar::kNever};
    const double limit = wanted.latest ? std::min(wanted.latest[rows[owner]], 1.0) : 1.0;
    if (points.add(owner, pair, limit)) continue;
    if (!reader_a.is_valid(pair.a) || !reader_b.is_valid(pair.b)) {
      times[owner] = {std::numeric_limits<double>::quiet_NaN(), Status::invalid};
      continue;
    }
    PathSearch& search = searches.emplace_back(a, b, pair, owner, limit);
    const auto add = [&](const PlacedPart& part_a, const PlacedPart& part_b) {
      run.add(owner, part_a, search.sweep_a, part_b, search.sweep_b);
    };
    if (!search.path) {
      find_swept_part_pairs(search.bodies.a, search.sweep_a, search.bodies.b, search.sweep_b, add);
    }
    if (search.path && !search.walk.is_done()) {
      active.push_back(&search);
    } else {
      searches.pop_back();
    }
  }
  for (const LeftTriangle& left : points.finish()) {
    const PlacedBodies bodies(a, b, left.pair);
    const bool mesh_is_a = bodies.a.kind() == ShapeKind::mesh;
    run.add(left.owner, mesh_is_a ? bodies.a.item(left.triangle) : bodies.a,
            sweep_of(reader_a, left.pair.a), mesh_is_a ? bodies.b : bodies.b.item(left.triangle),
            sweep_of(reader_b, left.pair.b));
  }
  // Each round tests some more triangles of every pair. The times found limit the next round.
  for (size_t most = kFirstTriangles; !active.empty(); most = std::min(2 * most, kMostTriangles)) {
    found.find(active, times, most);
    // Triangles lie far apart in memory.
    found.for_each(
        [&](size_t i, uint32_t triangle) { prefetch_indices(active[i]->mesh().mesh(), triangle); });
    found.for_each(
        [&](size_t i, uint32_t triangle) { prefetch_corners(active[i]->mesh().mesh(), triangle); });
    found.for_each([&](size_t i, uint32_t triangle) {
      const PathSearch& search = *active[i];
      search.use(triangle, [&](const PlacedPart& part_a, const PlacedPart& part_b) {
        run.add(search.owner, part_a, search.sweep_a, part_b, search.sweep_b);
      });
    });
    run.run();
    std::erase_if(active, [](PathSearch* search) { return search->walk.is_done(); });
  }
  run.run();
}

}  // namespace carom
