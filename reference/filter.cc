// The filter on pairs.
#include "carom/reference/reference.h"

namespace carom::reference {

bool may_meet(const BodyDesc& a, const BodyDesc& b) {
  const bool layers_agree = (a.layer & b.mask) != 0 && (b.layer & a.mask) != 0;
  const bool share_owner = a.owner != 0 && a.owner == b.owner;
  const bool both_fixed = a.motion == Motion::fixed && b.motion == Motion::fixed;
  return layers_agree && !share_owner && !both_fixed;
}

}  // namespace carom::reference
