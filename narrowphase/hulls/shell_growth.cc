#include "narrowphase/hulls/shell_growth.h"

#include <algorithm>
#include <bit>

namespace carom {
namespace {

using namespace scalar;

// The most corners that one proof adds.
constexpr size_t kMostSteps = 40;

// How many corners a shell may get after it was made.
constexpr size_t kMoreCorners = 6;

// The sides of the first shell are tilted by 40 degrees from its axis.
constexpr float kTiltCosine = 0.77f, kTiltSine = 0.64f;

// Corners in front of a triangle by more than this make a dent.
constexpr float kDent = 0x1p-14f;

// A length without a direction.
constexpr float kNoLength = 0x1p-20f;

Vector3f unit(const Vector3f& v) { return v * (1 / std::sqrt(dot(v, v))); }

Vector3f across(const Vector3f& n) {
  const Vector3f side = std::fabs(n.x()) < 0.6f ? Vector3f::UnitX() : Vector3f::UnitY();
  return unit(cross(n, side));
}

// The share of q in the point of an edge from p to q that is nearest to zero.
float nearest_share(const Vector3f& p, const Vector3f& q) {
  const Vector3f e = q - p;
  const float ee = dot(e, e);
  return ee > 0 ? clamp<float>(-dot(p, e) / ee, 0, 1) : 0;
}

// If all axes overlap by this, one with such a height has no more overlap than they, but for the
// slack.
float reach_of(float height, float slack) { return max(height - slack, 0.0f) + kShellRounding; }

bool proves(const ShellCheck& check, float reach) { return reach * reach <= check.least_squared; }

}  // namespace

ShellGrowth::ShellGrowth(Shell& shell, const ShellHulls& hulls, ShellSpace& space)
    : shell_(shell), hulls_(hulls), space_(space) {
  hulls_.steps.place_corners(shell_, hulls_.a, hulls_.b.view(), space_);
}

void ShellGrowth::begin(const Vector3f& way) {
  shell_.points_of_a = static_cast<uint8_t>(hulls_.a.point_count);
  shell_.points_of_b = static_cast<uint8_t>(hulls_.b.count);
  shell_.most_corners = Shell::kMostCorners;
  shell_.is_new = true;
  const Vector3f axis = dot(way, way) > kNoLength * kNoLength ? unit(way) : Vector3f::UnitX();
  const Vector3f u = across(axis) * kTiltSine, v = cross(axis, u);
  const Vector3f up = axis * kTiltCosine;
  const std::array<Vector3f, 6> ways = {axis, up + u, up + v, up - u, up - v, -axis};
  std::array<size_t, 6> corner;
  for (size_t i = 0; i < ways.size(); ++i) {
    const Support found = support(ways[i]);
    corner[i] = place_of(found, shell_.corners);
    put_corner(found, corner[i]);
  }
  // Two ways may find the same corner. Triangles without area are left out.
  const auto add = [&](size_t i, size_t j, size_t k) {
    if (i != j && j != k && k != i) put_triangle(shell_.triangle_count++, i, j, k);
  };
  for (size_t k = 1; k <= 4; ++k) {
    const size_t next = k % 4 + 1;
    add(corner[0], corner[k], corner[next]);
    add(corner[5], corner[next], corner[k]);
  }
}

ShellAnswer ShellGrowth::measure(float slack, ShellDepth& found) {
  for (size_t step = 0; step < kMostSteps; ++step) {
    const ShellCheck planes = hulls_.steps.check_planes(shell_, space_);
    if (!planes.is_around) {
      const Support next = support(way_out());
      if (next.height <= 0) return ShellAnswer::apart;
      if (!grow(next)) return ShellAnswer::none;
      continue;
    }
    Nearest nearest = nearest_on(planes.nearest);
    Support next = support(nearest.way);
    if (is_proved(planes, slack, nearest, next)) {
      locate(nearest, found);
      return ShellAnswer::depth;
    }
    if (!grow(next)) return ShellAnswer::none;
  }
  return ShellAnswer::none;
}

// Whether no axis has less overlap than the one to the nearest point, but for the slack. If not,
// `next` is the corner to grow to; before, the one along that axis. A plane that is nearer than its
// triangle proves nothing: the surface has a dent there, which another corner of it fills, or else
// triangles tell.
bool ShellGrowth::is_proved(const ShellCheck& planes, float slack, Nearest& nearest,
                            Support& next) const {
  const float reach = reach_of(next.height, slack);
  if (proves(planes, reach)) return true;
  if (nearest.is_inside || fills_dent(nearest.triangle, next)) return false;
  const ShellCheck triangles = hulls_.steps.check_edges(shell_, space_);
  if (proves(triangles, reach)) return true;
  nearest = nearest_on(triangles.nearest);
  next = support(nearest.way);
  return proves(triangles, reach_of(next.height, slack));
}

// Whether a corner of the shell is clearly in front of a triangle; the furthest becomes `next`.
bool ShellGrowth::fills_dent(size_t triangle, Support& next) const {
  const Vector3f n = space_.normal_at(triangle);
  float most = space_.volume[triangle] + kDent * std::sqrt(dot(n, n));
  size_t furthest = Shell::kMostCorners;
  for (uint32_t left = shell_.corners; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    const float height = dot(n, space_.corner_at(i));
    if (height > most) {
      most = height;
      furthest = i;
    }
  }
  if (furthest == Shell::kMostCorners) return false;
  next = {shell_.of_a[furthest], shell_.of_b[furthest], space_.corner_at(furthest), 0};
  return true;
}

void ShellGrowth::end() {
  const size_t most = static_cast<size_t>(std::popcount(shell_.corners)) + kMoreCorners;
  shell_.most_corners = static_cast<uint8_t>(std::min(most, Shell::kMostCorners));
}

ShellGrowth::Support ShellGrowth::support(const Vector3f& way) const {
  const FurthestOfHull a = hulls_.steps.furthest(hulls_.a.points(), way);
  const FurthestOfHull b = hulls_.steps.furthest(hulls_.b.view(), -way);
  const Vector3f point = hulls_.a.corner(a.index) - hulls_.b[b.index];
  return {a.index, b.index, point, a.height * hulls_.a.scale + b.height};
}

ShellGrowth::Nearest ShellGrowth::nearest_on(size_t triangle) const {
  std::array<Vector3f, 3> p;
  for (size_t k = 0; k < 3; ++k) p[k] = space_.corner_at(shell_.corner_of(triangle, k));
  const Vector3f n = space_.normal_at(triangle);
  const float volume = space_.volume[triangle], nn = dot(n, n);
  Nearest nearest;
  nearest.triangle = triangle;
  std::array<float, 3>& share = nearest.share;
  for (size_t k = 0; k < 3; ++k) share[k] = dot(n, cross(p[(k + 1) % 3], p[(k + 2) % 3]));
  nearest.is_inside = nn > 0 && share[0] >= 0 && share[1] >= 0 && share[2] >= 0;
  if (nearest.is_inside) {
    const float inverse = (volume < 0 ? -1 : 1) / std::sqrt(nn);
    nearest.distance = volume * inverse;
    nearest.way = n * inverse;
    return nearest;
  }
  float least = kLargest;
  Vector3f x = p[0];
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    const float of_next = nearest_share(p[k], p[next]);
    const Vector3f on_edge = p[k] * (1 - of_next) + p[next] * of_next;
    if (!(dot(on_edge, on_edge) < least)) continue;
    least = dot(on_edge, on_edge);
    x = on_edge;
    share = {};
    share[k] = 1 - of_next;
    share[next] = of_next;
  }
  nearest.distance = std::sqrt(dot(x, x));
  nearest.way = nearest.distance > kNoLength ? Vector3f(x * (1 / nearest.distance)) : unit(n);
  return nearest;
}

