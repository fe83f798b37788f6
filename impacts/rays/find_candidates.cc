// Searches meshes for the triangles that rays may touch first: rays that lie close to one another
// together, others side by side.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/rays/find_candidates.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <memory>
#include <vector>

#include "impacts/rays/ray_in_mesh.h"
#include "impacts/rays/ray_packet-inl.h"
#include "impacts/rays/ray_walks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct RayScratch {
  RayPacket packet;
  RayWalks walks;
  std::vector<RaySearch*> single;
};

void find_ray_candidates(std::span<RaySearch> searches, bool any) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<RayScratch>();
  scratch->single.clear();
  for (size_t i = 0; i < searches.size(); i += RayPacket::kMost) {
    const auto group = searches.subspan(i, std::min(RayPacket::kMost, searches.size() - i));
    if (scratch->packet.set(group)) {
      scratch->packet.run(any);
    } else {
      for (RaySearch& search : group) scratch->single.push_back(&search);
    }
  }
  scratch->walks.run(scratch->single, any);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_ray_candidates);

}  // namespace

void find_candidates(std::span<RaySearch> searches, bool any) {
  CAROM_DISPATCH(find_ray_candidates)(searches, any);
}

}  // namespace carom
#endif  // HWY_ONCE
