// The data of the scene page: a world after a step.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "carom/world/world.h"

namespace carom::cli {

// Shapes, bodies and contacts in columns, and the distances of contact points from the surfaces.
// Leaves out bodies that the step left out. Needs a detail with contacts.
nlohmann::ordered_json view_of(const World& world, const std::string& scene, uint64_t frame);

}  // namespace carom::cli
