// Tests the lowest corner of every box against the plane, in lanes of double precision.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/halfspace_pairs.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>

#include "broadphase/box_source.h"
#include "broadphase/halfspace_pairs.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

HWY_INLINE D load(const float* from) {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), from));
}

HWY_INLINE Mask is_in_order(const BoxBlock& boxes, size_t axis, size_t i) {
  return hn::Le(hn::LoadU(FloatTag(), boxes.lower[axis] + i),
                hn::LoadU(FloatTag(), boxes.upper[axis] + i));
}

// Sets bit i if box i takes part.
void find_valid(const BoxBlock& boxes, uint64_t* words) {
  for (size_t i = 0; i < boxes.count; i += kLanes) {
    const Mask valid = hn::And(hn::And(is_in_order(boxes, 0, i), is_in_order(boxes, 1, i)),
                               is_in_order(boxes, 2, i));
    words[i / 64] |= bits_of(FloatTag(), valid) << i % 64;
  }
}

// Sets bit i if may_hold() is true of the corner of box i that is lowest along the normal.
void find_reaching(const BoxBlock& boxes, const WorldHalfspace& halfspace, uint64_t* words) {
  const DoubleTag tag;
  const float* corners[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    corners[axis] = halfspace.normal[axis] >= 0 ? boxes.lower[axis] : boxes.upper[axis];
  }
  const D nx = hn::Set(tag, halfspace.normal[0]);
  const D ny = hn::Set(tag, halfspace.normal[1]);
  const D nz = hn::Set(tag, halfspace.normal[2]);
  const D slack = hn::Set(tag, halfspace.slack);
  const D limit = hn::Set(tag, halfspace.limit);
  for (size_t i = 0; i < boxes.count; i += kDoubleLanes) {
    const D x = load(corners[0] + i), y = load(corners[1] + i), z = load(corners[2] + i);
    const D height = hn::Add(hn::Add(hn::Mul(nx, x), hn::Mul(ny, y)), hn::Mul(nz, z));
    const D size = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
    const auto outside = hn::Gt(hn::Sub(height, hn::Mul(slack, size)), limit);
    words[i / 64] |= bits_of(tag, hn::Not(outside)) << i % 64;
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cfloat>
#include <numeric>

#include "base/fresh_pages.h"
#include "base/parallel.h"
#include "broadphase/sort/merge_pairs.h"
#include "broadphase/sort/pair_list.h"
#include "shapes/body_reader.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_valid);
HWY_EXPORT(find_reaching);

constexpr size_t kBoxesPerPlaneTask = 4096;
constexpr size_t kHalfspacesPerTask = 64;
// Up to this many are tested against the boxes of all spaces.
constexpr size_t kFewHalfspaces = 16;
constexpr size_t kBoxesPerWord = 64;
constexpr size_t kWordsPerBlock = BoxBlock::kBoxes / kBoxesPerWord;
static_assert(kBoxesPerPlaneTask % BoxBlock::kBoxes == 0);

// 32 units in the last place; the rounding below adds up to less than 16 of the sizes involved.
constexpr double kRounding = 0x1p-48;

// Mask of the boxes of a word whose index is below that of the body.
uint64_t boxes_below(uint32_t body, size_t word) {
  const size_t first = word * kBoxesPerWord;
  if (body <= first) return 0;
  return body - first >= kBoxesPerWord ? ~uint64_t{0} : (uint64_t{1} << (body - first)) - 1;
}

// Calls visit(box) for each bit of the word.
template <class Visit>
void for_each_box(uint64_t bits, size_t word, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) {
    visit(
        static_cast<uint32_t>(word * kBoxesPerWord + static_cast<size_t>(std::countr_zero(bits))));
  }
}

// Whether the corner of the box that is lowest along the normal may lie in the half-space.
bool reaches(const WorldHalfspace& halfspace, const BoundsView& bounds, uint32_t box) {
  double corner[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto& column = halfspace.normal[axis] >= 0 ? bounds.lower : bounds.upper;
    corner[axis] = value_at(bounds, column[axis], box);
  }
  return may_hold(halfspace, corner[0], corner[1], corner[2]);
}

size_t count_of(uint64_t bits) { return static_cast<size_t>(std::popcount(bits)); }

// Turns counts into the places where each begins; returns their sum.
size_t sum_up(std::vector<size_t>& counts) {
  const size_t last = counts.empty() ? 0 : counts.back();
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), size_t{0});
  return counts.empty() ? 0 : counts.back() + last;
}

}  // namespace

