// The corners of a k-DOP in the unit of a test.
#pragma once

#include <optional>

#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

using Eigen::Vector3d;

// Those that are kept with the shape, or else found now. Units of tests are powers of two, so that
// both are the same to the bit.
class DopCorners {
 public:
  template <class Real>
  explicit DopCorners(const DopShape<Real>& dop) : scale_(dop.geometry ? dop.scale : 1) {
    if (dop.geometry) {
      polytope_ = &dop.geometry->polytope();
    } else {
      polytope_ = &found_.emplace(dop.slabs);
    }
  }
  DopCorners(const DopCorners&) = delete;
  DopCorners& operator=(const DopCorners&) = delete;

  // Its points are those of point() : scale.
  const DopPolytope& polytope() const { return *polytope_; }

  size_t size() const { return polytope_->point_count(); }
  Vector3d point(size_t i) const {
    const Double3 p = polytope_->point(i);
    return Vector3d(p[0], p[1], p[2]) * scale_;
  }

 private:
  const double scale_;
  std::optional<DopPolytope> found_;
  const DopPolytope* polytope_;
};

}  // namespace carom::scalar
