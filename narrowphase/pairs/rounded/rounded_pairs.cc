// Pairs with a box or a hull that has a rounding: the kernel of their cores runs first, and its
// results grow.
#include <algorithm>
#include <array>
#include <limits>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/row_selection.h"
#include "narrowphase/batch/row_store.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/world_point.h"
#include "narrowphase/batch/world_points.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "narrowphase/pairs/rounded/growth.h"
#include "narrowphase/scalar/length.h"

namespace carom {
namespace {

// One side of a batch, read body by body.
class GrownSide {
 public:
  GrownSide(const BatchSide& side, PositionLayout layout, ShapeKind kind)
      : view_(view_of(side, layout, kind)), kind_(kind) {}

  BodyReader reader() const { return BodyReader{view_}; }

  const Row* rows(size_t body) const {
    return reinterpret_cast<const Row*>(view_.rows.data) + reader().first_row(body);
  }
  float rounding(size_t body) const { return is_rounded(kind_) ? (*rows(body))[3] : 0; }
  float core_size(size_t body) const {
    if (kind_ == ShapeKind::sphere) return reader().radius(body);
    if (kind_ == ShapeKind::aabb) {
      const BodyReader box = reader();
      return core_size_of_aabb({box.lower(0, body), box.lower(1, body), box.lower(2, body)},
                               {box.upper(0, body), box.upper(1, body), box.upper(2, body)});
    }
    return carom::core_size(kind_, rows(body));
  }
  bool is_special_triangle(size_t body) const {
    return kind_ == ShapeKind::triangle && carom::is_special_triangle(kind_, rows(body));
  }

 private:
  const Collidables view_;
  const ShapeKind kind_;
};

class RoundedBatch {
 public:
  RoundedBatch(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b)
      : batch_(batch),
        kind_a_(kind_a),
        kind_b_(kind_b),
        core_(kPairKinds[find_pair_kind(core_kind(kind_a), core_kind(kind_b)).index]),
        a_(batch.a, batch.layout, kind_a),
        b_(batch.b, batch.layout, kind_b) {}

  void run_tests() {
    Batch cores = core_batch(batch_);
    cores.out = has_contacts(batch_.detail) ? batch_.out : memory_.columns();
    cores.detail = Detail::contact;
    cores.pass = core_.measures_at_once() ? Pass::distance : batch_.pass;
    core_.run(cores);
    const bool is_bound = cores.pass == Pass::test && core_.has_distance_pass();
    grow_rows(cores.out, is_bound);
    if (near_count_ > 0) measure_near(cores);
    find_unsure(cores);
    if (!has_contacts(batch_.detail)) {
      std::copy_n(cores.out.overlap, batch_.count, batch_.out.overlap);
      std::copy_n(cores.out.status, batch_.count, batch_.out.status);
    } else if (batch_.frame == WitnessFrame::world) {
      move_to_world(batch_);
    }
  }

  // The contacts shrink, and the points that the cores have for them grow.
  void run_manifolds() const {
    TestColumns memory;
    std::array<float, kPairsPerBlock> reach;
    Batch cores = core_batch(batch_);
    cores.tested = memory.columns();
    cores.reach = reach.data();
    for (size_t row = 0; row < batch_.count; ++row) {
      const Pair pair = batch_.pairs[row];
      const float rounding_a = a_.rounding(pair.a), both = rounding_a + b_.rounding(pair.b);
      cores.tested.separation[row] = batch_.tested.separation[row] + both;
      for (size_t axis = 0; axis < 3; ++axis) {
        const float n = batch_.tested.normal[axis][row];
        cores.tested.normal[axis][row] = n;
        cores.tested.point_a[axis][row] = batch_.tested.point_a[axis][row] - n * rounding_a;
      }
      reach[row] = (batch_.reach ? batch_.reach[row] : 0) + both;
    }
    pad(cores);
    core_.run(cores);
    for (size_t row = 0; row < batch_.count; ++row) {
      const size_t to = batch_.manifold_row[row];
      const auto& n = batch_.tested.normal;
      ManifoldPoints& points = batch_.out.manifold[to];
      const uint8_t count = batch_.out.manifold_count[to];
      const Pair pair = batch_.pairs[row];
      grow_points(points, count, std::array{n[0][row], n[1][row], n[2][row]},
                  a_.rounding(pair.a), b_.rounding(pair.b));
      for (size_t k = 0; batch_.frame == WitnessFrame::world && k < count; ++k) {
        points.point[k] = world_point(a_.reader(), pair.a, points.point[k]);
      }
    }
  }

 private:
  // Kernels of cores may read whole vectors of these.
  void pad(const Batch& cores) const {
    const size_t last = batch_.count - 1;
    const size_t end = std::min((batch_.count + kMostLanes - 1) / kMostLanes * kMostLanes,
                                size_t{kPairsPerBlock});
    const auto repeat = [&](float* column) {
      std::fill(column + batch_.count, column + end, column[last]);
    };
    repeat(cores.tested.separation);
    for (size_t axis = 0; axis < 3; ++axis) {
      repeat(cores.tested.normal[axis]);
      repeat(cores.tested.point_a[axis]);
    }
    repeat(const_cast<float*>(cores.reach));
  }