// With q = (x, y, z, w), M its rotation times |q|^2 and p the body's position, the plane
// n . (R^T (x - p)) = offset is (M n) . x = offset |q|^2 + (M n) . p. Products of two floats are
// exact, and nothing overflows but positions beyond 1e190.
WorldHalfspace world_halfspace(const Collidables& bodies, uint32_t body) {
  const BodyReader reader{bodies};
  const Position<double> p = reader.position<double>(body);
  const Row row = reader.row(body, 0);
  const double nx = row[0], ny = row[1], nz = row[2], offset = row[3];
  const Row q = reader.orientation(body);
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  const std::array<double, 3> m0 = {(ww + xx) - (yy + zz), 2 * (x * y - w * z),
                                    2 * (x * z + w * y)};
  const std::array<double, 3> m1 = {2 * (x * y + w * z), (ww + yy) - (xx + zz),
                                    2 * (y * z - w * x)};
  const std::array<double, 3> m2 = {2 * (x * z - w * y), 2 * (y * z + w * x),
                                    (ww + zz) - (xx + yy)};
  const std::array<double, 3> normal = {(m0[0] * nx + m0[1] * ny) + m0[2] * nz,
                                        (m1[0] * nx + m1[1] * ny) + m1[2] * nz,
                                        (m2[0] * nx + m2[1] * ny) + m2[2] * nz};
  const double scale = (xx + yy) + (zz + ww);
  const double size = scale * ((std::abs(nx) + std::abs(ny)) + std::abs(nz));
  const double limit = offset * scale + ((normal[0] * p.x + normal[1] * p.y) + normal[2] * p.z);
  const double error = kRounding * (std::abs(offset) * scale +
                                    size * ((std::abs(p.x) + std::abs(p.y)) + std::abs(p.z)));
  // DBL_MIN covers what underflows.
  return {body, normal, (limit + error) + DBL_MIN, kRounding * size};
}

size_t HalfspaceSearch::find(std::span<const WorldHalfspace> halfspaces, const BoundsView& bounds,
                             const PairFilter& filter, size_t most_pairs, Parallelism parallelism,
                             std::vector<Pair>& out) {
  halfspaces_ = halfspaces;
  if (filter.space && halfspaces.size() > kFewHalfspaces) {
    return find_in_spaces(bounds, filter, most_pairs, parallelism, out);
  }
  tasks_ = block_count(bounds.count, kBoxesPerPlaneTask);
  words_ = block_count(bounds.count, kBoxesPerWord);
  hits_.resize(halfspaces.size() * words_);
  box_first_.resize(tasks_);
  halfspace_first_.resize(halfspaces.size() * tasks_);
  const auto for_each_task = [&](const auto& body) {
    for_each_block(bounds.count, kBoxesPerPlaneTask, parallelism,
                   [&](size_t index, size_t begin, size_t end) {
                     body(Task{index, begin, end});
                   });
  };
  for_each_task([&](const Task& task) {
    find_hits(bounds, task);
    if (!lets_all_meet(filter)) filter_hits(filter, task);
    count_hits(task);
  });
  box_pairs_.clear();
  halfspace_pairs_.clear();
  out.clear();
  const size_t with_box_first = sum_up(box_first_);
  const size_t with_halfspace_first = sum_up(halfspace_first_);
  const size_t count = with_box_first + with_halfspace_first;
  if (count > most_pairs) return count;

  resize_for_overwriting(box_pairs_, with_box_first);
  resize_for_overwriting(halfspace_pairs_, with_halfspace_first);
  for_each_task([&](const Task& task) { list_hits(task); });
  merge_pairs(box_pairs_, halfspace_pairs_, parallelism, out);
  return count;
}

// Tests each half-space against the boxes of its own space.
size_t HalfspaceSearch::find_in_spaces(const BoundsView& bounds, const PairFilter& filter,
                                       size_t most_pairs, Parallelism parallelism,
                                       std::vector<Pair>& out) {
  spaces_.update(bounds, filter.space, bounds.count);
  found_.start(most_pairs);
  found_.add(block_count(halfspaces_.size(), kHalfspacesPerTask));
  for_each_block(halfspaces_.size(), kHalfspacesPerTask, parallelism,
                 [&](size_t task, size_t begin, size_t end) {
                   for (const WorldHalfspace& halfspace : halfspaces_.subspan(begin, end - begin)) {
                     const auto boxes = spaces_.boxes_of(filter.space[halfspace.body]);
                     Pair* hits = found_[task].reserve(boxes.size() + 1);
                     size_t count = 0;
                     for (const uint32_t box : boxes) {
                       hits[count] = {std::min(box, halfspace.body), std::max(box, halfspace.body)};
                       count += reaches(halfspace, bounds, box);
                     }
                     found_[task].commit(count, filter);
                   }
                 });
  out.clear();
  const size_t count = found_.count();
  if (count <= most_pairs) sorter_.sort(found_.lists(), bounds.count, parallelism, out, scratch_);
  found_.settle();
  return count;
}

