#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/scaled.h"
#include "geometries/part.h"
#include "geometries/placed_shape.h"
#include "geometries/scale.h"
#include "shapes/dop_geometry.h"

namespace carom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Columns whose cosine is less are at right angles: an orientation in float32 says no more.
constexpr double kRightAngle = 0x1p-22;

Matrix3d rotation_matrix(const Orientation& orientation) {
  const Turn rows =
      rotation_of({orientation.x(), orientation.y(), orientation.z(), orientation.w()});
  Matrix3d result;
  for (int i = 0; i < 3; ++i) result.row(i) = Vector3d(rows[i][0], rows[i][1], rows[i][2]);
  return result;
}

Orientation orientation_of(const Matrix3d& rotation) {
  return Orientation(Eigen::Quaterniond(rotation).cast<float>());
}

// A scale along the shape's own axes, and then a rotation.
struct TurnedScale {
  Orientation orientation;
  Vector3f scale;
};

// The orientation that mirrors of a turned shape have, if axes with a negative factor are mirrored
// before it turns as well.
Orientation mirrored(const Orientation& q, const Vector3f& scale) {
  const Vector3f signs = scale.cwiseSign();
  const Vector3f axis = signs.prod() * signs.cwiseProduct(Vector3f(q.x(), q.y(), q.z()));
  return Orientation(q.w(), axis.x(), axis.y(), axis.z());
}

// A scale of a turned shape as a scale along its own axes; nothing if it shears the shape.
std::optional<TurnedScale> after_turn(const Orientation& orientation, const Vector3f& scale) {
  const bool is_turned = !orientation.vec().isZero(0);
  if (!is_turned) return TurnedScale{orientation, scale};
  if (is_uniform(scale)) return TurnedScale{mirrored(orientation, scale), scale};
  Matrix3d columns = scale.cast<double>().asDiagonal() * rotation_matrix(orientation);
  Vector3d lengths = columns.colwise().norm();
  columns = columns * lengths.cwiseInverse().asDiagonal();
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(columns.col(i).dot(columns.col((i + 1) % 3))) > kRightAngle) return std::nullopt;
  }
  if (is_mirroring(scale)) {  // along x, which most shapes do not notice
    columns.col(0) *= -1;
    lengths.x() *= -1;
  }
  return TurnedScale{orientation_of(columns), lengths.cast<float>()};
}

// Shears shapes. The map is about the shape's own origin.
class Shearer {
 public:
  explicit Shearer(const Matrix3d& map) : map_(map), mirrors_(map.determinant() < 0) {}

