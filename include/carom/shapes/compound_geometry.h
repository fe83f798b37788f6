// The geometry of compounds: children with poses, and a tree of their boxes; made once, never
// changed, shared by all bodies of that shape.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/compound.h"
#include "carom/shapes/shape.h"

namespace carom {

class BoxTree;
struct Part;

// x of the child's frame is at position + R(orientation) x of the compound's, as for bodies. An
// aabb lies along the axes of the compound, whatever its orientation, and is turned with it.
struct CompoundChild {
  Shape shape = Sphere{};
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // metres
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

// A body of this shape at position p with orientation q has its children at p + R(q) position, in
// double precision, turned by q * orientation rounded to float32: decisions, exact ones too, are
// about children that are placed so.
class CAROM_EXPORT CompoundGeometry {
 public:
  ~CompoundGeometry();

  // As given: sub-shapes are named by their index.
  std::span<const CompoundChild> children() const { return children_; }

  // A box that holds all children, rounded outwards.
  const Eigen::Vector3f& lower() const { return lower_; }
  const Eigen::Vector3f& upper() const { return upper_; }

  // The children as tests take them.
  std::span<const Part> parts() const;
  // Items are children.
  const BoxTree& tree() const { return *tree_; }

 private:
  friend class CompoundMaker;
  CompoundGeometry();

  std::vector<CompoundChild> children_;
  std::vector<Part> parts_;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  std::unique_ptr<const BoxTree> tree_;
};

// Children may be of any kind but compounds and half-spaces. Fails if there is no child, or one of
// these, or a child's shape, position or orientation is not valid (numbers that are not finite,
// negative sizes, a quaternion of zeros, a geometry that is not there).
CAROM_EXPORT Result<std::shared_ptr<const CompoundGeometry>> make_compound(
    std::span<const CompoundChild> children);

}  // namespace carom
