// Writes what a kernel reports for its lanes to columns of results, after it has computed unsure
// lanes in double precision, or gathered them for the end of the batch.
#if defined(CAROM_NARROWPHASE_BATCH_REPORT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_REPORT_INL_H_
#undef CAROM_NARROWPHASE_BATCH_REPORT_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_REPORT_INL_H_
#endif

#include <array>
#include <limits>

#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/exact_lanes-inl.h"
#include "narrowphase/batch/fetch-inl.h"
#include "narrowphase/batch/kernel_policy.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/store-inl.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct AnswerLanes {
  F separation;
  F3 normal, arm_a, arm_b;
};

// Rows that float32 cannot decide. One vector has few of them, so they are gathered, and computed
// together at the end of the batch.
struct UnsureRows {
  size_t count = 0;
  std::array<uint32_t, kPairsPerBlock> row;

  // Adds lanes of a vector, unless they are more than a vector of doubles holds, or have no room.
  // `first`: the row of the first lane. Not inlined: the loops that call it seldom do.
  HWY_NOINLINE bool add_few(Mask lanes, size_t first) {
    if (count + kLanes > row.size() || hn::CountTrue(FloatTag(), lanes) > kDoubleLanes)
      return false;
    const Indices rows = hn::Iota(IndexTag(), static_cast<uint32_t>(first));
    count += compress_store(rows, lanes, row.data() + count);
    return true;
  }
};

// Writes columns at Detail::overlap or Detail::contact. Kernels may report in other units than
// metres.
template <class Kernel, bool kHasLow, Columns kColumns>
struct LaneReport {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  // Whether more is stored than the decision.
  static constexpr bool kHasContact = kColumns != Columns::decision;
  // Whether unsure rows of a batch are computed together. Only boxes do so: their tests in doubles
  // take longer than putting the answers back.
  static constexpr bool kGathersUnsure = kLanes > 1 &&
                                         (Kernel::kUnsure == Unsure::in_lanes ||
                                          Kernel::kUnsure == Unsure::test) &&
                                         is_box(A::kKind) && is_box(B::kKind);

  const Batch& batch;   // a private copy of `source`
  const Batch& source;  // the batch it is a copy of
  size_t row;
  const PositionLanes& positions;
  F up;        // metres in a unit
  Mask plain;  // finite and of usual size
  Mask valid;
  bool is_odd;           // not all lanes are plain
  UnsureRows* gathered;  // nullptr: unsure lanes are computed at once

  // Asks for a part of the bodies of pairs to come. Only for kernels with kTestFetches, each part
  // once.
  template <size_t kPart>
  HWY_INLINE void fetch() const {
    fetch_part<A, B, kPart>(batch, row);
  }
  // Whether the caller wants to know the unsure lanes. Kernels that refine need them in any case.
  HWY_INLINE bool marks_unsure() const { return batch.unsure != nullptr; }

  HWY_INLINE void operator()(Mask overlap, Mask unsure, Mask degenerate, F separation,
                             const F3& normal, const F3& arm_a, const F3& arm_b) const {
    AnswerLanes answer = in_metres(separation, normal, arm_a, arm_b);
    // A gap in scaled units may vanish in metres.
    if constexpr (Kernel::kUnits == Units::scaled) overlap = hn::Le(answer.separation, splat(0));
    unsure = hn::And(unsure, valid);
    Mask proven = no_lanes();
    const F in_floats = answer.separation;
    if constexpr (Kernel::kUnsure != Unsure::nothing && Kernel::kUnsure != Unsure::left) {
      proven = refine(unsure, answer, overlap, degenerate);
    }
    if (HWY_UNLIKELY(marks_unsure())) mark_unsure(hn::AndNot(proven, unsure), proven, in_floats);
    I status = bytes_where(degenerate, static_cast<int32_t>(Status::degenerate));
    if (HWY_UNLIKELY(is_odd)) blot_out_invalid(answer, overlap, status);
    store_bytes(status, batch.out.status, row);
    store_answer(overlap, answer);
  }

  // For lanes whose answer is good, but whose decision is not proven. Call it after the report.
  HWY_NOINLINE void mark_unproven(Mask lanes) const {
    HWY_ALIGN float flags[kLanes];
    hn::Store(hn::IfThenElseZero(hn::And(lanes, valid), splat(1)), FloatTag(), flags);
    for (size_t i = 0; i < kLanes; ++i) {
      if (flags[i] != 0) batch.unsure[row + i] = 1;
    }
  }

