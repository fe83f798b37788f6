#include "cli/pairs/pair_set.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "carom/ladders/build_ladder.h"
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

// To build a model takes as long as some hundred tests.
constexpr size_t kFewestUses = 100;

void use_models(const io::PairsFile& file, float tolerance, std::vector<Shape>& shapes) {
  const double error = 0.5 * double{tolerance};
  std::vector<size_t> uses(shapes.size());
  for (const io::PairSide* side : {&file.a, &file.b}) {
    for (const uint32_t shape : side->shape) ++uses[shape];
  }
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (uses[i] < kFewestUses || !has_geometry(kind_of(shapes[i]))) continue;
    const Result<LadderedShape> laddered = build_ladder(shapes[i], {&error, 1});
    if (!laddered) continue;  // a shape that is not valid stays so
    const LadderPtr ladder = ladder_of(laddered->shape);
    if (ladder) shapes[i] = ladder->rungs.back().shape;
  }
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

Result<PairSet> read_pair_set(const std::string& path, float tolerance) {
  Result<io::PairsFile> file = io::read_pairs(path);
  if (!file) return file.error();
  Result<std::vector<Shape>> shapes = convert_shapes(file->shapes, path);
  if (!shapes) return shapes.error();
  if (tolerance > 0) use_models(*file, tolerance, *shapes);
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

ResultArrays results_of(const PairSet& pairs, Detail detail) {
  if (!pairs.has_composites()) return ResultArrays(pairs.size(), detail);
  return ResultArrays(pairs.size(), detail, {ColumnRole::sub_shape});
}

}  // namespace carom::cli
