#include "world/pairs/halfspace_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/sort/merge_pairs.h"
#include "shapes/body_reader.h"
#include "world/store/columns.h"

namespace carom {
namespace {

// The half-space that holds everything the given one covers during the interval. One that turns
// covers all of space.
WorldHalfspace covered(WorldHalfspace halfspace, const Sweep& sweep) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!sweep.rotation.isZero(0)) {
    halfspace.limit = kInfinity;
    return halfspace;
  }
  const Eigen::Vector3d d = sweep.displacement.cast<double>();
  if (d.isZero(0)) return halfspace;
  const auto& n = halfspace.normal;
  const double along = (n[0] * d.x() + n[1] * d.y()) + n[2] * d.z();
  const double error = halfspace.slack * ((std::abs(d.x()) + std::abs(d.y())) + std::abs(d.z()));
  halfspace.limit = std::nextafter(halfspace.limit + std::max(along + error, 0.0), kInfinity);
  return halfspace;
}

WorldHalfspace grown(WorldHalfspace halfspace, float growth) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto& n = halfspace.normal;
  const double length = (std::abs(n[0]) + std::abs(n[1])) + std::abs(n[2]);  // at least the norm
  if (growth > 0) {
    halfspace.limit = std::nextafter(halfspace.limit + double{growth} * length, kInfinity);
  }
  return halfspace;
}

}  // namespace

void HalfspaceStage::set_aside(const BodyStore& bodies, std::array<LargeVector<float>, 6>& bounds) {
  halfspaces_.clear();
  swept_.clear();
  if (bodies.halfspaces().empty()) return;
  const Collidables view = bodies.view();
  for (const uint32_t index : bodies.halfspaces()) {
    if (bounds[0][index] > bounds[3][index]) continue;
    halfspaces_.push_back(world_halfspace(view, index));
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds[axis][index] = std::numeric_limits<float>::infinity();
      bounds[3 + axis][index] = -std::numeric_limits<float>::infinity();
    }
  }
}

void HalfspaceStage::sweep(const Sweeps& sweeps) {
  swept_.clear();
  for (const WorldHalfspace& halfspace : halfspaces_) {
    swept_.push_back(covered(halfspace, sweeps.sweep(halfspace.body)));
  }
}

void HalfspaceStage::stay() { swept_.clear(); }

void HalfspaceStage::widen(const ContactDistances& distances) {
  if (swept_.empty()) swept_ = halfspaces_;
  for (WorldHalfspace& halfspace : swept_) {
    halfspace = grown(halfspace, distances.growth(halfspace.body));
  }
}

bool HalfspaceStage::reaches(uint32_t body, const BoundsView& bounds, uint32_t other,
                             float growth) const {
  const auto halfspace =
      std::lower_bound(halfspaces_.begin(), halfspaces_.end(), body,
                       [](const WorldHalfspace& h, uint32_t index) { return h.body < index; });
  double corner[3];  // the corner that is lowest along the normal
  for (size_t axis = 0; axis < 3; ++axis) {
    corner[axis] = (halfspace->normal[axis] >= 0 ? bounds.lower : bounds.upper)[axis][other];
  }
  return may_hold(grown(*halfspace, growth), corner[0], corner[1], corner[2]);
}

void HalfspaceStage::add_pairs(const BoundsView& bounds, const PairFilter& filter,
                               size_t most_pairs, Parallelism parallelism, std::vector<Pair>& pairs,
                               PairSearch& search) {
  if (!search_) search_.emplace();
  search.pairs += search_->find(swept_.empty() ? halfspaces_ : swept_, bounds, filter, most_pairs,
                                parallelism, own_pairs_);
  search.complete = search.complete && search.pairs <= most_pairs;
  if (search.complete) {
    merge_pairs(other_pairs_, own_pairs_, parallelism, pairs);
  } else {
    pairs.clear();
  }
}

void HalfspaceStage::add_point_candidates(const float* xyz, size_t count, size_t stride,
                                          std::vector<Pair>& candidates) const {
  if (halfspaces_.empty()) return;
  const auto middle = static_cast<ptrdiff_t>(candidates.size());
  for (size_t i = 0; i < count; ++i) {
    const auto p = load_strided<Position<float>>(xyz, stride, i);
    for (const WorldHalfspace& halfspace : halfspaces_) {
      if (!may_hold(halfspace, p.x, p.y, p.z)) continue;
      candidates.push_back({static_cast<uint32_t>(i), halfspace.body});
    }
  }
  std::inplace_merge(candidates.begin(), candidates.begin() + middle, candidates.end());
}

void HalfspaceStage::give_back() {
  carom::give_back(halfspaces_, swept_);
  give_back_scratch(other_pairs_, own_pairs_);
  search_.reset();
}

size_t HalfspaceStage::bytes() const {
  return bytes_of(halfspaces_) + bytes_of(swept_) + (search_ ? search_->bytes() : 0) +
         bytes_of(other_pairs_) + bytes_of(own_pairs_);
}

}  // namespace carom
