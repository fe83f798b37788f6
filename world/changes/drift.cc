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
constexpr float kMostGrowth = 0.05f;  // of bounds, a share of the body's radius
constexpr float kStepsAhead = 400;    // for which new bounds hold a body that goes on as it has
constexpr float kFewestStepsAhead = 8;

// Limits of a pair: together less than a jump.
constexpr uint32_t kMostShare = kJump / 8, kMostGap = kJump / 4;
// So many ticks are somewhere else, too: no bounds hold a body that far.
constexpr uint32_t kMostAhead = kJump / 2;

// Whether a is further on than b.
bool is_past(uint32_t a, uint32_t b) { return static_cast<int32_t>(b - a) < 0; }

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
  const size_t rows = bodies.rows();
  for (auto& column : anchors32_) column.resize(bodies.records32().size() / 4);
  for (auto& column : anchors64_) column.resize(bodies.records64().size() / 4);
  for (size_t c = 0; c < 4; ++c) {
    anchor_orientations_[c].resize(bodies.orientations().size(), BodyStore::kIdentity[c]);
  }
  for (auto* column :
       {&anchored_, &travelled_, &travelled_before_, &share_, &fence_, &early_fence_}) {
    column->resize(rows);
  }
  radii_.resize(rows);
  turn_radii_.resize(rows);
  for (const uint32_t index : replaced_bodies_) {
    if (index < replaced_.size()) replaced_[index] = 0;
  }
  replaced_bodies_.clear();
  replaced_.resize(rows);
  made_.resize(rows);
}

void Drift::prepare(const BodyStore& bodies, float tolerance) {
  resize(bodies);
  ticks_per_metre_ = std::min(kTicks / unit_of(bodies, tolerance), FLT_MAX);
  move_all_elsewhere(bodies, tolerance);
  known_ = Known::poses;
}

// The tolerance by which ticks are measured: the least one, but not much more than the smallest
// body, since bounds grow by some ticks in any case, nor so little that the greatest one leaves the
// range. Of a tolerance that is larger than its body, no more than the body's size counts.
float Drift::unit_of(const BodyStore& bodies, float tolerance) const {
  const Collidables view = bodies.view();
  float least = FLT_MAX, greatest = 0;
  for (uint32_t i = 0; i < bodies.rows(); ++i) {
    const float own = bodies.tolerance(i).value_or(tolerance);
    const float radius = bounding_radius(BodyReader{view}, i);
    if (!(own > 0) || std::isinf(radius)) continue;
    const float useful = radius > 0 ? std::min(own, 4 * radius) : own;
    if (radius > 0) greatest = std::max(greatest, useful);
    least = std::min(least, useful);
  }
  return std::max(least, greatest * 0x1p-14f);
}

float Drift::measure_paces(const BodyStore& bodies, Parallelism parallelism) {
  resize(bodies);
  read_odometers(bodies, parallelism);
  known_ = Known::paces;
  size_t slow = 0;
  for (uint32_t i = 0; i < travelled_.size(); ++i) {
    const float pace = pace_of(i);
    const bool is_slow = kFewestStepsAhead * pace <= most_growth(i) ||
                         pace <= static_cast<float>(share_[i] & ~kHasFront);
    slow += is_slow && !bodies.touched(i);
  }
  return static_cast<float>(slow) / static_cast<float>(std::max<size_t>(1, travelled_.size()));
}

void Drift::update(const BodyStore& bodies, const ChangeTracker& shapes, float tolerance,
                   Parallelism parallelism) {
  ++step_;
  if (std::exchange(known_, Known::all) == Known::paces) {
    begin(bodies, tolerance);
  } else {
    resize(bodies);
    find_moved_elsewhere(bodies, shapes, tolerance);
    read_odometers(bodies, parallelism);
  }
  const Collidables view = bodies.view();
  for (const uint32_t index : bodies.halfspaces()) {
    if (travelled_[index] != anchored_[index]) {
      move_elsewhere(bodies, BodyReader{view}, index, tolerance);
    }
  }
  find_outgrown(parallelism);
}

