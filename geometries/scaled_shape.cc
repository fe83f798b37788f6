#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "base/float_environment.h"
#include "carom/shapes/scaled.h"
#include "geometries/placed_shape.h"
#include "geometries/scale.h"
#include "shapes/body_reader.h"
#include "shapes/dop_geometry.h"
#include "shapes/rounding.h"

namespace carom {
namespace {

using Eigen::Vector3f;

// Half a turn about x.
Orientation upside_down() { return Orientation(0, 1, 0, 0); }

Vector3f times(const Vector3f& v, const Vector3f& scale) { return v.cwiseProduct(scale); }

// Scales shapes that are not made of others. Sizes that are not valid stay so.
class Scaler {
 public:
  explicit Scaler(const Vector3f& scale)
      : scale_(scale), factors_(scale.cwiseAbs()), is_uniform_(is_uniform(scale)) {}

  Result<CompoundChild> operator()(const Sphere& sphere) const {
    if (is_uniform_) return child(Sphere{sphere.radius * factors_.x()});
    return child(Ellipsoid{sphere.radius * factors_});
  }

  Result<CompoundChild> operator()(const Aabb& box) const {
    const Vector3f first = times(box.lower, scale_), last = times(box.upper, scale_);
    Aabb result{first, last};
    for (int axis = 0; axis < 3; ++axis) {
      if (scale_[axis] < 0) std::swap(result.lower[axis], result.upper[axis]);
    }
    return child(result);
  }

  Result<CompoundChild> operator()(const Capsule& capsule) const {
    const Vector3f a = times(capsule.a, scale_), b = times(capsule.b, scale_);
    if (is_uniform_ || capsule.radius == 0) {
      return child(Capsule{a, b, capsule.radius * factors_.x()});
    }
    if (capsule.a == capsule.b) return CompoundChild{Ellipsoid{capsule.radius * factors_}, a};
    return no_shape("a capsule", "factors that are equal but for their signs");
  }

  Result<CompoundChild> operator()(const Box& box) const {
    return child(Box{times(box.half, factors_)});
  }

  Result<CompoundChild> operator()(const Triangle& triangle) const {
    Triangle result = triangle;
    for (Vector3f& corner : result.corners) corner = times(corner, scale_);
    if (is_mirroring(scale_)) {
      std::swap(result.corners[1], result.corners[2]);
      const unsigned edges = triangle.inner_edges;  // edge i becomes edge 2 - i
      result.inner_edges = static_cast<uint8_t>((edges & 2) | (edges & 1) << 2 | (edges >> 2 & 1));
    }
    return child(result);
  }

  // n . x <= d is (n / s) . (s x) <= d.
  Result<CompoundChild> operator()(const Halfspace& plane) const {
    const Eigen::Vector3d normal = plane.normal.cast<double>(), s = scale_.cast<double>();
    const Eigen::Vector3d divided = normal.cwiseQuotient(s);
    const double greatest = divided.cwiseAbs().maxCoeff();
    // The normal keeps about the length that it had.
    const double length = is_uniform_    ? double{factors_.x()}
                          : greatest > 0 ? normal.cwiseAbs().maxCoeff() / greatest
                                         : 1;
    return child(
        Halfspace{(divided * length).cast<float>(), static_cast<float>(plane.offset * length)});
  }

  Result<CompoundChild> operator()(const Dop& dop) const {
    if (!is_dop_kind(dop.kind)) return Error{"a k-DOP of an unknown kind"};
    if (!is_uniform_ && dop.kind != DopKind::k6) return child_of(hull_of_corners(dop));
    Dop result;
    result.kind = dop.kind;
    const auto directions = slab_directions(dop.kind);
    for (size_t i = 0; i < directions.size(); ++i) {
      const auto [slab, sign] = mirrored_slab(directions, i);
      // All factors are equal, but in the slabs of a box.
      const float factor = i < 3 ? factors_[static_cast<int>(i)] : factors_.x();
      const float lower = dop.lower[i] * factor, upper = dop.upper[i] * factor;
      result.lower[slab] = sign > 0 ? lower : -upper;
      result.upper[slab] = sign > 0 ? upper : -lower;
    }
    return child(result);
  }

  Result<CompoundChild> operator()(const Cylinder& cylinder) const {
    if (!is_round_about_z(cylinder.radius)) return no_shape("a cylinder", kRoundAboutZ);
    return child(Cylinder{cylinder.radius * factors_.x(), cylinder.half_length * factors_.z()});
  }

  Result<CompoundChild> operator()(const Cone& cone) const {
    if (!is_round_about_z(cone.radius)) return no_shape("a cone", kRoundAboutZ);
    const Cone result{cone.radius * factors_.x(), cone.half_length * factors_.z()};
    const bool has_tip = cone.radius != 0 && cone.half_length != 0;
    if (scale_.z() > 0 || !has_tip) return child(result);
    return CompoundChild{result, Vector3f::Zero(), upside_down()};
  }

