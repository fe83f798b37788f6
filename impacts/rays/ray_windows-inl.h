// When rays may touch triangles of meshes, and whether they certainly do, in lanes of doubles:
// C. Ericson, Real-Time Collision Detection, 2005, section 5.3.6, with bounds on the rounding of
// each number.
#if defined(CAROM_IMPACTS_RAYS_RAY_WINDOWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_RAYS_RAY_WINDOWS_INL_H_
#undef CAROM_IMPACTS_RAYS_RAY_WINDOWS_INL_H_
#else
#define CAROM_IMPACTS_RAYS_RAY_WINDOWS_INL_H_
#endif

#include <cmath>

#include "impacts/rays/ray_in_mesh.h"
#include "impacts/slack.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Bounds on rounding and on the slack of linear times, as shares of products of lengths; more than
// kSweepSlack and kSeam.
inline constexpr double kPointSlack = 0x1p-38;
inline constexpr double kParallel = 0x1p-30;
// The square of the sine above which a face is certainly not slanted.
inline constexpr double kSurelyUpright = 4 * kSlantedFace * kSlantedFace;

// When rays may touch triangles, as columns.
class RayWindows {
 public:
  static constexpr size_t kMost = 128;

  // The ray may touch the triangle, from `earliest` to `latest`.
  bool passes(size_t i) const { return bit(passes_, i); }
  // It certainly touches the triangle in that time, and from the front if `is_from_front`.
  bool is_sure(size_t i) const { return bit(sure_, i); }
  bool is_from_front(size_t i) const { return bit(front_, i); }
  double earliest(size_t i) const { return earliest_[i]; }
  double latest(size_t i) const { return latest_[i]; }

  // Finds the windows of a vector of rays with triangles a, b, c, and stores them from row i on.
  // `travel` and `lengths` as in RayInMesh.
  HWY_INLINE void find(const D3& start, const D3& way, D travel, D lengths, const D3& a,
                       const D3& b, const D3& c, size_t i) {
    const DoubleTag tag;
    const D3 u = b - a, v = c - a;
    const D3 normal = cross(u, v), from = start - a;
    const D towards = hn::Neg(dot(way, normal));
    const D rate = hn::Abs(towards);
    const D side = max(largest_component(u), largest_component(v));
    const D area = hn::Mul(side, side);
    const D area_travel = hn::Mul(area, travel), area_lengths = hn::Mul(area, lengths);

    const D3 turn = cross(from, way);  // -way x from
    const D sign = hn::CopySign(splat_double(1), towards);
    const D along_u = hn::Mul(sign, dot(v, turn)), along_v = hn::Neg(hn::Mul(sign, dot(u, turn)));
    const D along = hn::Add(along_u, along_v), least = min(along_u, along_v);
    const D slack = splat_double(kPointSlack);
    const D doubt = hn::Mul(slack, hn::Add(hn::Mul(hn::Mul(side, travel), lengths), rate));
    const auto reaches =
        hn::And(hn::Ge(least, hn::Neg(doubt)), hn::Le(along, hn::Add(rate, doubt)));
    const auto is_inside = hn::And(hn::Ge(least, doubt), hn::Le(along, hn::Sub(rate, doubt)));

    const D per_rate = hn::Div(splat_double(1), rate);
    const D t = hn::Mul(hn::Mul(sign, dot(from, normal)), per_rate);
    const D late =
        hn::Mul(slack, hn::Mul(hn::Add(area_lengths, hn::Mul(hn::Abs(t), area_travel)), per_rate));
    const D earliest = hn::Sub(t, late), latest = hn::Add(t, late);
    const D zero = hn::Zero(tag), one = splat_double(1);
    const auto is_slow = hn::Le(rate, hn::Mul(splat_double(kParallel), area_travel));
    const auto in_time = hn::And(hn::Le(earliest, one), hn::Ge(latest, zero));
    const auto surely_in_time = hn::And(hn::Ge(earliest, zero), hn::Le(latest, one));
    const auto is_upright = hn::Gt(
        dot(normal, normal), hn::Mul(splat_double(kSurelyUpright), hn::Mul(dot(u, u), dot(v, v))));

    hn::Store(hn::IfThenElse(is_slow, zero, earliest), tag, earliest_.data() + i);
    hn::Store(hn::IfThenElse(is_slow, splat_double(HUGE_VAL), latest), tag, latest_.data() + i);
    put(hn::And(reaches, hn::Or(is_slow, in_time)), passes_, i);
    put(hn::AndNot(is_slow, hn::And(hn::And(is_inside, is_upright), surely_in_time)), sure_, i);
    put(hn::Gt(towards, zero), front_, i);
  }

 private:
  // The bits of each vector have a place of their own.
  using Bits = std::array<uint8_t, kMost / kDoubleLanes + 8>;
  static bool bit(const Bits& bits, size_t i) {
    return (bits[i / kDoubleLanes] >> (i % kDoubleLanes) & 1) != 0;
  }
  static HWY_INLINE void put(DoubleMask mask, Bits& bits, size_t i) {
    hn::StoreMaskBits(DoubleTag(), mask, bits.data() + i / kDoubleLanes);
  }

  alignas(64) std::array<double, kMost> earliest_, latest_;
  Bits passes_, sure_, front_;
};

// Pairs of a ray and a triangle, as columns.
class RayPairs {
 public:
  void clear() { count_ = 0; }

  HWY_INLINE void add(const RayInMesh& ray, uint32_t triangle) {
    double* number = numbers_.data() + count_;
    const auto put = [&number](double value) {
      *number = value;
      number += kStride;
    };
    for (const double x : ray.start) put(x);
    for (const double x : ray.way) put(x);
    put(ray.travel);
    put(ray.lengths);
    float* coordinate = corners_.data() + count_;
    for (const uint32_t vertex : ray.mesh->triangles()[triangle]) {
      const float* const corner = ray.mesh->vertices()[vertex].data();
      for (size_t axis = 0; axis < 3; ++axis, coordinate += kStride) *coordinate = corner[axis];
    }
    ++count_;
  }

  HWY_INLINE void find(RayWindows& windows) const {
    for (size_t i = 0; i < count_; i += kDoubleLanes) {
      windows.find(vector(0, i), vector(3, i), number(6, i), number(7, i), corner(0, i),
                   corner(1, i), corner(2, i), i);
    }
  }

 private:
  // Not a power of two, which would put all columns into a few sets of the cache.
  static constexpr size_t kStride = RayWindows::kMost + 8;

  HWY_INLINE D number(size_t column, size_t i) const {
    return hn::Load(DoubleTag(), numbers_.data() + column * kStride + i);
  }
  HWY_INLINE D3 vector(size_t column, size_t i) const {
    return {number(column, i), number(column + 1, i), number(column + 2, i)};
  }
  HWY_INLINE D coordinate(size_t column, size_t i) const {
    const hn::Rebind<float, DoubleTag> floats;
    return hn::PromoteTo(DoubleTag(), hn::Load(floats, corners_.data() + column * kStride + i));
  }
  HWY_INLINE D3 corner(size_t k, size_t i) const {
    return {coordinate(3 * k, i), coordinate(3 * k + 1, i), coordinate(3 * k + 2, i)};
  }

  size_t count_ = 0;
  alignas(64) std::array<double, 8 * kStride> numbers_;
  alignas(64) std::array<float, 9 * kStride> corners_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_RAYS_RAY_WINDOWS_INL_H_
