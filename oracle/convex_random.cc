#include "oracle/convex_random.h"

namespace carom::oracle {

Shape ConvexRandom::shape(ShapeKind kind, double size) {
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{static_cast<float>(style_.degenerate && random_.chance(0.5) ? 0
                                       : style_.lattice ? size * integer(1, 5) / 2
                                                        : size)};
    case ShapeKind::capsule:
      return capsule(size);
    case ShapeKind::aabb:
      return aabb(size);
    case ShapeKind::box:
      return Box{half(size)};
    case ShapeKind::triangle:
      return triangle(size);
    case ShapeKind::dop:
      return dop(size);
    case ShapeKind::hull:
      return hull(size);
    case ShapeKind::cylinder:
      return Cylinder{length(size), length(size)};
    case ShapeKind::cone:
      return Cone{length(size), length(size)};
    case ShapeKind::ellipsoid:
      return Ellipsoid{half(size)};
    case ShapeKind::rounded_box:
      return Box{half(size), rounding(size)};
    case ShapeKind::rounded_hull: {
      Hull rounded = hull(size);
      rounded.rounding = rounding(std::min(size, FLT_MAX / 4.0));
      return rounded;
    }
    default:
      return halfspace(size);
  }
}

Eigen::Quaternionf ConvexRandom::orientation() {
  const double u = random_.uniform(0, 1);
  const double s = random_.uniform(0, 2 * std::numbers::pi);
  const double t = random_.uniform(0, 2 * std::numbers::pi);
  const double size = random_.chance(0.2) ? random_.log_uniform(0.1, 10) : 1;
  const double a = size * std::sqrt(1 - u);
  const double b = size * std::sqrt(u);
  return Eigen::Quaterniond(b * std::cos(t), a * std::sin(s), a * std::cos(s), b * std::sin(t))
      .cast<float>();
}

Eigen::Quaternionf ConvexRandom::quarter_turns() {
  Eigen::Quaternionf q = Eigen::Quaternionf::Identity();
  const int turns = integer(0, 3);
  for (int i = 0; i < turns; ++i) {
    Eigen::Quaternionf quarter(1, 0, 0, 0);
    quarter.coeffs()[integer(0, 2)] = 1;
    q = q * quarter;
  }
  const float largest = q.coeffs().cwiseAbs().maxCoeff();
  q.coeffs() /= largest;
  return q;
}

int ConvexRandom::integer(int low, int high) {
  return low + static_cast<int>(random_.below(static_cast<uint64_t>(high - low + 1)));
}

double ConvexRandom::extent(double size) {
  if (style_.degenerate && random_.chance(0.4)) return 0;
  if (style_.lattice) return size * integer(0, 2);
  return size * random_.log_uniform(1 / style_.aspect, 1);
}

float ConvexRandom::rounding(double size) {
  const float some = length(size);
  if (some > 0) return some;
  const double small = size * (style_.lattice ? 0.5 : random_.log_uniform(1e-7, 1e-2));
  return std::max(static_cast<float>(small), FLT_TRUE_MIN);
}

Eigen::Vector3d ConvexRandom::extents(double size) {
  Eigen::Vector3d all;
  for (double& x : all) x = extent(size);
  return all;
}

Eigen::Vector3d ConvexRandom::shift(double size) {
  if (random_.chance(0.5)) return Eigen::Vector3d::Zero();
  return style_.lattice ? lattice_point(size, 1).eval() : vector(size);
}

Eigen::Vector3d ConvexRandom::vector(double size) {
  Eigen::Vector3d all;
  for (double& x : all) x = random_.uniform(-size, size);
  return all;
}

Eigen::Vector3d ConvexRandom::lattice_point(double size, int largest) {
  Eigen::Vector3d all;
  for (double& x : all) x = size * integer(-largest, largest);
  return all;
}

Eigen::Vector3d ConvexRandom::direction() {
  if (!style_.lattice && !(style_.aligned && random_.chance(0.7))) return random_.direction();
  return Eigen::Vector3d::Unit(integer(0, 2));
}

Capsule ConvexRandom::capsule(double size) {
  const Eigen::Vector3d middle = shift(size);
  const double half = extent(size);
  const Eigen::Vector3d along = direction() * half;
  Capsule capsule;
  capsule.a = (middle - along).cast<float>();
  capsule.b = (middle + along).cast<float>();
  capsule.radius = static_cast<float>(extent(size));
  return capsule;
}

Aabb ConvexRandom::aabb(double size) {
  const Eigen::Vector3d middle = shift(size);
  const Eigen::Vector3d reach = half(size).cast<double>();
  return {(middle - reach).cast<float>(), (middle + reach).cast<float>()};
}

Triangle ConvexRandom::triangle(double size) {
  const Eigen::Vector3d middle = shift(size);
  const Eigen::Vector3d scale = extents(size);
  const int flat = style_.aligned && random_.chance(0.7) ? integer(0, 2) : -1;
  Triangle triangle;
  for (Eigen::Vector3f& corner : triangle.corners) {
    Eigen::Vector3d p = middle;
    p += style_.lattice ? lattice_point(size, 2).eval() : vector(1).cwiseProduct(scale).eval();
    if (flat >= 0) p[flat] = middle[flat];
    corner = p.cast<float>();
  }
  if (flat >= 0) {  // one edge along an axis
    triangle.corners[1][(flat + 1) % 3] = triangle.corners[0][(flat + 1) % 3];
  }
  if (style_.degenerate && random_.chance(0.7)) spoil(triangle, size);
  if (!style_.degenerate && random_.chance(0.3)) {
    triangle.thickness = static_cast<float>(style_.lattice ? size * integer(0, 2)
                                                           : size * random_.log_uniform(0.01, 1));
  }
  return triangle;
}

