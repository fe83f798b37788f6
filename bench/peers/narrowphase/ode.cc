// ODE: dCollide() of two geoms, with its own formulas for spheres, capsules and boxes. Its convex
// shapes take planes that a caller must find, and are left out; it has no distances.
#include <ode/ode.h>

#include <cmath>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

struct Library {
  Library() { dInitODE2(0); }
  ~Library() { dCloseODE(); }
};

dGeomID make_geom(PeerShape shape, const std::array<float, 9>& size) {
  if (shape == PeerShape::sphere) return dCreateSphere(nullptr, size[0]);
  if (shape == PeerShape::capsule) return dCreateCapsule(nullptr, size[0], 2 * size[1]);
  return dCreateBox(nullptr, 2 * size[0], 2 * size[1], 2 * size[2]);
}

// ODE's capsules lie along z, those of the streams along y: a quarter turn about x leads there.
void turn(PeerShape shape, const std::array<float, 4>& q, dQuaternion turned) {
  const dQuaternion stated = {q[3], q[0], q[1], q[2]};
  dQuaternion first = {1, 0, 0, 0};
  if (shape == PeerShape::capsule) dQFromAxisAndAngle(first, 1, 0, 0, -M_PI / 2);
  dQMultiply0(turned, stated, first);
}

class Bodies {
 public:
  explicit Bodies(const PeerBodies& source) {
    for (const PeerBody& body : source.bodies) {
      const dGeomID geom = make_geom(source.shape, body.size);
      const auto& p = body.position;
      dQuaternion q;
      turn(source.shape, body.orientation, q);
      dGeomSetPosition(geom, p[0], p[1], p[2]);
      dGeomSetQuaternion(geom, q);
      geoms_.push_back(geom);
    }
  }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;
  ~Bodies() {
    for (const dGeomID geom : geoms_) dGeomDestroy(geom);
  }

  size_t count() const { return geoms_.size(); }
  dGeomID geom(size_t i) const { return geoms_[i]; }

 private:
  std::vector<dGeomID> geoms_;
};

class OdePairs final : public PairPeer {
 public:
  OdePairs(const PeerBodies& a, const PeerBodies& b, PeerDetail detail) : a_(a), b_(b) {
    // Not CONTACTS_UNIMPORTANT for decisions: with it one in six boxes that overlap has no contact.
    flags_ = detail == PeerDetail::manifold ? kMostContacts : 1;
  }

  void run(PairAnswers& answers) override {
    std::array<dContactGeom, kMostContacts> contacts;
    for (size_t i = 0; i < a_.count(); ++i) {
      const int found =
          dCollide(a_.geom(i), b_.geom(i), flags_, contacts.data(), sizeof contacts[0]);
      answers.overlaps[i] = found > 0 ? 1 : 0;
      float separation = kNotReported;
      for (int contact = 0; contact < found; ++contact) {
        const dReal depth = contacts[static_cast<size_t>(contact)].depth;
        separation = std::fmin(separation, static_cast<float>(-depth));
      }
      answers.separations[i] = separation;
    }
  }

 private:
  static constexpr int kMostContacts = 4;

  const Library library_;
  const Bodies a_, b_;
  int flags_;
};

bool is_known(PeerShape shape) {
  return shape == PeerShape::sphere || shape == PeerShape::capsule || shape == PeerShape::box;
}

}  // namespace

std::unique_ptr<PairPeer> make_ode_pairs(const PeerBodies& a, const PeerBodies& b,
                                         PeerDetail detail) {
  if (!is_known(a.shape) || !is_known(b.shape) || detail == PeerDetail::distance) return nullptr;
  return std::make_unique<OdePairs>(a, b, detail);
}

}  // namespace carom::bench
