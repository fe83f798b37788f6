// Geometries of k-DOPs, one for all that are equal.
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_map>

#include "carom/shapes/dop.h"

namespace carom {

class DopGeometries {
 public:
  // The geometry of the k-DOP: its own, that of an equal one that somebody still keeps, or a new
  // one. nullptr if the k-DOP is not valid.
  std::shared_ptr<const DopGeometry> find(const Dop& dop);

  // Of the geometries that somebody keeps.
  size_t bytes() const;
  size_t known() const { return known_.size(); }

 private:
  void forget_lost();

  std::unordered_multimap<size_t, std::weak_ptr<const DopGeometry>> known_;  // by hash of the slabs
  size_t most_known_ = 16;  // the count at which to look for those that nobody keeps
};

}  // namespace carom
