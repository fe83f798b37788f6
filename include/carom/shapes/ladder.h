/// @file
/// Ladders: simpler models of a shape, each with its proved distance from it.
#pragma once

#include <memory>

namespace carom {

struct Ladder;  // carom/shapes/rungs.h

/// A ladder that shapes share; nullptr: they have none.
using LadderPtr = std::shared_ptr<const Ladder>;

}  // namespace carom
