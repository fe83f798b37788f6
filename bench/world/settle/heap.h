// The bodies of a scene under gravity, moved by the solver of examples/rigid_solver.h.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "cli/scenes/player.h"
#include "examples/rigid_solver.h"
#include "io/scene.h"

namespace carom::bench {

// Where bodies fall between two frames: along -y if they go further down there than along z,
// otherwise along -z.
Eigen::Vector3f find_down(const cli::Player& player, const io::SceneFrame& first,
                          const io::SceneFrame& last);

class Heap {
 public:
  // Dynamic bodies start as they are in this frame. All others stay there: kinematic ones, which
  // nobody moves here, and sensors, which would fall for ever.
  Heap(const cli::Player& player, const io::SceneFrame& start,
       const rigid::SolverSettings& settings);

  // One frame. No body is ever put to sleep.
  void step();

  const World& world() const { return solver_.world(); }
  std::span<const BodyId> moving() const { return moving_; }

  // A frame of the scene, with orientations and velocities of all bodies.
  void write(io::SceneFrame& frame) const;

 private:
  void add(const BodyDesc& body);

  rigid::Solver solver_;
  std::vector<BodyId> moving_;
  // A world does not keep orientations of balls, though a picture shows how they roll.
  std::vector<Eigen::Quaternionf> orientation_;
};

}  // namespace carom::bench
