// The data of the scene page: a world after a step.
#pragma once

#include <cstdint>
#include <string>

#include "carom/world/world.h"
#include "cli/page/motion_track.h"

namespace carom::cli {

// Shapes, bodies and contacts in columns, and how far the contact points are from the surfaces.
// Bodies that were left out of the step are not in it. At details with contacts. The poses of other
// frames are those of the track, `dt` seconds apart. The text of one JSON object; infinite numbers
// are null.
std::string view_of(const World& world, const std::string& scene, uint64_t frame,
                    const MotionTrack& track, double dt);

}  // namespace carom::cli
