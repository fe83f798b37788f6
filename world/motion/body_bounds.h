// The bounds of all bodies, by index.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "carom/base/parallelism.h"
#include "carom/bounds/bounds.h"
#include "carom/shapes/body.h"
#include "carom/shapes/views.h"
#include "world/pairs/halfspace_stage.h"
#include "world/store/body_store.h"

namespace carom {

// Rows without a body, bodies that are not valid and half-spaces have an empty box. Half-spaces go
// to their stage.
class BodyBounds {
 public:
  void update_all(BodyStore& bodies, Parallelism parallelism, HalfspaceStage& halfspaces);

  // Does the same where only the bodies at these indices, ascending, differ from the last update.
  void update(const BodyStore& bodies, std::span<const uint32_t> changed,
              HalfspaceStage& halfspaces);

  // Grows the boxes of these bodies by these metres, outwards for certain. Empty boxes stay.
  void grow(std::span<const uint32_t> bodies, std::span<const float> metres,
            Parallelism parallelism);

  BoundsView view() const;
  // The bodies that are not valid, by index.
  const std::vector<BodyId>& quarantined() const { return quarantined_; }

  void give_back();
  size_t bytes() const;  // without those of quarantined()

 private:
  void resize(size_t rows);
  void clear_box(size_t index);
  BoundsColumns columns_to_write();

  std::array<LargeVector<float>, 6> columns_;  // lower corners, then upper ones
  std::vector<BodyId> quarantined_;
};

}  // namespace carom
