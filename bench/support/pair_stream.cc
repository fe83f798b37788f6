#include "bench/support/pair_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <numeric>

#include "bench/support/bodies.h"
#include "bench/support/measure.h"
#include "carom/narrowphase/collide.h"

namespace carom::bench {
namespace {

reference::PairResult reference_result(const PlacedShape& a, const PlacedShape& b,
                                       Storage storage) {
  return test::reference_result({a, b}, position_type(storage));
}

// How far B may be from A, as a multiple of the distance at which their bounds touch.
constexpr double kReach = 1.3;

// A random displacement from A to B that puts their bounds near each other.
Eigen::Vector3d draw_way(const PlacedShape& a, const PlacedShape& b, oracle::Random& random) {
  const Eigen::AlignedBox3d bounds_a = local_bounds(a), bounds_b = local_bounds(b);
  const Eigen::Vector3d reach = kReach / 2 * (bounds_a.sizes() + bounds_b.sizes());
  Eigen::Vector3d way = bounds_a.center() - bounds_b.center();
  for (int axis = 0; axis < 3; ++axis) way[axis] += random.uniform(-reach[axis], reach[axis]);
  return way;
}

// A random displacement from a half-space's position to a body near its plane.
Eigen::Vector3d draw_way_from_plane(const PlacedShape& plane, const PlacedShape& body,
                                    oracle::Random& random) {
  const auto& halfspace = std::get<Halfspace>(plane.shape);
  const Eigen::Vector3d normal = (plane.orientation * halfspace.normal).cast<double>();
  const Eigen::AlignedBox3d bounds = local_bounds(body);
  const double reach = kReach / 2 * bounds.sizes().dot(normal.cwiseAbs());
  const Eigen::Vector3d along = normal.cross(random.direction()) * 10;
  return normal * (halfspace.offset + random.uniform(-reach, reach)) + along - bounds.center();
}

Eigen::Vector3d draw_way(const StreamSpec& spec, const PlacedShape& a, const PlacedShape& b,
                         oracle::Random& random) {
  if (spec.kind_a == ShapeKind::halfspace) return draw_way_from_plane(a, b, random);
  if (spec.kind_b == ShapeKind::halfspace) return -draw_way_from_plane(b, a, random);
  return draw_way(a, b, random);
}

// A way out of A for a body that overlaps it: far, in any direction that a half-space does not
// fill.
Eigen::Vector3d draw_exit(const StreamSpec& spec, const PlacedShape& a, oracle::Random& random) {
  constexpr double kFar = 20;
  const Eigen::Vector3d way = kFar * random.direction();
  if (spec.kind_a != ShapeKind::halfspace) return way;
  const Eigen::Vector3d normal =
      (a.orientation * std::get<Halfspace>(a.shape).normal).cast<double>();
  return way.dot(normal) < 0 ? -way : way;
}

// A pair with B near A that overlaps or not, as `overlap` says.
test::TestPair draw_free_pair(const StreamSpec& spec, std::span<const Hull> hulls, bool overlap,
                              oracle::Random& random) {
  const PlacedShape a = draw_body(spec.kind_a, random, hulls);
  PlacedShape b = draw_body(spec.kind_b, random, hulls);
  const PlacedShape stored_a = as_stored(a, spec.storage);
  for (;;) {
    b.position = a.position + draw_way(spec, a, b, random);
    const PlacedShape stored_b = as_stored(b, spec.storage);
    if (reference_result(stored_a, stored_b, spec.storage).overlap == overlap) {
      return {stored_a, stored_b};
    }
  }
}

// A pair whose bodies touch to within the rounding of their positions: B lies between the last
// place where they overlap and the first where they do not, on a random way out of A.
test::TestPair draw_touching_pair(const StreamSpec& spec, std::span<const Hull> hulls,
                                  oracle::Random& random) {
  for (;;) {
    const test::TestPair inside = draw_free_pair(spec, hulls, true, random);
    const test::TestPair outside = {inside.a, [&] {
                                      PlacedShape b = inside.b;
                                      b.position += draw_exit(spec, inside.a, random);
                                      return as_stored(b, spec.storage);
                                    }()};
    if (reference_result(outside.a, outside.b, spec.storage).overlap) continue;
    PlacedShape low = inside.b, high = outside.b;
    for (int round = 0; round < 40; ++round) {
      PlacedShape middle = low;
      middle.position = 0.5 * (low.position + high.position);
      const PlacedShape stored = as_stored(middle, spec.storage);
      (reference_result(inside.a, stored, spec.storage).overlap ? low : high) = middle;
    }
    return {inside.a, as_stored(random.chance(0.5) ? low : high, spec.storage)};
  }
}

// Two boxes face to face.
test::TestPair draw_parallel_pair(const StreamSpec& spec, oracle::Random& random) {
  assert(spec.kind_a == ShapeKind::box && spec.kind_b == ShapeKind::box);
  constexpr double kMostAngle = 1e-2, kLeastAngle = 1e-8, kMostGap = 1.0 / 3, kLeastGap = 1e-8;
  const PlacedShape a = draw_body(ShapeKind::box, random, {});
  PlacedShape b = draw_body(ShapeKind::box, random, {});
  const Eigen::Vector3d half_a = std::get<Box>(a.shape).half.cast<double>();
  const Eigen::Vector3d half_b = std::get<Box>(b.shape).half.cast<double>();
  const double angle = random.chance(0.2) ? 0 : random.log_uniform(kLeastAngle, kMostAngle);
  const Eigen::Vector3f axis = random.direction().cast<float>();
  b.orientation = a.orientation * Eigen::AngleAxisf(static_cast<float>(angle), axis);
  const double gap = random.log_uniform(kLeastGap, kMostGap);
  const bool is_apart = random.chance(0.5);
  const auto side = static_cast<Eigen::Index>(random.below(3));
  Eigen::Vector3d way = random.direction() / 2;
  way[side] = half_a[side] + half_b[side] + (is_apart ? gap : -gap);
  b.position = a.position + a.orientation.cast<double>() * way;
  return {as_stored(a, spec.storage), as_stored(b, spec.storage)};
}

test::TestPair draw_pair(const StreamSpec& spec, std::span<const Hull> hulls, bool overlap,
                         oracle::Random& random) {
  switch (spec.placing) {
    case Placing::touching:
      return draw_touching_pair(spec, hulls, random);
    case Placing::parallel:
      return draw_parallel_pair(spec, random);
    case Placing::freely:
      break;
  }
  return draw_free_pair(spec, hulls, overlap, random);
}

std::vector<uint32_t> shuffled(size_t count, oracle::Random& random) {
  std::vector<uint32_t> places(count);
  std::iota(places.begin(), places.end(), 0);
  for (size_t i = count; i > 1; --i) std::swap(places[i - 1], places[random.below(i)]);
  return places;
}

// A coordinate of a witness point in the world; the position is the sum of two floats.
float world_coordinate(double position, float arm) {
  const auto high = static_cast<float>(position);
  const auto low = static_cast<float>(position - high);
  return high + (low + arm);
}

bool has_manifold_of(const reference::PairResult& expected, const Eigen::Vector3d& position,
                     const ResultColumns& out, size_t row) {
  if (out.manifold_count[row] != expected.manifold_count) return false;
  ManifoldPoints manifold = expected.manifold;
  for (size_t i = 0; i < expected.manifold_count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      float& x = manifold.point[i][static_cast<size_t>(axis)];
      x = world_coordinate(position[axis], x);
    }
  }
  return std::memcmp(&manifold, &out.manifold[row], sizeof manifold) == 0;
}

}  // namespace