  // Computes the first `count` lanes in double precision, and stores them.
  HWY_INLINE void compute_in_doubles(size_t count) const {
    const Mask unsure = hn::FirstN(FloatTag(), count);
    AnswerLanes answer = {splat(0), splat3(0), splat3(0), splat3(0)};
    Mask degenerate = no_lanes();
    const Mask proven = refine_lanes(unsure, answer, degenerate);
    if (marks_unsure()) store_bytes(bytes_where(hn::AndNot(proven, unsure), 1), batch.unsure, row);
    store_bytes(bytes_where(degenerate, static_cast<int32_t>(Status::degenerate)), batch.out.status,
                row);
    store_answer(hn::Le(answer.separation, splat(0)), answer);
  }

 private:
  static HWY_INLINE F scaled(F v, F up) { return clamp_to_finite(hn::Mul(v, up)); }

  HWY_INLINE AnswerLanes in_metres(F separation, const F3& normal, const F3& arm_a,
                                   const F3& arm_b) const {
    if constexpr (Kernel::kUnits == Units::metres) return {separation, normal, arm_a, arm_b};
    return {scaled(separation, up), normal, arm_a * up, arm_b * up};
  }

  // Gaps that vanished in metres, and lanes so large that numbers were clamped, are unsure, too,
  // unless they are proven. `separation`: in float32.
  HWY_INLINE void mark_unsure(Mask unsure, Mask proven, F separation) const {
    if constexpr (Kernel::kUnsure != Unsure::left) {
      const Mask vanished = hn::Or(hn::Eq(separation, splat(0)), hn::Not(plain));
      unsure = hn::Or(unsure, hn::AndNot(proven, hn::And(valid, vanished)));
    }
    if (HWY_LIKELY(hn::AllFalse(FloatTag(), unsure))) return;
    store_bytes(bytes_where(unsure, 1), batch.unsure, row);
  }

  // Returns the lanes whose decisions are proven by that. Lanes that are gathered keep the answer
  // of float32 until the end of the batch.
  HWY_INLINE Mask refine(Mask unsure, AnswerLanes& answer, Mask& overlap, Mask& degenerate) const {
    Mask proven = no_lanes();
    if (HWY_LIKELY(hn::AllFalse(FloatTag(), unsure))) return proven;
    if (HWY_UNLIKELY(batch.single_precision)) {
      unsure = hn::AndNot(is_good_enough(answer), unsure);
      if (hn::AllFalse(FloatTag(), unsure)) return proven;
    }
    if constexpr (kGathersUnsure) {
      if (gathered && gathered->add_few(unsure, row)) return proven;
    }
    AnswerLanes in_memory = answer;  // `answer` itself stays in registers
    if constexpr (Kernel::kUnsure == Unsure::everything) {
      refine_one_by_one(unsure, in_memory, degenerate);
    } else {
      proven = refine_lanes(unsure, in_memory, degenerate);
    }
    answer = in_memory;
    overlap = hn::Le(answer.separation, splat(0));
    return proven;
  }

  // NaN in lanes without an answer. Points in world coordinates stay NaN, since 0 + NaN is that
  // NaN.
  HWY_INLINE void blot_out_invalid(AnswerLanes& answer, Mask& overlap, I& status) const {
    const F3 nan = splat3(std::numeric_limits<float>::quiet_NaN());
    overlap = hn::And(overlap, valid);
    const I invalid = bytes_where(hn::Not(valid), static_cast<int32_t>(Status::invalid));
    status = hn::IfThenElse(hn::RebindMask(IntTag(), valid), status, invalid);
    answer.separation = hn::IfThenElse(valid, answer.separation, nan.x);
    answer.normal = select(valid, answer.normal, nan);
    answer.arm_a = select(valid, answer.arm_a, nan);
    answer.arm_b = select(valid, answer.arm_b, nan);
  }

