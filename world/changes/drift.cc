#include "world/changes/drift.h"

#include <algorithm>
#include <atomic>
#include <cfloat>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "shapes/body_reader.h"
#include "world/motion/bounding_radii.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

constexpr float kTicks = 1024;        // of a tolerance
constexpr uint32_t kLeash = 32;       // ticks, see TravelUnit
constexpr float kMostGrowth = 0.03f;  // of bounds, a share of the body's radius
constexpr float kStepsAhead = 128;    // for which new bounds hold a body that goes on as it has
constexpr float kFewestStepsAhead = 8;

// Whether a is further on than b.
bool is_past(uint32_t a, uint32_t b) { return static_cast<int32_t>(b - a) < 0; }

// The tolerance by which ticks are measured: that of the world, or else the least one that a body
// has.
float unit_of(const BodyStore& bodies, float tolerance) {
  if (tolerance > 0) return tolerance;
  float least = FLT_MAX;
  for (const float own : bodies.tolerances()) {
    if (own > 0) least = std::min(least, own);
  }
  return least;
}

bool has_front(const Shape& shape) {
  if (const auto* triangle = std::get_if<Triangle>(&shape)) return triangle->one_sided;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->geometry->rules().one_sided;
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return false;
  const std::span<const CompoundChild> children = compound->geometry->children();
  return std::any_of(children.begin(), children.end(),
                     [](const CompoundChild& child) { return has_front(child.shape); });
}

}  // namespace

void Drift::resize(const BodyStore& bodies) {
  anchors32_.resize(bodies.records32().size());
  anchors64_.resize(bodies.records64().size());
  anchor_orientations_.resize(bodies.orientations().size(), BodyStore::kIdentity);
  const size_t rows = bodies.rows();
  for (auto* column : {&anchored_, &travelled_, &share_, &fence_, &early_fence_}) {
    column->resize(rows);
  }
  radii_.resize(rows);
  turn_radii_.resize(rows);
  has_front_.resize(rows);
  for (const uint32_t index : replaced_bodies_) {
    if (index < replaced_.size()) replaced_[index] = 0;
  }
  replaced_bodies_.clear();
  replaced_.resize(rows);
  made_.resize(rows);
}

void Drift::update(const BodyStore& bodies, const ChangeTracker& shapes, float tolerance,
                   Parallelism parallelism) {
  ++step_;
  resize(bodies);
  if (!knows_last_) ticks_per_metre_ = std::min(kTicks / unit_of(bodies, tolerance), FLT_MAX);
  find_moved_elsewhere(bodies, shapes, tolerance);
  const bool is_float64 = !bodies.records64().empty();
  const bool turns = !bodies.orientations().empty();
  const TravelColumns columns = {
      .type = is_float64 ? PositionType::float64 : PositionType::float32,
      .position = is_float64 ? static_cast<const void*>(bodies.records64().data())
                             : bodies.records32().data(),
      .orientation = turns ? bodies.orientations()[0].data() : nullptr,
      .turn_radius = turn_radii_.data(),
      .anchor_position = is_float64 ? static_cast<void*>(anchors64_.data()) : anchors32_.data(),
      .anchor_orientation = turns ? anchor_orientations_[0].data() : nullptr,
      .anchored = anchored_.data(),
      .travelled = travelled_.data()};
  for_each_block(bodies.rows(), kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    add_travel(columns, {ticks_per_metre_, kLeash}, begin, end);
  });
  // Half-spaces have no bounds that could grow.
  const Collidables view = bodies.view();
  for (const uint32_t index : bodies.halfspaces()) {
    if (travelled_[index] != anchored_[index]) {
      move_elsewhere(bodies, BodyReader{view}, index, tolerance);
    }
  }
  find_outgrown(parallelism);
}

// Bodies that are others, or have other shapes or properties.
void Drift::find_moved_elsewhere(const BodyStore& bodies, const ChangeTracker& shapes,
                                 float tolerance) {
  const Collidables view = bodies.view();
  const BodyReader reader{view};
  const auto rows = static_cast<uint32_t>(bodies.rows());
  const bool knows_last = std::exchange(knows_last_, true);
  // A caller may have written the radii of spheres.
  const bool looks = bodies.shares_poses() && bodies.has_kind(ShapeKind::sphere);
  if (knows_last && !looks && !shapes.any_reshaped()) {
    for (const uint32_t index : bodies.touched_indices()) {
      if (index < rows) move_elsewhere(bodies, reader, index, tolerance);
    }
    return;
  }
  for (uint32_t i = 0; i < rows; ++i) {
    const bool is_other =
        !knows_last || bodies.touched(i) || shapes.reshaped(view, i) ||
        (looks && reader.kind(i) == ShapeKind::sphere && reader.radius(i) != radii_[i]);
    if (is_other) move_elsewhere(bodies, reader, i, tolerance);
  }
}

