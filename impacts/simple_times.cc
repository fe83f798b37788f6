#include "impacts/simple_times.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "impacts/linear/gather_linear.h"
#include "narrowphase/doubles/furthest.h"

namespace carom {
namespace {

using scalar::kNever;

constexpr size_t kRowsPerBlock = 1024;
constexpr size_t kKinds = 7;  // of LinearKind
constexpr uint8_t kTurningHulls = kKinds * kKinds;
constexpr uint8_t kAdvanced = kTurningHulls + 1;
constexpr size_t kGroups = kAdvanced + 1;

// The rows of a block, sorted by how they are tested.
struct SimpleScratch {
  std::array<uint8_t, kRowsPerBlock> group;
  std::array<uint16_t, kRowsPerBlock> row;
  std::array<size_t, kGroups + 1> first;  // first place of each group in `row`
  std::array<uint32_t, LinearRows::kMost> body_a, body_b;
  LinearRows rows;
  std::array<bool, LinearRows::kMost> valid;
};

class SimpleTimes {
 public:
  SimpleTimes(const MovingSide& a, const MovingSide& b, const Pair* pairs, size_t count,
              const TimeColumns& out, const GroupsOfRows* groups, SimpleScratch& scratch)
      : a_{a},
        b_{b},
        shared_group_(group_of_all(a, b)),
        pairs_(pairs),
        count_(count),
        out_(out),
        groups_(groups),
        scratch_(scratch) {
    cores_.clear();
  }

  void run() {
    sort_rows();
    for (size_t group = 0; group < kTurningHulls; ++group) {
      if (!rows_of(group).empty()) run_linear(group);
    }
    if (!rows_of(kTurningHulls).empty()) run_turning_hulls();
    if (!rows_of(kAdvanced).empty()) advance();
    leave_out_what_passes();
  }

 private:
  std::span<const uint16_t> rows_of(size_t group) const {
    return {scratch_.row.data() + scratch_.first[group],
            scratch_.first[group + 1] - scratch_.first[group]};
  }

  void write(size_t row, double time, Status status) {
    out_.time[row] = time;
    out_.status[row] = static_cast<uint8_t>(status);
  }

  void write_invalid(size_t row) {
    write(row, std::numeric_limits<double>::quiet_NaN(), Status::invalid);
  }

  void sort_rows() {
    scratch_.first.fill(0);
    if (shared_group_) {
      std::fill(scratch_.first.begin() + *shared_group_ + 1, scratch_.first.end(), count_);
      return std::iota(scratch_.row.begin(), scratch_.row.begin() + count_, uint16_t{0});
    }
    for (size_t row = 0; row < count_; ++row) {
      scratch_.group[row] = group_of(pairs_[row]);
      ++scratch_.first[scratch_.group[row] + 1];
    }
    for (size_t group = 0; group < kGroups; ++group) {
      scratch_.first[group + 1] += scratch_.first[group];
    }
    std::array<size_t, kGroups> next;
    std::copy_n(scratch_.first.begin(), kGroups, next.begin());
    for (size_t row = 0; row < count_; ++row) {
      scratch_.row[next[scratch_.group[row]]++] = static_cast<uint16_t>(row);
    }
  }

  uint8_t group_of(Pair pair) const {
    const LinearKind a = kind_of(a_, pair.a), b = kind_of(b_, pair.b);
    if (a_.moves_in_a_line(pair.a) && b_.moves_in_a_line(pair.b)) return group_of(a, b);
    const bool has_arms = a_.side.arm || b_.side.arm;
    const bool are_hulls = a == LinearKind::hull && b == LinearKind::hull;
    return are_hulls && !has_arms ? kTurningHulls : kAdvanced;
  }

  // The common group of all rows, if each side has bodies of one kind only and none rotates.
  static std::optional<uint8_t> group_of_all(const MovingSide& a, const MovingSide& b) {
    const auto is_uniform = [](const MovingSide& side) {
      const bool is_triangle = side.bodies.uniform_kind == ShapeKind::triangle;  // may be thick
      return !side.bodies.kind && !side.sweep.rotation && !is_triangle;
    };
    if (!is_uniform(a) || !is_uniform(b)) return std::nullopt;
    return group_of(linear_kind(a.bodies.uniform_kind), linear_kind(b.bodies.uniform_kind));
  }

  static uint8_t group_of(LinearKind a, LinearKind b) {
    const auto [low, high] = std::minmax(a, b);
    const bool has_kernel = high < LinearKind::hull && low != LinearKind::triangle;
    const bool is_special = (low == LinearKind::triangle && high == LinearKind::plane) ||
                            (low == LinearKind::hull && high == LinearKind::hull);
    if (!has_kernel && !is_special) return kAdvanced;
    return static_cast<uint8_t>(static_cast<size_t>(a) * kKinds + static_cast<size_t>(b));
  }

  static LinearKind kind_of(const MovingReader& side, size_t i) {
    const LinearKind kind = linear_kind(side.body().kind(i));
    const bool is_thick = kind == LinearKind::triangle && side.body().row(i, 0)[3] > 0;
    return is_thick ? LinearKind::none : kind;
  }

  void run_linear(size_t group) {
    const auto kind_a = static_cast<LinearKind>(group / kKinds);
    const auto kind_b = static_cast<LinearKind>(group % kKinds);
    const bool flipped = kind_a > kind_b;
    const LinearKind low = flipped ? kind_b : kind_a, high = flipped ? kind_a : kind_b;
    const LinearSide a{a_.side, kind_a, scratch_.body_a.data()},
        b{b_.side, kind_b, scratch_.body_b.data()};
    run_kernel(linear_kernel(low, high), rows_of(group), flipped ? b : a, flipped ? a : b);
  }

