// FCL: the loop of a user, since it has no cast at many bodies. Its tree names the bodies in the
// box of the path; those that the path reaches before the best hit so far go through
// continuousCollide() with the motion and the solver for translations that its request offers
// (conservative advancement; the default would try ten places of the path). In double precision.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "bench/peers/queries/cast_peer.h"

namespace carom::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

fcl::Vector3d vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

fcl::Transform3d pose(const CastBody& body) {
  const auto& q = body.orientation;
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
  pose.translation() = vector(body.position);
  return pose;
}

Geometry make_hull(const CastHull& hull) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& point : hull.points) points->push_back(vector(point));
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& outline : hull.faces) {
    faces->push_back(static_cast<int>(outline.size()));
    faces->insert(faces->end(), outline.begin(), outline.end());
  }
  return std::make_shared<fcl::Convexd>(points, static_cast<int>(hull.faces.size()), faces);
}

Geometry make_mesh(const CastScene& scene) {
  std::vector<fcl::Vector3d> vertices;
  for (const auto& vertex : scene.vertices) vertices.push_back(vector(vertex));
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : scene.triangles) triangles.emplace_back(a, b, c);
  auto mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  mesh->beginModel();
  mesh->addSubModel(vertices, triangles);
  mesh->endModel();
  return mesh;
}

// A geometry that has only bounds.
class PathGeometry final : public fcl::CollisionGeometryd {
 public:
  void computeLocalAABB() override {}
};

class FclCasts final : public CastPeer {
 public:
  FclCasts(const CastScene& scene, const CastList& list) : list_(list) {
    for (const CastHull& hull : scene.hulls) hulls_.push_back(make_hull(hull));
    for (const CastBody& body : scene.bodies) {
      const bool is_mesh = body.shape == CastShape::mesh;
      bodies_.emplace_back(is_mesh ? make_mesh(scene) : make_convex(body), pose(body));
    }
    for (const CastBody& query : list_.queries) {
      queries_.emplace_back(make_convex(query), pose(query));
    }
    std::vector<fcl::CollisionObjectd*> all;
    for (fcl::CollisionObjectd& body : bodies_) all.push_back(&body);
    manager_.registerObjects(all);
    manager_.setup();
    request_.ccd_motion_type = fcl::CCDM_TRANS;
    request_.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  }

  void run(std::span<float> times) override {
    for (size_t i = 0; i < times.size(); ++i) {
      query_ = &queries_[i];
      displacement_ = vector(list_.displacements[i]);
      end_ = query_->getTransform();
      end_.translation() += displacement_;
      best_ = 2;
      reach_ = path_box(1);
      path_->aabb_local = reach_;
      path_object_.computeAABB();
      manager_.collide(&path_object_, this, visit);
      times[i] = static_cast<float>(best_);
    }
  }

 private:
  Geometry make_convex(const CastBody& body) const {
    switch (body.shape) {
      case CastShape::sphere:
        return std::make_shared<fcl::Sphered>(body.size[0]);
      case CastShape::capsule:
        return std::make_shared<fcl::Capsuled>(body.size[0], 2 * body.size[1]);
      case CastShape::box:
        return std::make_shared<fcl::Boxd>(2 * vector(body.size));
      default:
        return hulls_[body.hull];
    }
  }

  fcl::AABBd path_box(double time) const {
    const fcl::AABBd& start = query_->getAABB();
    fcl::AABBd box = start;
    box += fcl::AABBd(start.min_ + time * displacement_, start.max_ + time * displacement_);
    return box;
  }

  static bool visit(fcl::CollisionObjectd* body, fcl::CollisionObjectd* /*path*/, void* casts) {
    static_cast<FclCasts*>(casts)->cast_at(*body);
    return false;  // go on
  }

  void cast_at(const fcl::CollisionObjectd& body) {
    if (!reach_.overlap(body.getAABB())) return;
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(query_, end_, &body, body.getTransform(), request_, result);
    if (!result.is_collide || result.time_of_contact >= best_) return;
    best_ = result.time_of_contact;
    reach_ = path_box(best_);
  }

  const CastList& list_;
  std::vector<Geometry> hulls_;
  std::vector<fcl::CollisionObjectd> bodies_, queries_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  fcl::ContinuousCollisionRequestd request_;
  const std::shared_ptr<PathGeometry> path_ = std::make_shared<PathGeometry>();
  fcl::CollisionObjectd path_object_{path_};
  // Of the cast that runs.
  const fcl::CollisionObjectd* query_ = nullptr;
  fcl::Vector3d displacement_ = fcl::Vector3d::Zero();
  fcl::Transform3d end_ = fcl::Transform3d::Identity();
  fcl::AABBd reach_;
  double best_ = 2;
};

}  // namespace

std::unique_ptr<CastPeer> make_fcl_casts(const CastScene& scene, const CastList& list) {
  return std::make_unique<FclCasts>(scene, list);
}

}  // namespace carom::bench