// No bounds and no results are known, but how far each body has gone in this step.
void Drift::begin(const BodyStore& bodies, float tolerance) {
  std::vector<uint32_t>& gone = travelled_before_;
  for (uint32_t i = 0; i < gone.size(); ++i) {
    gone[i] = bodies.touched(i) ? 0 : travelled_[i] - travelled_before_[i];
  }
  move_all_elsewhere(bodies, tolerance);
  for (uint32_t i = 0; i < gone.size(); ++i) {
    made_[i] = {travelled_[i] - gone[i], step_ - 1};
    travelled_before_[i] = made_[i].at;
    fence_[i] = early_fence_[i] = travelled_[i] - 1;
  }
}

void Drift::move_all_elsewhere(const BodyStore& bodies, float tolerance) {
  const Collidables view = bodies.view();
  for (uint32_t i = 0; i < bodies.rows(); ++i) {
    move_elsewhere(bodies, BodyReader{view}, i, tolerance);
  }
}

void Drift::read_odometers(const BodyStore& bodies, Parallelism parallelism) {
  const TravelUnit unit = {ticks_per_metre_, kLeash};
  std::atomic<uint32_t> gained{0};
  const auto add = [&](const auto& columns) {
    for_each_block(
        bodies.rows(), kRowsPerBlock, parallelism,
        [&](size_t, size_t begin, size_t end) { gained |= add_travel(columns, unit, begin, end); });
  };
  if (bodies.records64().empty()) {
    add(columns(bodies.records32(), bodies, anchors32_));
  } else {
    add(columns(bodies.records64(), bodies, anchors64_));
  }
  most_gained_ = gained;
}

template <class T>
TravelColumns<T> Drift::columns(const LargeVector<T>& positions, const BodyStore& bodies,
                                std::array<LargeVector<T>, 3>& anchors) {
  auto& turned = anchor_orientations_;
  const bool turns = !bodies.orientations().empty();
  return {.position = positions.data(),
          .orientation = turns ? bodies.orientations()[0].data() : nullptr,
          .turn_radius = turn_radii_.data(),
          .anchor_position = {anchors[0].data(), anchors[1].data(), anchors[2].data()},
          .anchor_orientation = {turned[0].data(), turned[1].data(), turned[2].data(),
                                 turned[3].data()},
          .anchored = anchored_.data(),
          .travelled = travelled_.data(),
          .travelled_before = travelled_before_.data()};
}

// Bodies that are others, or have other shapes or properties.
void Drift::find_moved_elsewhere(const BodyStore& bodies, const ChangeTracker& shapes,
                                 float tolerance) {
  const Collidables view = bodies.view();
  const BodyReader reader{view};
  const auto rows = static_cast<uint32_t>(bodies.rows());
  // A caller may have written the radii of spheres.
  const bool looks = bodies.shares_poses() && bodies.has_kind(ShapeKind::sphere);
  if (!looks && !shapes.any_reshaped()) {
    for (const uint32_t index : bodies.touched_indices()) {
      if (index < rows) move_elsewhere(bodies, reader, index, tolerance);
    }
    return;
  }
  for (uint32_t i = 0; i < rows; ++i) {
    const bool is_other =
        bodies.touched(i) || shapes.reshaped(view, i) ||
        (looks && reader.kind(i) == ShapeKind::sphere && reader.radius(i) != radii_[i]);
    if (is_other) move_elsewhere(bodies, reader, i, tolerance);
  }
}