void Drift::move_elsewhere(const BodyStore& bodies, const BodyReader& reader, uint32_t index,
                           float tolerance) {
  radii_[index] = bounding_radius(reader, index);
  turn_radii_[index] = bodies.turns(index) ? radii_[index] : 0;
  const float own = bodies.tolerance(index).value_or(tolerance);
  share_[index] =
      static_cast<uint32_t>(std::min(0.5f * own * ticks_per_metre_, static_cast<float>(kJump)));
  has_front_[index] =
      bodies.is_alive(index) && reader.is_valid(index) && has_front(bodies.shape(index));
  const auto copy = [index](const auto& from, auto& to) {
    if (!from.empty()) std::copy_n(&from[4 * size_t{index}], 4, &to[4 * size_t{index}]);
  };
  copy(bodies.records32(), anchors32_);
  copy(bodies.records64(), anchors64_);
  if (!anchor_orientations_.empty()) anchor_orientations_[index] = bodies.orientations()[index];
  replaced_[index] = 1;
  replaced_bodies_.push_back(index);
  anchored_[index] += kJump;
  travelled_[index] = anchored_[index];
}

void Drift::find_outgrown(Parallelism parallelism) {
  const size_t rows = travelled_.size();
  // The sign of each: some body has passed its fence, some such body that could have stayed.
  std::atomic<uint32_t> any_past{0}, any_slow{0};
  for_each_block(rows, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    uint32_t past = 0, slow = 0;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t left = fence_[i] - travelled_[i];
      past |= left;
      slow |= left & (early_fence_[i] - fence_[i]);
    }
    any_past |= past;
    any_slow |= slow;
  });
  outgrown_.clear();
  if (any_past >> 31) {
    // Those that would follow soon come along: then the steps until that leave all bounds alone.
    list_past(any_slow >> 31 ? early_fence_ : fence_, parallelism);
  }
  constexpr size_t kFewest = 16;  // one body in so many: then lanes find the bounds of all faster
  if (!outgrown_.empty() && kFewest * outgrown_.size() >= rows) {
    outgrown_.resize(rows);
    std::iota(outgrown_.begin(), outgrown_.end(), 0u);
  }
  growth_.resize(outgrown_.size());
  for_each_block(outgrown_.size(), kRowsPerBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t k = begin; k < end; ++k) growth_[k] = make_fence(outgrown_[k]);
                 });
}

void Drift::list_past(const std::vector<uint32_t>& fence, Parallelism parallelism) {
  const size_t rows = travelled_.size();
  outgrown_of_block_.reset(block_count(rows, kRowsPerBlock));
  for_each_block(rows, kRowsPerBlock, parallelism, [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (is_past(travelled_[i], fence[i])) {
        outgrown_of_block_[block].push_back(static_cast<uint32_t>(i));
      }
    }
  });
  outgrown_of_block_.concatenate(outgrown_, parallelism);
}

// Bodies that are too fast for bounds that would hold them for some steps get bounds of now.
float Drift::make_fence(uint32_t index) {
  Made& made = made_[index];
  const uint32_t now = travelled_[index];
  const float pace = static_cast<float>(now - made.at) / static_cast<float>(step_ - made.in_step);
  made = {now, step_};
  const float most =
      std::min(kMostGrowth * radii_[index] * ticks_per_metre_, static_cast<float>(kJump / 2));
  float ahead = 0;
  if (kFewestStepsAhead * pace <= most) ahead = std::min(kStepsAhead * pace, most);
  fence_[index] = now + static_cast<uint32_t>(ahead);
  early_fence_[index] = now + static_cast<uint32_t>(ahead / 2);
  const float from_anchor = static_cast<float>(now - anchored_[index]);
  return (ahead + 2 * from_anchor) / ticks_per_metre_ * (1 + 0x1p-20f);
}

uint32_t Drift::holds_until(Pair pair, float gap) const {
  const auto start = [this](uint32_t body) { return 2 * anchored_[body] - travelled_[body]; };
  uint32_t ticks = share_[pair.a] + share_[pair.b];
  const bool may_shrink = gap > 0 && !has_front_[pair.a] && !has_front_[pair.b];
  if (may_shrink) {
    const float of_gap = (1 - 0x1p-10f) * gap * ticks_per_metre_;
    ticks += static_cast<uint32_t>(std::min(of_gap, static_cast<float>(kJump)));
  }
  return start(pair.a) + start(pair.b) + ticks;
}

void Drift::give_back() {
  carom::give_back(anchors32_, anchors64_, anchor_orientations_, radii_, turn_radii_, anchored_,
                   travelled_, share_, has_front_, replaced_, replaced_bodies_, fence_,
                   early_fence_, made_);
  give_back_scratch(outgrown_of_block_, outgrown_, growth_);
}

size_t Drift::bytes() const {
  return bytes_of(anchors32_) + bytes_of(anchors64_) + bytes_of(anchor_orientations_) +
         bytes_of(radii_) + bytes_of(turn_radii_) + bytes_of(anchored_) + bytes_of(travelled_) +
         bytes_of(share_) + bytes_of(has_front_) + bytes_of(replaced_) +
         bytes_of(replaced_bodies_) + bytes_of(fence_) + bytes_of(early_fence_) + bytes_of(made_) +
         outgrown_of_block_.bytes() + bytes_of(outgrown_) + bytes_of(growth_);
}

}  // namespace carom
