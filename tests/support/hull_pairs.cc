#include "tests/support/hull_pairs.h"

namespace carom::test {

Points bipyramid(size_t sides) {
  Points points = prism(sides, 1, 0);
  points.emplace_back(0, 0, 0.75f);
  points.emplace_back(0, 0, -0.5f);
  return points;
}

Points repeated(const Points& points, size_t times) {
  Points all;
  for (size_t i = 0; i < times; ++i) all.insert(all.end(), points.begin(), points.end());
  return all;
}

Hull fine_prism(size_t sides) {
  const Points points = prism(sides, 1, 0.5f);
  std::vector<std::vector<uint32_t>> faces(2);
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t low = 2 * i, next = 2 * ((i + 1) % static_cast<uint32_t>(sides));
    faces[0].push_back(low + 1);
    faces[1].insert(faces[1].begin(), low);
    faces.push_back({low, next, next + 1, low + 1});
  }
  return {*make_hull(points, faces)};
}

Hull cube_with_corners_on_edges() {
  Points points = cube_corners();
  std::vector<std::vector<uint32_t>> faces;
  const auto index_of = [&](const Eigen::Vector3f& p) {
    const auto found = std::find(points.begin(), points.end(), p);
    if (found == points.end()) return points.push_back(p), static_cast<uint32_t>(points.size() - 1);
    return static_cast<uint32_t>(found - points.begin());
  };
  constexpr int kAround[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0},
                                 {1, 1},   {0, 1},  {-1, 1}, {-1, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      std::vector<uint32_t>& face = faces.emplace_back();
      for (const auto& at : kAround) {
        Eigen::Vector3f p = side * Eigen::Vector3f::Unit(axis);
        p[(axis + 1) % 3] = side * static_cast<float>(at[0]);
        p[(axis + 2) % 3] = static_cast<float>(at[1]);
        face.push_back(index_of(p));
      }
    }
  }
  return {*make_hull(points, faces)};
}

std::vector<Hull> solid_hulls() {
  Random random(1);
  std::vector<Hull> all = {oracle::hull_of(cube_corners()), cube_with_corners_on_edges(),
                           fine_prism(40)};
  for (size_t sides = 3; sides <= 12; ++sides) {
    const Points points = prism(sides, 1, 0.5f);
    all.push_back(oracle::hull_of(points));
    all.push_back(oracle::hull_of(bipyramid(sides)));
    if (sides % 2 == 0) all.push_back(oracle::hull_of(repeated(points, 2)));
  }
  for (const size_t count : {4, 6, 8, 13, 40}) {
    all.push_back(oracle::hull_of(round_points(count, {1, 1, 1}, random)));
  }
  return all;
}

std::vector<Hull> hulls_of_unknown_faces() {
  Random random(2);
  std::vector<Hull> all = {oracle::hull_of({{0, 0, 0}}), oracle::hull_of({{-1, 0, 0}, {1, 0, 0}}),
                           oracle::hull_of({{-1, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}})};
  for (const size_t sides : {3, 4, 6, 8, 9, 12}) {
    all.push_back(oracle::hull_of(prism(sides, 1, 0)));
  }
  all.push_back(oracle::hull_of(repeated(round_points(12, {1, 1, 1}, random), 11)));
  all.push_back(fine_prism(kMostLanePoints / 2 + 1));
  return all;
}

TestPair HullPairMaker::next() {
  const bool hull_is_b = kinds_.b == ShapeKind::hull;
  const double size = random_.log_uniform(1e-20, 1e15);
  const double ratio =
      random_.chance(0.2) ? random_.log_uniform(1e-3, 1e3) : random_.log_uniform(0.5, 2);
  PlacedShape one = {shape(hull_is_b ? kinds_.a : kinds_.b, size), {0, 0, 0}};
  PlacedShape hull = {shape(ShapeKind::hull, size * ratio), {0, 0, 0}};
  place(one, hull, size * std::min(ratio, 1.0));
  return hull_is_b ? TestPair{one, hull} : TestPair{hull, one};
}

Shape HullPairMaker::shape(ShapeKind kind, double size) {
  const auto side = [&] { return static_cast<float>(size * random_.uniform(0.4, 1)); };
  const float x = side(), y = side(), z = side();
  const Eigen::Vector3f half(x, y, z);
  if (kind == ShapeKind::box) return Box{half};
  if (kind == ShapeKind::aabb) return Aabb{-half, Eigen::Vector3f(half * 0.75f)};
  if (kind == ShapeKind::triangle) return triangle(static_cast<float>(size));
  static const std::vector<Hull> known = solid_hulls(), unknown = hulls_of_unknown_faces();
  const auto& some = random_.chance(0.85) ? known : unknown;
  return with_points(some[random_.below(some.size())],
                     [&](Eigen::Vector3f& p) { p = p.cwiseProduct(half); });
}

Triangle HullPairMaker::triangle(float size) {
  Triangle result;
  for (Eigen::Vector3f& corner : result.corners) {
    corner = random_.direction().cast<float>() * size;
  }
  if (random_.chance(0.6)) return result;
  result.one_sided = random_.chance(0.5);
  result.inner_edges = static_cast<uint8_t>(random_.below(8));
  if (random_.chance(0.3)) result.thickness = 0.1f * size;
  return result;
}

