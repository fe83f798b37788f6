// Convex shapes and their separation in double and long double.
#include "oracle/convex_dop_templates.h"
#include "oracle/convex_oracle_templates.h"
#include "oracle/convex_shape_templates.h"

namespace carom::oracle {

template class ConvexDop<double>;
template class ConvexDop<long double>;
template struct Rotation<double>;
template struct ConvexFace<double>;
template struct ConvexShape<double>;
template struct Rotation<long double>;
template struct ConvexFace<long double>;
template struct ConvexShape<long double>;
template class ConvexDirections<double>;
template ConvexSeparation<double> separation_with_normal(
    const ConvexShape<double>& a, const ConvexShape<double>& b,
    const ConvexDirections<double>& directions);
template double widest_gap(const ConvexShape<double>& a, const ConvexShape<double>& b);
template ConvexSeparation<double> separation_with_normal(const ConvexShape<double>& a,
                                                         const ConvexShape<double>& b);
template double gap_along(const ConvexShape<double>& a, const ConvexShape<double>& b,
                          const Vec3<double>& n);
template double surface_distance(const ConvexShape<double>& shape, const Vec3<double>& point);
template class ConvexDirections<long double>;
template ConvexSeparation<long double> separation_with_normal(
    const ConvexShape<long double>& a, const ConvexShape<long double>& b,
    const ConvexDirections<long double>& directions);
template long double widest_gap(const ConvexShape<long double>& a,
                                const ConvexShape<long double>& b);
template ConvexSeparation<long double> separation_with_normal(const ConvexShape<long double>& a,
                                                              const ConvexShape<long double>& b);
template long double gap_along(const ConvexShape<long double>& a, const ConvexShape<long double>& b,
                               const Vec3<long double>& n);
template long double surface_distance(const ConvexShape<long double>& shape,
                                      const Vec3<long double>& point);

}  // namespace carom::oracle
