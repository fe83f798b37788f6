// A scene of examples/rigid_scenes.h in Bullet's own world: its contacts, its solver.
#pragma once

#include <memory>

#include "examples/rigid_scenes.h"

namespace carom::bench {

class BulletScene {
 public:
  // Takes over shapes, poses, masses, friction and joints. A frame of 1/60 s is `substeps` steps of
  // Bullet. Bodies never sleep.
  BulletScene(const rigid::Scene& scene, int substeps);
  ~BulletScene();

  void step();
  // World frame, metres.
  Eigen::Vector3d position(BodyId id) const;
  // Metres a second.
  double speed(BodyId id) const;
  // The deepest overlap of the last step as Bullet sees it, metres, >= 0.
  double deepest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom::bench
