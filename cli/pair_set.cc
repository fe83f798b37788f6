#include "cli/pair_set.h"

#include <cmath>
#include <limits>
#include <utility>

#include "cli/shapes.h"

namespace carom::cli {
namespace {

bool is_rotation(const std::array<float, 4>& q) {
  bool finite =
      std::isfinite(q[0]) && std::isfinite(q[1]) && std::isfinite(q[2]) && std::isfinite(q[3]);
  return finite && (q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0);
}

Eigen::Vector3d position_of(const io::PairSide& side, size_t index) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (!side.orientation.empty() && !is_rotation(side.orientation[index])) {
    return Eigen::Vector3d::Constant(kNan);
  }
  if (!side.position64.empty()) return Eigen::Vector3d(side.position64[index].data());
  return Eigen::Map<const Eigen::Vector3f>(side.position32[index].data()).cast<double>();
}

BodyColumns columns_of(const io::PairSide& side, const std::vector<Shape>& shapes,
                       PositionType positions) {
  BodyColumns columns(positions);
  columns.reserve(side.shape.size());
  for (size_t i = 0; i < side.shape.size(); ++i) {
    columns.push(shapes[side.shape[i]], position_of(side, i));
  }
  return columns;
}

}  // namespace

Result<PairSet> read_pair_set(const std::string& path) {
  Result<io::PairsFile> file = io::read_pairs(path);
  if (!file) return file.error();
  Result<std::vector<Shape>> shapes = convert_shapes(file->shapes, path);
  if (!shapes) return shapes.error();
  PositionType positions = file->float64_positions ? PositionType::float64 : PositionType::float32;
  return PairSet{columns_of(file->a, *shapes, positions), columns_of(file->b, *shapes, positions)};
}

PairColumns::PairColumns(size_t pairs, Detail detail)
    : detail_(detail), overlap_(pairs), status_(pairs) {
  if (detail != Detail::contact) return;
  separation_.resize(pairs);
  for (Column3* columns : {&normal_, &point_a_, &point_b_}) {
    for (std::vector<float>& column : *columns) column.resize(pairs);
  }
}

ResultColumns PairColumns::columns() {
  ResultColumns out;
  out.overlap = overlap_.data();
  out.status = status_.data();
  if (detail_ != Detail::contact) return out;
  out.separation = separation_.data();
  for (int axis = 0; axis < 3; ++axis) {
    out.normal[axis] = normal_[axis].data();
    out.point_a[axis] = point_a_[axis].data();
    out.point_b[axis] = point_b_[axis].data();
  }
  return out;
}

PairColumns::Row PairColumns::row(size_t index) const {
  Row row{overlap_[index], status_[index], 0, {}, {}, {}};
  if (detail_ != Detail::contact) return row;
  row.separation = separation_[index];
  for (int axis = 0; axis < 3; ++axis) {
    row.normal[axis] = normal_[axis][index];
    row.point_a[axis] = point_a_[axis][index];
    row.point_b[axis] = point_b_[axis][index];
  }
  return row;
}

std::vector<std::array<float, 3>> PairColumns::rows_of(const Column3& column) {
  std::vector<std::array<float, 3>> rows(column[0].size());
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = {column[0][i], column[1][i], column[2][i]};
  return rows;
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
  return results;
}

}  // namespace carom::cli
