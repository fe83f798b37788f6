// A kernel's formula in lanes of doubles, for the lanes that float32 cannot decide: test(), or
// exact_separation() where the separation alone is found again. exact_answer() is the scalar form,
// exact_box_test() that of the test pass of boxes.
//
// Reads the rows again instead of keeping what the kernel had in registers: that would cost every
// vector, and the rows are still in a near cache.
#if defined(CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#undef CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <utility>

#include "base/tolerances.h"
#include "narrowphase/batch/certificate-inl.h"
#include "narrowphase/batch/kernel_policy.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/to_floats-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// visit_numbers(shape, visit) calls visit() for each number of a shape and each mask, in lanes of
// floats or of doubles.
template <class V, class Visit>
HWY_INLINE void visit_numbers(Lanes3<V>& v, Visit& visit) {
  visit(v.x), visit(v.y), visit(v.z);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(QuaternionOf<V>& q, Visit& visit) {
  visit_numbers(q.v, visit), visit(q.w);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(SphereOf<V>& sphere, Visit& visit) {
  visit(sphere.radius);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(AabbOf<V>& box, Visit& visit) {
  visit_numbers(box.lower, visit), visit_numbers(box.upper, visit);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(CapsuleOf<V>& capsule, Visit& visit) {
  visit_numbers(capsule.a, visit), visit_numbers(capsule.b, visit), visit(capsule.radius);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(BoxOf<V>& box, Visit& visit) {
  visit_numbers(box.half, visit);
}
template <class V, ShapeKind kRound, class Visit>
HWY_INLINE void visit_numbers(RimOf<V, kRound>& round, Visit& visit) {
  visit(round.radius), visit(round.half_length), visit(round.rounding);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(EllipsoidOf<V>& ellipsoid, Visit& visit) {
  visit_numbers(ellipsoid.semi_axes, visit), visit(ellipsoid.rounding);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(TriangleOf<V>& triangle, Visit& visit) {
  visit_numbers(triangle.a, visit), visit_numbers(triangle.b, visit);
  visit_numbers(triangle.c, visit), visit(triangle.is_special);
}
template <class V, class Visit>
HWY_INLINE void visit_numbers(HalfspaceOf<V>& plane, Visit& visit) {
  visit_numbers(plane.normal, visit), visit(plane.offset);
}

// Visitors. Floats go to columns, which are read as doubles.
struct FloatWriter {
  float (*column)[kLanes];

  HWY_INLINE void operator()(F v) { hn::Store(v, FloatTag(), *column++); }
  HWY_INLINE void operator()(Mask mask) { (*this)(hn::IfThenElseZero(mask, splat(1))); }
};

struct DoubleReader {
  const float (*column)[kLanes];
  size_t first_lane;

  HWY_INLINE void operator()(D& v) {
    const hn::Rebind<float, DoubleTag> half;
    v = hn::PromoteTo(DoubleTag(), hn::Load(half, *column++ + first_lane));
  }
  HWY_INLINE void operator()(DoubleMask& mask) {
    D v;
    (*this)(v);
    mask = hn::Ne(v, splat_double(0));
  }
};

constexpr bool is_box(ShapeKind kind) { return kind == ShapeKind::aabb || kind == ShapeKind::box; }

// The answers of kLanes rows, in doubles rounded to floats. `kContacts`: whether more than the
// decision is wanted.
template <class Kernel, bool kContacts>
class ExactLanes {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  using ShapeA = typename A::template Of<D>;
  using ShapeB = typename B::template Of<D>;
  static constexpr bool kIsTest = Kernel::kUnsure == Unsure::test;
  static constexpr bool kSeparationOnly = Kernel::kUnsure == Unsure::separation;

  static constexpr bool is_one_of(ShapeKind kind) { return A::kKind == kind || B::kKind == kind; }
  // Whether a gap wider than rounding proves the decision. Where nearly parallel edges may make a
  // kernel skip an axis, or take another feature for the nearest, a certificate is sought.
  static constexpr bool kProves = is_one_of(ShapeKind::sphere) || is_one_of(ShapeKind::halfspace) ||
                                  (is_box(A::kKind) && is_box(B::kKind));

 public:
  // For test_boxes().
  static constexpr bool kHasContact = kContacts;
  // Whether the caller wants to know which decisions are proven.
  bool marks_unsure() const { return batch_.unsure != nullptr; }
  template <size_t kPart>
  static HWY_INLINE void fetch() {}

  // Separation, normal, arm_a, arm_b as the scalar form gives them; the separation alone where no
  // more is wanted.
  static constexpr size_t kNumbers = kContacts && !kSeparationOnly ? 10 : 1;

  ExactLanes(const Batch& batch, size_t row) : batch_(batch), row_(row) {}

  // Finds the answers of the lanes whose bits are set, and whose bodies are valid. Returns a bit
  // for each of these whose status is degenerate.
  HWY_NOINLINE uint64_t find(uint64_t lanes) {
    if constexpr (kLanes > kDoubleLanes) {
      constexpr uint64_t kHalf = (uint64_t{1} << kDoubleLanes) - 1;
      const auto count = static_cast<size_t>(std::popcount(lanes));
      const bool is_in_both_halves = (lanes & kHalf) != 0 && (lanes & ~kHalf) != 0;
      if (is_in_both_halves && count <= kDoubleLanes) return find_packed(lanes, count);
    }
    load(Listed{batch_.pairs + row_});
    return find_loaded(lanes, [](size_t place) { return place; });
  }

  // A bit for each of the lanes whose decision is proven.
  uint64_t proven() const { return proven_; }

  HWY_INLINE F number(size_t c) const { return hn::Load(FloatTag(), answers_[c]); }

  // What the kernel reports.
  HWY_INLINE void operator()(DoubleMask, DoubleMask unsure, DoubleMask, D separation,
                             const D3& normal, const D3& arm_a, const D3& arm_b) {
    const D gap = hn::Mul(separation, up_);
    DoubleMask is_answered = hn::AndNot(unsure, hn::Le(hn::Abs(gap), splat_double(DBL_MAX)));
    // A gap of boxes that is zero in metres needs the scalar form.
    if constexpr (kIsTest) {
      const D zero = splat_double(0);
      is_answered = hn::AndNot(hn::And(hn::Gt(separation, zero), hn::Le(gap, zero)), is_answered);
    }
    answered_ = bits_of(DoubleTag(), is_answered);
    if constexpr (kProves) {
      const DoubleMask is_wide = hn::Gt(hn::Abs(separation), splat_double(kProvenGap));
      proven_ |= (bits_of(DoubleTag(), is_wide) & answered_) << first_;
    } else if (HWY_UNLIKELY(marks_unsure())) {
      reason_ = {separation, normal, arm_a, arm_b};
    }
    put(0, rounded_separation(gap));
    if constexpr (kNumbers > 1) {
      put(1, normal);
      put(4, arm_a * up_);
      put(7, arm_b * up_);
    }
  }

 private:
  // The same of lanes in both halves of the vector that fit into one: that takes half the time.
  uint64_t find_packed(uint64_t lanes, size_t count) {
    size_t lane_of[kLanes];
    Pair pairs[kLanes];
    size_t place = 0;
    for (uint64_t rest = lanes; rest != 0; rest &= rest - 1) {
      lane_of[place++] = static_cast<size_t>(std::countr_zero(rest));
    }
    for (place = 0; place < kLanes; ++place) {
      pairs[place] = batch_.pairs[row_ + lane_of[std::min(place, count - 1)]];
    }
    load(Listed{pairs});
    const uint64_t degenerate =
        find_loaded((uint64_t{1} << count) - 1, [&lane_of](size_t k) { return lane_of[k]; });
    // The last first: no lane comes before its place.
    const uint64_t proven = std::exchange(proven_, 0);
    for (place = count; place-- > 0;) {
      const size_t lane = lane_of[place];
      for (size_t c = 0; c < kNumbers; ++c) answers_[c][lane] = answers_[c][place];
      proven_ |= (proven >> place & 1) << lane;
    }
    return degenerate;
  }

  // Finds the answers of the loaded bodies whose bits are set. lane_of(place): their lanes. Returns
  // the lanes that are degenerate.
  template <class LaneOf>
  HWY_INLINE uint64_t find_loaded(uint64_t places, const LaneOf& lane_of) {
    uint64_t degenerate = 0;
    for (size_t first = 0; places >> first != 0; first += kDoubleLanes) {
      const uint64_t wanted = places >> first & ((uint64_t{1} << kDoubleLanes) - 1);
      if (wanted == 0) continue;
      for (uint64_t left = wanted & ~run(first); left != 0; left &= left - 1) {
        const size_t place = first + static_cast<size_t>(std::countr_zero(left));
        const size_t lane = lane_of(place);
        degenerate |= ask_scalar_form(row_ + lane, place) << lane;
      }
    }
    return degenerate;
  }

  // Bodies of rows, to memory, where each half of the lanes finds them.
  HWY_INLINE void load(const Listed& bodies) {
    PositionLanes positions;
    AnyRecords::load(batch_, bodies, positions);
    FloatWriter write{numbers_};
    visit_numbers(positions.a, write);
    visit_numbers(positions.b, write);
    write_shape<Role::a, A>(batch_.a, bodies, positions, write);
    write_shape<Role::b, B>(batch_.b, bodies, positions, write);
    // Rounded to float32, positions of 64 bits are not what they were.
    if (batch_.layout == PositionLayout::records64) load_relative(bodies);
  }

  template <Role kRole, class Shape>
  static HWY_INLINE void write_shape(const BatchSide& side, const Listed& bodies,
                                     const PositionLanes& positions, FloatWriter& write) {
    if constexpr (Shape::kKind == ShapeKind::halfspace) {
      HalfspaceOf<F> plane;
      F down;
      Shape::template load_given<kRole>(side, bodies, plane, down);
      visit_numbers(plane, write), write(down);
    } else {
      Shape shape = Shape::template load<kRole>(side, bodies, positions);
      visit_numbers(shape, write);
    }
    if constexpr (Shape::kIsOriented) {
      Quaternion q;
      load_orientation<kRole>(side, bodies, q);
      make_plain(q);
      visit_numbers(q, write);
    }
  }

  template <class Shape>
  static HWY_INLINE void read_shape(typename Shape::template Of<D>& shape, QuaternionOf<D>& q,
                                    DoubleReader& read) {
    visit_numbers(shape, read);
    if constexpr (Shape::kKind == ShapeKind::halfspace) {
      D down;
      read(down);
      shape.make_unit(down);
    }
    if constexpr (Shape::kIsOriented) visit_numbers(q, read);
  }

  HWY_INLINE void load_relative(const Listed& bodies) {
    const RecordSource<double, Role::a, Listed> a{batch_.a, bodies};
    const RecordSource<double, Role::b, Listed> b{batch_.b, bodies};
    for (size_t i = 0; i < kLanes; ++i) {
      for (size_t c = 0; c < 3; ++c) relative_[c][i] = b.record(i)[c] - a.record(i)[c];
    }
  }

  // Runs the lanes from `first` on, as many as there are lanes of doubles. Returns a bit for each
  // that is answered.
  HWY_NOINLINE uint64_t run(size_t first) {
    first_ = first;
    PoseOf<D> pose;
    ShapeA a;
    ShapeB b;
    read(pose, a, b);
    if constexpr (kSeparationOnly) {
      DoubleMask is_proven;
      put(0, rounded_separation(Kernel::exact_separation(pose.d, a, b, is_proven)));
      proven_ |= bits_of(DoubleTag(), is_proven) << first;
      return ~uint64_t{0};
    } else {
      scale(pose, a, b);
      Kernel::test(pose, a, b, *this);
      if constexpr (!kProves) {
        if (HWY_UNLIKELY(marks_unsure())) proven_ |= (certified() & answered_) << first_;
      }
      return answered_;
    }
  }

  // The bodies of the lanes from first_ on.
  HWY_INLINE void read(PoseOf<D>& pose, ShapeA& a, ShapeB& b) const {
    const DoubleTag tag;
    D3 at_a, at_b;
    DoubleReader read{numbers_, first_};
    visit_numbers(at_a, read);
    visit_numbers(at_b, read);
    read_shape<A>(a, pose.a, read);
    read_shape<B>(b, pose.b, read);
    pose.d = at_b - at_a;
    if (batch_.layout == PositionLayout::records64) {
      pose.d = {hn::Load(tag, relative_[0] + first_), hn::Load(tag, relative_[1] + first_),
                hn::Load(tag, relative_[2] + first_)};
    }
  }

  // A bit for each lane whose decision has a certificate. Reads the bodies again: what run() has in
  // registers would else have to be in memory in every call.
  HWY_NOINLINE uint64_t certified() {
    PoseOf<D> pose;
    ShapeA shape_a;
    ShapeB shape_b;
    read(pose, shape_a, shape_b);
    scale(pose, shape_a, shape_b);
    const D zero = splat_double(0);
    const auto a = placed(shape_a, pose.a, {zero, zero, zero});
    const auto b = placed(shape_b, pose.b, pose.d);
    const DoubleMask overlap = hn::Le(reason_.separation, zero);
    const DoubleMask is_common = have_common_point(a, b, reason_.arm_a, pose.d + reason_.arm_b);
    return bits_of(DoubleTag(), hn::Or(hn::And(overlap, is_common),
                                       hn::AndNot(overlap, are_apart(a, b, reason_.normal))));
  }

  // As scalar::in_scaled_units() does.
  HWY_INLINE void scale(PoseOf<D>& pose, ShapeA& a, ShapeB& b) {
    D down;
    power_of_two(max(largest_component(pose.d), max(a.extent(), b.extent())), up_, down);
    pose.d = pose.d * down;
    a.scale(down);
    b.scale(down);
  }

  HWY_INLINE void put(size_t c, D v) { store_as_floats(v, answers_[c] + first_); }
  HWY_INLINE void put(size_t c, const D3& v) { put(c, v.x), put(c + 1, v.y), put(c + 2, v.z); }

  // Returns 1 if the status is degenerate.
  uint64_t ask_scalar_form(size_t row, size_t place) {
    std::array<float, 11> numbers;
    if constexpr (kIsTest) {
      numbers = exact_box_test(batch_, A::kKind, row);
    } else {
      numbers = exact_answer(batch_, A::kKind, B::kKind, row);
    }
    for (size_t c = 0; c < kNumbers; ++c) answers_[c][place] = numbers[c];
    return numbers[10] != 0 ? 1 : 0;
  }

  static constexpr size_t kMostNumbers = 6 + 2 * 10 + 2 * 4;  // positions, triangles, orientations

  const Batch& batch_;
  const size_t row_;
  size_t first_ = 0;
  uint64_t answered_ = 0;
  uint64_t proven_ = 0;
  D up_;
  struct {
    D separation;
    D3 normal, arm_a, arm_b;
  } reason_;  // in scaled units
  HWY_ALIGN float numbers_[kMostNumbers][kLanes];
  HWY_ALIGN double relative_[3][kLanes];
  HWY_ALIGN float answers_[kNumbers][kLanes] = {};
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_EXACT_LANES_INL_H_
