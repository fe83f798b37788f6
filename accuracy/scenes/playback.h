// A scene that can be played into worlds any number of times.
#pragma once

#include <cstddef>
#include <string>

#include "carom/world/world.h"

namespace carom::accuracy {

class Playback {
 public:
  virtual ~Playback() = default;

  virtual const std::string& name() const = 0;
  virtual size_t frames() const = 0;
  virtual PositionType positions() const = 0;
  // Puts the first frame into an empty world: adds all bodies, body i of the scene at index i.
  virtual void start(World& world) const = 0;
  // Moves the bodies to a later frame, counted from 1.
  virtual void move(size_t frame, World& world) const = 0;
};

}  // namespace carom::accuracy
