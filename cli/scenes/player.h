// Feeds the frames of a scene to worlds.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "carom/ladders/build_ladder.h"
#include "carom/world/world.h"
#include "cli/support/pair_kinds.h"
#include "io/scene.h"

namespace carom::cli {

class Player {
 public:
  // Fails if convert_shapes() fails. `info` must outlive the player; errors name `source`.
  static Result<Player> create(const io::SceneInfo& info, const std::string& source);

  // Gives the shapes of the scene ladders with rungs of these errors, for worlds with a tolerance.
  // Returns one report a shape that could have one.
  Result<std::vector<LadderReport>> add_ladders(std::span<const double> errors);

  const io::SceneInfo& info() const { return *info_; }
  PositionType positions() const;
  // The number of bodies of each kind.
  BodiesOfKind bodies_of_kind() const;
  // The pairs that never meet, sorted.
  std::span<const Pair> excluded() const { return excluded_; }
  // The arrays of a frame that worlds at this detail read; velocities if they look ahead.
  io::SceneArrays wanted(Detail detail, bool looks_ahead = false) const;

  // Puts the first frame into a world: adds all bodies in the order of the file, so that a body's
  // index is its index in the file. Dynamic bodies get this detection.
  void start(const io::SceneFrame& frame, World& world,
             Detection detection = Detection::discrete) const;
  // Puts a later frame into a world: writes poses, and boxes of recordings, straight into the
  // arrays.
  void move(const io::SceneFrame& frame, World& world) const;

  // Body `index` in this frame.
  BodyDesc body(const io::SceneFrame& frame, size_t index) const;

 private:
  Player(const io::SceneInfo& info, std::vector<Shape> shapes);

  Shape scene_shape(size_t index) const;
  bool reads_orientations() const;
  Shape shape(const io::SceneFrame& frame, size_t index) const;
  void write_boxes(const io::SceneFrame& frame, World& world) const;
  void write_orientations(const io::SceneFrame& frame, World& world) const;
  void write_velocities(const io::SceneFrame& frame, World& world) const;

  const io::SceneInfo* info_;
  std::vector<Shape> shapes_;  // empty if the parameters in `info` say all of every shape
  std::vector<Pair> excluded_;
  bool oriented_;  // the scene has orientations and some body's kind reads them
};

}  // namespace carom::cli
