// The first frames of a scene in memory, which can be played any number of times.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/scenes/playback.h"
#include "cli/scenes/player.h"
#include "io/scene.h"

namespace carom::cli {

class LoadedScene : public accuracy::Playback {
 public:
  // Opens a scene named as on the command line and loads its first frame. Loads all velocities if
  // worlds look ahead.
  static Result<std::unique_ptr<LoadedScene>> open(const std::string& source,
                                                   bool looks_ahead = false);

  // Reads until `frames` frames are loaded, the scene ends, or about `bytes` bytes are used.
  Result<void> load(size_t frames, size_t bytes = size_t{1} << 28);

  // As Player::add_ladders().
  Result<std::vector<LadderReport>> add_ladders(std::span<const double> errors) {
    return player_.add_ladders(errors);
  }

  const Player& player() const { return player_; }
  const io::SceneInfo& info() const { return scene_->info(); }
  const io::SceneFrame& frame(size_t index) const { return frames_[index]; }

  const std::string& name() const override { return name_; }
  size_t frames() const override { return frames_.size(); }
  PositionType positions() const override { return player_.positions(); }
  void start(World& world) const override { player_.start(frames_.front(), world); }
  void move(size_t frame, World& world) const override { player_.move(frames_[frame], world); }

 private:
  LoadedScene(std::string name, std::unique_ptr<io::SceneReader> scene, Player player)
      : name_(std::move(name)), scene_(std::move(scene)), player_(std::move(player)) {}

  std::string name_;
  std::unique_ptr<io::SceneReader> scene_;
  Player player_;
  std::vector<io::SceneFrame> frames_;
};

}  // namespace carom::cli
