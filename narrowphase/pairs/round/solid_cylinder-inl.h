// The kernel for hulls or triangles and cylinders: poses of a vector of pairs in lanes, then the
// features of one solid at a time. solid_cylinder_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_PAIRS_ROUND_SOLID_CYLINDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_PAIRS_ROUND_SOLID_CYLINDER_INL_H_
#undef CAROM_NARROWPHASE_PAIRS_ROUND_SOLID_CYLINDER_INL_H_
#else
#define CAROM_NARROWPHASE_PAIRS_ROUND_SOLID_CYLINDER_INL_H_
#endif

#include <array>
#include <optional>

#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/solid_contact-inl.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "narrowphase/pairs/round/solid_cylinder_scalar.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Three columns of floats, a lane each.
struct ColumnsOf3 {
  HWY_ALIGN float column[3][kLanes];

  HWY_INLINE void put(const F3& v) {
    const FloatTag tag;
    hn::Store(v.x, tag, column[0]);
    hn::Store(v.y, tag, column[1]);
    hn::Store(v.z, tag, column[2]);
  }
  Vector3f lane(size_t i) const { return {column[0][i], column[1][i], column[2][i]}; }
};

// The shapes of solids, a lane at a time.
class HullsOfLanes {
 public:
  using Shape = scalar::HullShape<float>;

  explicit HWY_INLINE HullsOfLanes(const HullLanes& hulls) : hulls_(hulls) {
    hn::Store(hulls.scaling, FloatTag(), scale_);
  }
  Shape operator[](size_t i) const { return {hulls_.geometry[i], scale_[i]}; }

 private:
  const HullLanes& hulls_;
  HWY_ALIGN float scale_[kLanes];
};

class TrianglesOfLanes {
 public:
  using Shape = scalar::TriangleShape<float>;

  explicit HWY_INLINE TrianglesOfLanes(const TriangleLanes& triangles)
      : special_(bits_of(FloatTag(), triangles.is_special)) {
    corner_[0].put(triangles.a);
    corner_[1].put(triangles.b);
    corner_[2].put(triangles.c);
  }
  Shape operator[](size_t i) const {
    return {{corner_[0].lane(i), corner_[1].lane(i), corner_[2].lane(i)},
            0,
            false,
            0,
            (special_ >> i & 1) != 0};
  }

 private:
  std::array<ColumnsOf3, 3> corner_;
  uint64_t special_;
};

// A vector of solids and cylinders. `turn`: of the solids; `d`: from them to the cylinders.
template <class Solids>
class SolidCylinders {
 public:
  HWY_INLINE SolidCylinders(const Solids& shapes, const CylinderLanes& cylinders,
                            const Quaternion& q, const Rotation& turn, const F3& d) {
    middle_.put(rotate_back(turn, d));
    axis_.put(rotate_back(turn, rotation_of(q).z));
    hn::Store(cylinders.half_length, FloatTag(), half_length_);
    hn::Store(cylinders.radius, FloatTag(), rim_);
    shapes_ = &shapes;
  }

  // Lanes that are not valid, or whose solids have no kernel, have no sure contact.
  HWY_INLINE SolidContactLanes find(Mask valid) {
    const uint64_t lanes = bits_of(FloatTag(), valid);
    for (size_t i = 0; i < kLanes; ++i) {
      if (!(lanes >> i & 1)) continue;
      const auto shape = (*shapes_)[i];
      const Solid& solid = solid_[i].emplace(shape).view();
      if (!scalar::has_kernel(solid)) continue;
      SolidCylinderPair& pair = pairs_[count_];
      lane_[count_++] = i;
      pair.solid = &solid;
      pair.cylinder = {middle_.lane(i), axis_.lane(i), half_length_[i], rim_[i]};
      pair.is_blunt = scalar::is_blunt(shape);
    }
    find_solid_contacts_in_lanes()(pairs_.data(), count_);
    return contacts();
  }

  // The lanes whose shapes overlap, but have no common point that float32 is sure of.
  HWY_NOINLINE Mask unproven() const {
    HWY_ALIGN float flags[kLanes] = {};
    for (size_t k = 0; k < count_; ++k) {
      const SolidCylinderPair& pair = pairs_[k];
      if (pair.contact.separation > 0) continue;
      if (!has_common_point(*pair.solid, pair.cylinder, pair.contact)) flags[lane_[k]] = 1;
    }
    return hn::Gt(hn::Load(FloatTag(), flags), splat(0));
  }

 private:
  HWY_INLINE SolidContactLanes contacts() const {
    HWY_ALIGN float number[8][kLanes] = {};
    for (size_t k = 0; k < count_; ++k) {
      const auto& [separation, n, p, is_sure] = pairs_[k].contact;
      const float numbers[] = {separation, n.x(), n.y(), n.z(),
                               p.x(),      p.y(), p.z(), is_sure ? 1.0f : 0.0f};
      for (size_t c = 0; c < 8; ++c) number[c][lane_[k]] = numbers[c];
    }
    const auto column = [&](size_t c) HWY_ATTR { return hn::Load(FloatTag(), number[c]); };
    return {column(0),
            {column(1), column(2), column(3)},
            {column(4), column(5), column(6)},
            hn::Gt(column(7), splat(0))};
  }

  const Solids* shapes_;
  ColumnsOf3 middle_, axis_;
  HWY_ALIGN float half_length_[kLanes];
  HWY_ALIGN float rim_[kLanes];
  std::array<std::optional<SolidOf<typename Solids::Shape>>, kLanes> solid_;
  // Those that have a kernel, and their lanes.
  std::array<SolidCylinderPair, kLanes> pairs_;
  std::array<size_t, kLanes> lane_;
  size_t count_ = 0;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_PAIRS_ROUND_SOLID_CYLINDER_INL_H_