void ConvexRandom::spoil(Triangle& triangle, double size) {
  auto& [a, b, c] = triangle.corners;
  const int kind = integer(0, 4);
  if (kind == 0) b = c = a;
  if (kind == 1) c = random_.chance(0.5) ? a : b;
  if (kind == 2) b = (a + c) / 2;  // collinear except for rounding
  if (kind >= 3) {
    const double width = size * random_.log_uniform(1e-7, 1e-2);
    const Eigen::Vector3d on_edge =
        a.cast<double>() + (b - a).cast<double>() * random_.uniform(-0.2, 1.2);
    c = (on_edge + random_.direction() * width).cast<float>();
  }
  std::swap(triangle.corners[0], triangle.corners[static_cast<size_t>(integer(0, 2))]);
}

Dop ConvexRandom::dop(double size) {
  // Mostly kinds with few planes: the oracle is slow for many.
  constexpr DopKind kKinds[] = {DopKind::k6,  DopKind::k6,  DopKind::k6,  DopKind::k14,
                                DopKind::k14, DopKind::k14, DopKind::k18, DopKind::k26};
  const Eigen::Vector3d middle = shift(size);
  const Eigen::Vector3d scale = extents(size);
  const bool is_box = style_.aligned || random_.chance(0.2);
  const int count = is_box ? 8 : style_.degenerate ? integer(1, 4) : integer(4, 12);
  std::vector<Eigen::Vector3f> points;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p = style_.lattice ? lattice_point(size, 2) : vector(1).cwiseProduct(scale);
    if (is_box)
      p = Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(scale);
    points.push_back((middle + p).cast<float>());
    mean += points.back().cast<double>() / count;
  }
  Dop dop = Dop::of_points(points, kKinds[integer(0, 7)]);
  if (!style_.lattice && !style_.degenerate && random_.chance(0.3)) narrow(dop, mean);
  return dop;
}

void ConvexRandom::narrow(Dop& dop, const Eigen::Vector3d& point) {
  const auto directions = slab_directions(dop.kind);
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto& d = directions[i];
    const double height = Eigen::Vector3d(d[0], d[1], d[2]).dot(point);
    for (float* end : {&dop.lower[i], &dop.upper[i]}) {
      if (random_.chance(0.3))
        *end = static_cast<float>(*end + (height - *end) * random_.uniform(0, 0.9));
    }
    if (dop.lower[i] > dop.upper[i]) std::swap(dop.lower[i], dop.upper[i]);
  }
}

Hull ConvexRandom::hull(double size) {
  size = std::min(size, FLT_MAX / 4.0);
  const Eigen::Vector3d middle = shift(size);
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& p : corners(size)) points.push_back((middle + p).cast<float>());
  if (random_.chance(0.2)) points.push_back(points[random_.below(points.size())]);
  return hull_of(points);
}

std::vector<Eigen::Vector3d> ConvexRandom::corners(double size) {
  const Eigen::Vector3d scale = extents(size);
  const bool is_box = style_.aligned ? random_.chance(0.7) : random_.chance(0.1);
  const bool is_round = random_.chance(0.5);
  const bool is_thin = style_.degenerate && random_.chance(0.3);
  const Eigen::Vector3d along = direction() * size;
  const Eigen::Vector3d aside = random_.chance(0.5) ? vector(size) : Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> all(is_box ? 8 : corner_count());
  for (size_t i = 0; i < all.size(); ++i) {
    if (is_box) {
      all[i] = Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      all[i] = all[i].cwiseProduct(scale);
    } else if (style_.lattice) {
      all[i] = lattice_point(size, 2);
    } else if (is_thin) {
      all[i] = along * random_.uniform(-0.5, 0.5) + aside * random_.uniform(-0.5, 0.5);
    } else {
      all[i] = (is_round ? random_.direction() : vector(1)).cwiseProduct(scale);
    }
  }
  return all;
}

size_t ConvexRandom::corner_count() {
  const int least = style_.degenerate ? 1 : 4;
  const bool is_large = !style_.degenerate && !style_.lattice && random_.chance(0.03);
  return static_cast<size_t>(is_large ? integer(12, 64) : integer(least, 10));
}

Halfspace ConvexRandom::halfspace(double size) {
  Halfspace halfspace;
  const double length = style_.lattice ? 1 : random_.log_uniform(0.1, 10);
  halfspace.normal = (direction() * length).cast<float>();
  if (random_.chance(0.5)) halfspace.normal = -halfspace.normal;
  const double offset = style_.lattice ? size * integer(-2, 2) : random_.uniform(-size, size);
  halfspace.offset = static_cast<float>(offset * length);
  return halfspace;
}

}  // namespace carom::oracle