const char* name(Detail detail) {
  static constexpr std::array<const char*, 4> kNames = {"pairs", "overlap", "contact", "manifold"};
  return kNames[static_cast<size_t>(detail)];
}

void spoil(ResultArrays& results) {
  for_each_column(
      [&]<class T>(const ColumnInfo&, T* column) {
        if (column) std::memset(static_cast<void*>(column), 0xff, results.count() * sizeof(T));
      },
      results.columns());
}

bool has_bits_of(const reference::PairResult& expected, const PlacedShape& a, const PlacedShape& b,
                 Detail detail, const ResultColumns& out, size_t row) {
  if (out.overlap[row] != (expected.overlap ? 1 : 0)) return false;
  if (out.status[row] != static_cast<uint8_t>(expected.status)) return false;
  if (detail == Detail::overlap) return true;

  bool same = same_bits(out.separation[row], expected.separation);
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<size_t>(axis);
    const float point_a = world_coordinate(a.position[axis], expected.arm_a[axis]);
    const float point_b = world_coordinate(b.position[axis], expected.arm_b[axis]);
    same = same && same_bits(out.normal[column][row], expected.normal[axis]) &&
           same_bits(out.point_a[column][row], point_a) &&
           same_bits(out.point_b[column][row], point_b);
  }
  return same && (detail == Detail::contact || has_manifold_of(expected, a.position, out, row));
}

