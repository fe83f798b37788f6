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
    double low[3][kLanes], high[3][kLanes];  // `high`: the negative of the upper ends
    const TurnColumns turns(q);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const Intervals ends = reach(turns.of(lane), Corners::points(*shapes[lane]));
      const double slack = Corners::slack(*shapes[lane]);
      for (size_t axis = 0; axis < 3; ++axis) {
        low[axis][lane] = ends[axis].lower - slack;
        high[axis][lane] = -(ends[axis].upper + slack);
      }
    }
    const auto down = [](const double* ends) HWY_ATTR { return downwards(load_wide(ends)); };
    lower = {down(low[0]), down(low[1]), down(low[2])};
    upper = {hn::Neg(down(high[0])), hn::Neg(down(high[1])), hn::Neg(down(high[2]))};
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_POINT_EXTENTS_INL_H_
