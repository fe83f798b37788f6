// The filter on pairs.
#include "carom/reference/reference.h"

namespace carom::reference {
namespace {

bool layers_allow(const BodyDesc& a, const BodyDesc& b, FilterRule rule) {
  const bool b_lets_a = (a.layer & b.mask) != 0;
  const bool a_lets_b = (b.layer & a.mask) != 0;
  return rule == FilterRule::both ? b_lets_a && a_lets_b : b_lets_a || a_lets_b;
}

}  // namespace

bool may_meet(const BodyDesc& a, const BodyDesc& b, FilterRule rule) {
  const bool both_fixed = a.motion == Motion::fixed && b.motion == Motion::fixed;
  const bool share_owner = a.owner != 0 && a.owner == b.owner;
  const bool share_group = a.group != 0 && a.group == b.group;
  if (both_fixed || share_owner || a.space != b.space) return false;
  return share_group ? a.group > 0 : layers_allow(a, b, rule);
}

}  // namespace carom::reference
