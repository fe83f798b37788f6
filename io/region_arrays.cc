#include "io/region_arrays.h"

#include <span>

namespace carom::io {

Result<void> write_regions(NpzWriter& writer, const RegionArrays& regions) {
  const uint64_t count = regions.separation.size();
  const float* const points = count > 0 ? regions.point[0].data() : nullptr;
  Result<void> done =
      writer.add("region_first", std::span<const uint64_t>(regions.first), {regions.first.size()});
  if (done) done = writer.add("region_normal", regions.normal);
  if (done) {
    done = writer.add("region_separation", std::span<const float>(regions.separation), {count});
  }
  if (done) done = writer.add("region_part", regions.part);
  if (done) {
    done = writer.add("region_point_count", std::span<const uint8_t>(regions.point_count), {count});
  }
  if (done) done = writer.add("region_point", std::span(points, 12 * count), {count, 4, 3});
  if (done) done = writer.add("region_point_separation", regions.point_separation);
  return done;
}

}  // namespace carom::io