void ShellGrowth::locate(const Nearest& nearest, ShellDepth& found) const {
  const std::array<float, 3>& share = nearest.share;
  Vector3f sum = Vector3f::Zero();
  for (size_t k = 0; k < 3; ++k) {
    sum += hulls_.a.corner(shell_.of_a[shell_.corner_of(nearest.triangle, k)]) * share[k];
  }
  found.depth = nearest.distance;
  found.normal = nearest.way;
  found.on_a = sum * (1 / ((share[0] + share[1]) + share[2]));
}

// Where zero may be outside: the normal of the triangle that it is furthest in front of.
Vector3f ShellGrowth::way_out() const {
  float least = kLargest;
  Vector3f way = Vector3f::UnitX();
  for (size_t t = 0; t < shell_.triangle_count; ++t) {
    const Vector3f n = space_.normal_at(t);
    const float length = std::sqrt(dot(n, n)), height = space_.volume[t] / length;
    if (!(length > 0 && height < least)) continue;
    least = height;
    way = n * (1 / length);
  }
  return way;
}

// Puts a cone from the new corner in the place of the triangles that it is in front of. What is
// left of the surface is closed together with the cone.
bool ShellGrowth::grow(const Support& support) {
  Cut cut_out;
  if (!cut(hulls_.steps.in_front(shell_, space_, support.point), cut_out)) return false;
  FewOf<std::array<uint8_t, 2>, Shell::kMostTriangles> rim;
  uint32_t from_rim = 0;  // a bit for each corner of it
  for (uint32_t left = cut_out.corners; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    for (uint32_t ends = cut_out.edges[i]; ends != 0; ends &= ends - 1) {
      const auto j = static_cast<size_t>(std::countr_zero(ends));
      if (cut_out.edges[j] >> i & 1) continue;
      // A rim that meets itself would make a surface that does, and cannot grow there any more.
      if (rim.is_full() || (from_rim >> i & 1) != 0) return false;
      rim.push_back({static_cast<uint8_t>(i), static_cast<uint8_t>(j)});
      from_rim |= uint32_t{1} << i;
    }
  }
  const uint32_t used = shell_.corners & ~gone(cut_out, from_rim);
  const size_t corner = place_of(support, used);
  const size_t kept = shell_.triangle_count - static_cast<size_t>(std::popcount(cut_out.triangles));
  if (corner >= Shell::kMostCorners || kept + rim.size() > Shell::kMostTriangles) return false;
  if (static_cast<size_t>(std::popcount(used)) >= shell_.most_corners) return false;
  shell_.corners = used;
  put_corner(support, corner);

  // The cone takes the places of the triangles removed, and then places at the end.
  uint64_t free = cut_out.triangles;
  for (const auto& [from, to] : rim) {
    if (from == corner || to == corner) continue;
    size_t place = shell_.triangle_count;
    if (free != 0) {
      place = static_cast<size_t>(std::countr_zero(free));
      free &= free - 1;
    } else {
      if (place % Shell::kGroup == 0) shell_.corner[place / Shell::kGroup] = {};
      ++shell_.triangle_count;
    }
    put_triangle(place, from, to, corner);
  }
  // Places that are left over are filled from the end.
  while (free != 0) {
    const auto place = static_cast<size_t>(std::bit_width(free)) - 1;
    free ^= uint64_t{1} << place;
    const size_t last = --shell_.triangle_count;
    put_triangle(place, shell_.corner_of(last, 0), shell_.corner_of(last, 1),
                 shell_.corner_of(last, 2));
  }
  return true;
}

