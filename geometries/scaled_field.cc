#include <algorithm>
#include <cfloat>
#include <cmath>

#include "base/float_environment.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/scaled.h"
#include "geometries/height_field_limits.h"
#include "geometries/scale.h"

namespace carom {

class ScaledFieldMaker {
 public:
  static std::shared_ptr<const HeightFieldGeometry> source_of(
      const std::shared_ptr<const HeightFieldGeometry>& field) {
    return field->source_ ? field->source_ : field;
  }

  static std::shared_ptr<const HeightFieldGeometry> make(
      std::shared_ptr<const HeightFieldGeometry> source, const Eigen::Vector3f& scale) {
    const std::shared_ptr<HeightFieldGeometry> made(new HeightFieldGeometry());
    HeightFieldGeometry& field = *made;
    field.nx_ = source->nx_;
    field.ny_ = source->ny_;
    field.dx_ = source->dx_;
    field.dy_ = source->dy_;
    field.middle_x_ = source->middle_x_;
    field.middle_y_ = source->middle_y_;
    field.type_ = source->type_;
    field.borrows_ = source->borrows_;
    field.scale_ = source->scale_;
    field.offset_ = source->offset_;
    field.most_ = source->most_;
    field.samples_ = source->samples_;
    field.row_stride_ = source->row_stride_;
    field.materials_ = source->materials_;
    field.pyramid_ = source->pyramid_;
    field.factors_ = scale;
    field.is_scaled_ = true;
    field.is_mirrored_ = is_mirroring(scale);
    const Eigen::Vector3f first = source->lower_.cwiseProduct(scale);
    const Eigen::Vector3f last = source->upper_.cwiseProduct(scale);
    field.lower_ = first.cwiseMin(last);
    field.upper_ = first.cwiseMax(last);
    field.source_ = std::move(source);
    return made;
  }
};

namespace {

// The grid has whole cells, and every triangle an area.
bool is_field(const HeightFieldGeometry& source, const Eigen::Vector3f& scale) {
  const double dx = double{source.dx()} * std::fabs(scale.x());
  const double dy = double{source.dy()} * std::fabs(scale.y());
  const double height = std::max(std::fabs(source.lower().z()), std::fabs(source.upper().z())) *
                        std::fabs(double{scale.z()});
  const auto [least, most] = std::minmax(dx, dy);
  return is_spacing(dx) && is_spacing(dy) && most <= kMostAspect * least &&
         source.cells_x() * dx <= FLT_MAX && source.cells_y() * dy <= FLT_MAX &&
         height <= std::min(kMostSlope * least, double{FLT_MAX});
}

}  // namespace

Result<std::shared_ptr<const HeightFieldGeometry>> scaled(
    const std::shared_ptr<const HeightFieldGeometry>& field, const Eigen::Vector3f& scale) {
  const FloatEnvironment environment;
  if (!field) return Error{"a height field without geometry"};
  Result<Eigen::Vector3f> both = scale_after(field->scale(), scale);
  if (!both) return both.error();
  if (*both == field->scale()) return field;
  std::shared_ptr<const HeightFieldGeometry> source = ScaledFieldMaker::source_of(field);
  if (*both == Eigen::Vector3f::Ones()) return source;
  if (!is_field(*source, *both)) {
    return Error{"the scale " + text_of_scale(*both) +
                 " leaves the height field without cells, or with heights out of range"};
  }
  return ScaledFieldMaker::make(std::move(source), *both);
}

}  // namespace carom
