#include "cli/pairs/pair_set.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "cli/scenes/shapes.h"

namespace carom::cli {
namespace {

bool is_rotation(const Eigen::Quaternionf& q) {
  return q.coeffs().allFinite() && (q.coeffs().array() != 0).any();
}

Pose pose_of(const io::PairSide& side, size_t index) {
  Pose pose;
  if (!side.position64.empty()) {
    pose.position = Eigen::Vector3d(side.position64[index].data());
  } else {
    pose.position = Eigen::Map<const Eigen::Vector3f>(side.position32[index].data()).cast<double>();
  }
  if (!side.orientation.empty()) {
    pose.orientation = Eigen::Quaternionf(side.orientation[index].data());
  }
  return pose;
}

BodyColumns columns_of(const io::PairSide& side, const std::vector<Shape>& shapes,
                       PositionType positions) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  BodyColumns columns(positions);
  columns.reserve(side.shape.size());
  for (size_t i = 0; i < side.shape.size(); ++i) {
    const Shape& shape = shapes[side.shape[i]];
    Pose pose = pose_of(side, i);
    bool ignores_orientation = row_count(kind_of(shape)) == 0;
    if (ignores_orientation && !is_rotation(pose.orientation)) pose.position.setConstant(kNan);
    columns.push(shape, pose);
  }
  return columns;
}

Motions motions_of(io::PairSide& side) {
  return {std::move(side.displacement), std::move(side.rotation)};
}

const float* first_of(const std::vector<std::array<float, 3>>& rows) {
  return rows.empty() ? nullptr : rows.front().data();
}

Eigen::Vector3f vector_of(const std::vector<std::array<float, 3>>& rows, size_t index) {
  return rows.empty() ? Eigen::Vector3f::Zero() : Eigen::Vector3f(rows[index].data());
}

}  // namespace

void Motions::push(const Sweep& sweep) {
  const Eigen::Vector3f& d = sweep.displacement;
  const Eigen::Vector3f& r = sweep.rotation;
  displacement.push_back({d.x(), d.y(), d.z()});
  rotation.push_back({r.x(), r.y(), r.z()});
}

SweepView Motions::view() const {
  return {.displacement = first_of(displacement), .rotation = first_of(rotation)};
}

Sweep Motions::sweep(size_t index) const {
  return {vector_of(displacement, index), vector_of(rotation, index)};
}

Result<PairSet> read_pair_set(const std::string& path) {
  Result<io::PairsFile> file = io::read_pairs(path);
  if (!file) return file.error();
  Result<std::vector<Shape>> shapes = convert_shapes(file->shapes, path);
  if (!shapes) return shapes.error();
  PositionType positions = file->float64_positions ? PositionType::float64 : PositionType::float32;
  return PairSet{columns_of(file->a, *shapes, positions), columns_of(file->b, *shapes, positions),
                 motions_of(file->a), motions_of(file->b)};
}

std::vector<Pair> rows_in_order(size_t count) {
  std::vector<Pair> rows;
  rows.reserve(count);
  for (uint32_t i = 0; i < count; ++i) rows.push_back({i, i});
  return rows;
}

std::vector<Pair> rows_spread_out(size_t count) {
  std::vector<Pair> rows;
  rows.reserve(count);
  const size_t stride = count / 3 + 1;
  for (size_t first = 0; first < stride; ++first) {
    for (size_t i = first; i < count; i += stride) {
      rows.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(i)});
    }
  }
  return rows;
}

PairColumns::PairColumns(const PairSet& pairs, Detail detail)
    : detail_(detail), overlap_(pairs.size()), status_(pairs.size()) {
  if (detail < Detail::contact) return;
  separation_.resize(pairs.size());
  for (Column3* columns : {&normal_, &point_a_, &point_b_}) {
    for (std::vector<float>& column : *columns) column.resize(pairs.size());
  }
  if (pairs.has_composites()) {
    sub_a_.resize(pairs.size());
    sub_b_.resize(pairs.size());
  }
  if (detail < Detail::manifold) return;
  manifold_count_.resize(pairs.size());
  manifold_.resize(pairs.size());
}

ResultColumns PairColumns::columns() {
  ResultColumns out;
  out.overlap = overlap_.data();
  out.status = status_.data();
  if (detail_ < Detail::contact) return out;
  out.separation = separation_.data();
  for (int axis = 0; axis < 3; ++axis) {
    out.normal[axis] = normal_[axis].data();
    out.point_a[axis] = point_a_[axis].data();
    out.point_b[axis] = point_b_[axis].data();
  }
  if (!sub_a_.empty()) {
    out.sub_a = sub_a_.data();
    out.sub_b = sub_b_.data();
  }
  if (detail_ < Detail::manifold) return out;
  out.manifold_count = manifold_count_.data();
  out.manifold = manifold_.data();
  return out;
}

PairColumns::Row PairColumns::row(size_t index) const {
  Row row{overlap_[index], status_[index], 0, 0, {}, {}, {}, {}};
  if (detail_ < Detail::contact) return row;
  row.separation = separation_[index];
  for (int axis = 0; axis < 3; ++axis) {
    row.normal[axis] = normal_[axis][index];
    row.point_a[axis] = point_a_[axis][index];
    row.point_b[axis] = point_b_[axis][index];
  }
  if (!sub_a_.empty()) {
    row.sub_a = sub_a_[index];
    row.sub_b = sub_b_[index];
  }
  if (detail_ < Detail::manifold) return row;
  row.manifold_count = manifold_count_[index];
  row.manifold = manifold_[index];
  return row;
}

std::vector<std::array<float, 3>> PairColumns::rows_of(const Column3& column) {
  std::vector<std::array<float, 3>> rows(column[0].size());
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = {column[0][i], column[1][i], column[2][i]};
  return rows;
}

void PairColumns::add_manifolds(io::PairResults& results) const {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::array<float, 12> no_points;
  no_points.fill(kNan);
  results.manifold_count = manifold_count_;
  results.manifold_point.assign(manifold_.size(), no_points);
  results.manifold_separation.assign(manifold_.size(), {kNan, kNan, kNan, kNan});
  for (size_t pair = 0; pair < manifold_.size(); ++pair) {
    for (size_t i = 0; i < manifold_count_[pair]; ++i) {
      const std::array<float, 3>& point = manifold_[pair].point[i];
      std::copy(point.begin(), point.end(), &results.manifold_point[pair][3 * i]);
      results.manifold_separation[pair][i] = manifold_[pair].separation[i];
    }
  }
}

io::PairResults PairColumns::results() const {
  io::PairResults results;
  results.pairs = overlap_.size();
  results.overlap = overlap_;
  results.separation = separation_;
  results.normal = rows_of(normal_);
  results.point_a = rows_of(point_a_);
  results.point_b = rows_of(point_b_);
  results.status = status_;
  results.sub_a = sub_a_;
  results.sub_b = sub_b_;
  add_manifolds(results);
  return results;
}

}  // namespace carom::cli
