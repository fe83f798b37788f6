#include "cli/verify/verify_system.h"

namespace carom::cli {
namespace {

class WorldStepper : public Stepper {
 public:
  WorldStepper(const Player& player, const WorldSettings& settings)
      : player_(player), world_(settings) {}

  FrameView step(const io::SceneFrame& frame) override {
    if (started_) {
      player_.move(frame, world_);
    } else {
      player_.start(frame, world_);
    }
    started_ = true;
    world_.step();
    return {world_.pairs(),     world_.overlaps(), world_.contacts(),
            world_.manifolds(), world_.events(),   world_.quarantined()};
  }

 private:
  const Player& player_;
  World world_;
  bool started_ = false;
};

}  // namespace

std::unique_ptr<Stepper> System::make_stepper(const Player& player, const WorldSettings& settings) {
  return std::make_unique<WorldStepper>(player, settings);
}

Result<void> System::collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                                  const ResultColumns& out, WitnessFrame frame,
                                  Parallelism parallelism, Tier tier) {
  return carom::collide_rows(
      a, b, detail, out, {.frame = frame, .parallelism = parallelism, .accuracy = {.tier = tier}});
}

Result<void> System::collide(const Collidables& a, const Collidables& b,
                             std::span<const Pair> pairs, Detail detail, const ResultColumns& out,
                             WitnessFrame frame, Parallelism parallelism, Tier tier) {
  return carom::collide(a, b, pairs, detail, out,
                        {.frame = frame, .parallelism = parallelism, .accuracy = {.tier = tier}});
}

Result<void> System::time_of_impact(const Collidables& a, const SweepView& sweep_a,
                                    const Collidables& b, const SweepView& sweep_b,
                                    std::span<const Pair> pairs, const ImpactColumns& out,
                                    WitnessFrame frame, Parallelism parallelism) {
  return carom::time_of_impact(a, sweep_a, b, sweep_b, pairs, out,
                               {.frame = frame, .parallelism = parallelism});
}

}  // namespace carom::cli
