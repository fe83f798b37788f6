// The test of two boxes in lanes of doubles, for rows that float32 cannot decide. exact_box_test()
// in narrowphase/pairs/single_pair.cc is the scalar form.
#if defined(CAROM_NARROWPHASE_FEATURES_BOXES_EXACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOXES_EXACT_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOXES_EXACT_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOXES_EXACT_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "narrowphase/batch/exact_boxes.h"
#include "narrowphase/features/boxes_contact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

class ExactBoxLanes {
 public:
  ExactBoxLanes(const Batch& batch, ShapeKind kind_a)
      : batch_(batch), reader_(batch, kind_a), kind_a_(kind_a) {}

  // Tests row + lane for each of the lanes, and calls put(lane, numbers); numbers as those of
  // exact_answer().
  template <class Put>
  void test(size_t row, std::span<const size_t> lanes, const Put& put) {
    for (size_t begin = 0; begin < lanes.size(); begin += kDoubleLanes) {
      const auto group = lanes.subspan(begin, std::min(kDoubleLanes, lanes.size() - begin));
      for (size_t k = 0; k < kDoubleLanes; ++k) read(row + group[std::min(k, group.size() - 1)], k);
      run();
      for (size_t k = 0; k < group.size(); ++k) {
        const size_t lane = group[k];
        put(lane, is_answered(k) ? numbers_of(k) : exact_box_test(batch_, kind_a_, row + lane));
      }
    }
  }

 private:
  void read(size_t row, size_t k) {
    ExactBoxes boxes;
    up_[k] = reader_.read(row, boxes);
    std::array<double, kExactBoxNumbers> numbers;
    std::memcpy(numbers.data(), &boxes, sizeof(boxes));
    for (size_t c = 0; c < kExactBoxNumbers; ++c) in_[c][k] = numbers[c];
  }

  HWY_INLINE D3 vector(size_t c) const {
    const DoubleTag tag;
    return {hn::Load(tag, in_[c]), hn::Load(tag, in_[c + 1]), hn::Load(tag, in_[c + 2])};
  }
  HWY_INLINE QuaternionOf<D> quaternion(size_t c) const {
    return {vector(c), hn::Load(DoubleTag(), in_[c + 3])};
  }

  HWY_INLINE void boxes(BoxPairOf<D>& p, RotationOf<D>& turn_a) const {
    p.half_a = vector(3);
    p.half_b = vector(6);
    const QuaternionOf<D> q_a = quaternion(9), q_b = quaternion(13);
    if (kind_a_ == ShapeKind::aabb) {
      const D zero = splat_double(0), one = splat_double(1);
      turn_a = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
      p.centre = vector(0);
      p.turn = rotation_of(q_b);
    } else {
      turn_a = rotation_of(q_a);
      p.centre = rotate_back(turn_a, vector(0));
      p.turn = rotation_of(relative_rotation(q_a, q_b));
    }
  }

  HWY_NOINLINE void run() {
    BoxPairOf<D> p;
    RotationOf<D> turn_a;
    boxes(p, turn_a);
    const SeparatingAxisOf<D> axis = best_axis(p, best_edges(p));
    D3 on_a = p.centre, on_b = p.centre;
    DoubleMask is_sure = hn::Not(hn::MaskFromVec(hn::Zero(DoubleTag())));
    if (has_contacts(batch_.detail)) {
      const DoubleMask overlap = hn::Not(hn::Gt(axis.gap, splat_double(0)));
      const FacingPoints<D> facing(p, axis);
      // Elsewhere the scalar form takes the middle of the features.
      is_sure = hn::Or(hn::Or(facing.are_edges, do_face(facing, axis.normal)), hn::Not(overlap));
      on_a = select(overlap, facing.on_a(), on_a);
      on_b = select(overlap, on_a + axis.normal * axis.gap, on_b);
    }
    const DoubleTag tag;
    hn::Store(hn::IfThenElseZero(is_sure, splat_double(1)), tag, is_sure_);
    hn::Store(axis.gap, tag, out_[0]);
    store(rotate(turn_a, axis.normal), 1);
    store(rotate(turn_a, on_a) + vector(17), 4);
    store(rotate(turn_a, on_b - p.centre), 7);
  }

  HWY_INLINE void store(const D3& v, size_t c) {
    const DoubleTag tag;
    hn::Store(v.x, tag, out_[c]);
    hn::Store(v.y, tag, out_[c + 1]);
    hn::Store(v.z, tag, out_[c + 2]);
  }

  // A gap that vanishes in metres needs more than the test.
  bool is_answered(size_t k) const {
    return is_sure_[k] != 0 && (!(out_[0][k] > 0) || out_[0][k] * up_[k] > 0);
  }

  std::array<float, 11> numbers_of(size_t k) const {
    std::array<float, 11> numbers{};
    numbers[0] = scalar::round_separation(scalar::finite(out_[0][k] * up_[k]));
    for (size_t c = 1; c < 4; ++c) numbers[c] = static_cast<float>(out_[c][k]);
    for (size_t c = 4; c < 10; ++c) numbers[c] = static_cast<float>(out_[c][k] * up_[k]);
    return numbers;
  }

  const Batch& batch_;
  const ExactBoxReader reader_;
  const ShapeKind kind_a_;
  std::array<double, kDoubleLanes> up_;
  HWY_ALIGN double in_[kExactBoxNumbers][kDoubleLanes];
  HWY_ALIGN double out_[10][kDoubleLanes];
  HWY_ALIGN double is_sure_[kDoubleLanes];
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOXES_EXACT_INL_H_
