// A kernel's formula in lanes of doubles, for the rows that float32 cannot decide. exact_answer()
// is the scalar form, exact_box_test() that of the test pass of boxes.
#if defined(CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#undef CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <span>

#include "narrowphase/batch/exact_shapes.h"
#include "narrowphase/batch/kernel_policy.h"
#include "narrowphase/batch/shape_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Columns of numbers; read(c, shape) takes a shape from columns c, c + 1, ...
struct ExactColumns {
  const double (*column)[kDoubleLanes];

  HWY_INLINE D number(size_t c) const { return hn::Load(DoubleTag(), column[c]); }
  HWY_INLINE D3 vector(size_t c) const { return {number(c), number(c + 1), number(c + 2)}; }
  HWY_INLINE QuaternionOf<D> quaternion(size_t c) const { return {vector(c), number(c + 3)}; }

  HWY_INLINE void read(size_t c, SphereOf<D>& sphere) const { sphere.radius = number(c); }
  HWY_INLINE void read(size_t c, CapsuleOf<D>& capsule) const {
    capsule = {vector(c), vector(c + 3), number(c + 6)};
  }
  HWY_INLINE void read(size_t c, BoxOf<D>& box) const { box.half = vector(c); }
  HWY_INLINE void read(size_t c, TriangleOf<D>& triangle) const {
    triangle = {vector(c), vector(c + 3), vector(c + 6), hn::Ne(number(c + 9), splat_double(0))};
  }
  HWY_INLINE void read(size_t c, AabbOf<D>& box) const { box = {vector(c), vector(c + 3)}; }
};

// Kernel::test() of rows that are unsure in float32. `kContacts`: whether more than the decision is
// wanted.
template <class Kernel, bool kContacts>
class ExactLanes {
  static constexpr bool kIsTest = Kernel::kUnsure == Unsure::test;
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  using Reader = ExactPairReader<A::kKind, B::kKind>;

 public:
  explicit ExactLanes(const Batch& batch) : batch_(batch), reader_(batch) {}

  // For test_boxes().
  static constexpr bool kHasContact = kContacts;
  static constexpr bool faces_only() { return false; }
  template <size_t kPart>
  static HWY_INLINE void fetch() {}

  // Calls put(lane, numbers) for each of the lanes, with what the scalar form gives for row + lane.
  template <class Put>
  void test(size_t row, std::span<const size_t> lanes, const Put& put) {
    for (size_t begin = 0; begin < lanes.size(); begin += kDoubleLanes) {
      const auto group = lanes.subspan(begin, std::min(kDoubleLanes, lanes.size() - begin));
      reader_.read(row, group, kDoubleLanes, in_[0], up_.data());
      for (size_t c = 0; c < Reader::kNumbers; ++c) {
        std::fill(in_[c] + group.size(), in_[c] + kDoubleLanes, in_[c][0]);
      }
      run();
      for (size_t k = 0; k < group.size(); ++k) {
        const size_t lane = group[k];
        put(lane, is_answered(k) ? numbers_of(k) : scalar_form(row + lane));
      }
    }
  }

  // What the kernel reports.
  HWY_INLINE void operator()(DoubleMask, DoubleMask unsure, DoubleMask, D separation,
                             const D3& normal, const D3& arm_a, const D3& arm_b) {
    const DoubleTag tag;
    hn::Store(hn::IfThenElseZero(unsure, splat_double(1)), tag, is_unsure_);
    const D numbers[kNumbers] = {separation, normal.x, normal.y, normal.z, arm_a.x,
                                 arm_a.y,    arm_a.z,  arm_b.x,  arm_b.y,  arm_b.z};
    for (size_t c = 0; c < kNumbers; ++c) hn::Store(numbers[c], tag, out_[c]);
  }

 private:
  static constexpr size_t kNumbers = 10;
  using Numbers = std::array<float, kNumbers + 1>;  // as those of exact_answer()

  HWY_NOINLINE void run() {
    const ExactColumns columns{in_};
    const PoseOf<D> pose = {columns.vector(0), columns.quaternion(3), columns.quaternion(7)};
    typename A::template Of<D> a;
    typename B::template Of<D> b;
    columns.read(Reader::kOfA, a);
    columns.read(Reader::kOfB, b);
    Kernel::test(pose, a, b, *this);
  }

  // A gap of boxes that is zero in metres needs the scalar form.
  bool is_answered(size_t k) const {
    return is_unsure_[k] == 0 && !(kIsTest && out_[0][k] > 0 && !(out_[0][k] * up_[k] > 0));
  }

  Numbers scalar_form(size_t row) const {
    if constexpr (kIsTest) return exact_box_test(batch_, A::kKind, row);
    return exact_answer(batch_, A::kKind, B::kKind, row);
  }

  Numbers numbers_of(size_t k) const {
    Numbers numbers{};
    numbers[0] = scalar::round_separation(scalar::finite(out_[0][k] * up_[k]));
    for (size_t c = 1; c < 4; ++c) numbers[c] = static_cast<float>(out_[c][k]);
    for (size_t c = 4; c < kNumbers; ++c) numbers[c] = static_cast<float>(out_[c][k] * up_[k]);
    return numbers;
  }

  const Batch& batch_;
  const Reader reader_;
  std::array<double, kDoubleLanes> up_;
  HWY_ALIGN double in_[Reader::kNumbers][kDoubleLanes];
  HWY_ALIGN double out_[kNumbers][kDoubleLanes];
  HWY_ALIGN double is_unsure_[kDoubleLanes];
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
