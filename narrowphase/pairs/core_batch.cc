#include "narrowphase/pairs/core_batch.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/row_selection.h"
#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/doubles/furthest.h"
#include "narrowphase/hulls/fetch_solid.h"
#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/shell.h"
#include "narrowphase/pairs/all_pairs.h"
#include "narrowphase/pairs/core_row.h"
#include "narrowphase/pairs/manifold_batch.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {
namespace {

template <class T, class Real>
auto shape_at(const BodyReader& body, size_t index) {
  if constexpr (std::is_same_v<T, Hull>) {
    return scalar::HullShape<Real>{geometry_at<HullGeometry>(body.row(index, 0)), 1};
  } else {
    return scalar::shape_as<Real>(std::get<T>(shape_of(body, index)));
  }
}

template <class T>
using FloatShape = decltype(scalar::shape_as<float>(std::declval<T>()));

std::array<float, 10> numbers_of(const scalar::Separation& s) {
  return {s.separation, s.normal.x(), s.normal.y(), s.normal.z(), s.arm_a.x(),
          s.arm_a.y(),  s.arm_a.z(),  s.arm_b.x(),  s.arm_b.y(),  s.arm_b.z()};
}

bool has_distance_pass(ShapeKind kind_a, ShapeKind kind_b) {
  return kPairKinds[find_pair_kind(kind_a, kind_b).index].has_distance_pass();
}

// The error bounds of the double test hold for points that only a rotation has rounded: not for
// special triangles.
template <class T>
bool has_exact_points(const T& shape) {
  if constexpr (std::is_same_v<T, scalar::TriangleShape<double>>) return !shape.is_special();
  return true;
}

// Tests the deferred rows of a batch: depths in groups, and the others as far as it goes in lanes
// of doubles.
template <class A, class B>
class RowTester {
 public:
  RowTester(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        view_a_(view_of(batch.a, batch.layout, kind_a)),
        view_b_(view_of(batch.b, batch.layout, kind_b)),
        store_(batch, kind_a, kind_b),
        test_{furthest_point_in_lanes(), !has_contacts(batch.detail)},
        decides_separate_(has_contacts(batch.detail) && batch.pass == Pass::test &&
                          has_distance_pass(kind_a, kind_b)) {
    waiting_.rows.decides_only = test_.decides_only;
    waiting_.rows.decides_separate = test_.decides_only;
  }

  // Tests rows whose cores surely overlap, whose bodies are valid. Rows may wait until finish().
  void run_deep(std::span<uint16_t> rows) {
    static_assert(kIsSolid<FloatShape<A>> && kIsSolid<FloatShape<B>>);
    if (batch_.shells) rows = rows.first(run_shells(rows));
    for (size_t first = 0; first < rows.size(); first += kMostDeepPairs) {
      run_deep_group(rows, first, std::min(rows.size(), first + kMostDeepPairs));
    }
  }

  // Tests rows by their shells. Returns how many are left, where no shell proves a depth; they are
  // the first ones then.
  size_t run_shells(std::span<uint16_t> rows) {
    std::array<DeepRow, kMostDeepPairs> placed;
    std::array<DeepPair, kMostDeepPairs> pairs;
    std::array<scalar::Separation, kMostDeepPairs> contacts;
    size_t left = 0;
    for (size_t begin = 0; begin < rows.size(); begin += kMostDeepPairs) {
      const size_t count = std::min(rows.size() - begin, kMostDeepPairs);
      for (size_t i = 0; i < count; ++i) place(rows[begin + i], placed[i], pairs[i]);
      shell_depths({pairs.data(), count}, steps_, contacts.data());
      for (size_t i = 0; i < count; ++i) {
        const uint16_t row = rows[begin + i];
        if (contacts[i].is_unsure) {
          rows[left++] = row;
        } else {
          put_depth(row, contacts[i], placed[i]);
        }
      }
    }
    return left;
  }

  // Tests a row in double precision. Both bodies are valid. The row may wait until finish().
  void run(size_t row) {
    if (!gather(row)) return put_separation(row);
    if (waiting_.are_full()) finish();
  }

  void finish() {
    waiting_.test([this](size_t row, const std::array<float, CoreRows::kAnswers>& numbers,
                         bool is_unsure) { put(row, Status::ok, numbers, is_unsure); },
                  [this](size_t row) { put_separation(row); });
  }

 private:
  // A row in scaled units.
  struct DeepRow {
    scalar::ScaleOf<float> scale;
    std::optional<FloatShape<A>> shape_a;
    std::optional<SolidOf<FloatShape<A>>> a;
    std::optional<SolidOf<FloatShape<B>>> b;
  };

  // Finds the depths of rows[begin] to rows[end - 1] in float32, and in double precision where
  // that is unsure.
  void run_deep_group(std::span<const uint16_t> rows, size_t begin, size_t end) {
    std::array<DeepRow, kMostDeepPairs> placed;
    std::array<DeepPair, kMostDeepPairs> pairs;
    std::array<scalar::Separation, kMostDeepPairs> contacts;
    const size_t count = end - begin;
    for (size_t i = 0; i < count; ++i) {
      if (batch_.has_rounded_points) fetch(rows, begin + i);
      place(rows[begin + i], placed[i], pairs[i]);
    }
    solid_depths({pairs.data(), count}, steps_, contacts.data());
    for (size_t i = 0; i < count; ++i) {
      scalar::Separation& s = contacts[i];
      if (s.is_unsure) {
        run(rows[begin + i]);
      } else {
        put_depth(rows[begin + i], s, placed[i]);
      }
    }
  }

  void put_depth(size_t row, scalar::Separation& s, const DeepRow& placed) const {
    grow(s, *placed.shape_a);
    put_in_metres(s, placed.scale);
    store_.put(row, s.status, numbers_of(s));
  }

  void place(size_t row, DeepRow& placed, DeepPair& deep) const {
    const Pair pair = batch_.pairs[row];
    const auto a = shape_at<A, float>(a_, pair.a);
    const auto b = shape_at<B, float>(b_, pair.b);
    const scalar::PairPose<float> pose = rounded_pose(a_, b_, pair);
    placed.scale = scalar::scale_of_pair(a, b, pose);
    placed.shape_a.emplace(a.scaled(placed.scale.down));
    placed.a.emplace(*placed.shape_a);
    placed.b.emplace(b.scaled(placed.scale.down));
    deep.a = &placed.a->view();
    deep.b = &placed.b->view();
    // One by one: compilers would copy the pose in larger pieces than those that were just written,
    // and wait for these.
    for (int k = 0; k < 3; ++k) {
      deep.d[k] = pose.d[k] * placed.scale.down;
      deep.turn_a.v[k] = pose.a.v[k];
      deep.turn_b.v[k] = pose.b.v[k];
    }
    deep.turn_a.w = pose.a.w;
    deep.turn_b.w = pose.b.w;
    deep.slack = batch_.slack * placed.scale.down;
    deep.shell = batch_.shells ? batch_.shells[row] : nullptr;
  }

  // Asks for the hulls of the rows after row i of the list. Hulls are mostly shared by many bodies,
  // but k-DOPs have one each. Each step of fetching is a row further ahead than the next.
  [[gnu::always_inline]] void fetch(std::span<const uint16_t> rows, size_t i) const {
    for (size_t step = 0; step < kFetchSteps; ++step) {
      const size_t ahead = i + kFetchSteps - step;
      if (ahead < rows.size()) fetch_hulls(rows[ahead], step);
    }
  }

  [[gnu::always_inline]] void fetch_hulls(size_t row, size_t step) const {
    const Pair pair = batch_.pairs[row];
    if constexpr (std::is_same_v<A, Hull>) {
      fetch_solid(*geometry_at<HullGeometry>(a_.row(pair.a, 0)), step);
    }
    if constexpr (std::is_same_v<B, Hull>) {
      fetch_solid(*geometry_at<HullGeometry>(b_.row(pair.b, 0)), step);
    }
  }

  // The pose in double precision.
  [[gnu::always_inline]] scalar::PairPose<double> pose(Pair pair) const {
    constexpr bool kTurns = !std::is_same_v<A, Sphere> && !std::is_same_v<A, Aabb>;
    scalar::Quaternion<double> of_a{Eigen::Vector3d::Zero(), 1};
    if constexpr (kTurns) of_a = orientation_of(a_, pair.a);
    const Position<double> p = a_.template position<double>(pair.a);
    const Position<double> q = b_.template position<double>(pair.b);
    return {{q.x - p.x, q.y - p.y, q.z - p.z}, of_a, orientation_of(b_, pair.b)};
  }

  // False if lanes of doubles do not take the row.
  bool gather(size_t row) {
    if constexpr (std::is_same_v<B, Hull>) {
      const Pair pair = batch_.pairs[row];
      waiting_.name_next(row);
      return add_core_row(shape_at<A, double>(a_, pair.a), shape_at<B, double>(b_, pair.b),
                          pose(pair), waiting_.rows);
    } else {
      return false;
    }
  }

  // Tests in double precision.
  void put_separation(size_t row) const {
    const Pair pair = batch_.pairs[row];
    const scalar::SeparationAs<double> s = scalar::in_scaled_units<double>(
        shape_at<A, double>(a_, pair.a), shape_at<B, double>(b_, pair.b), pose(pair),
        [&](const auto& x, const auto& y, const scalar::PairPose<double>& its_pose) {
          return core_separation(x, y, its_pose, test_);
        });
    const bool is_decided_alone = decides_separate_ && s.separation > 0;
    put(row, is_decided_alone ? Status::ok : s.status, numbers_of(scalar::rounded(s)), s.is_unsure);
  }

  // Marks the row as unsure unless the test's error bound proves the decision.
  void put(size_t row, Status status, const std::array<float, 10>& numbers, bool is_unsure) const {
    store_.put(row, status, numbers);
    if (!batch_.unsure) return;
    const Pair pair = batch_.pairs[row];
    const bool is_proven = !is_unsure && !batch_.has_rounded_points &&
                           has_exact_points(shape_at<A, double>(a_, pair.a)) &&
                           has_exact_points(shape_at<B, double>(b_, pair.b));
    if (!is_proven) batch_.unsure[row] = 1;
  }

  const Batch& batch_;
  const Collidables view_a_, view_b_;
  const BodyReader a_{view_a_}, b_{view_b_};
  const RowStore store_;
  const HullSteps& steps_ = hull_steps_in_lanes();  // dispatching for every row would cost too much
  const scalar::CoreTest test_;
  // The test pass of a kind that has a distance pass only states that a pair is separate. The
  // distance pass finds how far, and the status.
  const bool decides_separate_;
  WaitingRows waiting_;
};

template <class A, class B>
void run_rows(const Batch& batch, const CoreKernels& kernels) {
  const ShapeKind kind_a = kind_of(A()), kind_b = kind_of(B());
  const bool decides_only = batch.pass == Pass::test &&
                            (!has_contacts(batch.detail) || has_distance_pass(kind_a, kind_b));
  const auto in_lanes = decides_only ? kernels.for_decisions : kernels.for_all_else;
  if (batch.pass == Pass::manifold) return run_manifolds(batch, kind_a, kind_b, in_lanes);
  if (batch.pass == Pass::direction || batch.pass == Pass::recall || batch.pass == Pass::balls) {
    return in_lanes(batch);
  }
  RowTester<A, B> rows(batch, kind_a, kind_b);
  std::array<uint16_t, kPairsPerBlock + 1> deep, unsure;
  if (batch.pass == Pass::shell) {
    std::iota(deep.begin(), deep.begin() + batch.count, uint16_t{0});
    std::fill_n(batch.out.overlap, batch.count, uint8_t{0});
    rows.run_shells({deep.data(), batch.count});
    return;
  }
  std::array<uint8_t, kPairsPerBlock> left{};
  Batch lanes = batch;
  lanes.unsure = left.data();
  in_lanes(lanes);
  // Lists the deferred rows first, without branches: they are as random as overlaps, and would be
  // predicted badly.
  size_t deep_count = 0, unsure_count = 0;
  for (size_t row = 0; row < batch.count; ++row) {
    deep[deep_count] = unsure[unsure_count] = static_cast<uint16_t>(row);
    deep_count += left[row] == kDeep ? 1 : 0;
    unsure_count += left[row] != 0 && left[row] != kDeep ? 1 : 0;
  }
  rows.run_deep({deep.data(), deep_count});
  for (size_t i = 0; i < unsure_count; ++i) rows.run(unsure[i]);
  rows.finish();
}

// Whether balls may decide rows: of two hulls whose decision alone is wanted. Those of the first
// row stand for all. GJK takes little longer than balls do if they have few points.
template <class A, class B>
bool is_for_balls(const Batch& batch) {
  constexpr size_t kFewestPoints = 24;  // of both together
  if constexpr (std::is_same_v<A, Hull> && std::is_same_v<B, Hull>) {
    if (batch.count == 0 || batch.pass != Pass::test || has_contacts(batch.detail) ||
        batch.unsure) {
      return false;
    }
    const BodyReader a{view_of(batch.a, batch.layout, ShapeKind::hull)};
    const BodyReader b{view_of(batch.b, batch.layout, ShapeKind::hull)};
    const auto* of_a = geometry_at<HullGeometry>(a.row(batch.pairs[0].a, 0));
    const auto* of_b = geometry_at<HullGeometry>(b.row(batch.pairs[0].b, 0));
    return of_a && of_b && of_a->points().size() + of_b->points().size() >= kFewestPoints;
  } else {
    return false;
  }
}

// Decides rows by balls, and marks in `open` those that need a test. False if these are nearly all
// of the first ones: then nothing is decided.
bool run_balls(const Batch& batch, const CoreKernels& kernels, uint8_t* open) {
  constexpr size_t kFirst = 64, kFewest = 8;  // fewer than one row in so many are few
  Batch balls = batch;
  balls.pass = Pass::balls;
  balls.unsure = open;
  balls.count = std::min(batch.count, kFirst);
  kernels.for_decisions(balls);
  const auto decided = static_cast<size_t>(std::count(open, open + balls.count, 0));
  if (kFewest * decided < balls.count) return false;
  if (balls.count < batch.count) {
    std::fill_n(open, balls.count, uint8_t{0});
    balls.count = batch.count;
    kernels.for_decisions(balls);
  }
  return true;
}

// Tests the rows that balls do not decide.
template <class A, class B>
void run_by_balls(const Batch& batch, const CoreKernels& kernels) {
  std::array<uint8_t, kPairsPerBlock> open{};
  if (!run_balls(batch, kernels, open.data())) return run_rows<A, B>(batch, kernels);
  RowSelection left(batch);
  left.select([&](size_t row) { return open[row] != 0; });
  if (left.count() == 0) return;
  TestColumns scratch;
  Batch rest = left.batch(Pass::test);
  rest.out = scratch.columns();
  run_rows<A, B>(rest, kernels);
  left.scatter(rest.out, batch.out, batch.detail);
}

}  // namespace

template <class A, class B>
void run_core_batch(const Batch& batch, const CoreKernels& kernels) {
  is_for_balls<A, B>(batch) ? run_by_balls<A, B>(batch, kernels) : run_rows<A, B>(batch, kernels);
}

template void run_core_batch<Sphere, Hull>(const Batch&, const CoreKernels&);
template void run_core_batch<Capsule, Hull>(const Batch&, const CoreKernels&);
template void run_core_batch<Aabb, Hull>(const Batch&, const CoreKernels&);
template void run_core_batch<Box, Hull>(const Batch&, const CoreKernels&);
template void run_core_batch<Hull, Hull>(const Batch&, const CoreKernels&);
template void run_core_batch<Hull, Triangle>(const Batch&, const CoreKernels&);

}  // namespace carom
