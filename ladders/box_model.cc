#include "ladders/box_model.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hulls/surface.h"

namespace carom::ladders {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector3f;

// The rounding of distances, and of the turns of children, which worlds multiply by those of their
// bodies in float32; a share of the size.
constexpr double kSlackOfBoxes = 4e-6;

// The rotation is that of the stored numbers, as worlds read them.
Quaterniond turn_of(const Orientation& orientation) {
  return orientation.cast<double>().normalized();
}

// A hull as seen from a place in its frame.
class Placing {
 public:
  Placing(const HullGeometry& hull, const hulls::Surface& surface, const Vector3f& position,
          const Orientation& orientation)
      : surface_(surface),
        position_(position.cast<double>()),
        turn_(turn_of(orientation)),
        lower_(Vector3d::Constant(std::numeric_limits<double>::infinity())),
        upper_(-lower_) {
    for (const Vector3f& p : hull.points()) {
      points_.push_back(turn_.conjugate() * (p.cast<double>() - position_));
      lower_ = lower_.cwiseMin(points_.back());
      upper_ = upper_.cwiseMax(points_.back());
    }
  }

  Vector3d half_extents() const { return (upper_ - lower_) / 2; }
  // The middle of the extents, in the frame of the hull.
  Vector3d middle() const { return position_ + turn_ * ((lower_ + upper_) / 2); }

  // Both are convex, so that the furthest point of one from the other is a corner.
  double furthest_of_hull(const Vector3f& half) const {
    double most = 0;
    for (const Vector3d& p : points_) {
      most = std::max(most, (p.cwiseAbs() - half.cast<double>()).cwiseMax(0).norm());
    }
    return most;
  }
  double furthest_of_box(const Vector3f& half) const {
    double most = 0;
    for (int i = 0; i < 8; ++i) {
      const Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      const Vector3d corner = signs.cwiseProduct(half.cast<double>());
      most = std::max(most, surface_.distance(position_ + turn_ * corner));
    }
    return most;
  }

 private:
  const hulls::Surface& surface_;
  Vector3d position_;
  Quaterniond turn_;
  std::vector<Vector3d> points_;
  Vector3d lower_, upper_;
};

// The box at this place. One that holds the hull sticks out at bevelled edges. It shrinks, by the
// same length on all sides, until the hull sticks out of it as far.
BoxModel fit(const HullGeometry& hull, const hulls::Surface& surface, const Vector3f& position,
             const Orientation& orientation) {
  constexpr int kRounds = 16;
  const Placing placing(hull, surface, position, orientation);
  const Vector3d extents = placing.half_extents();
  BoxModel best{{.position = position, .orientation = orientation},
                std::numeric_limits<double>::infinity()};
  if (!extents.cast<float>().allFinite()) return best;  // turned, they may be too large for float32
  double too_little = 0, too_much = 2 * placing.furthest_of_box(extents.cast<float>());
  for (int round = 0; round <= kRounds; ++round) {
    const double inset = round == 0 ? 0 : (too_little + too_much) / 2;
    const Vector3f half = (extents.array() - inset).max(0).matrix().cast<float>();
    const double of_hull = placing.furthest_of_hull(half), of_box = placing.furthest_of_box(half);
    const double error = std::max(of_hull, of_box) + kSlackOfBoxes * double{hull.size()};
    if (error < best.error) {
      best.box.shape = Box{half};
      best.error = error;
    }
    (of_box > of_hull ? too_little : too_much) = inset;
  }
  return best;
}

// The normal of each face, as long as its area is large (twice).
std::vector<Vector3d> areas_of(const HullGeometry& hull) {
  std::vector<Vector3d> areas;
  for (const HullGeometry::Face& face : hull.faces()) {
    const auto corners = hull.corners(face);
    const auto way_to = [&](size_t i) -> Vector3d {
      return hull.points()[corners[i]].cast<double>() - hull.points()[corners[0]].cast<double>();
    };
    Vector3d area = Vector3d::Zero();
    for (size_t i = 2; i < corners.size(); ++i) area += way_to(i - 1).cross(way_to(i));
    areas.push_back(area);
  }
  return areas;
}

Vector3d largest(const std::vector<Vector3d>& vectors) {
  return *std::max_element(
      vectors.begin(), vectors.end(),
      [](const Vector3d& a, const Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
}

// The axes along the largest face and the one that is largest as seen along that. Then, again and
// again, each axis becomes the mean of the faces around it. Faces that look along it count most, so
// that neither corners that are off nor bevels turn it.
Matrix3d axes_of_faces(const HullGeometry& hull) {
  constexpr int kRounds = 8;
  const std::vector<Vector3d> areas = areas_of(hull);
  Matrix3d axes;
  axes.col(0) = largest(areas).normalized();
  std::vector<Vector3d> across = areas;
  for (Vector3d& area : across) area -= axes.col(0).dot(area) * axes.col(0);
  axes.col(1) = largest(across).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  for (int round = 0; round < kRounds; ++round) {
    Matrix3d sums = Matrix3d::Zero();
    for (const Vector3d& area : areas) {
      if (area.isZero(0)) continue;
      const Vector3d cosine = axes.transpose() * area.normalized();
      for (int axis = 0; axis < 3; ++axis) {
        const double square = cosine[axis] * cosine[axis];
        sums.col(axis) += square * square * square * cosine[axis] * area;
      }
    }
    // The nearest rotation.
    const Eigen::JacobiSVD<Matrix3d> parts(sums.colwise().normalized(),
                                           Eigen::ComputeFullU | Eigen::ComputeFullV);
    axes = parts.matrixU() * parts.matrixV().transpose();
  }
  return axes;
}

bool is_flat(const HullGeometry& hull) { return hull.faces().size() < 4; }

}  // namespace

std::optional<BoxModel> box_of_body(const HullGeometry& hull) {
  if (is_flat(hull)) return std::nullopt;
  return fit(hull, hulls::Surface(hull), Vector3f::Zero(), Orientation::Identity());
}

std::optional<BoxModel> box_of_child(const HullGeometry& hull) {
  if (is_flat(hull)) return std::nullopt;
  const hulls::Surface surface(hull);
  std::optional<BoxModel> best;
  for (const Matrix3d& axes : {Matrix3d::Identity().eval(), axes_of_faces(hull)}) {
    const Orientation orientation(Quaterniond(axes).cast<float>());
    const Placing placing(hull, surface, Vector3f::Zero(), orientation);
    BoxModel model = fit(hull, surface, placing.middle().cast<float>(), orientation);
    if (!best || model.error < best->error) best = std::move(model);
  }
  return best;
}

BoxModel placed(const BoxModel& model, const CompoundChild& hull) {
  const Quaterniond turn = turn_of(hull.orientation);
  const Vector3d position = hull.position.cast<double>() + turn * model.box.position.cast<double>();
  const Quaterniond orientation = turn * turn_of(model.box.orientation);
  const CompoundChild box{model.box.shape, position.cast<float>(), orientation.cast<float>()};
  const Matrix3d turned_by_rounding =
      turn_of(box.orientation).toRotationMatrix() - orientation.toRotationMatrix();
  const double radius = std::get<Box>(box.shape).half.cast<double>().norm();
  const double rounding =
      (box.position.cast<double>() - position).norm() + radius * turned_by_rounding.norm();
  return {box, model.error + rounding};
}

}  // namespace carom::ladders
