#include "world/pairs/outer_stage.h"

#include <algorithm>
#include <limits>

#include "base/outward.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/mesh_geometry.h"
#include "geometries/part.h"
#include "midphase/collide_pairs.h"
#include "shapes/body_reader.h"
#include "shapes/dop_geometry.h"

namespace carom {
namespace {

// The hull of a body many times as large as another one mostly holds that.
constexpr float kMostRatio = 8;

// By how much a hull is larger, a share of its size: tests of the parts round by less.
constexpr double kMargin = 0x1p-16;

// The slabs around points with radii.
class Slabs {
 public:
  void add(const Double3& p, double radius) {
    const auto directions = slab_directions(DopKind::k26);
    for (size_t s = 0; s < directions.size(); ++s) {
      const Double3 d = {double(directions[s][0]), double(directions[s][1]),
                         double(directions[s][2])};
      const double height = dot(d, p), reach = radius * std::sqrt(dot(d, d));
      lower_[s] = std::min(lower_[s], height - reach);
      upper_[s] = std::max(upper_[s], height + reach);
    }
    size_ = std::max(size_, greatest(p) + radius);
  }

  // Nothing if there are no points, or their numbers leave the range of floats.
  std::shared_ptr<const HullGeometry> hull() const {
    Dop dop;
    dop.kind = DopKind::k26;
    const double margin = kMargin * size_ + std::numeric_limits<float>::min();
    if (!(size_ < 0x1p100)) return nullptr;
    for (size_t s = 0; s < slab_directions(DopKind::k26).size(); ++s) {
      dop.lower[s] = round_downwards(lower_[s] - 2 * margin);
      dop.upper[s] = -round_downwards(-(upper_[s] + 2 * margin));
    }
    return is_valid_dop(dop) ? carom::hull_of(dop).geometry : nullptr;
  }

 private:
  std::array<double, 13> lower_ = filled(HUGE_VAL), upper_ = filled(-HUGE_VAL);
  double size_ = 0;

  static std::array<double, 13> filled(double value) {
    std::array<double, 13> all;
    all.fill(value);
    return all;
  }
};

void add_mesh(const MeshGeometry& mesh, const Part* frame, Slabs& slabs) {
  const Turn turn = frame ? frame->turn() : kNotTurned;
  for (size_t triangle = 0; triangle < mesh.triangles().size(); ++triangle) {
    for (const Eigen::Vector3f& p : mesh.corners(triangle)) {
      const Double3 point = turned(turn, {p.x(), p.y(), p.z()});
      slabs.add(frame ? plus(frame->position, point) : point, mesh.rules().thickness);
    }
  }
}

void add_child(const Part& child, Slabs& slabs) {
  if (child.kind == ShapeKind::mesh) {
    return add_mesh(*geometry_at<MeshGeometry>(child.rows[0]), &child, slabs);
  }
  const Turn turn = child.turn();
  const auto add = [&](const Double3& p, double radius) {
    slabs.add(plus(child.position, turned(turn, p)), radius);
  };
  if (child.kind == ShapeKind::sphere) return add({}, child.radius);
  if (child.kind == ShapeKind::capsule) {
    add(vector_of(child.rows[0]), child.rows[0][3]);
    return add(vector_of(child.rows[1]), child.rows[0][3]);
  }
  if (core_kind(child.kind) == ShapeKind::hull) {
    const double rounding = child.kind == ShapeKind::hull ? 0 : child.rows[0][3];
    for (const Eigen::Vector3f& p : geometry_at<HullGeometry>(child.rows[0])->points()) {
      add({p.x(), p.y(), p.z()}, rounding);
    }
    return;
  }
  const PartBox box = box_of(child);
  for (size_t i = 0; i < 8; ++i) {
    Double3 corner = box.middle;
    for (size_t axis = 0; axis < 3; ++axis) {
      corner[axis] += (i >> axis & 1) != 0 ? box.half[axis] : -box.half[axis];
    }
    add(corner, 0);
  }
}

// Height fields change, and lie under all that is near them: a hull would leave out little.
bool has_many_parts(ShapeKind kind, const Row& row) {
  if (kind == ShapeKind::height_field) return false;
  return kind == ShapeKind::mesh
             ? geometry_at<MeshGeometry>(row)->triangles().size() >= kManyParts
             : geometry_at<CompoundGeometry>(row)->children().size() >= kManyParts;
}

std::shared_ptr<const HullGeometry> hull_around(const Shape& shape) {
  Slabs slabs;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    add_mesh(*mesh->geometry, nullptr, slabs);
  } else {
    for (const Part& child : std::get<Compound>(shape).geometry->parts()) add_child(child, slabs);
  }
  return slabs.hull();
}

}  // namespace