Eigen::Vector3d HullPairMaker::any_normal(const Shape& shape) {
  const double sign = random_.chance(0.5) ? 1 : -1;
  if (const auto* triangle = std::get_if<Triangle>(&shape)) {
    const auto& [a, b, c] = triangle->corners;
    const Eigen::Vector3d u = (b - a).cast<double>(), v = (c - a).cast<double>();
    return sign * u.stableNormalized().cross(v.stableNormalized()).normalized();
  }
  const auto* hull = std::get_if<Hull>(&shape);
  if (!hull) return sign * Eigen::Vector3d::Unit(static_cast<int>(random_.below(3)));
  const HullGeometry& geometry = *hull->geometry;
  if (!geometry.features()) return sign * Eigen::Vector3d::UnitZ();
  const auto faces = geometry.faces();
  const auto has_fewer = [](const auto& x, const auto& y) { return x.count < y.count; };
  const auto most = std::max_element(faces.begin(), faces.end(), has_fewer) - faces.begin();
  const size_t face = random_.chance(0.5) ? static_cast<size_t>(most) : random_.below(faces.size());
  return geometry.features()->normal(face).cast<double>();
}

std::vector<Eigen::Vector3d> HullPairMaker::corners_of(const PlacedShape& body) {
  Points points;
  if (const auto* hull = std::get_if<Hull>(&body.shape)) points = points_of(*hull);
  if (const auto* box = std::get_if<Box>(&body.shape)) points = box_corners(box->half);
  if (const auto* box = std::get_if<Aabb>(&body.shape)) points = {box->lower, box->upper};
  if (const auto* triangle = std::get_if<Triangle>(&body.shape)) {
    points = {triangle->corners.begin(), triangle->corners.end()};
  }
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3f& p : points) {
    corners.push_back(body.orientation.cast<double>() * p.cast<double>());
  }
  return corners;
}

double HullPairMaker::reach(const PlacedShape& body, const Eigen::Vector3d& way) {
  // Two corners are not enough for an aabb.
  if (const auto* box = std::get_if<Aabb>(&body.shape)) {
    return box->lower.cast<double>()
        .cwiseProduct(way)
        .cwiseMax(box->upper.cast<double>().cwiseProduct(way))
        .sum();
  }
  double most = -HUGE_VAL;
  for (const Eigen::Vector3d& p : corners_of(body)) most = std::max(most, way.dot(p));
  return most;
}

Eigen::Vector3d HullPairMaker::middle(const PlacedShape& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> corners = corners_of(body);
  for (const Eigen::Vector3d& p : corners) sum += p;
  return sum / static_cast<double>(corners.size());
}

namespace {

// The shortest turn from one unit vector to another (half angles). Opposite ones have many.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double w = 1 + from.dot(to);
  if (w < 1e-12) return Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI, from.unitOrthogonal()));
  const Eigen::Vector3d v = from.cross(to);
  return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized();
}

}  // namespace

Eigen::Quaterniond HullPairMaker::any_rotation() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(random_.uniform(0, 3), random_.direction()));
}

void HullPairMaker::place(PlacedShape& one, PlacedShape& hull, double size) {
  Eigen::Quaterniond turn_one = Eigen::Quaterniond::Identity(), turn_hull = any_rotation();
  if (kind_of(one.shape) != ShapeKind::aabb && random_.chance(0.7)) turn_one = any_rotation();
  Eigen::Vector3d n = turn_one * any_normal(one.shape);
  if (random_.chance(0.75)) {
    turn_hull = Eigen::AngleAxisd(tilt(), random_.direction()) *
                Eigen::AngleAxisd(random_.chance(0.3) ? 0 : random_.uniform(0, 6), n) *
                turn_between(any_normal(hull.shape), -n);
  } else {
    n = random_.direction();
    if (random_.chance(0.5)) turn_hull = turn_one = Eigen::Quaterniond::Identity();
  }
  one.orientation = turn_one.cast<float>();
  hull.orientation = turn_hull.cast<float>();
  const double gap = random_.log_uniform(1e-7, 0.5) * (random_.chance(0.3) ? 1 : -1);
  const Eigen::Vector3d beside = n.cross(random_.direction()) * random_.uniform(0, 0.6) * size;
  const double far = positions_ == PositionType::float64 ? random_.log_uniform(1, 1e7) : 2;
  one.position = stored(random_.direction() * (far * size), positions_);
  const Eigen::Vector3d shift = middle(one) - middle(hull) + beside;
  const double along = reach(one, n) + reach(hull, -n) + gap * size - n.dot(shift);
  hull.position = stored(one.position + n * along + shift, positions_);
}

std::vector<TestPair> make_hull_pairs(KindPair kinds, PositionType positions, size_t count,
                                      uint64_t seed) {
  HullPairMaker maker(kinds, positions, seed);
  std::vector<TestPair> pairs;
  for (size_t i = 0; i < count; ++i) pairs.push_back(maker.next());
  return pairs;
}

}  // namespace carom::test
