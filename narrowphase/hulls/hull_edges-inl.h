// The edges of two solids in lanes, for the penetration search: which of them are open, and the
// best crossing of two. hull_steps_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_HULLS_HULL_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_HULL_EDGES_INL_H_
#undef CAROM_NARROWPHASE_HULLS_HULL_EDGES_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_HULL_EDGES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "base/tolerances.h"
#include "narrowphase/hulls/hull_depth.h"
#include "simd/first_of_most-inl.h"
#include "simd/gather-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F3 in_all_lanes(const Eigen::Vector3f& v) {
  return {splat(v.x()), splat(v.y()), splat(v.z())};
}

// --- Open edges ---

HWY_INLINE void settle_faces(const Solid& solid, float gap, FaceBounds& bounds) {
  const FloatTag tag;
  const hn::Rebind<uint8_t, FloatTag> bytes;
  const F most = splat(gap);
  for (size_t row = 0; row < bounds.settled_rows(); ++row) {
    const size_t first = 8 * row, end = std::min(bounds.count, first + 8);
    for (size_t i = 0; i < solid.face_count; i += kLanes) {
      I settled = hn::Zero(IntTag());
      I bit = hn::Set(IntTag(), 1);
      for (size_t ball = first; ball < end; ++ball) {
        const Mask is_low = hn::Le(hn::LoadU(tag, bounds.between[ball].data() + i), most);
        settled = hn::Or(settled, hn::IfThenElseZero(hn::RebindMask(IntTag(), is_low), bit));
        bit = hn::Add(bit, bit);
      }
      hn::StoreU(hn::DemoteTo(bytes, settled), bytes, bounds.settled[row].data() + i);
    }
  }
}

#if HWY_TARGET != HWY_SCALAR

using ByteTag = hn::ScalableTag<uint8_t>;
using Bytes = hn::Vec<ByteTag>;
inline constexpr size_t kByteLanes = HWY_LANES(uint8_t);

// table[index] in each lane, for indices below `size`. The table is looked up sixteen bytes at a
// time, which takes no gather.
HWY_INLINE Bytes look_up(const uint8_t* table, size_t size, Bytes index) {
  const ByteTag tag;
  const Bytes above = hn::Set(tag, 0x70), low = hn::Set(tag, 0x8f);
  Bytes found = hn::Zero(tag);
  for (size_t i = 0; i < size; i += 16) {
    // An index of other sixteen bytes gets its highest bit set, and finds zero.
    const Bytes within = hn::Xor(index, hn::Set(tag, static_cast<uint8_t>(i)));
    const Bytes place = hn::And(hn::SaturatedAdd(within, above), low);
    found = hn::Or(found, hn::TableLookupBytesOr0(hn::LoadDup128(tag, table + i), place));
  }
  return found;
}

// Bit k: edge e + k is open.
HWY_INLINE auto open_bits(const Solid& solid, const FaceBounds& bounds, size_t e) {
  using Bits = std::conditional_t<kByteLanes == 64, uint64_t,
                                  std::conditional_t<kByteLanes == 32, uint32_t, uint16_t>>;
  const ByteTag tag;
  const Bytes left = hn::LoadU(tag, solid.side[0] + e), right = hn::LoadU(tag, solid.side[1] + e);
  Bytes settled = hn::Zero(tag);
  for (size_t row = 0; row < bounds.settled_rows(); ++row) {
    const uint8_t* const table = bounds.settled[row].data();
    settled = hn::Or(settled, hn::And(look_up(table, solid.face_count, left),
                                      look_up(table, solid.face_count, right)));
  }
  uint8_t stored[8];  // as many bytes as StoreMaskBits may write
  hn::StoreMaskBits(tag, hn::Eq(settled, hn::Zero(tag)), stored);
  Bits bits;
  std::memcpy(&bits, stored, sizeof bits);
  return bits;
}

HWY_INLINE void find_open_edges(const Solid& solid, float gap, FaceBounds& bounds,
                                OpenEdges& open) {
  settle_faces(solid, gap, bounds);
  open.count = 0;
  for (size_t e = 0; e < solid.edges.size(); e += kByteLanes) {
    uint64_t bits = open_bits(solid, bounds, e);
    if (const size_t left = solid.edges.size() - e; left < 64) bits &= (uint64_t{1} << left) - 1;
    for (; bits != 0; bits &= bits - 1) {
      const size_t found = e + size_t(std::countr_zero(bits));
      __builtin_prefetch(&solid.edges[found]);
      open.index[open.count++] = static_cast<uint16_t>(found);
    }
  }
}

#else

HWY_INLINE void find_open_edges(const Solid& solid, float gap, FaceBounds& bounds,
                                OpenEdges& open) {
  settle_faces(solid, gap, bounds);
  open.count = 0;
  for (size_t e = 0; e < solid.edges.size(); ++e) {
    int settled = 0;
    for (size_t row = 0; row < bounds.settled_rows(); ++row) {
      settled |= bounds.settled[row][solid.side[0][e]] & bounds.settled[row][solid.side[1][e]];
    }
    open.index[open.count] = static_cast<uint16_t>(e);
    open.count += settled == 0 ? 1 : 0;
  }
}

#endif

// --- Crossings ---

// A vector crosses kOfA edges of A with kOfB edges of B: lane i has edge i / kOfB of A, and edge
// i % kOfB of B.
inline constexpr size_t kOfB = std::min<size_t>(kLanes, 4);
inline constexpr size_t kOfA = kLanes / kOfB;

#if HWY_TARGET != HWY_SCALAR

// `record(i)` is four floats, of which the first three are used.
template <class Record>
struct BlockSource {
  const Record& record;
  HWY_INLINE hn::Vec<Quad> quad(size_t lane) const {
    return hn::LoadU(Quad(), record(lane / kOfB));
  }
};

