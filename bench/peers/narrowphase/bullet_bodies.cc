#include "bench/peers/narrowphase/bullet_bodies.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

namespace carom::bench {
namespace {

// Bullet rounds the corners of boxes and thickens triangles by a margin. This margin, a thousandth
// of the smallest shape, makes its question nearly the same as Carom's.
constexpr btScalar kMargin = 2.5e-4f;

// Bullet has no ellipsoids. This is what its users add: a support point.
class BulletEllipsoid final : public btConvexInternalShape {
 public:
  explicit BulletEllipsoid(const btVector3& semi_axes) : semi_axes_(semi_axes) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    setMargin(0);
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& way) const override {
    const btVector3 reached = semi_axes_ * way;
    const btScalar length = reached.length();
    return length > 0 ? semi_axes_ * reached / length : btVector3(0, 0, 0);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* ways, btVector3* points,
                                                         int count) const override {
    for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(ways[i]);
  }
  void calculateLocalInertia(btScalar /*mass*/, btVector3& inertia) const override {
    inertia.setZero();
  }
  const char* getName() const override { return "Ellipsoid"; }

 private:
  btVector3 semi_axes_;
};

std::shared_ptr<btCollisionShape> with_margin(std::shared_ptr<btCollisionShape> shape,
                                              btScalar margin) {
  shape->setMargin(margin);
  return shape;
}

// The margin of spheres and capsules is the radius. Hulls have none, because Bullet would add it
// outside.
std::shared_ptr<btCollisionShape> make_shape(PeerShape shape, const std::array<float, 9>& size) {
  switch (shape) {
    case PeerShape::sphere:
      return std::make_shared<btSphereShape>(size[0]);
    case PeerShape::capsule:
      return std::make_shared<btCapsuleShape>(size[0], 2 * size[1]);
    case PeerShape::box:
      return with_margin(std::make_shared<btBoxShape>(bullet_vector(&size[0])), kMargin);
    case PeerShape::triangle:
      return with_margin(
          std::make_shared<btTriangleShape>(bullet_vector(&size[0]), bullet_vector(&size[3]),
                                            bullet_vector(&size[6])),
          kMargin);
    case PeerShape::cylinder:
      return with_margin(std::make_shared<btCylinderShapeZ>(btVector3(size[0], size[0], size[1])),
                         kMargin);
    case PeerShape::cone:
      return with_margin(std::make_shared<btConeShapeZ>(size[0], 2 * size[1]), kMargin);
    case PeerShape::ellipsoid:
      return std::make_shared<BulletEllipsoid>(bullet_vector(&size[0]));
    case PeerShape::hull:
    case PeerShape::mesh:
      break;
  }
  return nullptr;
}

std::shared_ptr<btCollisionShape> make_hull(const std::vector<std::array<float, 3>>& points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& point : points) hull->addPoint(bullet_vector(point.data()), false);
  hull->recalcLocalAabb();
  return with_margin(hull, 0);
}

std::shared_ptr<btTriangleMesh> make_triangles(const PeerBodies& source) {
  auto triangles = std::make_shared<btTriangleMesh>();
  for (const auto& [a, b, c] : source.triangles) {
    triangles->addTriangle(bullet_vector(source.vertices[a].data()),
                           bullet_vector(source.vertices[b].data()),
                           bullet_vector(source.vertices[c].data()));
  }
  return triangles;
}

// A shape and the triangles that it points to.
template <class Shape>
struct ShapeOf {
  std::shared_ptr<btTriangleMesh> triangles;
  Shape shape;
};

std::shared_ptr<btCollisionShape> make_ground(const PeerBodies& source) {
  const auto triangles = make_triangles(source);
  auto ground = std::shared_ptr<ShapeOf<btBvhTriangleMeshShape>>(
      new ShapeOf<btBvhTriangleMeshShape>{triangles, {triangles.get(), true}});
  ground->shape.setMargin(kMargin);
  return {ground, &ground->shape};
}

std::shared_ptr<btCollisionShape> make_moving_mesh(const PeerBodies& source) {
  const auto triangles = make_triangles(source);
  auto mesh = std::shared_ptr<ShapeOf<btGImpactMeshShape>>(
      new ShapeOf<btGImpactMeshShape>{triangles, btGImpactMeshShape(triangles.get())});
  mesh->shape.setMargin(0);
  mesh->shape.updateBound();
  return {mesh, &mesh->shape};
}

}  // namespace

BulletBodies::BulletBodies(const PeerBodies& source, bool is_ground) {
  std::vector<std::shared_ptr<btCollisionShape>> shared;
  for (const PeerHull& hull : source.hulls) shared.push_back(make_hull(hull.points));
  if (source.shape == PeerShape::mesh) {
    shared.push_back(is_ground ? make_ground(source) : make_moving_mesh(source));
  }
  for (const PeerBody& body : source.bodies) {
    shapes_.push_back(shared.empty() ? make_shape(source.shape, body.size) : shared[body.hull]);
    const auto& q = body.orientation;
    transforms_.emplace_back(btQuaternion(q[0], q[1], q[2], q[3]),
                             bullet_vector(body.position.data()));
  }
}

}  // namespace carom::bench
