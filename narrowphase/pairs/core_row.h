// Pairs as rows for lanes of doubles.
#pragma once

#include <memory>

#include "narrowphase/doubles/core_rows.h"
#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/scalar/scaled.h"

namespace carom {

using OwnPoints = std::array<std::array<float, 4>, 8>;

// Rows with the points of the cores that are no hulls.
struct CoreRowsWithPoints : CoreRows {
  std::array<OwnPoints, kMost> own_a, own_b;
};

inline CoreRowsWithPoints& core_rows_of_thread() {
  thread_local const auto rows = std::make_unique<CoreRowsWithPoints>();
  return *rows;
}

// Rows of a batch that wait for lanes of doubles.
class WaitingRows {
 public:
  CoreRowsWithPoints& rows = core_rows_of_thread();

  WaitingRows() { rows.count = 0; }

  // Before it is added: the next one of `rows` is this row of the batch.
  void name_next(size_t row) { row_of_[rows.count] = static_cast<uint16_t>(row); }
  bool are_full() const { return rows.count == CoreRows::kMost; }

  // Tests all. Calls found(row, answer, is_unsure) for those that lanes find, and left(row) for the
  // others.
  template <class Found, class Left>
  void test(const Found& found, const Left& left) {
    if (rows.count == 0) return;
    find_gaps_(rows);
    for (size_t place = 0; place < rows.count; ++place) {
      if (!rows.is_found[place]) {
        left(row_of_[place]);
        continue;
      }
      std::array<float, CoreRows::kAnswers> answer;
      for (size_t c = 0; c < answer.size(); ++c) answer[c] = rows.answer[c][place];
      found(row_of_[place], answer, rows.is_unsure[place]);
    }
    rows.count = 0;
  }

 private:
  const FindCoreGaps find_gaps_ = find_core_gaps();
  std::array<uint16_t, CoreRows::kMost> row_of_;
};

// A core before it is turned, in metres: its points, and what lies about them.
struct StatedCore {
  const float* points;
  size_t count;
  Eigen::Vector3d middle;
  double size;  // within a factor of two of all coordinates
  double radius = 0;
  bool is_round = false;
  // An ellipsoid with these half axes lies about each point of a round one, times its share.
  Eigen::Vector3d half_axes = Eigen::Vector3d::Zero();
  std::array<double, 2> share{};
};

inline void put_point(const Eigen::Vector3d& p, std::array<float, 4>& out) {
  out = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
}

inline StatedCore stated_core(const scalar::SphereShape<double>& sphere, OwnPoints& own) {
  own[0] = {0, 0, 0, 0};
  return {own[0].data(), 1, Eigen::Vector3d::Zero(), sphere.size(), sphere.radius};
}
inline StatedCore stated_core(const scalar::CapsuleShape<double>& capsule, OwnPoints& own) {
  put_point(capsule.a, own[0]);
  put_point(capsule.b, own[1]);
  return {own[0].data(), 2, (capsule.a + capsule.b) / 2, capsule.size(), capsule.radius};
}
inline StatedCore stated_box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                             double size, OwnPoints& own) {
  for (size_t i = 0; i < 8; ++i) {  // bit k of i: at the upper end of axis k
    put_point(
        {(i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(), (i & 4 ? upper : lower).z()},
        own[i]);
  }
  return {own[0].data(), 8, (lower + upper) / 2, size};
}
inline StatedCore stated_core(const scalar::AabbShape<double>& box, OwnPoints& own) {
  return stated_box(box.lower, box.upper, box.size(), own);
}
inline StatedCore stated_core(const scalar::BoxShape<double>& box, OwnPoints& own) {
  return stated_box(-box.half, box.half, box.size(), own);
}
inline StatedCore stated_core(const scalar::HullShape<double>& hull, OwnPoints&) {
  const HullGeometry& geometry = *hull.geometry;
  return {geometry.records()[0].data(), geometry.points().size(), geometry.middle(), hull.size()};
}
// A triangle that is not special.
inline StatedCore stated_core(const scalar::TriangleShape<double>& triangle, OwnPoints& own) {
  for (size_t i = 0; i < 3; ++i) put_point(triangle.corners[i], own[i]);
  return {own[0].data(), 3, scalar::middle_of(triangle), triangle.size()};
}

template <scalar::RoundShape S>
StatedCore stated_core(const S& shape, OwnPoints& own) {
  const scalar::RoundNumbers numbers = scalar::round_numbers(shape);
  put_point({0, 0, -numbers.half_length}, own[0]);
  put_point({0, 0, numbers.half_length}, own[1]);
  return {own[0].data(),           numbers.half_length > 0 ? 2u : 1u,
          Eigen::Vector3d::Zero(), shape.size(),
          shape.rounding,          true,
          numbers.half_axes,       numbers.shares};
}

// Adds a row unless lanes of doubles do not take it. Pose in metres; spheres and aabbs have the
// identity for an orientation. Points that are not those of a hull
// have to lie in memory that stays until the row is tested, as own_a and own_b do.
inline bool add_stated_row(const StatedCore& a, const StatedCore& b,
                           const scalar::PairPose<double>& pose, CoreRows& rows) {
  // Products of rotations and lengths vanish at no scale within these.
  constexpr double kMostScale = 0x1p200;
  const scalar::DoubleScale scale =
      scalar::scale_of(scalar::max(scalar::largest_component(pose.d), scalar::max(a.size, b.size)));
  if (!(scale.up <= kMostScale && scale.down <= kMostScale)) return false;
  if (a.count > kMostPointsOfDoubles || b.count > kMostPointsOfDoubles) return false;
  const size_t row = rows.count++;
  const auto put = [&](size_t column, const Eigen::Vector3d& v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      rows.column[column + axis][row] = v[static_cast<Eigen::Index>(axis)];
    }
  };
  const auto put_turn = [&](size_t column, const scalar::Quaternion<double>& q) {
    put(column, q.v);
    rows.column[column + 3][row] = q.w;
  };
  put(CoreRows::kOffset, pose.d * scale.down);
  put_turn(CoreRows::kTurnA, pose.a);
  put_turn(CoreRows::kTurnB, pose.b);
  rows.column[CoreRows::kDown][row] = scale.down;
  rows.column[CoreRows::kUp][row] = scale.up;
  const auto put_core = [&](const StatedCore& core, CoreRows::Side& side, size_t middle,
                            size_t radius, size_t roundness) {
    put(middle, core.middle);
    rows.column[radius][row] = core.radius * scale.down;
    side.points[row] = core.points;
    side.count[row] = static_cast<uint32_t>(core.count);
    side.is_round = core.is_round;
    if (!core.is_round) return;
    put(roundness, core.half_axes);
    rows.column[roundness + 3][row] = core.share[0];
    rows.column[roundness + 4][row] = core.share[1];
  };
  put_core(a, rows.a, CoreRows::kMiddleA, CoreRows::kRadiusA, CoreRows::kRoundnessA);
  put_core(b, rows.b, CoreRows::kMiddleB, CoreRows::kRadiusB, CoreRows::kRoundnessB);
  return true;
}

// The same for shapes in metres, hulls at scale 1.
template <class A, class B>
bool add_core_row(const A& a, const B& b, const scalar::PairPose<double>& pose,
                  CoreRowsWithPoints& rows) {
  const size_t row = rows.count;
  return add_stated_row(stated_core(a, rows.own_a[row]), stated_core(b, rows.own_b[row]), pose,
                        rows);
}

}  // namespace carom
