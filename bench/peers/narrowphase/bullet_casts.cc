#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bench/peers/narrowphase/bullet_bodies.h"

namespace carom::bench {
namespace {

// Bullet's casts, constructed for every pair, as in its world.
class ContinuousCast {
 public:
  btContinuousConvexCollision operator()(const btConvexShape* a, const btConvexShape* b) {
    return {a, b, &simplex_, &depth_};
  }

 private:
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
};

class GjkCast {
 public:
  btGjkConvexCast operator()(const btConvexShape* a, const btConvexShape* b) {
    return {a, b, &simplex_};
  }

 private:
  btVoronoiSimplexSolver simplex_;
};

btMatrix3x3 turned(const btTransform& pose, const std::vector<std::array<float, 3>>& turns,
                   size_t i) {
  if (turns.empty()) return pose.getBasis();
  const btVector3 turn = bullet_vector(turns[i].data());
  const btScalar angle = turn.length();
  if (angle == 0) return pose.getBasis();
  return btMatrix3x3(btQuaternion(turn / angle, angle)) * pose.getBasis();
}

template <class MakeCast>
class CastPairs final : public PairPeer {
 public:
  CastPairs(const PeerBodies& a, const PeerBodies& b, PeerMotions motions)
      : a_(a), b_(b), motions_(std::move(motions)) {}

  void run(PairAnswers& impacts) override {
    for (size_t i = 0; i < a_.count(); ++i) {
      const btTransform& a = a_.transform(i);
      const btTransform& b = b_.transform(i);
      const btTransform a_end(turned(a, motions_.turns_a, i), a.getOrigin());
      const btTransform b_end(turned(b, motions_.turns_b, i),
                              b.getOrigin() + bullet_vector(motions_.displacements[i].data()));
      auto cast =
          make_(static_cast<btConvexShape*>(a_.shape(i)), static_cast<btConvexShape*>(b_.shape(i)));
      btConvexCast::CastResult result;
      const bool meets = cast.calcTimeOfImpact(a, a_end, b, b_end, result);
      impacts.overlaps[i] = meets && result.m_fraction <= 1 ? 1 : 0;
      impacts.separations[i] = kNotReported;
    }
  }

 private:
  BulletBodies a_;
  BulletBodies b_;
  const PeerMotions motions_;
  MakeCast make_;
};

}  // namespace

std::unique_ptr<PairPeer> make_bullet_casts(const PeerBodies& a, const PeerBodies& b,
                                            PeerMotions motions, PeerCast cast) {
  if (cast == PeerCast::gjk) {
    return std::make_unique<CastPairs<GjkCast>>(a, b, std::move(motions));
  }
  return std::make_unique<CastPairs<ContinuousCast>>(a, b, std::move(motions));
}

}  // namespace carom::bench