  HWY_INLINE void store_answer(Mask overlap, const AnswerLanes& answer) const {
    store_bytes(bytes_where(overlap, 1), batch.out.overlap, row);
    if constexpr (kColumns == Columns::as_asked) {
      if (!has_contacts(batch.detail)) return;
    }
    if constexpr (kHasContact) {
      store(answer.separation, batch.out.separation, row);
      store(answer.normal, batch.out.normal, row);
      store(witness(positions.a, positions.a_low, answer.arm_a), batch.out.point_a, row);
      store(witness(positions.b, positions.b_low, answer.arm_b), batch.out.point_b, row);
    }
  }

  // Whether Tier::fast may keep the float32 answer. Not for triangles: special
  // ones, which the kernel does not test, are unsure. Not for half-spaces, which may be far away.
  // Not for round shapes: a search that has not ended may be far from the answer. Not without a
  // unit normal, if the detail stores one.
  static HWY_INLINE Mask is_good_enough(const AnswerLanes& answer) {
    constexpr auto kNeedsMore = [](ShapeKind kind) {
      return kind == ShapeKind::triangle || kind == ShapeKind::halfspace || is_round(kind);
    };
    if constexpr (kNeedsMore(A::kKind) || kNeedsMore(B::kKind)) return no_lanes();
    if constexpr (!kHasContact) return hn::Not(no_lanes());
    const F squared = dot(answer.normal, answer.normal);
    return hn::And(hn::Ge(squared, splat(0.9f)), hn::Le(squared, splat(1.1f)));
  }

  // `answer` is in memory.
  HWY_NOINLINE Mask refine_lanes(Mask unsure, AnswerLanes& answer, Mask& degenerate) const {
    ExactLanes<Kernel, kHasContact> exact(source, row);
    const uint64_t degenerate_bits = exact.find(bits_of(FloatTag(), unsure));
    F* const numbers[] = {&answer.separation, &answer.normal.x, &answer.normal.y, &answer.normal.z,
                          &answer.arm_a.x,    &answer.arm_a.y,  &answer.arm_a.z,  &answer.arm_b.x,
                          &answer.arm_b.y,    &answer.arm_b.z};
    for (size_t c = 0; c < exact.kNumbers; ++c) {
      *numbers[c] = hn::IfThenElse(unsure, exact.number(c), *numbers[c]);
    }
    if constexpr (Kernel::kUnsure != Unsure::separation) {
      degenerate = hn::Or(hn::AndNot(unsure, degenerate), lanes_of(degenerate_bits));
    }
    return hn::And(unsure, lanes_of(exact.proven()));
  }

  // The lanes whose bits are set.
  static HWY_INLINE Mask lanes_of(uint64_t bits) {
    const uint8_t bytes[8] = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
    return hn::LoadMaskBits(FloatTag(), bytes);
  }

  HWY_NOINLINE void refine_one_by_one(Mask unsure, AnswerLanes& answer, Mask& degenerate) const {
    constexpr size_t kNumbers = 11;
    HWY_ALIGN float values[kNumbers][kLanes];
    F* const columns[kNumbers - 1] = {
        &answer.separation, &answer.normal.x, &answer.normal.y, &answer.normal.z, &answer.arm_a.x,
        &answer.arm_a.y,    &answer.arm_a.z,  &answer.arm_b.x,  &answer.arm_b.y,  &answer.arm_b.z};
    for (size_t c = 0; c + 1 < kNumbers; ++c) hn::Store(*columns[c], FloatTag(), values[c]);
    hn::Store(hn::IfThenElseZero(degenerate, splat(1)), FloatTag(), values[kNumbers - 1]);
    HWY_ALIGN float flags[kLanes];
    hn::Store(hn::IfThenElseZero(unsure, splat(1)), FloatTag(), flags);
    for (size_t i = 0; i < kLanes; ++i) {
      if (flags[i] == 0) continue;
      const std::array<float, kNumbers> exact = exact_answer(source, A::kKind, B::kKind, row + i);
      for (size_t c = 0; c < kNumbers; ++c) values[c][i] = exact[c];
    }
    for (size_t c = 0; c + 1 < kNumbers; ++c) *columns[c] = hn::Load(FloatTag(), values[c]);
    degenerate = hn::Ne(hn::Load(FloatTag(), values[kNumbers - 1]), splat(0));
  }

  HWY_INLINE F3 witness(const F3& position, const F3& low, const F3& arm) const {
    if (batch.frame == WitnessFrame::body) return arm;
    if constexpr (kHasLow) return position + (low + arm);
    return position + arm;
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_REPORT_INL_H_