// Calls visit(half-space, its word of hits, index of the word).
template <class Visit>
void HalfspaceSearch::for_each_word(const Task& task, const Visit& visit) {
  for (size_t h = 0; h < halfspaces_.size(); ++h) {
    for (size_t word = task.begin / kBoxesPerWord; word * kBoxesPerWord < task.end; ++word) {
      visit(h, hits_[h * words_ + word], word);
    }
  }
}

void HalfspaceSearch::find_hits(const BoundsView& bounds, const Task& task) {
  BlockBuffer buffer;
  for (size_t begin = task.begin; begin < task.end; begin += BoxBlock::kBoxes) {
    const size_t end = std::min(begin + BoxBlock::kBoxes, task.end);
    const BoxBlock boxes = buffer.load(BoxSource(bounds), begin, end);
    const size_t first_word = begin / kBoxesPerWord;
    const size_t words = std::min(kWordsPerBlock, words_ - first_word);
    std::array<uint64_t, kWordsPerBlock> valid{};
    CAROM_DISPATCH(find_valid)(boxes, valid.data());
    for (size_t h = 0; h < halfspaces_.size(); ++h) {
      std::array<uint64_t, kWordsPerBlock> reaching{};
      CAROM_DISPATCH(find_reaching)(boxes, halfspaces_[h], reaching.data());
      uint64_t* hits = &hits_[h * words_ + first_word];
      for (size_t i = 0; i < words; ++i) hits[i] = reaching[i] & valid[i];
    }
  }
}

void HalfspaceSearch::filter_hits(const PairFilter& filter, const Task& task) {
  for_each_word(task, [&](size_t h, uint64_t& hits, size_t word) {
    for_each_box(hits, word, [&](uint32_t box) {
      const bool meet = may_meet(filter, halfspaces_[h].body, box);
      if (!meet) hits &= ~(uint64_t{1} << box % kBoxesPerWord);
    });
  });
}

void HalfspaceSearch::count_hits(const Task& task) {
  box_first_[task.index] = 0;
  for (size_t h = 0; h < halfspaces_.size(); ++h) halfspace_first_[h * tasks_ + task.index] = 0;
  for_each_word(task, [&](size_t h, uint64_t hits, size_t word) {
    const size_t below = count_of(hits & boxes_below(halfspaces_[h].body, word));
    box_first_[task.index] += below;
    halfspace_first_[h * tasks_ + task.index] += count_of(hits) - below;
  });
}

void HalfspaceSearch::list_hits(const Task& task) {
  for (size_t h = 0; h < halfspaces_.size(); ++h) {
    Pair* to = halfspace_pairs_.data() + halfspace_first_[h * tasks_ + task.index];
    const uint32_t body = halfspaces_[h].body;
    for (size_t word = task.begin / kBoxesPerWord; word * kBoxesPerWord < task.end; ++word) {
      const uint64_t above = hits_[h * words_ + word] & ~boxes_below(body, word);
      for_each_box(above, word, [&](uint32_t box) { *to++ = {body, box}; });
    }
  }
  Pair* to = box_pairs_.data() + box_first_[task.index];
  for (size_t word = task.begin / kBoxesPerWord; word * kBoxesPerWord < task.end; ++word) {
    uint64_t any = 0;
    for (size_t h = 0; h < halfspaces_.size(); ++h) {
      any |= hits_[h * words_ + word] & boxes_below(halfspaces_[h].body, word);
    }
    for_each_box(any, word, [&](uint32_t box) {
      for (size_t h = 0; h < halfspaces_.size(); ++h) {
        const bool hit = hits_[h * words_ + word] >> box % kBoxesPerWord & 1;
        if (hit && box < halfspaces_[h].body) *to++ = {box, halfspaces_[h].body};
      }
    });
  }
}

size_t HalfspaceSearch::bytes() const {
  return hits_.capacity() * sizeof(uint64_t) +
         (box_first_.capacity() + halfspace_first_.capacity()) * sizeof(size_t) +
         (box_pairs_.capacity() + halfspace_pairs_.capacity()) * sizeof(Pair) + spaces_.bytes() +
         found_.bytes() + sorter_.bytes() + scratch_.bytes();
}

}  // namespace carom
#endif  // HWY_ONCE
