// Feeds the frames of a scene to worlds.
#pragma once

#include <string>
#include <vector>

#include "carom/world/world.h"
#include "cli/support/pair_kinds.h"
#include "io/scene.h"

namespace carom::cli {

class Player {
 public:
  // Fails as convert_shapes() does. `info` has to live as long as the player; `source` names it in
  // errors.
  static Result<Player> create(const io::SceneInfo& info, const std::string& source);

  const io::SceneInfo& info() const { return *info_; }
  PositionType positions() const;
  // How many bodies have which kind.
  BodiesOfKind bodies_of_kind() const;
  // The arrays of a frame that are read at this detail, by worlds that look ahead or do not.
  io::SceneArrays wanted(Detail detail, bool looks_ahead = false) const;

  // The first frame of a world: adds all bodies in the order of the file, so that the index of a
  // body is its index in the file. Dynamic ones are looked after as `detection` says.
  void start(const io::SceneFrame& frame, World& world,
             Detection detection = Detection::discrete) const;
  // Any later frame: writes poses, and boxes of recordings, straight into the arrays.
  void move(const io::SceneFrame& frame, World& world) const;

  // Body `index` as it is in this frame.
  BodyDesc body(const io::SceneFrame& frame, size_t index) const;

 private:
  Player(const io::SceneInfo& info, std::vector<Shape> shapes);

  Shape shape(const io::SceneFrame& frame, size_t index) const;
  void write_boxes(const io::SceneFrame& frame, World& world) const;
  void write_orientations(const io::SceneFrame& frame, World& world) const;
  void write_velocities(const io::SceneFrame& frame, World& world) const;

  const io::SceneInfo* info_;
  std::vector<Shape> shapes_;
  bool oriented_;  // some body has a kind whose orientation matters, and the scene gives it
};

}  // namespace carom::cli