  static Batch core_batch(const Batch& batch) {
    Batch cores = batch;
    cores.frame = WitnessFrame::body;
    cores.unsure = nullptr;
    cores.features = nullptr;
    cores.shells = nullptr;
    return cores;
  }

  Growth growth_of(size_t row) const {
    const Pair pair = batch_.pairs[row];
    const Eigen::Vector3f d = a_.reader().is_float64() ? relative_position<double>(pair)
                                            : relative_position<float>(pair);
    return {a_.rounding(pair.a), b_.rounding(pair.b), distance_along_axes(d),
            a_.core_size(pair.a), b_.core_size(pair.b)};
  }

  template <class T>
  Eigen::Vector3f relative_position(Pair pair) const {
    const Position<T> a = a_.reader().position<T>(pair.a), b = b_.reader().position<T>(pair.b);
    return scalar::relative_position(Eigen::Vector3<T>(a.x, a.y, a.z),
                                     Eigen::Vector3<T>(b.x, b.y, b.z));
  }

  // `is_bound`: of separate cores the separation is only a bound, which leaves the nearest rows to
  // measure_near().
  void grow_rows(const ResultColumns& out, bool is_bound) {
    for (size_t row = 0; row < batch_.count; ++row) {
      if (out.status[row] == static_cast<uint8_t>(Status::invalid)) continue;
      const Pair pair = batch_.pairs[row];
      if (!is_valid_radius(a_.rounding(pair.a)) || !is_valid_radius(b_.rounding(pair.b))) {
        invalid_[invalid_count_++] = static_cast<uint32_t>(row);
        continue;
      }
      const Growth growth = growth_of(row);
      const bool is_measured = !is_bound || out.overlap[row];
      if (!is_measured && !(out.separation[row] - growth.both() > growth.near)) {
        near_[near_count_++] = static_cast<uint32_t>(row);
      } else {
        grow(out, row, growth);
      }
    }
  }

  void grow(const ResultColumns& out, size_t row, const Growth& growth) {
    if (growth.both() == 0) return keep(out, row, growth);
    const float separation = out.separation[row] - growth.both();
    out.separation[row] = separation;
    out.overlap[row] = separation <= 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const float n = out.normal[axis][row];
      out.point_a[axis][row] += n * growth.a;
      out.point_b[axis][row] -= n * growth.b;
    }
    const Pair pair = batch_.pairs[row];
    if (!growth.is_sure(separation) || a_.is_special_triangle(pair.a) ||
        b_.is_special_triangle(pair.b)) {
      unsure_[unsure_count_++] = static_cast<uint32_t>(row);
    }
  }

  // Without roundings the answer is that of the cores.
  void keep(const ResultColumns& out, size_t row, const Growth& growth) const {
    if (batch_.unsure && !growth.is_sure(out.separation[row])) batch_.unsure[row] = 1;
  }

  // Separate cores that are not sure to be further apart than the roundings reach.
  void measure_near(const Batch& cores) {
    RowSelection near(cores);
    near.select(near_.data(), near_count_);
    TestColumns memory;
    Batch distances = near.batch(Pass::distance);
    distances.out = memory.columns();
    core_.run(distances);
    near.scatter(distances.out, cores.out, Detail::contact);
    for (size_t i = 0; i < near_count_; ++i) grow(cores.out, near_[i], growth_of(near_[i]));
  }

  void find_unsure(const Batch& cores) const {
    const RowStore store(cores, kind_a_, kind_b_);
    for (size_t i = 0; i < unsure_count_; ++i) {
      const std::array<float, 11> found = exact_answer(batch_, kind_a_, kind_b_, unsure_[i]);
      std::array<float, 10> answer;
      std::copy_n(found.begin(), answer.size(), answer.begin());
      store.put(unsure_[i], found[10] != 0 ? Status::degenerate : Status::ok, answer);
      if (batch_.unsure) batch_.unsure[unsure_[i]] = 1;
    }
    std::array<float, 10> none;
    none.fill(std::numeric_limits<float>::quiet_NaN());
    for (size_t i = 0; i < invalid_count_; ++i) store.put(invalid_[i], Status::invalid, none);
  }

  const Batch& batch_;
  const ShapeKind kind_a_, kind_b_;
  const PairKind& core_;
  const GrownSide a_, b_;
  TestColumns memory_;
  size_t near_count_ = 0, unsure_count_ = 0, invalid_count_ = 0;
  std::array<uint32_t, kPairsPerBlock> near_, unsure_, invalid_;
};

}  // namespace

void run_rounded_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  RoundedBatch rounded(batch, kind_a, kind_b);
  return batch.pass == Pass::manifold ? rounded.run_manifolds() : rounded.run_tests();
}

}  // namespace carom