// False if there is nothing to cut, or if the surface has an edge twice there: a bit would not do.
bool ShellGrowth::cut(uint64_t triangles, Cut& cut) const {
  cut.triangles = triangles;
  for (uint64_t left = triangles; left != 0; left &= left - 1) {
    const auto t = static_cast<size_t>(std::countr_zero(left));
    for (size_t k = 0; k < 3; ++k) {
      const size_t from = shell_.corner_of(t, k);
      const uint32_t to = uint32_t{1} << shell_.corner_of(t, (k + 1) % 3);
      if (cut.edges[from] & to) return false;
      cut.edges[from] |= to;
      cut.corners |= uint32_t{1} << from;
    }
  }
  return triangles != 0;
}

// The corners that are in no triangle any more. One that is not on the rim may still be in some:
// where the surface meets itself in that corner alone.
uint32_t ShellGrowth::gone(const Cut& cut, uint32_t rim) const {
  uint32_t gone = cut.corners & ~rim;
  for (size_t t = 0; gone != 0 && t < shell_.triangle_count; ++t) {
    if (cut.triangles >> t & 1) continue;
    for (size_t k = 0; k < 3; ++k) gone &= ~(uint32_t{1} << shell_.corner_of(t, k));
  }
  return gone;
}

// The place of this corner, or the first that is not in use.
size_t ShellGrowth::place_of(const Support& support, uint32_t used) const {
  for (uint32_t left = used; left != 0; left &= left - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(left));
    if (shell_.of_a[i] == support.of_a && shell_.of_b[i] == support.of_b) return i;
  }
  return static_cast<size_t>(std::countr_one(used));
}

void ShellGrowth::put_corner(const Support& support, size_t place) {
  shell_.corners |= uint32_t{1} << place;
  shell_.of_a[place] = static_cast<uint8_t>(support.of_a);
  shell_.of_b[place] = static_cast<uint8_t>(support.of_b);
  for (size_t axis = 0; axis < 3; ++axis) {
    space_.corner[axis][place] = support.point[static_cast<int>(axis)];
  }
}

void ShellGrowth::put_triangle(size_t place, size_t i, size_t j, size_t k) {
  auto& group = shell_.corner[place / Shell::kGroup];
  const size_t number = place % Shell::kGroup;
  group[0][number] = static_cast<uint8_t>(i);
  group[1][number] = static_cast<uint8_t>(j);
  group[2][number] = static_cast<uint8_t>(k);
}

}  // namespace carom
