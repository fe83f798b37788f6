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

template <class V = F>
HWY_INLINE Lanes3<V> in_all_lanes(const Eigen::Vector3f& v) {
  return {splat_as<V>(v.x()), splat_as<V>(v.y()), splat_as<V>(v.z())};
}

// --- Open edges ---

HWY_INLINE void settle_faces(const Solid& solid, float gap, FaceBounds& bounds) {
  const FloatTag tag;
  const hn::Rebind<uint8_t, FloatTag> bytes;
  const F most = splat(gap);
  const size_t padded = padded_count(solid.face_count);
  for (size_t row = 0; row < bounds.settled_rows(); ++row) {
    const size_t count = std::min<size_t>(bounds.count - 8 * row, 8);
    uint8_t* const faces = bounds.settled[row].data();
    for (size_t i = 0; i < solid.face_count; i += kLanes) {
      const float* between = bounds.between(8 * row) + i;
      I settled = hn::Zero(IntTag());
      // Unrolled, so that the bits are constants.
      for (size_t ball = 0; ball < 8; ++ball, between += padded) {
        if (ball == count) break;
        const auto is_low = hn::RebindMask(IntTag(), hn::Le(hn::LoadU(tag, between), most));
        settled = hn::IfThenElse(is_low, hn::Or(settled, hn::Set(IntTag(), 1 << ball)), settled);
      }
      hn::StoreU(hn::DemoteTo(bytes, settled), bytes, faces + i);
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
  for (size_t e = 0; e < solid.edge_count; e += kByteLanes) {
    uint64_t bits = open_bits(solid, bounds, e);
    if (const size_t left = solid.edge_count - e; left < 64) bits &= (uint64_t{1} << left) - 1;
    // Several at a time, because nobody can predict how many there are.
    while (bits != 0) {
      const auto left = static_cast<size_t>(std::popcount(bits));
      for (size_t k = 0; k < OpenEdges::kAtOnce; ++k, bits &= bits - 1) {
        const size_t found = std::min(e + size_t(std::countr_zero(bits)), solid.edge_count - 1);
        if (solid.edges) __builtin_prefetch(&solid.edges[found]);
        open.index[open.count + k] = static_cast<uint16_t>(found);
      }
      open.count += std::min(left, OpenEdges::kAtOnce);
    }
  }
}

#else

HWY_INLINE void find_open_edges(const Solid& solid, float gap, FaceBounds& bounds,
                                OpenEdges& open) {
  settle_faces(solid, gap, bounds);
  open.count = 0;
  for (size_t e = 0; e < solid.edge_count; ++e) {
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

// Edges of B are turned once, before they are repeated for the edges of A.
using OfB = hn::Vec<Quad>;

// The first three numbers of four records.
template <class Record>
HWY_INLINE Lanes3<OfB> lanes_of_b(const Record& record) {
  const Quad tag;
  const auto r0 = hn::LoadU(tag, record(0)), r1 = hn::LoadU(tag, record(1));
  const auto r2 = hn::LoadU(tag, record(2)), r3 = hn::LoadU(tag, record(3));
  const auto xy02 = hn::InterleaveLower(tag, r0, r2), xy13 = hn::InterleaveLower(tag, r1, r3);
  const auto zw02 = hn::InterleaveUpper(tag, r0, r2), zw13 = hn::InterleaveUpper(tag, r1, r3);
  return {hn::InterleaveLower(tag, xy02, xy13), hn::InterleaveUpper(tag, xy02, xy13),
          hn::InterleaveLower(tag, zw02, zw13)};
}

template <class Tag>
HWY_INLINE hn::Vec<Tag> in_all_blocks(Tag tag, OfB v) {
  if constexpr (kLanesOf<Tag> == 4) {
    return v;
  } else {
    const auto half = in_all_blocks(hn::Half<Tag>(), v);
    return hn::Combine(tag, half, half);
  }
}

#else

template <class Record>
HWY_INLINE F3 lanes_of_a(const Record& record) {
  const float* const p = record(0);
  return {splat(p[0]), splat(p[1]), splat(p[2])};
}

using OfB = F;

template <class Record>
HWY_INLINE F3 lanes_of_b(const Record& record) {
  return lanes_of_a(record);
}
HWY_INLINE F in_all_blocks(FloatTag, F v) { return v; }

#endif

HWY_INLINE F3 in_all_blocks(const Lanes3<OfB>& v) {
  const FloatTag tag;
  return {in_all_blocks(tag, v.x), in_all_blocks(tag, v.y), in_all_blocks(tag, v.z)};
}

template <class V>
struct EdgesOf {
  Lanes3<V> direction, left, right, from;
};
using EdgeLanes = EdgesOf<F>;

// Edges from `first` on. The lanes behind the last edge repeat it; they find nothing better.
template <class ToLanes, class V>
HWY_INLINE void load_edges(const CrossedEdges& edges, size_t first, const ToLanes& to_lanes,
                           EdgesOf<V>& out) {
  const Solid& solid = edges.solid;
  const auto edge = [&](size_t i) HWY_ATTR -> const Solid::Edge& {
    return edges.edge(std::min(first + i, edges.open.count - 1));
  };
  out.direction = to_lanes([&](size_t i) HWY_ATTR { return edge(i).direction.data(); });
  out.left = to_lanes([&](size_t i) HWY_ATTR { return solid.plane_record[edge(i).left].data(); });
  out.right = to_lanes([&](size_t i) HWY_ATTR { return solid.plane_record[edge(i).right].data(); });
  out.from = to_lanes([&](size_t i) HWY_ATTR { return edges.points[edge(i).from].data(); }) *
             splat_as<V>(solid.scale);
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
  const RotationOf<OfB> r{in_all_lanes<OfB>(turn.x), in_all_lanes<OfB>(turn.y),
                          in_all_lanes<OfB>(turn.z)};
  const Lanes3<OfB> d = in_all_lanes<OfB>(offset);
  const F lane_of_a = lanes_from([](size_t i) { return static_cast<float>(i / kOfB); });
  const F lane_of_b = lanes_from([](size_t i) { return static_cast<float>(i % kOfB); });
  const F most = splat(kMostCrossed);
  Mask doubtful = no_lanes();
  FirstOfMost best{splat(gap), splat(-1)};
  for (size_t k = 0; k < b.open.count; k += kOfB) {
    EdgesOf<OfB> few_of_b;
    load_edges(b, k, load_b, few_of_b);
    const EdgeLanes of_b = {
        in_all_blocks(rotate(r, few_of_b.direction)), in_all_blocks(rotate(r, few_of_b.left)),
        in_all_blocks(rotate(r, few_of_b.right)), in_all_blocks(rotate(r, few_of_b.from) + d)};
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
