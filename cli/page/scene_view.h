// What the page of a scene shows of a world after a step.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "carom/world/world.h"

namespace carom::cli {

// Shapes, bodies and contacts in columns, and how far the contact points are from the surfaces.
// Bodies that were left out of the step are not in it. At details with contacts.
nlohmann::ordered_json view_of(const World& world, const std::string& scene, uint64_t frame);

}  // namespace carom::cli
