// A contender that replaces shapes by their bounding spheres.
#pragma once

#include <memory>

#include "accuracy/tiers/contenders.h"

namespace carom::accuracy {

// Replaces every body except half-spaces by the ball about its position that contains its shape.
std::unique_ptr<Contender> make_proxy_spheres();

}  // namespace carom::accuracy
