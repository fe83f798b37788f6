#include "world/store/dop_geometries.h"

#include <algorithm>
#include <string_view>

#include "shapes/dop_geometry.h"

namespace carom {
namespace {

size_t hash_of(const Dop& dop) {
  const auto rows = shape_rows(dop);
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(rows.data()), sizeof rows});
}

}  // namespace

std::shared_ptr<const DopGeometry> DopGeometries::find(const Dop& dop) {
  if (known_geometry(dop)) return dop.geometry;
  const size_t hash = hash_of(dop);
  const auto [begin, end] = known_.equal_range(hash);
  for (auto known = begin; known != end; ++known) {
    const std::shared_ptr<const DopGeometry> geometry = known->second.lock();
    if (geometry && geometry->is_of(dop)) return geometry;
  }
  const std::shared_ptr<const DopGeometry> geometry = dop_geometry(dop);
  if (!geometry) return nullptr;
  if (known_.size() == most_known_) forget_lost();
  known_.emplace(hash, geometry);
  return geometry;
}

void DopGeometries::forget_lost() {
  std::erase_if(known_, [](const auto& known) { return known.second.expired(); });
  most_known_ = std::max<size_t>(16, 2 * known_.size());
}

size_t DopGeometries::bytes() const {
  size_t sum = 0;
  for (const auto& known : known_) {
    if (const auto geometry = known.second.lock()) sum += geometry->bytes();
  }
  return sum;
}

}  // namespace carom
