// Reads any bytes as two clouds of points. build_hull() must end and keep its promises. For the
// hulls in any poses all kernels must agree with the reference, and independent projections must
// confirm its results.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "fuzz/check_pair.h"
#include "fuzz/points_input.h"
#include "tests/support/hull_checks.h"
#include "tests/support/kind_checks.h"

namespace {

using namespace carom;
using namespace carom::fuzz;

using Eigen::Vector3d;

enum Flag : uint8_t {
  kFloat64 = 1,
  kSameHull = 2,
  kSameTurn = 4,
  kTouching = 8,
  kFar = 16,
  kNear = 32
};

// The most corners for the oracle, which tries every three corners and every two edges.
constexpr size_t kMostJudged = 20;

// 1 to 64 points; small counts are more frequent.
size_t take_count(Data& data) {
  const auto byte = take<uint8_t>(data);
  return 1 + byte * byte / 1024u;
}

// As a share of the extents: a face contains points that are in its plane up to the rounding of the
// coordinates.
double face_tolerance(const hulls::Points& points) {
  double largest = 0;
  for (const Eigen::Vector3f& p : points)
    largest = std::max<double>(largest, p.cwiseAbs().maxCoeff());
  return 1e-5 + 0x1p-19 * largest / hulls::extents(points).maxCoeff();
}

void check_hull(const hulls::Points& points, const BuiltHull& hull) {
  hulls::expect_subset(points, hull);
  std::mt19937_64 random(points.size());
  hulls::expect_same_support(points, hull, random);
  hulls::expect_faces_outside(points, hull, face_tolerance(points));
  if (hull.geometry->points().size() <= kMostJudged) hulls::expect_inside(points, hull);
}

std::optional<Hull> take_hull(Data& data) {
  const size_t count = take_count(data);
  const double size = take_size(data);
  const hulls::Points points = CloudReader(size, data).points(count);
  const auto hull = build_hull(points);
  const auto is_finite = [](const Eigen::Vector3f& p) { return p.allFinite(); };
  EXPECT_EQ(bool(hull), std::all_of(points.begin(), points.end(), is_finite));
  if (!hull) return std::nullopt;
  check_hull(points, *hull);
  return Hull{hull->geometry};
}

using Number = long double;
using Cloud = oracle::ConvexShape<Number>;

// The placed points without faces, which suffices for projections.
Cloud placed_points(const test::PlacedShape& body, PositionType positions) {
  const oracle::Rotation<Number> turn(body.orientation);
  Cloud cloud(oracle::Vec3<Number>{});
  cloud.points.clear();
  for (const Eigen::Vector3f& p : std::get<Hull>(body.shape).geometry->points()) {
    cloud.points.push_back(turn(oracle::vec3_as<Number>(p)));
  }
  cloud.translate(oracle::vec3_as<Number>(test::stored(body.position, positions)));
  return cloud;
}

Vector3d middle_of(const test::PlacedShape& body) {
  return body.orientation.cast<double>().normalized() *
         std::get<Hull>(body.shape).geometry->middle();
}

double reach_of(const Hull& hull) {
  double reach = 0;
  for (const Eigen::Vector3f& p : hull.geometry->points()) {
    reach = std::max(reach, (p.cast<double>() - hull.geometry->middle()).norm());
  }
  return reach;
}

// Puts B beside A; with kTouching moves B back along the same direction until the two touch.
void place(TestPair& pair, uint8_t flags, Data& data) {
  const Hull &a = std::get<Hull>(pair.a.shape), &b = std::get<Hull>(pair.b.shape);
  const double reach = reach_of(a) + reach_of(b);
  if (flags & kFar) pair.a.position = take_vector(data) * 1000 * reach;
  const int nearness = flags & kNear ? take<uint8_t>(data) % 32 : 0;
  const Vector3d way = take_vector(data) * std::ldexp(reach, -nearness);
  pair.b.position = pair.a.position + middle_of(pair.a) - middle_of(pair.b) + way;
  if (!(flags & kTouching) || !(way.norm() > 0)) return;
  const Vector3d unit = way.normalized();
  const auto gap = oracle::gap_along(placed_points(pair.a, PositionType::float64),
                                     placed_points(pair.b, PositionType::float64),
                                     oracle::vec3_as<Number>(unit));
  pair.b.position -= unit * static_cast<double>(gap);
}

TestPair take_pair(const Hull& a, const Hull& b, uint8_t flags, Data& data) {
  TestPair pair{{a}, {b}};
  pair.a.orientation = take_orientation(data);
  pair.b.orientation = flags & kSameTurn ? pair.a.orientation : take_orientation(data);
  place(pair, flags, data);
  return pair;
}

// The gap along the normal must equal the separation. As no direction has a larger gap than the
// true separation, the reported overlap is not too deep and the reported distance not too large.
void check_projections(const TestPair& pair, PositionType positions,
                       const reference::PairResult& result) {
  const auto normal = oracle::vec3_as<Number>(result.normal);
  const Number gap =
      oracle::gap_along(placed_points(pair.a, positions), placed_points(pair.b, positions), normal);
  const Number size = test::bounding_radius(pair.a.shape) + test::bounding_radius(pair.b.shape);
  EXPECT_NEAR(gap, result.separation, 1e-5L * (size + std::fabs(gap)) + 0x1p-140L);
}

// Only pairs within the range of floats have all the promises.
bool is_in_range(const TestPair& pair) {
  const double size = test::bounding_radius(pair.a.shape) + test::bounding_radius(pair.b.shape);
  return size + pair.a.position.norm() + pair.b.position.norm() < 1e37;
}

// A zero quaternion is not an orientation.
bool is_turned(const test::PlacedShape& body) { return body.orientation.norm() > 0; }

size_t corner_count(const test::PlacedShape& body) {
  return std::get<Hull>(body.shape).geometry->points().size();
}

// Separations may be off by 2^-18 of the greatest input number (docs/accuracy.md), which is 2e-6 of
// the size of two such bodies.
test::ExactKinds exact_pair(const TestPair& pair, PositionType positions) {
  test::ExactKinds exact(pair, positions);
  exact.scale = exact.oracle.a.bounding_radius + exact.oracle.b.bounding_radius;
  return exact;
}

void check_pair(const TestPair& pair, PositionType positions) {
  SCOPED_TRACE(test::show(pair) + "\n" + test::name(positions));
  const reference::PairResult result = test::reference_result(pair, positions);
  expect_everywhere(pair, positions, result);
  if (!is_in_range(pair) || !is_turned(pair.a) || !is_turned(pair.b)) return;
  EXPECT_NE(result.status, Status::invalid);
  expect_numbers(pair, result);
  check_projections(pair, positions, result);
  if (std::max(corner_count(pair.a), corner_count(pair.b)) > kMostJudged) return;
  test::check_result(exact_pair(pair, positions), result);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  Data data(bytes, size);
  const auto flags = take<uint8_t>(data);
  const std::optional<Hull> a = take_hull(data);
  const std::optional<Hull> b = flags & kSameHull ? a : take_hull(data);
  if (a && b) {
    check_pair(take_pair(*a, *b, flags, data),
               flags & kFloat64 ? PositionType::float64 : PositionType::float32);
  }
  abort_on_failure();
  return 0;
}
