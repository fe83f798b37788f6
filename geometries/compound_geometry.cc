#include "carom/shapes/compound_geometry.h"

#include <algorithm>
#include <cfloat>
#include <string>

#include "base/float_environment.h"
#include "bounds/extent.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {
namespace {

using Eigen::Vector3f;

bool is_empty_geometry(const Shape& shape) {
  return has_geometry(kind_of(shape)) && geometry_at<void>(shape_rows(shape)[0]) == nullptr;
}

// A view of one child as a single body at the origin.
class ChildView {
 public:
  explicit ChildView(const CompoundChild& child)
      : rows_(shape_rows(child.shape)), orientation_(child.orientation.coeffs()) {
    view_.count = 1;
    view_.uniform_kind = kind_of(child.shape);
    if (const auto* sphere = std::get_if<Sphere>(&child.shape)) radius_ = sphere->radius;
    if (const auto* box = std::get_if<Aabb>(&child.shape)) box_ = *box;
    if (const auto* dop = std::get_if<Dop>(&child.shape)) dop_ = dop->geometry.get();
    view_.position = {.data = position_.data(),
                      .stride = sizeof position_,
                      .radius_layout = RadiusLayout::column,
                      .radius = &radius_};
    for (int axis = 0; axis < 3; ++axis) {
      view_.boxes.lower[axis] = &box_.lower[axis];
      view_.boxes.upper[axis] = &box_.upper[axis];
    }
    view_.orientation.data = orientation_.data();
    view_.rows.data = rows_[0].data();
    view_.dops = &dop_;
  }
  ChildView(const ChildView&) = delete;
  ChildView& operator=(const ChildView&) = delete;

  bool is_valid() const { return BodyReader{view_}.is_valid(0); }
  Extent extent() const { return extent_of(BodyReader{view_}, 0); }

  // An aabb becomes a box about its own middle, since it turns with the body.
  Part part(const Vector3f& position) const {
    Part part;
    part.kind = view_.uniform_kind;
    part.radius = radius_;
    part.rows = rows_;
    part.dop = dop_;
    part.position = {position.x(), position.y(), position.z()};
    if (part.is_turned()) {
      std::copy_n(orientation_.data(), 4, part.orientation.begin());
    } else if (part.kind == ShapeKind::aabb) {
      part.kind = ShapeKind::box;
      for (int axis = 0; axis < 3; ++axis) {
        const double lower = box_.lower[axis], upper = box_.upper[axis];
        part.rows[0][axis] = static_cast<float>((upper - lower) / 2);
        part.position[axis] += (lower + upper) / 2;
      }
    }
    return part;
  }

 private:
  std::array<float, 3> position_{};
  float radius_ = 0;
  Aabb box_;
  const DopGeometry* dop_ = nullptr;
  std::array<std::array<float, 4>, kMostRows> rows_;
  Eigen::Vector4f orientation_;
  Collidables view_;
};

Error bad_child(size_t i, const char* what) {
  return {"child " + std::to_string(i) + " of the compound " + what};
}

}  // namespace

class CompoundMaker {
 public:
  explicit CompoundMaker(std::span<const CompoundChild> children)
      : compound_(new CompoundGeometry()) {
    compound_->children_.assign(children.begin(), children.end());
  }

  Result<std::shared_ptr<const CompoundGeometry>> make() {
    std::vector<TreeBox> boxes;
    for (size_t i = 0; i < compound_->children_.size(); ++i) {
      CompoundChild& child = compound_->children_[i];
      if (auto* dop = std::get_if<Dop>(&child.shape)) dop->geometry = dop_geometry(*dop);
      const ShapeKind kind = kind_of(child.shape);
      if (kind == ShapeKind::compound) return bad_child(i, "is a compound itself");
      if (kind == ShapeKind::halfspace) return bad_child(i, "is a half-space, which has no bounds");
      if (is_empty_geometry(child.shape)) return bad_child(i, "has no geometry");
      if (!child.position.allFinite()) return bad_child(i, "has a position that is not finite");
      const Eigen::Vector4f& q = child.orientation.coeffs();
      if (!q.allFinite() || q.isZero(0)) {
        return bad_child(i, "has an orientation that is zero or not finite");
      }
      const ChildView view(child);
      if (!view.is_valid()) return bad_child(i, "has a shape that is not valid");
      compound_->parts_.push_back(view.part(child.position));
      const bool has_many = compound_->children_.size() >= kManyParts;
      if (has_many) compound_->parts_.back().ball = ball_of(compound_->parts_.back());
      boxes.push_back(box_at(child.position, view.extent()));
    }
    add_up(boxes);
    compound_->tree_ = std::make_unique<BoxTree>(boxes);
    return std::shared_ptr<const CompoundGeometry>(compound_);
  }

 private:
  // The child's box in the body's frame. Double precision rounds the sums; the half size makes room
  // for that.
  static TreeBox box_at(const Vector3f& position, const Extent& extent) {
    Double3 middle, half;
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = extent.lower[axis], upper = extent.upper[axis];
      middle[axis] = position[axis] + (lower + upper) / 2;
      half[axis] = (upper - lower) / 2 + kTurnRounding * (std::fabs(middle[axis]) + upper - lower);
    }
    return rounded_outwards(middle, half);
  }

  void add_up(std::span<const TreeBox> boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      compound_->lower_[axis] = boxes[0].lower[axis];
      compound_->upper_[axis] = boxes[0].upper[axis];
      for (const TreeBox& box : boxes) {
        compound_->lower_[axis] = std::min(compound_->lower_[axis], box.lower[axis]);
        compound_->upper_[axis] = std::max(compound_->upper_[axis], box.upper[axis]);
      }
    }
  }

  std::shared_ptr<CompoundGeometry> compound_;
};

CompoundGeometry::CompoundGeometry() = default;
CompoundGeometry::~CompoundGeometry() = default;

std::span<const Part> CompoundGeometry::parts() const { return parts_; }

Result<std::shared_ptr<const CompoundGeometry>> make_compound(
    std::span<const CompoundChild> children) {
  const FloatEnvironment environment;
  if (children.empty()) return Error{"a compound without children"};
  return CompoundMaker(children).make();
}

}  // namespace carom
