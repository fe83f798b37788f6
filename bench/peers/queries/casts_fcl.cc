// FCL: the loop of a user, since it has no cast at many bodies. Its tree names the bodies in the
// box of the path; those that the path reaches before the best hit so far go through
// continuousCollide(), in double precision, with these choices of its request:
// - translations, and conservative advancement: the default solver tries ten places of the path;
// - GJK of FCL itself: with libccd, the default, boxes and hulls miss hits.
// A mesh is one object for each triangle. As a BVHModel of OBBRSS, continuousCollide() misses most
// hits and takes 20 ms at 5,000 triangles (its headers measure the boxes of the tree against the
// shape without its pose); with the mesh as the second object it recurses without end.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
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

// A flat hull; continuousCollide() does not take FCL's triangles.
Geometry make_triangle(const CastScene& scene, const std::array<uint32_t, 3>& corners) {
  CastHull hull = {.points = {}, .faces = {{0, 1, 2}, {2, 1, 0}}};
  for (const uint32_t corner : corners) hull.points.push_back(scene.vertices[corner]);
  return make_hull(hull);
}

// A geometry that has only bounds.
class PathGeometry final : public fcl::CollisionGeometryd {
 public:
  void computeLocalAABB() override {}
};

class FclCasts final : public CastPeer {
 public:
  explicit FclCasts(const CastScene& scene) {
    for (const CastHull& hull : scene.hulls) hulls_.push_back(make_hull(hull));
    for (const CastBody& body : scene.bodies) {
      if (body.shape != CastShape::mesh) bodies_.emplace_back(make_convex(body), pose(body));
    }
    for (const auto& corners : scene.triangles) bodies_.emplace_back(make_triangle(scene, corners));
    std::vector<fcl::CollisionObjectd*> all;
    for (fcl::CollisionObjectd& body : bodies_) all.push_back(&body);
    manager_.registerObjects(all);
    manager_.setup();
    request_.ccd_motion_type = fcl::CCDM_TRANS;
    request_.gjk_solver_type = fcl::GST_INDEP;
    request_.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  }

  void prepare(const CastList& list) override {
    list_ = &list;
    queries_.clear();
    for (const CastBody& query : list.queries) {
      queries_.emplace_back(make_convex(query), pose(query));
    }
  }

  void run(std::span<float> times) override {
    for (size_t i = 0; i < times.size(); ++i) {
      query_ = &queries_[i];
      displacement_ = vector(list_->displacements[i]);
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
    fcl::continuousCollide(&body, body.getTransform(), query_, end_, request_, result);
    if (!result.is_collide || result.time_of_contact >= best_) return;
    best_ = result.time_of_contact;
    reach_ = path_box(best_);
  }

  const CastList* list_ = nullptr;
  std::vector<Geometry> hulls_;
  std::vector<fcl::CollisionObjectd> bodies_, queries_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  fcl::ContinuousCollisionRequestd request_;
  const std::shared_ptr<PathGeometry> path_ = std::make_shared<PathGeometry>();
  fcl::CollisionObjectd path_object_{path_};
  // These belong to the cast that runs.
  const fcl::CollisionObjectd* query_ = nullptr;
  fcl::Vector3d displacement_ = fcl::Vector3d::Zero();
  fcl::Transform3d end_ = fcl::Transform3d::Identity();
  fcl::AABBd reach_;
  double best_ = 2;
};

}  // namespace

std::unique_ptr<CastPeer> make_fcl_casts(const CastScene& scene) {
  return std::make_unique<FclCasts>(scene);
}

}  // namespace carom::bench
