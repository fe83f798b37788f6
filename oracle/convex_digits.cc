// Convex shapes and their separation in 100 and 1,500 decimal digits.
#include "oracle/convex_dop_templates.h"
#include "oracle/convex_oracle_templates.h"
#include "oracle/convex_shape_templates.h"
#include "oracle/digits.h"

namespace carom::oracle {

template class ConvexDop<Digits<100>>;
template class ConvexDop<Digits<1500>>;
template struct Rotation<Digits<100>>;
template struct ConvexFace<Digits<100>>;
template struct ConvexShape<Digits<100>>;
template struct Rotation<Digits<1500>>;
template struct ConvexFace<Digits<1500>>;
template struct ConvexShape<Digits<1500>>;
template class ConvexDirections<Digits<100>>;
template ConvexSeparation<Digits<100>> separation_with_normal(
    const ConvexShape<Digits<100>>& a, const ConvexShape<Digits<100>>& b,
    const ConvexDirections<Digits<100>>& directions);
template Digits<100> widest_gap(const ConvexShape<Digits<100>>& a,
                                const ConvexShape<Digits<100>>& b);
template ConvexSeparation<Digits<100>> separation_with_normal(const ConvexShape<Digits<100>>& a,
                                                              const ConvexShape<Digits<100>>& b);
template Digits<100> gap_along(const ConvexShape<Digits<100>>& a, const ConvexShape<Digits<100>>& b,
                               const Vec3<Digits<100>>& n);
template Digits<100> surface_distance(const ConvexShape<Digits<100>>& shape,
                                      const Vec3<Digits<100>>& point);
template class ConvexDirections<Digits<1500>>;
template ConvexSeparation<Digits<1500>> separation_with_normal(
    const ConvexShape<Digits<1500>>& a, const ConvexShape<Digits<1500>>& b,
    const ConvexDirections<Digits<1500>>& directions);
template Digits<1500> widest_gap(const ConvexShape<Digits<1500>>& a,
                                 const ConvexShape<Digits<1500>>& b);
template ConvexSeparation<Digits<1500>> separation_with_normal(const ConvexShape<Digits<1500>>& a,
                                                               const ConvexShape<Digits<1500>>& b);
template Digits<1500> gap_along(const ConvexShape<Digits<1500>>& a,
                                const ConvexShape<Digits<1500>>& b, const Vec3<Digits<1500>>& n);
template Digits<1500> surface_distance(const ConvexShape<Digits<1500>>& shape,
                                       const Vec3<Digits<1500>>& point);

}  // namespace carom::oracle