void Drift::move_elsewhere(const BodyStore& bodies, const BodyReader& reader, uint32_t index,
                           float tolerance) {
  radii_[index] = bounding_radius(reader, index);
  turn_radii_[index] = turning_radius(reader, index, radii_[index]);
  const float own = bodies.tolerance(index).value_or(tolerance);
  // The model of the shape takes its part first.
  const double half = 0.5 * double{own} - bodies.model_error(index);
  const double ticks = half * double{ticks_per_metre_} * (1 - 0x1p-20);
  share_[index] = ticks > 0 ? static_cast<uint32_t>(std::min(ticks, double{kMostShare})) : 0;
  const ShapeKind kind = reader.kind(index);
  const bool may_have_front =
      kind == ShapeKind::triangle || is_composite(kind) || bodies.model_error(index) > 0;
  const bool is_known = may_have_front && bodies.is_alive(index) && reader.is_valid(index);
  if (is_known && has_front(bodies.shape(index))) share_[index] |= kHasFront;
  const auto copy = [index](const auto& records, auto& anchors) {
    for (size_t c = 0; !records.empty() && c < 3; ++c) {
      anchors[c][index] = records[4 * size_t{index} + c];
    }
  };
  copy(bodies.records32(), anchors32_);
  copy(bodies.records64(), anchors64_);
  for (size_t c = 0; !bodies.orientations().empty() && c < 4; ++c) {
    anchor_orientations_[c][index] = bodies.orientations()[index][c];
  }
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
  const float most = most_growth(index);
  float ahead = 0;
  if (kFewestStepsAhead * pace <= most) ahead = std::min(kStepsAhead * pace, most);
  fence_[index] = now + static_cast<uint32_t>(ahead);
  early_fence_[index] = now + static_cast<uint32_t>(ahead / 2);
  const float from_anchor = static_cast<float>(now - anchored_[index]);
  return (ahead + 2 * from_anchor) / ticks_per_metre_ * (1 + 0x1p-20f);
}

// Ticks in this step; 0 of a body that is somewhere else.
float Drift::pace_of(uint32_t body) const {
  const auto ticks = static_cast<int32_t>(travelled_[body] - travelled_before_[body]);
  const bool is_known = ticks >= 0 && ticks < static_cast<int32_t>(kMostAhead);
  return is_known ? static_cast<float>(ticks) : 0;
}

// By how many ticks the bounds of a body may grow at most. Half-spaces have none.
float Drift::most_growth(uint32_t body) const {
  if (std::isinf(radii_[body])) return 0;
  return std::min(kMostGrowth * radii_[body] * ticks_per_metre_, static_cast<float>(kMostAhead));
}

float Drift::reach(Pair pair, float steps) const {
  const auto shares =
      static_cast<float>((share_[pair.a] & ~kHasFront) + (share_[pair.b] & ~kHasFront));
  return std::max(steps * (pace_of(pair.a) + pace_of(pair.b)), shares) / ticks_per_metre_;
}

uint32_t Drift::holds_until(Pair pair, float gap) const {
  const auto start = [this](uint32_t body) { return 2 * anchored_[body] - travelled_[body]; };
  const uint32_t share_a = share_[pair.a], share_b = share_[pair.b];
  uint32_t ticks = (share_a & ~kHasFront) + (share_b & ~kHasFront);
  if (gap > 0 && !((share_a | share_b) & kHasFront)) {
    const float of_gap = (1 - 0x1p-10f) * gap * ticks_per_metre_;
    ticks += static_cast<uint32_t>(std::min(of_gap, static_cast<float>(kMostGap)));
  }
  return start(pair.a) + start(pair.b) + ticks;
}

void Drift::give_back() {
  const auto each = [](auto& columns) {
    for (auto& column : columns) carom::give_back(column);
  };
  each(anchors32_);
  each(anchors64_);
  each(anchor_orientations_);
  carom::give_back(radii_, turn_radii_, anchored_, travelled_, travelled_before_, share_, replaced_,
                   replaced_bodies_, fence_, early_fence_, made_);
  give_back_scratch(outgrown_of_block_, outgrown_, growth_);
}

size_t Drift::bytes() const {
  size_t sum = outgrown_of_block_.bytes();
  const auto add = [&sum](const auto&... columns) { ((sum += bytes_of(columns)), ...); };
  const auto each = [&add](const auto& columns) {
    for (const auto& column : columns) add(column);
  };
  each(anchors32_);
  each(anchors64_);
  each(anchor_orientations_);
  add(radii_, turn_radii_, anchored_, travelled_, travelled_before_, share_, replaced_,
      replaced_bodies_, fence_, early_fence_, made_, outgrown_, growth_);
  return sum;
}

}  // namespace carom
