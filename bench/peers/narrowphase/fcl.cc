// FCL: collide() of two objects, with libccd's MPR for what it has no formula of its own for (its
// default), in double precision; distance(), with GJK and EPA, for distances.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

fcl::Vector3d vector(const float* v) { return {v[0], v[1], v[2]}; }

Geometry make_hull(const PeerHull& hull) {
  auto points = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& point : hull.points) points->push_back(vector(point.data()));
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& outline : hull.faces) {
    faces->push_back(static_cast<int>(outline.size()));
    faces->insert(faces->end(), outline.begin(), outline.end());
  }
  return std::make_shared<fcl::Convexd>(points, static_cast<int>(hull.faces.size()), faces);
}

// FCL's capsules lie along z, those of the streams along y.
fcl::Quaterniond turn_of(PeerShape shape, const std::array<float, 4>& q) {
  const fcl::Quaterniond turn(q[3], q[0], q[1], q[2]);
  if (shape != PeerShape::capsule) return turn;
  return turn * fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), fcl::Vector3d::UnitY());
}

class Bodies {
 public:
  explicit Bodies(const PeerBodies& source) {
    std::vector<Geometry> hulls;
    for (const PeerHull& hull : source.hulls) hulls.push_back(make_hull(hull));
    for (const PeerBody& body : source.bodies) {
      fcl::Transform3d pose = fcl::Transform3d::Identity();
      pose.linear() = turn_of(source.shape, body.orientation).normalized().toRotationMatrix();
      pose.translation() = vector(body.position.data());
      objects_.emplace_back(hulls.empty() ? make_shape(source.shape, body.size) : hulls[body.hull],
                            pose);
    }
  }

  size_t count() const { return objects_.size(); }
  const fcl::CollisionObjectd* object(size_t i) const { return &objects_[i]; }

 private:
  static Geometry make_shape(PeerShape shape, const std::array<float, 9>& size) {
    if (shape == PeerShape::sphere) return std::make_shared<fcl::Sphered>(size[0]);
    if (shape == PeerShape::capsule) return std::make_shared<fcl::Capsuled>(size[0], 2 * size[1]);
    if (shape == PeerShape::cylinder) return std::make_shared<fcl::Cylinderd>(size[0], 2 * size[1]);
    if (shape == PeerShape::cone) return std::make_shared<fcl::Coned>(size[0], 2 * size[1]);
    if (shape == PeerShape::ellipsoid) {
      return std::make_shared<fcl::Ellipsoidd>(size[0], size[1], size[2]);
    }
    return std::make_shared<fcl::Boxd>(2 * vector(size.data()));
  }

  std::vector<fcl::CollisionObjectd> objects_;
};

class FclPairs final : public PairPeer {
 public:
  FclPairs(const PeerBodies& a, const PeerBodies& b, PeerDetail detail)
      : a_(a), b_(b), measures_(detail == PeerDetail::distance) {
    collision_.enable_contact = detail != PeerDetail::overlap;
    collision_.num_max_contacts = detail == PeerDetail::manifold ? 4 : 1;
    distance_.enable_nearest_points = true;
    distance_.enable_signed_distance = true;
  }

  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.count(); ++i) {
      float& separation = answers.separations[i];
      answers.overlaps[i] = (measures_ ? measure(i, separation) : collide(i, separation)) ? 1 : 0;
    }
  }

 private:
  bool collide(size_t i, float& separation) const {
    fcl::CollisionResultd result;
    fcl::collide(a_.object(i), b_.object(i), collision_, result);
    separation = kNotReported;
    if (!collision_.enable_contact) return result.isCollision();  // its contacts have no depth
    for (size_t contact = 0; contact < result.numContacts(); ++contact) {
      const double depth = result.getContact(contact).penetration_depth;
      separation = std::fmin(separation, static_cast<float>(-depth));
    }
    return result.isCollision();
  }

  bool measure(size_t i, float& separation) const {
    fcl::DistanceResultd result;
    const double distance = fcl::distance(a_.object(i), b_.object(i), distance_, result);
    separation = static_cast<float>(distance);
    return distance <= 0;
  }

  const Bodies a_, b_;
  const bool measures_;
  fcl::CollisionRequestd collision_;
  fcl::DistanceRequestd distance_;
};

bool is_known(PeerShape shape) { return shape != PeerShape::triangle && shape != PeerShape::mesh; }

}  // namespace

std::unique_ptr<PairPeer> make_fcl_pairs(const PeerBodies& a, const PeerBodies& b,
                                         PeerDetail detail) {
  if (!is_known(a.shape) || !is_known(b.shape)) return nullptr;
  return std::make_unique<FclPairs>(a, b, detail);
}

}  // namespace carom::bench
