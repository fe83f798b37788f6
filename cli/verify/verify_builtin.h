// The built-in checks of `carom verify`: small scenes of every generator and random pairs of every
// kind, at rest and moving, including ill-formed bodies.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cli/pairs/pair_set.h"
#include "io/scene.h"

namespace carom::cli {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct BuiltinScene {
  std::string name;
  std::unique_ptr<io::SceneReader> scene;
};
std::vector<BuiltinScene> builtin_scenes();

struct BuiltinPairs {
  std::string name;
  PairSet pairs;
};
std::vector<BuiltinPairs> builtin_pairs();
// Moving pairs.
std::vector<BuiltinPairs> builtin_motions();

}  // namespace carom::cli
