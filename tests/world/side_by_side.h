// Several worlds with the same bodies and the same changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/world/crowds.h"

namespace carom::test {

// Crowds and settings that vary with the seed.
CrowdSpec varied_crowd(uint64_t seed, size_t count = 200);

WorldSettings varied_settings(uint64_t seed);

// Makes a triangle two-sided and without inner edges, so that it is a convex set.
Shape plain(Shape shape);

class SideBySide {
 public:
  SideBySide(std::span<const WorldSettings> settings, const CrowdSpec& spec);

  World& operator[](size_t i) { return worlds_[i]; }

  // Most bodies move by up to `distance` metres and turn by up to half as many radians.
  void creep(double distance);

  // Gives every third body a tolerance of its own, from 0 to four times `metres`, in all worlds.
  void set_tolerances(float metres);

  // Makes earlier results worthless: bodies are added, removed, teleported and changed, some
  // through the arrays.
  void disturb();

  void step();

 private:
  template <class Change>
  void each(const Change& change) {
    for (World& world : worlds_) change(world);
  }

  BodyId pick() { return ids_[random_.below(ids_.size())]; }

  void add(const BodyDesc& body);

  void remove();

  // The result need not be a unit quaternion, and has either sign.
  Eigen::Quaternionf turned(const Eigen::Quaternionf& q, double most);

  static void scale_in_arrays(World& world, BodyId id, float factor);

  Random random_;
  CrowdSpec spec_;
  std::vector<BodyDesc> crowd_;
  std::vector<World> worlds_;
  std::vector<BodyId> ids_;
};

}  // namespace carom::test
