// Bullet as a contender, if the program was built with it (CAROM_BUILD_PEERS).
#pragma once

#include <memory>

#include "accuracy/tiers/contenders.h"

namespace carom::accuracy {

#ifdef CAROM_HAS_BULLET
std::unique_ptr<Contender> make_bullet();
#else
inline std::unique_ptr<Contender> make_bullet() { return nullptr; }
#endif

}  // namespace carom::accuracy
