// Walks along one ray and along many share these parts.
#if defined(CAROM_IMPACTS_RAYS_RAY_HITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_RAYS_RAY_HITS_INL_H_
#undef CAROM_IMPACTS_RAYS_RAY_HITS_INL_H_
#else
#define CAROM_IMPACTS_RAYS_RAY_HITS_INL_H_
#endif

#include <algorithm>
#include <vector>

#include "impacts/rays/ray_windows-inl.h"
#include "trees/box_path-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Keeps what a walk has learnt about the first time of one ray.
class RayHits {
 public:
  void start(RaySearch& search) {
    search_ = &search;
    search.candidates.clear();
    search.is_sure = false;
    set_limit(std::min(search.limit, search.ray.last));
  }

  const RaySearch& search() const { return *search_; }

  // Later times are of no use: a time after ray.first, rounded upwards.
  float limit_on_path() const { return limit_on_path_; }

  // Takes row i of `windows`. Returns whether the limit has changed.
  HWY_INLINE bool take(uint32_t triangle, const RayWindows& windows, size_t i) {
    if (windows.earliest(i) > limit_) return false;
    search_->candidates.push_back({triangle, windows.earliest(i)});
    const bool counts = windows.is_from_front(i) || !search_->ray.one_sided;
    if (!windows.is_sure(i) || !counts || windows.latest(i) > limit_) return false;
    set_limit(windows.latest(i));
    search_->is_sure = true;
    return true;
  }

  void finish() {
    std::erase_if(search_->candidates,
                  [&](const RayCandidate& candidate) { return candidate.earliest > limit_; });
  }

 private:
  void set_limit(double limit) {
    limit_ = limit;
    limit_on_path_ = static_cast<float>(
        (limit - search_->ray.first) * (1 + 2.0 * BoxPath::kTimeRounding) + BoxPath::kTinyTime);
  }

  RaySearch* search_;
  double limit_;
  float limit_on_path_;
};

// A node that a walk has still to visit, and a lower bound of the time, after ray.first, at which a
// ray meets it.
struct RayStep {
  float key;
  uint32_t node;
};

// The steps of a walk, the next one last.
class RaySteps {
 public:
  void clear() { count_ = 0; }

  // Room for all children of a node.
  HWY_INLINE RayStep* room() {
    if (HWY_UNLIKELY(steps_.size() < count_ + BoxTree::kChildren)) grow();
    return steps_.data() + count_;
  }

  // Puts a step among those from room() on, which are sorted by falling keys. Returns their end.
  static HWY_INLINE RayStep* insert(const RayStep& step, RayStep* begin, RayStep* end) {
    RayStep* hole = end;
    for (; hole > begin && hole[-1].key < step.key; --hole) *hole = hole[-1];
    *hole = step;
    return end + 1;
  }

  // Keeps what was put from room() on.
  HWY_INLINE void keep(const RayStep* end) { count_ = static_cast<size_t>(end - steps_.data()); }

  // Takes the next node whose key is within the limit. False if there is none.
  HWY_INLINE bool take(float limit, uint32_t& node) {
    while (count_ > 0) {
      const RayStep& step = steps_[--count_];
      node = step.node;
      if (step.key <= limit) return true;
    }
    return false;
  }

 private:
  HWY_NOINLINE void grow() { steps_.resize(2 * count_ + 8 * BoxTree::kChildren); }

  std::vector<RayStep> steps_;  // the first count_ are in use
  size_t count_ = 0;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_RAYS_RAY_HITS_INL_H_
