// Fills the columns of the kernel as gather_linear() does, without a view of bodies between.
#include "impacts/rays/point_times.h"

#include <array>
#include <memory>
#include <tuple>

namespace carom {

struct PointTimes::Scratch {
  LinearRows rows;
  std::array<LeftTriangle, LinearRows::kMost> candidates;
  size_t count;
  std::vector<LeftTriangle> left;

  RayColumns rays;
  std::array<Point, RayColumns::kMost> points;
  size_t ray_count, cut_count;  // the first cut_count have been cut
  std::array<RaySearch, RayColumns::kMost> searches;
  size_t search_count;
};

namespace {

constexpr size_t kFirstOfTriangle = LinearRows::kPairColumns + number_count(LinearKind::sphere);
constexpr size_t kColumns = kFirstOfTriangle + number_count(LinearKind::triangle);

bool is_valid_point(const MovingReader& side, size_t i) {
  return side.body().kind(i) == ShapeKind::sphere && side.body().radius(i) == 0 && !side.turns(i) &&
         is_finite(side.body().position<double>(i)) && is_finite(side.displacement(i));
}

}  // namespace

PointTimes::Scratch& PointTimes::scratch_of_thread() {
  static thread_local const auto scratch = std::make_unique_for_overwrite<Scratch>();
  return *scratch;
}

PointTimes::PointTimes(const MovingSide& a, const MovingSide& b, bool any,
                       std::span<FirstTime> times)
    : a_{a}, b_{b}, any_(any), times_(times), scratch_(scratch_of_thread()) {
  scratch_.count = scratch_.ray_count = scratch_.cut_count = scratch_.search_count = 0;
  scratch_.left.clear();
}

bool PointTimes::take_mesh(bool is_a, uint32_t body) {
  if (mesh_is_a_ == is_a && mesh_body_ == body) return mesh_serves_;
  cut();
  const MovingReader& side = is_a ? a_ : b_;
  mesh_is_a_ = is_a;
  mesh_body_ = body;
  mesh_serves_ = false;
  if (side.turns(body) || !side.is_valid(body)) return false;
  const MeshGeometry& mesh = *geometry_at<MeshGeometry>(side.body().row(body, 0));
  const MeshRules& rules = mesh.rules();
  mesh_serves_ = rules.thickness == 0 && !mesh.is_scaled();
  target_.emplace(mesh, side.side.one_sided.value_or(rules.one_sided));
  orientation_ = side.body().orientation(body);
  turn_ = rotation_of(orientation_);
  return mesh_serves_;
}

bool PointTimes::add(size_t owner, Pair pair, double limit) {
  const bool mesh_is_a = a_.body().kind(pair.a) == ShapeKind::mesh;
  const auto [mesh, point] = mesh_is_a ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
  const MovingReader &of_mesh = mesh_is_a ? a_ : b_, &of_point = mesh_is_a ? b_ : a_;
  if (of_mesh.body().kind(mesh) != ShapeKind::mesh || !is_valid_point(of_point, point))
    return false;
  if (!take_mesh(mesh_is_a, mesh)) return false;
  const Double3 from = place_between(of_point, of_mesh, {point, mesh});
  const Double3 way = way_between(of_point, of_mesh, {point, mesh});
  if (!is_in_range(*target_, from, way)) return false;
  if (target_->mesh->tree().is_empty()) return true;
  if (scratch_.ray_count == RayColumns::kMost) search();
  const size_t row = scratch_.ray_count++;
  for (size_t axis = 0; axis < 3; ++axis) {
    scratch_.rays.from[axis][row] = from[axis];
    scratch_.rays.way[axis][row] = way[axis];
  }
  scratch_.rays.limit[row] = limit;
  scratch_.points[row] = {owner, pair, orientation_};
  return true;
}

void PointTimes::cut() {
  if (scratch_.cut_count == scratch_.ray_count) return;
  scratch_.search_count +=
      cut_rays(*target_, turn_, scratch_.rays, scratch_.cut_count, scratch_.ray_count,
               scratch_.searches.data() + scratch_.search_count);
  scratch_.cut_count = scratch_.ray_count;
}

void PointTimes::search() {
  cut();
  const auto searches = std::span(scratch_.searches).first(scratch_.search_count);
  find_candidates(searches, any_);
  for (const RaySearch& search : searches) {
    if (any_ && search.is_sure) {
      times_[scratch_.points[search.row].owner] = {search.limit, Status::ok};
      continue;
    }
    for (const RayCandidate& candidate : search.candidates) add_row(search, candidate.triangle);
  }
  scratch_.ray_count = scratch_.cut_count = scratch_.search_count = 0;
}

void PointTimes::add_row(const RaySearch& search, uint32_t triangle) {
  if (scratch_.count == LinearRows::kMost) test_rows();
  const Point& point = scratch_.points[search.row];
  const size_t row = scratch_.count++;
  scratch_.candidates[row] = {point.owner, point.pair, triangle};
  double* next = scratch_.rows.column(0) + row;
  const auto put = [&next](double value) {
    *next = value;
    next += LinearRows::kStride;
  };
  const RayColumns& rays = scratch_.rays;
  for (const auto& column : rays.from)
    put(column[search.row] + 0.0);  // so that no zero is negative
  for (const auto& column : rays.way) put(column[search.row]);
  put(0);  // the radius
  for (size_t i = 0; i < 3; ++i) {
    for (const double x : corner(*search.ray.mesh, triangle, i)) put(x);
  }
  for (const float x : point.orientation) put(x);
}

const std::vector<LeftTriangle>& PointTimes::finish() {
  search();
  test_rows();
  return scratch_.left;
}

void PointTimes::test_rows() {
  if (scratch_.count == 0) return;
  scratch_.rows.pad(kColumns, scratch_.count);
  linear_kernel(LinearKind::sphere, LinearKind::triangle)(scratch_.rows, scratch_.count);
  for (size_t row = 0; row < scratch_.count; ++row) {
    const LeftTriangle& candidate = scratch_.candidates[row];
    const double time = scratch_.rows.times()[row];
    if (time == kNoClosedForm) {
      scratch_.left.push_back(candidate);
      continue;
    }
    FirstTime& first = times_[candidate.owner];
    const bool mesh_is_a = a_.body().kind(candidate.pair.a) == ShapeKind::mesh;
    uint64_t& part = first.parts[mesh_is_a ? 0 : 1];
    // Among equal times the lowest triangle wins, whatever the order of the search.
    if (std::tie(time, candidate.triangle) < std::tie(first.time, part) && !passes(row, time)) {
      first.time = time;
      part = candidate.triangle;
    }
  }
  scratch_.count = 0;
}

// Whether the point comes from behind a one-sided triangle.
bool PointTimes::passes(size_t row, double time) const {
  const LeftTriangle& candidate = scratch_.candidates[row];
  const bool mesh_is_a = a_.body().kind(candidate.pair.a) == ShapeKind::mesh;
  const MovingReader& of_mesh = mesh_is_a ? a_ : b_;
  const size_t body = mesh_is_a ? candidate.pair.a : candidate.pair.b;
  const MeshGeometry& mesh = *geometry_at<MeshGeometry>(of_mesh.body().row(body, 0));
  if (!(time <= 1) || !of_mesh.side.one_sided.value_or(mesh.rules().one_sided)) return false;
  const double* next = scratch_.rows.column(0) + row;
  const auto take3 = [&next]() -> Eigen::Vector3d {
    const Eigen::Vector3d v = {next[0], next[LinearRows::kStride], next[2 * LinearRows::kStride]};
    next += 3 * LinearRows::kStride;
    return v;
  };
  const Eigen::Vector3d from = take3(), way = take3();
  next += LinearRows::kStride;  // the radius
  Triangle triangle;
  triangle.one_sided = true;
  for (Eigen::Vector3f& x : triangle.corners) x = take3().cast<float>();
  const Shape of_point = Sphere{0}, of_triangle = triangle;
  const scalar::Quaternion<double> turned = of_mesh.orientation(body), straight{{0, 0, 0}, 1};
  return scalar::passes_one_sided({of_point, straight, {0, 0, 0}, {0, 0, 0}},
                                  {of_triangle, turned, {0, 0, 0}, {0, 0, 0}}, from, way, time);
}

}  // namespace carom