template <class Record>
HWY_INLINE F3 lanes_of_a(const Record& record) {
  const F row = interleaved_row(FloatTag(), BlockSource<Record>{record}, 0);
  return {hn::Broadcast<0>(row), hn::Broadcast<1>(row), hn::Broadcast<2>(row)};
}

HWY_INLINE F in_all_blocks(const float* record) {
  if constexpr (kLanes == 4) return hn::LoadU(FloatTag(), record);
  return hn::LoadDup128(FloatTag(), record);
}

template <class Record>
HWY_INLINE F3 lanes_of_b(const Record& record) {
  F3 xyz;
  F unused;
  transpose_rows(in_all_blocks(record(0)), in_all_blocks(record(1)), in_all_blocks(record(2)),
                 in_all_blocks(record(3)), xyz, unused);
  return xyz;
}

#else

template <class Record>
HWY_INLINE F3 lanes_of_a(const Record& record) {
  const float* const p = record(0);
  return {splat(p[0]), splat(p[1]), splat(p[2])};
}

template <class Record>
HWY_INLINE F3 lanes_of_b(const Record& record) {
  return lanes_of_a(record);
}

#endif

struct EdgeLanes {
  F3 direction, left, right, from;
};

// Edges from `first` on. The lanes behind the last edge repeat it; they find nothing better.
template <class ToLanes>
HWY_INLINE void load_edges(const CrossedEdges& edges, size_t first, const ToLanes& to_lanes,
                           EdgeLanes& out) {
  const Solid& solid = edges.solid;
  const auto edge = [&](size_t i) HWY_ATTR -> const Solid::Edge& {
    return edges.edge(std::min(first + i, edges.open.count - 1));
  };
  out.direction = to_lanes([&](size_t i) HWY_ATTR { return edge(i).direction.data(); });
  out.left = to_lanes([&](size_t i) HWY_ATTR { return solid.plane_record[edge(i).left].data(); });
  out.right = to_lanes([&](size_t i) HWY_ATTR { return solid.plane_record[edge(i).right].data(); });
  out.from = to_lanes([&](size_t i) HWY_ATTR { return solid.point_record[edge(i).from].data(); }) *
             splat(solid.scale);
}

// Without branches, because whether two edges cross cannot be predicted.
HWY_INLINE void cross_lanes(const EdgeLanes& a, const EdgeLanes& b, F index, FirstOfMost& best,
                            Mask& doubtful) {
  const F zero = splat(0);
  const F of_left = dot(b.left, a.direction), of_right = dot(b.right, a.direction);
  const F on_left = dot(a.left, b.direction), on_right = dot(a.right, b.direction);
  const Mask crosses = hn::And(
      hn::Lt(hn::Mul(of_right, of_left), zero),
      hn::And(hn::Lt(hn::Mul(on_right, on_left), zero), hn::Lt(hn::Mul(of_right, on_left), zero)));
  const F3 n = cross(a.direction, b.direction);
  const F nn = dot(n, n);
  doubtful = hn::Or(doubtful, hn::AndNot(hn::Gt(nn, splat(kAlongEachOther)), crosses));
  const F along = hn::Mul(dot(n, b.from - a.from), hn::Div(splat(1), hn::Sqrt(nn)));
  const Mask is_back = hn::Lt(dot(n, a.left + a.right), zero);
  best.keep_first(crosses, hn::IfThenElse(is_back, hn::Neg(along), along), index);
}

HWY_INLINE Crossing cross_edges(const CrossedEdges& a, const CrossedEdges& b,
                                const scalar::Rotation<float>& turn, const Eigen::Vector3f& offset,
                                float gap) {
  const auto load_a = [](const auto& record) HWY_ATTR { return lanes_of_a(record); };
  const auto load_b = [](const auto& record) HWY_ATTR { return lanes_of_b(record); };
  const Rotation r{in_all_lanes(turn.x), in_all_lanes(turn.y), in_all_lanes(turn.z)};
  const F3 d = in_all_lanes(offset);
  const F lane_of_a = lanes_from([](size_t i) { return static_cast<float>(i / kOfB); });
  const F lane_of_b = lanes_from([](size_t i) { return static_cast<float>(i % kOfB); });
  const F most = splat(kMostCrossed);
  Mask doubtful = no_lanes();
  FirstOfMost best{splat(gap), splat(-1)};
  for (size_t k = 0; k < b.open.count; k += kOfB) {
    EdgeLanes of_b;
    load_edges(b, k, load_b, of_b);
    of_b.direction = rotate(r, of_b.direction);
    of_b.left = rotate(r, of_b.left);
    of_b.right = rotate(r, of_b.right);
    of_b.from = rotate(r, of_b.from) + d;
    const F index_b = hn::Add(lane_of_b, splat(static_cast<float>(k)));
    for (size_t i = 0; i < a.open.count; i += kOfA) {
      EdgeLanes of_a;
      load_edges(a, i, load_a, of_a);
      const F index_a = hn::Add(lane_of_a, splat(static_cast<float>(i)));
      cross_lanes(of_a, of_b, hn::Add(hn::Mul(index_a, most), index_b), best, doubtful);
    }
  }
  Crossing crossing{gap};
  crossing.is_doubtful = !hn::AllFalse(FloatTag(), doubtful);
  crossing.exists = best.value() > gap;
  if (!crossing.exists) return crossing;
  const size_t first = best.first();
  crossing.gap = best.value();
  crossing.of_a = first / kMostCrossed;
  crossing.of_b = first % kMostCrossed;
  return crossing;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_HULL_EDGES_INL_H_
