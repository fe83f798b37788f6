// Rows of linear pairs in lanes, and the loop over them.
#if defined(CAROM_SWEEP_LINEAR_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SWEEP_LINEAR_LOAD_INL_H_
#undef CAROM_SWEEP_LINEAR_LOAD_INL_H_
#else
#define CAROM_SWEEP_LINEAR_LOAD_INL_H_
#endif

#include "simd/rotation-inl.h"
#include "sweep/linear_rows.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Columns from the first on, at a row.
class RowReader {
 public:
  HWY_INLINE RowReader(const LinearRows& rows, size_t first, size_t row)
      : next_(rows.column(first) + row) {}

  HWY_INLINE D number() {
    const D value = hn::Load(DoubleTag(), next_);
    next_ += LinearRows::kMost;
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
  D slack;
};

struct LinearSphere {
  D radius;
};

// The core in world axes.
struct LinearCapsule {
  D3 start, edge;
  D radius;
};

struct LinearBox {
  D3 half;
  RotationOf<D> turn;
};

// In world axes.
struct LinearTriangle {
  D3 corner[3];
};

struct LinearPlane {
  D3 normal;
  D height, rate;
};

template <class Body>
HWY_INLINE Body load(RowReader in);

template <>
HWY_INLINE LinearPair load(RowReader in) {
  const D3 from = in.vector(), way = in.vector();
  return {from, way, in.number()};
}
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
  return {start, rotate(turn, b) - start, radius};
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
  return {{rotate(turn, a), rotate(turn, b), rotate(turn, c)}};
}
template <>
HWY_INLINE LinearPlane load(RowReader in) {
  const D3 normal = in.vector();
  const D height = in.number();
  return {normal, height, in.number()};
}

// Kernel: A, B and kKindA, whose numbers come first; time(pair, a, b).
template <class Kernel>
void run_rows(LinearRows& rows, size_t count) {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  constexpr size_t kFirstOfB = LinearRows::kPairColumns + number_count(Kernel::kKindA);
  for (size_t row = 0; row < count; row += kDoubleLanes) {
    const D time = Kernel::time(load<LinearPair>(RowReader(rows, 0, row)),
                                load<A>(RowReader(rows, LinearRows::kPairColumns, row)),
                                load<B>(RowReader(rows, kFirstOfB, row)));
    hn::Store(time, DoubleTag(), rows.times() + row);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SWEEP_LINEAR_LOAD_INL_H_
