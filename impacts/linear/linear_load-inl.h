// Loads rows of linear pairs into lanes, and loops over them.
#if defined(CAROM_IMPACTS_LINEAR_LINEAR_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_LINEAR_LOAD_INL_H_
#undef CAROM_IMPACTS_LINEAR_LINEAR_LOAD_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_LINEAR_LOAD_INL_H_
#endif

#include "impacts/linear/linear_rows.h"
#include "impacts/slack.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Reads the columns of a row, from column `first` on.
class RowReader {
 public:
  HWY_INLINE RowReader(const LinearRows& rows, size_t first, size_t row)
      : next_(rows.column(first) + row) {}

  HWY_INLINE D number() {
    const D value = hn::Load(DoubleTag(), next_);
    next_ += LinearRows::kStride;
    return value;
  }
  HWY_INLINE D3 vector() {
    const D x = number(), y = number(), z = number();
    return {x, y, z};
  }
  HWY_INLINE RotationOf<D> rotation() {
    const D3 v = vector();
    return rotation_of(QuaternionOf<D>{v, number()});
  }

 private:
  const double* next_;
};

struct LinearPair {
  D3 from, way;
  D slack;  // error of all lengths
};

// `size` of a body is its greatest coordinate.
struct LinearSphere {
  D radius;

  HWY_INLINE D size() const { return radius; }
};

// The core in world axes.
struct LinearCapsule {
  D3 start, edge;
  D radius;
  D greatest;

  HWY_INLINE D size() const { return greatest; }
};

struct LinearBox {
  D3 half;
  RotationOf<D> turn;

  HWY_INLINE D size() const { return largest_component(half); }
};

// In world axes.
struct LinearTriangle {
  D3 corner[3];
  D greatest;

  HWY_INLINE D size() const { return greatest; }
};

struct LinearPlane {
  D3 normal;
  D height, rate;
  D offset;

  HWY_INLINE D size() const { return offset; }
};

template <class Body>
HWY_INLINE Body load(RowReader in);

template <>
HWY_INLINE LinearSphere load(RowReader in) {
  return {in.number()};
}
template <>
HWY_INLINE LinearCapsule load(RowReader in) {
  const D3 a = in.vector(), b = in.vector();
  const D radius = in.number();
  const RotationOf<D> turn = in.rotation();
  const D3 start = rotate(turn, a);
  const D greatest = max(max(largest_component(a), largest_component(b)), radius);
  return {start, rotate(turn, b) - start, radius, greatest};
}
template <>
HWY_INLINE LinearBox load(RowReader in) {
  const D3 half = in.vector();
  return {half, in.rotation()};
}
template <>
HWY_INLINE LinearTriangle load(RowReader in) {
  const D3 a = in.vector(), b = in.vector(), c = in.vector();
  const RotationOf<D> turn = in.rotation();
  const D greatest = max(max(largest_component(a), largest_component(b)), largest_component(c));
  return {{rotate(turn, a), rotate(turn, b), rotate(turn, c)}, greatest};
}
template <>
HWY_INLINE LinearPlane load(RowReader in) {
  const D3 normal = in.vector();
  const D height = in.number(), rate = in.number();
  return {normal, height, rate, in.number()};
}

HWY_INLINE LinearPair load_pair(RowReader in, D sizes) {
  const D3 from = in.vector(), way = in.vector();
  const D lengths = hn::Add(hn::Add(largest_component(from), largest_component(way)), sizes);
  return {from, way, hn::Mul(splat_double(kSweepSlack), lengths)};
}

// A Kernel has types A and B, kKindA (the kind of A, whose numbers come first), and time(pair, a,
// b).
template <class Kernel>
void run_rows(LinearRows& rows, size_t count) {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  constexpr size_t kFirstOfB = LinearRows::kPairColumns + number_count(Kernel::kKindA);
  for (size_t row = 0; row < count; row += kDoubleLanes) {
    const A a = load<A>(RowReader(rows, LinearRows::kPairColumns, row));
    const B b = load<B>(RowReader(rows, kFirstOfB, row));
    const LinearPair pair = load_pair(RowReader(rows, 0, row), hn::Add(a.size(), b.size()));
    hn::Store(Kernel::time(pair, a, b), DoubleTag(), rows.times() + row);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_LINEAR_LOAD_INL_H_
