#include "carom/hulls/simplify_hull.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "carom/hulls/build_hull.h"
#include "hulls/inside.h"
#include "hulls/outside.h"
#include "hulls/surface.h"
#include "hulls/unit_points.h"

namespace carom::hulls {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Points = std::vector<Vector3f>;

constexpr double kDropped = 1e-9;  // build_hull() drops points this close, a share of the extents

// Cuts are searched for up to this many points: beyond it scaling is as good and faster.
constexpr size_t kMostCut = 64;

// The same order, whatever that of the caller is.
Points sorted(std::span<const Vector3f> points) {
  Points all(points.begin(), points.end());
  std::sort(all.begin(), all.end(), [](const Vector3f& p, const Vector3f& q) {
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  return all;
}

// What build_hull() and the arithmetic of distances may be off by.
double slack_of(const HullGeometry& hull) {
  Vector3f lower = hull.points()[0], upper = lower;
  for (const Vector3f& p : hull.points()) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return 2 * kDropped * (upper.cast<double>() - lower.cast<double>()).norm() +
         1e-14 * double{hull.size()};
}

double furthest(std::span<const Vector3f> points, const HullGeometry& from) {
  const Surface surface(from);
  double most = 0;
  for (const Vector3f& p : points) most = std::max(most, surface.distance(p.cast<double>()));
  return most;
}

Result<SimplifiedHull> simplify_inside(const HullGeometry& hull, size_t most_points) {
  const std::vector<bool> is_chosen = choose_points(hull.points(), most_points);
  Result<BuiltHull> built = build_hull(select(hull.points(), is_chosen));
  if (!built) return built.error();
  const Points others = select(hull.points(), is_chosen, false);
  const double error = furthest(others, *built->geometry) + slack_of(hull);
  return SimplifiedHull{std::move(built->geometry), error};
}

// The hull of some points, scaled about their middle until it lies as far outside of the original
// as inside.
Result<SimplifiedHull> simplify_both(const HullGeometry& hull, size_t most_points) {
  Result<SimplifiedHull> inside = simplify_inside(hull, most_points);
  if (!inside) return inside;
  SimplifiedHull best = *inside;
  const HullGeometry& inner = *inside->geometry;
  double radius = 0;  // of the points, about their middle
  for (const Vector3f& p : inner.points()) {
    radius = std::max(radius, (p.cast<double>() - inner.middle()).norm());
  }
  for (const double part : {0.4, 0.55, 0.7}) {
    const double factor = 1 + part * inside->error / radius;
    Points points;
    for (const Vector3f& p : inner.points()) {
      points.push_back(
          (inner.middle() + factor * (p.cast<double>() - inner.middle())).cast<float>());
    }
    Result<BuiltHull> built = build_hull(points);
    if (!built) continue;
    const double error = std::max(furthest(hull.points(), *built->geometry),
                                  furthest(built->geometry->points(), hull)) +
                         slack_of(*built->geometry);
    if (error < best.error) best = {std::move(built->geometry), error};
  }
  return best;
}

// Replaces `best` by the hull of these corners, if that is nearer to the original.
void keep_better(const std::optional<Corners>& corners, const UnitPoints& unit,
                 const HullGeometry& hull, std::optional<SimplifiedHull>& best) {
  if (!corners) return;
  Points points;
  for (const Vector3d& corner : *corners) points.push_back(unit.unscaled(corner).cast<float>());
  Result<BuiltHull> built = build_hull(sorted(points));
  if (!built || built->form != HullForm::solid) return;
  const double error = furthest(built->geometry->points(), hull) + slack_of(*built->geometry);
  if (!best || error < best->error) best = SimplifiedHull{std::move(built->geometry), error};
}

Result<SimplifiedHull> simplify_outside(const HullGeometry& hull, size_t most_points) {
  const UnitPoints unit = unit_points(hull.points());
  // The new corners may be twice as large, and rounding moves them; dropped points count as well.
  const double margin = 4 * unit.rounding.norm() + 10 * kDropped;
  std::optional<SimplifiedHull> best;
  const Corners chosen = select<Vector3d>(unit.point, choose_points(hull.points(), most_points));
  keep_better(scaled_around(chosen, unit.point, margin), unit, hull, best);
  if (most_points <= kMostCut) {
    const Surface surface(hull, unit.point);
    keep_better(cut_around(unit.point, surface, most_points, margin), unit, hull, best);
  }
  if (best) return std::move(*best);
  return Error{"the points of the hull are too flat to be simplified from outside"};
}

}  // namespace
}  // namespace carom::hulls

namespace carom {

Result<SimplifiedHull> simplify_hull(std::span<const Eigen::Vector3f> points,
                                     const SimplifyOptions& options) {
  const FloatEnvironment environment;
  if (options.most_points < 4) {
    return Error{"a simpler hull needs at least 4 points, not " +
                 std::to_string(options.most_points)};
  }
  const auto is_finite = [](const Eigen::Vector3f& p) { return p.allFinite(); };
  if (!std::all_of(points.begin(), points.end(), is_finite)) return build_hull(points).error();
  Result<BuiltHull> hull = build_hull(hulls::sorted(points));
  if (!hull) return hull.error();
  if (hull->geometry->points().size() <= options.most_points) {
    const double error = hull->inside > 0 ? hulls::slack_of(*hull->geometry) : 0;
    return SimplifiedHull{std::move(hull->geometry), error};
  }
  if (options.side == HullSide::inside) {
    return hulls::simplify_inside(*hull->geometry, options.most_points);
  }
  if (options.side == HullSide::both) {
    return hulls::simplify_both(*hull->geometry, options.most_points);
  }
  return hulls::simplify_outside(*hull->geometry, options.most_points);
}

}  // namespace carom
