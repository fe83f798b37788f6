/// @file
/// The geometry of compounds: children with poses, and a tree of their boxes. It is made once,
/// never changed, and shared by all bodies of that shape.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/compound.h"
#include "carom/shapes/orientation.h"
#include "carom/shapes/shape.h"

namespace carom {

class BoxTree;
struct Part;

/// A shape in a compound: a point x of the child's frame is at position + R(orientation) x of the
/// compound's frame, as for bodies. An aabb lies along the axes of the compound, whatever its
/// orientation, and turns with the compound.
struct CompoundChild {
  Shape shape = Sphere{};                              ///< no compound, no half-space
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< compound frame, metres
  Orientation orientation = Orientation::Identity();   ///< need not be a unit one, but not zero
};

/// The children of a compound and their tree. A body of this shape at position p with orientation q
/// has its children at p + R(q) position, in double precision, turned by q * orientation rounded to
/// float32. All decisions, exact ones too, are about children placed like this.
class CAROM_EXPORT CompoundGeometry {
 public:
  ~CompoundGeometry();

  /// The children in the order in which they were given; sub-shape indices refer to it.
  std::span<const CompoundChild> children() const { return children_; }

  /// Lower corner of a box that contains all children, rounded outwards; compound frame, metres.
  const Eigen::Vector3f& lower() const { return lower_; }
  /// Upper corner of the same box.
  const Eigen::Vector3f& upper() const { return upper_; }

  /// The children in the form that the tests read. For Carom's own use.
  std::span<const Part> parts() const;
  /// The tree of the children's boxes; its items are children. For Carom's own use.
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

/// Makes a compound of children of any kind but compounds and half-spaces. Fails if there is no
/// child, if a child is a compound or a half-space, or if a child's shape, position or orientation
/// is not valid (numbers that are not finite, negative sizes, a quaternion of zeros, a missing
/// geometry).
CAROM_EXPORT Result<std::shared_ptr<const CompoundGeometry>> make_compound(
    std::span<const CompoundChild> children);

}  // namespace carom