  void run_turning_hulls() {
    run_kernel(turning_hull_kernel(), rows_of(kTurningHulls),
               {a_.side, LinearKind::hull, scratch_.body_a.data()},
               {b_.side, LinearKind::hull, scratch_.body_b.data()});
  }

  // A and B are in the order of the kernel.
  void run_kernel(LinearKernel kernel, std::span<const uint16_t> rows, const LinearSide& a,
                  const LinearSide& b) {
    const size_t columns = LinearRows::kPairColumns + number_count(a.kind) + number_count(b.kind) +
                           (b.kind == LinearKind::hull ? LinearRows::kRotationColumns : 0);
    for (size_t begin = 0; begin < rows.size(); begin += LinearRows::kMost) {
      const auto chunk = rows.subspan(begin, std::min(rows.size() - begin, LinearRows::kMost));
      for (size_t i = 0; i < chunk.size(); ++i) {
        scratch_.body_a[i] = pairs_[chunk[i]].a;
        scratch_.body_b[i] = pairs_[chunk[i]].b;
      }
      gather_linear(a, b, chunk.size(), scratch_.rows, scratch_.valid.data());
      scratch_.rows.pad(columns, chunk.size());
      if (b.kind == LinearKind::hull) scratch_.rows.pad_hulls(chunk.size());
      kernel(scratch_.rows, chunk.size());
      write_times(chunk);
    }
  }

  void write_times(std::span<const uint16_t> chunk) {
    for (size_t i = 0; i < chunk.size(); ++i) {
      const double time = scratch_.rows.times()[i];
      if (!scratch_.valid[i]) {
        write_invalid(chunk[i]);
      } else if (time == kNoClosedForm) {
        advance(chunk[i]);
      } else {
        write(chunk[i], time, Status::ok);
      }
    }
  }

  void advance() {
    for (const uint16_t row : rows_of(kAdvanced)) {
      const Pair pair = pairs_[row];
      if (a_.is_valid(pair.a) && b_.is_valid(pair.b)) {
        advance(row);
      } else {
        write_invalid(row);
      }
    }
  }

  void advance(size_t row) {
    const Pair pair = pairs_[row];
    const Shape shape_a = shape_of(a_.body(), pair.a), shape_b = shape_of(b_.body(), pair.b);
    if (pair.a != advanced_.a) cores_.a.scale = 0;
    if (pair.b != advanced_.b) cores_.b.scale = 0;
    advanced_ = pair;
    const scalar::AdvancementResult result = scalar::advancement_time(
        a_.moving(shape_a, pair.a), b_.moving(shape_b, pair.b), eigen(place_between(a_, b_, pair)),
        eigen(way_between(a_, b_, pair)), furthest_, groups_ ? latest(row) : 1, cores_);
    write(row, result.t, result.status);
    // One that passes through a one-sided triangle does not count.
    const bool counts = !scalar::is_one_sided(shape_a) && !scalar::is_one_sided(shape_b);
    if (groups_ && counts) latest(row) = std::min(latest(row), result.t);
  }

  double& latest(size_t row) const { return groups_->latest[groups_->group[row]]; }

  // Removes impacts of shapes that come from behind a one-sided triangle.
  void leave_out_what_passes() {
    if (!has_triangles(a_) && !has_triangles(b_)) return;
    for (size_t row = 0; row < count_; ++row) {
      if (!(out_.time[row] <= 1)) continue;
      const Pair pair = pairs_[row];
      if (!is_triangle(a_, pair.a) && !is_triangle(b_, pair.b)) continue;
      const Shape shape_a = shape_of(a_.body(), pair.a), shape_b = shape_of(b_.body(), pair.b);
      const bool passes = scalar::passes_one_sided(
          a_.moving(shape_a, pair.a), b_.moving(shape_b, pair.b),
          eigen(place_between(a_, b_, pair)), eigen(way_between(a_, b_, pair)), out_.time[row]);
      if (passes) write(row, kNever, Status::ok);
    }
  }

  static bool is_triangle(const MovingReader& side, size_t i) {
    return side.body().kind(i) == ShapeKind::triangle;
  }
  static bool has_triangles(const MovingReader& side) {
    const Collidables& bodies = side.side.bodies;
    return bodies.kind || bodies.uniform_kind == ShapeKind::triangle;
  }

  const MovingReader a_, b_;
  const FurthestPoint furthest_ = furthest_point_in_lanes();  // looked up once per block
  const std::optional<uint8_t> shared_group_;
  const Pair* pairs_;
  const size_t count_;
  const TimeColumns out_;
  const GroupsOfRows* const groups_;
  SimpleScratch& scratch_;
  scalar::CoreScratch& cores_ = scalar::core_scratch_of_thread();  // of the pair advanced last
  Pair advanced_ = {};
};

}  // namespace

void find_simple_times(const MovingSide& a, const MovingSide& b, const Pair* pairs, size_t count,
                       const TimeColumns& out, const GroupsOfRows* groups) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<SimpleScratch>();
  for (size_t begin = 0; begin < count; begin += kRowsPerBlock) {
    const size_t rows = std::min(count - begin, kRowsPerBlock);
    const GroupsOfRows of_block =
        groups ? GroupsOfRows{groups->group + begin, groups->latest} : GroupsOfRows{};
    SimpleTimes(a, b, pairs + begin, rows, {out.time + begin, out.status + begin},
                groups ? &of_block : nullptr, *scratch)
        .run();
  }
}

}  // namespace carom
