// Balls in place of shapes.
#pragma once

#include <memory>

#include "accuracy/tiers/contenders.h"

namespace carom::accuracy {

// Every body but half-spaces is the ball about its position that holds its shape.
std::unique_ptr<Contender> make_proxy_spheres();

}  // namespace carom::accuracy
