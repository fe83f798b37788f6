// FCL: collide() of two meshes, whose triangles lie in trees of OBBRSS.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr size_t kAllContacts = 1'000'000;

std::shared_ptr<Model> make_model(const PeerBodies& source) {
  std::vector<fcl::Vector3d> vertices;
  for (const auto& [x, y, z] : source.vertices) vertices.emplace_back(x, y, z);
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : source.triangles) triangles.emplace_back(a, b, c);
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

std::vector<fcl::CollisionObjectd> make_objects(const PeerBodies& source) {
  const std::shared_ptr<Model> model = make_model(source);
  std::vector<fcl::CollisionObjectd> objects;
  for (const PeerBody& body : source.bodies) {
    const auto& [x, y, z] = body.position;
    const auto& q = body.orientation;
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() = fcl::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
    pose.translation() = fcl::Vector3d(x, y, z);
    objects.emplace_back(model, pose);
  }
  return objects;
}

class FclMeshPairs final : public PairPeer {
 public:
  FclMeshPairs(const PeerBodies& a, const PeerBodies& b, size_t most_contacts)
      : a_(make_objects(a)), b_(make_objects(b)) {
    request_.enable_contact = true;
    request_.num_max_contacts = most_contacts;
  }

  // The depths that FCL gives belong to single triangles.
  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.size(); ++i) {
      fcl::CollisionResultd result;
      fcl::collide(&a_[i], &b_[i], request_, result);
      answers.overlaps[i] = result.isCollision() ? 1 : 0;
      answers.separations[i] = kNotReported;
    }
  }

 private:
  const std::vector<fcl::CollisionObjectd> a_, b_;
  fcl::CollisionRequestd request_;
};

}  // namespace

std::unique_ptr<PairPeer> make_fcl_mesh_pairs(const PeerBodies& a, const PeerBodies& b,
                                              PeerDetail /*detail*/) {
  return std::make_unique<FclMeshPairs>(a, b, kAllContacts);
}

std::unique_ptr<PairPeer> make_fcl_first_mesh_pairs(const PeerBodies& a, const PeerBodies& b,
                                                    PeerDetail /*detail*/) {
  return std::make_unique<FclMeshPairs>(a, b, 1);
}

}  // namespace carom::bench
