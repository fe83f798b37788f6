// What `carom verify` checks without arguments: small scenes of every generator and random pairs of
// every kind, at rest and moving, ill-formed bodies included.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/pairs/pair_set.h"
#include "io/scene.h"

namespace carom::cli {

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
// Pairs that move.
std::vector<BuiltinPairs> builtin_motions();

}  // namespace carom::cli