  Result<CompoundChild> operator()(const Box& box) const {
    std::vector<Vector3f> points;
    for (int i = 0; i < 8; ++i) {  // bit k of i: the upper end of axis k
      Vector3f corner = box.half;
      for (int axis = 0; axis < 3; ++axis) {
        if ((i >> axis & 1) == 0) corner[axis] = -corner[axis];
      }
      points.push_back(corner);
    }
    static const std::vector<uint32_t> kFaces[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                   {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    const auto hull = make_hull(points, kFaces);
    if (!hull) return hull.error();
    return sheared(**hull);
  }

  Result<CompoundChild> operator()(const Hull& hull) const { return sheared(*hull.geometry); }

  Result<CompoundChild> operator()(const Dop& dop) const {
    if (!is_valid_dop(dop)) return Error{"a k-DOP is not valid"};
    return sheared(*hull_of(dop).geometry);
  }

  Result<CompoundChild> operator()(const Triangle& triangle) const {
    Triangle result = triangle;
    for (Vector3f& corner : result.corners) corner = at(corner);
    if (!mirrors_) return CompoundChild{result};
    // The corners and edges of its mirror image.
    Result<Shape> image = scaled(Shape(result), {-1, 1, 1});
    if (!image) return image.error();
    Triangle& turned = std::get<Triangle>(*image);
    for (Vector3f& corner : turned.corners) corner.x() = -corner.x();
    return CompoundChild{turned};
  }

  Result<CompoundChild> operator()(const Mesh& mesh) const {
    std::vector<Vector3f> vertices;
    for (size_t i = 0; i < mesh.geometry->vertices().size(); ++i) {
      vertices.push_back(at(mesh.geometry->vertex(i)));
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t i = 0; i < mesh.geometry->triangles().size(); ++i) {
      const auto [a, b, c] = mesh.geometry->corner_numbers(i);
      triangles.push_back(mirrors_ ? std::array{a, c, b} : std::array{a, b, c});
    }
    auto made = make_mesh(vertices, triangles, mesh.geometry->rules());
    if (!made) return made.error();
    return CompoundChild{Mesh{std::move(*made)}};
  }

  // The image of a ball is an ellipsoid: its axes are the left singular vectors of the map.
  Result<CompoundChild> operator()(const Ellipsoid& ellipsoid) const {
    const Matrix3d of_ball = map_ * ellipsoid.semi_axes.cast<double>().asDiagonal();
    if (!of_ball.allFinite()) return Error{"an ellipsoid is not finite"};
    Matrix3d axes = Eigen::JacobiSVD<Matrix3d>(of_ball, Eigen::ComputeFullU).matrixU();
    if (axes.determinant() < 0) axes.col(2) *= -1;
    const Vector3d lengths = (axes.transpose() * of_ball).rowwise().norm();
    return CompoundChild{Ellipsoid{lengths.cast<float>()}, Vector3f::Zero(), orientation_of(axes)};
  }

  template <class Other>
  Result<CompoundChild> operator()(const Other& shape) const {
    return Error{std::string("a ") + name(kind_of(shape)) +
                 " would be sheared by a scale across its orientation, and is no shape then"};
  }

 private:
  Vector3f at(const Vector3f& point) const { return (map_ * point.cast<double>()).cast<float>(); }

  Result<CompoundChild> sheared(const HullGeometry& hull) const {
    auto made = mapped(
        hull, [this](const Vector3f& point) { return at(point); }, mirrors_);
    if (!made) return made.error();
    return CompoundChild{Hull{std::move(*made)}};
  }

  const Matrix3d map_;
  const bool mirrors_;
};

// Spheres do not turn, nor do aabbs in a compound.
bool turns(const Shape& shape) {
  return !std::holds_alternative<Sphere>(shape) && !std::holds_alternative<Aabb>(shape);
}

Row row_of(const Orientation& q) { return {q.x(), q.y(), q.z(), q.w()}; }

// Children that share a geometry share that of the result.
class ChildScaler {
 public:
  explicit ChildScaler(const Vector3f& scale) : scale_(scale) {}

  Result<CompoundChild> operator()(const CompoundChild& child) {
    const Orientation orientation =
        turns(child.shape) ? child.orientation : Orientation(Orientation::Identity());
    const std::optional<TurnedScale> turned_scale = after_turn(orientation, scale_);
    Result<CompoundChild> result =
        turned_scale
            ? own_scale(child.shape, turned_scale->scale)
            : std::visit(Shearer(scale_.cast<double>().asDiagonal() * rotation_matrix(orientation)),
                         child.shape);
    if (!result) return result;
    const Vector3f place = child.position.cwiseProduct(scale_);
    if (!turned_scale) {
      result->position += place;
    } else if (result->position.isZero(0) && is_identity(result->orientation)) {
      result->position = place;
      result->orientation = turned_scale->orientation;
    } else {
      const Row q = row_of(turned_scale->orientation);
      const auto& p = result->position;
      const Double3 way = turned(rotation_of(q), {p.x(), p.y(), p.z()});
      for (int axis = 0; axis < 3; ++axis) {
        result->position[axis] = static_cast<float>(place[axis] + way[axis]);
      }
      const Row both = product(q, row_of(result->orientation));
      result->orientation = Orientation(both[3], both[0], both[1], both[2]);
    }
    return result;
  }

 private:
  static bool is_identity(const Orientation& q) {
    return q.coeffs() == Orientation::Identity().coeffs();
  }

  Result<CompoundChild> own_scale(const Shape& shape, const Vector3f& scale) {
    if (!has_geometry(kind_of(shape))) return scaled_in_place(shape, scale);
    const auto row = shape_rows(shape)[0];
    const auto [place, is_new] = known_.try_emplace(
        {geometry_at<void>(row), {scale.x(), scale.y(), scale.z()}}, CompoundChild{});
    if (!is_new) return place->second;
    Result<CompoundChild> made = scaled_in_place(shape, scale);
    if (made) place->second = *made;
    return made;
  }

  const Vector3f scale_;
  std::map<std::pair<const void*, std::array<float, 3>>, CompoundChild> known_;
};

}  // namespace

Result<std::shared_ptr<const CompoundGeometry>> scaled(
    const std::shared_ptr<const CompoundGeometry>& compound, const Vector3f& scale) {
  const FloatEnvironment environment;
  if (!compound) return Error{"a compound without geometry"};
  if (Result<void> checked = check_scale(scale); !checked) return checked.error();
  ChildScaler scaler(scale);
  std::vector<CompoundChild> children;
  for (size_t i = 0; i < compound->children().size(); ++i) {
    Result<CompoundChild> child = scaler(compound->children()[i]);
    if (!child) {
      return Error{"child " + std::to_string(i) + " of the compound: " + child.error().message};
    }
    children.push_back(std::move(*child));
  }
  return make_compound(children);
}

}  // namespace carom
