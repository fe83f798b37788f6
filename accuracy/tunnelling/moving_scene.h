// A scene whose bodies have velocities in every frame.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "carom/results/pair.h"
#include "carom/shapes/body.h"

namespace carom::accuracy {

class MovingScene {
 public:
  virtual ~MovingScene() = default;

  virtual const std::string& name() const = 0;
  virtual size_t frames() const = 0;
  virtual PositionType positions() const = 0;
  virtual double dt() const = 0;
  // The same bodies in the same order in every frame, with velocities.
  virtual std::vector<BodyDesc> bodies(size_t frame) const = 0;
  // The pairs of bodies that never meet, sorted.
  virtual std::span<const Pair> excluded() const = 0;
};

}  // namespace carom::accuracy
