/// @file
/// Shapes under a scale: their points times a factor along each axis of the shape's own frame.
/// Factors below zero mirror; surfaces keep their fronts.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/shape.h"

namespace carom {

/// The shape with all its points multiplied by `scale`, along x, y and z of its own frame, rounded
/// to float32. All of these functions fail if a factor is 0 or not finite, or if numbers leave the
/// range of float32. Threads may call them at once. Where the result is not of the kind of the
/// shape, it is another one that is the same set of points:
/// - A sphere whose factors differ, other than in their signs, becomes an ellipsoid.
/// - A k-DOP whose slabs would change their directions becomes a hull of its corners.
/// - A cone that is turned upside down, and a ball (a capsule of equal ends) whose factors differ,
///   become compounds of one child.
///
/// Capsules and rounded shapes whose factors differ, and cylinders and cones whose factors of x and
/// y do, would be no shapes of Carom: these fail, unless they are without radius. The thickness of
/// triangles stays as it is, in metres. A shape without geometry stays as it is, and no result has
/// a ladder.
CAROM_EXPORT Result<Shape> scaled(const Shape& shape, const Eigen::Vector3f& scale);

/// A hull of the scaled points, with the same faces.
CAROM_EXPORT Result<std::shared_ptr<const HullGeometry>> scaled(
    const std::shared_ptr<const HullGeometry>& hull, const Eigen::Vector3f& scale);

/// A mesh that shares the triangles, the vertices and the tree of another one, and keeps them
/// alive: it takes some hundred bytes. Triangles keep their numbers and their thickness. It takes
/// time in proportion to the triangles, and the first one of each mesh more, with 12 bytes a
/// triangle. Tests of a mesh with a scale take longer than those of a mesh without. A scale so
/// uneven that triangles lose their area makes a mesh that shares nothing. Where `mesh` has a scale
/// already, the result has the product of both; a product of 1 is the mesh as it was made.
CAROM_EXPORT Result<std::shared_ptr<const MeshGeometry>> scaled(
    const std::shared_ptr<const MeshGeometry>& mesh, const Eigen::Vector3f& scale);

/// A mesh of the triangles of another one in the body's frame that shares nothing and has no scale:
/// it has the size of any mesh, and is tested as fast.
CAROM_EXPORT Result<std::shared_ptr<const MeshGeometry>> unshared(const MeshGeometry& mesh);

/// A height field that shares the samples of another one, and keeps it alive. Triangles keep their
/// numbers. It must be made again if the other one is updated. Otherwise as for meshes. Also fails
/// if the scaled spacings or heights are not those of a height field (make_height_field()).
CAROM_EXPORT Result<std::shared_ptr<const HeightFieldGeometry>> scaled(
    const std::shared_ptr<const HeightFieldGeometry>& field, const Eigen::Vector3f& scale);

/// A compound of the scaled children. A child that is turned against a scale whose factors differ
/// is sheared: spheres and ellipsoids are ellipsoids then, boxes, k-DOPs and hulls become hulls,
/// and meshes get vertices of their own. Capsules, cylinders, cones and height fields fail, unless
/// their own axes stay at right angles.
CAROM_EXPORT Result<std::shared_ptr<const CompoundGeometry>> scaled(
    const std::shared_ptr<const CompoundGeometry>& compound, const Eigen::Vector3f& scale);

}  // namespace carom
