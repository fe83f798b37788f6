// The system that `carom verify` compares with the scalar reference: Carom by default. A test
// passes a broken one to see that its faults are found.
#pragma once

#include <memory>
#include <span>

#include "carom/impacts/time_of_impact.h"
#include "carom/narrowphase/collide.h"
#include "cli/scenes/player.h"

namespace carom::cli {

// The results of one frame.
struct FrameView {
  std::span<const Pair> pairs;
  std::span<const uint8_t> overlaps;
  std::span<const Contact> contacts;
  std::span<const ManifoldPoints> manifolds;
  std::span<const Event> events;
  std::span<const BodyId> quarantined;
};

// Plays a scene into a world.
class Stepper {
 public:
  virtual ~Stepper() = default;
  // Plays the next frame; the view is valid until the next call.
  virtual FrameView step(const io::SceneFrame& frame) = 0;
};

class System {
 public:
  virtual ~System() = default;
  virtual std::unique_ptr<Stepper> make_stepper(const Player& player,
                                                const WorldSettings& settings);
  virtual Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                                    const ResultColumns& out, WitnessFrame frame,
                                    Parallelism parallelism, Tier tier);
  virtual Result<void> collide(const Collidables& a, const Collidables& b,
                               std::span<const Pair> pairs, Detail detail, const ResultColumns& out,
                               WitnessFrame frame, Parallelism parallelism, Tier tier);
  virtual Result<void> time_of_impact(const Collidables& a, const SweepView& sweep_a,
                                      const Collidables& b, const SweepView& sweep_b,
                                      std::span<const Pair> pairs, const ImpactColumns& out,
                                      WitnessFrame frame, Parallelism parallelism);
};

}  // namespace carom::cli