PairStream::PairStream(const StreamSpec& spec) : spec_(spec) {
  draw();
  a_ = std::make_unique<DenseBodies>(spec.kind_a, bodies_a_, spec.storage);
  b_ = std::make_unique<DenseBodies>(spec.kind_b, bodies_b_, spec.storage);
  PassTimes times;
  for (int pass = 0; pass < 3; ++pass) times.measure([&] { run_reference(expected_); });
  reference_seconds_ = times.median();
}

void PairStream::draw() {
  oracle::Random random(1);
  std::vector<uint32_t> places(spec_.count);
  std::iota(places.begin(), places.end(), 0);
  if (spec_.access == Access::pairs) places = shuffled(spec_.count, random);
  bodies_b_.resize(spec_.count);
  const bool has_hull =
      core_kind(spec_.kind_a) == ShapeKind::hull || core_kind(spec_.kind_b) == ShapeKind::hull;
  const std::vector<Hull> hulls = draw_hulls(has_hull ? kHulls : 0, spec_.vertices, random);
  // Exactly `hits` pairs overlap, at random places.
  const size_t hits = spec_.count * static_cast<size_t>(spec_.hit_percent) / 100;
  const std::vector<uint32_t> ranks = shuffled(spec_.count, random);
  for (uint32_t row = 0; row < spec_.count; ++row) {
    const test::TestPair pair = draw_pair(spec_, hulls, ranks[row] < hits, random);
    bodies_a_.push_back(pair.a);
    bodies_b_[places[row]] = pair.b;
    pairs_.push_back({row, places[row]});
  }
}

double PairStream::hit_percent() const {
  const auto hits =
      std::count_if(expected_.begin(), expected_.end(),
                    [](const reference::PairResult& result) { return result.overlap; });
  return 100.0 * static_cast<double>(hits) / static_cast<double>(spec_.count);
}

size_t PairStream::bytes_per_pair(Detail detail) const {
  size_t bytes = a_->bytes_per_body() + b_->bytes_per_body();
  for_each_column(
      [&]<class T>(const ColumnInfo& info, T*) {
        if (info.detail <= detail && !is_optional(info.role)) bytes += sizeof(T);
      },
      ResultColumns());
  return spec_.access == Access::pairs ? bytes + sizeof(Pair) : bytes;
}

Result<void> PairStream::run(Detail detail, const ResultColumns& out, Measured measured) const {
  return run(*b_, detail, out, measured);
}

Result<void> PairStream::run_next_step(Detail detail, const ResultColumns& out,
                                       Measured measured) const {
  return run(*b_next_, detail, out, measured);
}

Result<void> PairStream::run(const DenseBodies& b, Detail detail, const ResultColumns& out,
                             Measured measured) const {
  const CollideOptions options = {.measured = measured};
  if (spec_.access == Access::rows) {
    return collide_rows(a_->view(), b.view(), detail, out, options);
  }
  return collide(a_->view(), b.view(), pairs_, detail, out, options);
}

void PairStream::draw_next_step() {
  oracle::Random random(2);
  std::vector<PlacedShape> moved = bodies_b_;
  for (PlacedShape& body : moved) {
    const double size = local_bounds(body).diagonal().norm();
    body.position += kStepLength * size * random.direction();
    const Eigen::AngleAxisd turn(kStepAngle, random.direction());
    body.orientation = (Eigen::Quaterniond(turn) * body.orientation.cast<double>()).cast<float>();
    body = as_stored(body, spec_.storage);
  }
  b_next_ = std::make_unique<DenseBodies>(spec_.kind_b, moved, spec_.storage);
}

void PairStream::run_reference(std::vector<reference::PairResult>& out) const {
  out.resize(pairs_.size());
  for (size_t row = 0; row < pairs_.size(); ++row) {
    out[row] = reference_result(bodies_a_[pairs_[row].a], bodies_b_[pairs_[row].b], spec_.storage);
  }
}

std::optional<std::string> PairStream::difference(Detail detail, const ResultColumns& out) const {
  for (size_t row = 0; row < pairs_.size(); ++row) {
    const Pair pair = pairs_[row];
    if (!has_bits_of(expected_[row], bodies_a_[pair.a], bodies_b_[pair.b], detail, out, row)) {
      return "row " + std::to_string(row) + " differs from the reference";
    }
  }
  return std::nullopt;
}

}  // namespace carom::bench
