// Extents of hulls alone, or of k-DOPs alone: turns and rounding in lanes of bodies, corners in
// lanes of points. Bit for bit the results of extent_of().
#if defined(CAROM_BOUNDS_POINT_EXTENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_POINT_EXTENTS_INL_H_
#undef CAROM_BOUNDS_POINT_EXTENTS_INL_H_
#else
#define CAROM_BOUNDS_POINT_EXTENTS_INL_H_
#endif

#include "bounds/bounds_load-inl.h"
#include "bounds/point_reach-inl.h"
#include "shapes/dop_geometry.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// find(reader, i): the geometry of body i, or nullptr if extent_of() has more to do.
struct HullCorners {
  using Geometry = HullGeometry;

  static HWY_INLINE const HullGeometry* find(const BodyReader& reader, size_t i) {
    return geometry_at<HullGeometry>(reader.bodies.rows.data + 4 * reader.first_row(i));
  }
  static const HullGeometry& points(const HullGeometry& hull) { return hull; }
  static double slack(const HullGeometry& hull) { return kTurnRounding * hull.size(); }
};

struct DopCorners {
  using Geometry = DopGeometry;

  static HWY_INLINE const DopGeometry* find(const BodyReader& reader, size_t i) {
    const DopGeometry* known = reader.dop_geometry(i);
    return known && known->is_of(reader.bodies.rows.data + 4 * reader.first_row(i)) ? known
                                                                                    : nullptr;
  }
  static const DopPolytope& points(const DopGeometry& dop) { return dop.polytope(); }
  static double slack(const DopGeometry& dop) { return kDopRounding * dop.size(); }
};

// Nine numbers a body.
class TurnColumns {
 public:
  HWY_INLINE explicit TurnColumns(const Quaternion& q) {
    Wide rows[9];
    for_each_half([&](const auto& wide, const auto& half_of) HWY_ATTR {
      const TurnLanes turn({wide(q.v.x), wide(q.v.y), wide(q.v.z)}, wide(q.w));
      size_t k = 0;
      for (const D3* row : {&turn.x, &turn.y, &turn.z}) {
        half_of(rows[k++]) = row->x;
        half_of(rows[k++]) = row->y;
        half_of(rows[k++]) = row->z;
      }
    });
    for (size_t k = 0; k < 9; ++k) store_wide(rows[k], column_[k]);
  }

  HWY_INLINE std::array<Double3, 3> of(size_t lane) const {
    const auto row = [&](size_t k) -> Double3 {
      return {column_[k][lane], column_[k + 1][lane], column_[k + 2][lane]};
    };
    return {row(0), row(3), row(6)};
  }

 private:
  double column_[9][kLanes];
};

template <class Corners>
struct PointExtents {
  const BodyReader& reader;

  HWY_INLINE void load(size_t first, F, F3& lower, F3& upper) const {
    const typename Corners::Geometry* shapes[kLanes];
    bool all_known = true;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      shapes[lane] = Corners::find(reader, first + lane);
      all_known = all_known && shapes[lane];
    }
    const Quaternion q = load_orientations(reader.bodies, first);
    if (HWY_UNLIKELY(!all_known || !hn::AllTrue(FloatTag(), is_plain(q)))) {
      return load_singly(reader, first, lower, upper);
    }
    const TurnColumns turns(q);
    Wide low[3], high[3];  // `high`: the negative of the upper ends
    size_t lane = 0;
    for_each_half([&](const auto&, const auto& half_of) HWY_ATTR {
      D least[3][kDoubleLanes], most[3][kDoubleLanes];  // a row a body
      double slacks[kDoubleLanes];
      for (size_t row = 0; row < kDoubleLanes; ++row, ++lane) {
        const std::array<Double3, 3> turn = turns.of(lane);
        const ReachOfLanes reach(turn, Corners::points(*shapes[lane]));
        slacks[row] = Corners::slack(*shapes[lane]);
        for (size_t axis = 0; axis < 3; ++axis) {
          least[axis][row] = reach.least[axis];
          most[axis][row] = reach.most[axis];
        }
      }
      const D slack = hn::LoadU(DoubleTag(), slacks), zero = splat_double(0);
      for (size_t axis = 0; axis < 3; ++axis) {
        const D least_of_all = fold_rows(least[axis], [](D a, D b) HWY_ATTR { return min(a, b); });
        const D most_of_all = fold_rows(most[axis], [](D a, D b) HWY_ATTR { return max(a, b); });
        half_of(low[axis]) = hn::Sub(hn::Add(least_of_all, zero), slack);
        half_of(high[axis]) = hn::Neg(hn::Add(hn::Add(most_of_all, zero), slack));
      }
    });
    lower = {downwards(low[0]), downwards(low[1]), downwards(low[2])};
    upper = {hn::Neg(downwards(high[0])), hn::Neg(downwards(high[1])), hn::Neg(downwards(high[2]))};
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_POINT_EXTENTS_INL_H_