  Result<CompoundChild> operator()(const Ellipsoid& ellipsoid) const {
    return child(Ellipsoid{times(ellipsoid.semi_axes, factors_)});
  }

  // A geometry is scaled as a whole.
  template <class ShapeOfGeometry>
  Result<CompoundChild> operator()(const ShapeOfGeometry& shape) const {
    if (!shape.geometry) return child(ShapeOfGeometry{});
    return child_of<ShapeOfGeometry>(scaled(shape.geometry, scale_));
  }

 private:
  static constexpr const char* kRoundAboutZ =
      "factors of x and y that are equal but for their signs";

  static CompoundChild child(Shape shape) { return {std::move(shape)}; }

  template <class ShapeOfGeometry = Hull, class Geometry>
  static Result<CompoundChild> child_of(Result<std::shared_ptr<Geometry>> made) {
    if (!made) return made.error();
    return child(ShapeOfGeometry{std::move(*made)});
  }

  bool is_round_about_z(float radius) const { return factors_.x() == factors_.y() || radius == 0; }

  Error no_shape(const std::string& what, const std::string& expected) const {
    return {what + " by the scale " + text_of_scale(scale_) + " is no shape (" + expected +
            " were expected)"};
  }

  // Where the slab goes if axes are mirrored, and whether its direction is turned round.
  std::pair<size_t, int> mirrored_slab(std::span<const std::array<int8_t, 3>> directions,
                                       size_t slab) const {
    std::array<int8_t, 3> way = directions[slab], back{};
    for (int axis = 0; axis < 3; ++axis) {
      if (scale_[axis] < 0) way[axis] = static_cast<int8_t>(-way[axis]);
      back[axis] = static_cast<int8_t>(-way[axis]);
    }
    const auto same = std::find(directions.begin(), directions.end(), way);
    if (same != directions.end()) return {same - directions.begin(), 1};
    return {std::find(directions.begin(), directions.end(), back) - directions.begin(), -1};
  }

  Result<std::shared_ptr<const HullGeometry>> hull_of_corners(const Dop& dop) const {
    if (!is_valid_dop(dop)) return Error{"a k-DOP is not valid"};
    return scaled(hull_of(dop).geometry, scale_);
  }

  const Vector3f scale_, factors_;
  const bool is_uniform_;
};

// Whether the numbers of a shape that has no geometry are finite.
struct AreFinite {
  bool operator()(const Sphere& s) const { return std::isfinite(s.radius); }
  bool operator()(const Aabb& box) const { return box.lower.allFinite() && box.upper.allFinite(); }
  template <class Other>
  bool operator()(const Other& shape) const {
    const ShapeKind kind = kind_of(shape);
    if (has_geometry(kind)) return true;
    const auto rows = shape_rows(shape);
    return std::all_of(rows.begin(), rows.begin() + row_count(kind),
                       [](const Row& row) { return is_finite(row); });
  }
};

bool are_finite(const Shape& shape) { return std::visit(AreFinite(), shape); }

// A rounding is a ball around every point, which stays one where the factors are equal.
Result<CompoundChild> round_again(CompoundChild scaled, const Shape& shape,
                                  const Eigen::Vector3f& scale) {
  const float rounding = rounding_of(shape);
  if (rounding == 0) return scaled;
  if (!is_uniform(scale)) {
    return Error{"a rounded " + std::string(name(kind_of(shape))) + " by the scale " +
                 text_of_scale(scale) +
                 " is no shape (factors that are equal but for their signs were expected)"};
  }
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.rounding; }) s.rounding = rounding * std::fabs(scale.x());
      },
      scaled.shape);
  return scaled;
}

}  // namespace

Result<CompoundChild> scaled_in_place(const Shape& shape, const Eigen::Vector3f& scale) {
  Result<CompoundChild> result = std::visit(Scaler(scale), shape);
  if (result) result = round_again(std::move(*result), shape, scale);
  if (!result || !are_finite(shape)) return result;
  if (are_finite(result->shape) && result->position.allFinite()) return result;
  return Error{"a " + std::string(name(kind_of(shape))) + " by the scale " + text_of_scale(scale) +
               " leaves the range of float32"};
}

Result<Shape> scaled(const Shape& shape, const Eigen::Vector3f& scale) {
  const FloatEnvironment environment;
  if (Result<void> checked = check_scale(scale); !checked) return checked.error();
  Result<CompoundChild> placed = scaled_in_place(shape, scale);
  if (!placed) return placed.error();
  const bool is_in_place = placed->position.isZero(0) &&
                           placed->orientation.coeffs() == Orientation::Identity().coeffs();
  if (is_in_place) return std::move(placed->shape);
  auto compound = make_compound(std::span(&*placed, 1));
  if (!compound) return compound.error();
  return Shape(Compound{std::move(*compound)});
}

}  // namespace carom