bool OuterStage::starts_step() { return pauses_.starts_step(); }

const HullGeometry* OuterStage::hull_of(const BodyStore& bodies, uint32_t body) {
  const std::shared_ptr<const void>& geometry = bodies.geometry(body);
  Outer& outer = outer_[geometry.get()];
  if (outer.of.expired()) outer = {geometry, hull_around(bodies.tested_shape(body))};
  return outer.hull.get();
}

// Replaces meshes and compounds that are valid and have a hull.
void OuterStage::update(const BodyStore& bodies) {
  const Collidables view = bodies.view();
  const BodyReader reader{view};
  const std::span<const BodyStore::Row> rows = bodies.shape_rows();
  kind_.resize(view.count);
  first_row_.resize(view.count);
  size_.assign(view.count, 0);
  rows_.assign(rows.begin(), rows.end());
  std::erase_if(outer_, [](const auto& entry) { return entry.second.of.expired(); });
  for (uint32_t i = 0; i < view.count; ++i) {
    kind_[i] = reader.kind(i);
    first_row_[i] = row_count(kind_[i]) > 0 ? reader.first_row(i) : 0;
    if (!is_composite(kind_[i]) || !bodies.is_alive(i) || !reader.is_valid(i)) continue;
    if (!has_many_parts(kind_[i], reader.row(i, 0))) continue;
    const HullGeometry* const hull = hull_of(bodies, i);
    if (!hull) continue;
    kind_[i] = ShapeKind::hull;
    size_[i] = hull->size();
    first_row_[i] = static_cast<uint32_t>(rows_.size());
    const Shape alias = Hull{std::shared_ptr<const HullGeometry>(std::shared_ptr<void>(), hull)};
    rows_.push_back(shape_rows(alias)[0]);
  }
  rows_.resize(rows_.size() + kMostRows, BodyStore::Row{});  // kMostRows can be read from any row
  is_known_ = true;
}

const std::vector<uint8_t>& OuterStage::test(const BodyStore& bodies, std::span<const Pair> pairs,
                                             Parallelism parallelism) {
  const bool may_differ =
      bodies.any_touched() || bodies.shares_shape_rows() || kind_.size() != bodies.rows();
  if (!is_known_ || may_differ) update(bodies);
  Collidables view = bodies.view();
  tested_.clear();
  place_.clear();
  needs_test_.assign(pairs.size(), 1);
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Pair pair = pairs[i];
    const float a = size_[pair.a], b = size_[pair.b];
    if (std::min(a, b) == 0 || std::max(a, b) > kMostRatio * std::min(a, b)) continue;
    tested_.push_back(pair);
    place_.push_back(static_cast<uint32_t>(i));
  }
  if (tested_.empty()) {
    judge(0);
    return needs_test_;
  }
  view.kind = kind_.data();
  view.rows = {rows_.front().data(), first_row_.data()};
  results_.resize(tested_.size(), Detail::overlap, {});
  const CollideOptions options = {.parallelism = parallelism, .measured = Measured::overlapping};
  collide_pairs({view, tested_, false, nullptr, nullptr}, Detail::overlap, results_.columns(),
                options);
  size_t apart = 0;
  for (size_t k = 0; k < tested_.size(); ++k) {
    const bool overlap = results_.columns().overlap[k] != 0;
    needs_test_[place_[k]] = overlap;
    apart += !overlap;
  }
  judge(apart);
  return needs_test_;
}

// Begins a pause if too few pairs were apart.
void OuterStage::judge(size_t apart) {
  constexpr size_t kFewest = 16;  // fewer than one pair in so many are few
  if (apart > 0 && kFewest * apart >= tested_.size()) {
    pauses_.end();
  } else {
    pauses_.begin();
  }
}

void OuterStage::give_back() {
  outer_.clear();
  is_known_ = false;
  give_back_scratch(kind_, first_row_, size_, rows_, tested_, place_, needs_test_);
}

size_t OuterStage::bytes() const {
  size_t sum = bytes_of(kind_) + bytes_of(first_row_) + bytes_of(size_) + bytes_of(rows_) +
               bytes_of(tested_) + bytes_of(place_) + bytes_of(needs_test_) + results_.bytes();
  for (const auto& [geometry, outer] : outer_) {
    if (outer.hull) sum += outer.hull->points().size() * 64;
  }
  return sum;
}

}  // namespace carom
