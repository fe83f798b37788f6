// Kinds whose bounds and tests take no more than a few nanoseconds.
#pragma once

#include "carom/shapes/views.h"

namespace carom {

// Whether all bodies are spheres, or all are aabbs.
inline bool have_quick_kind(const Collidables& bodies) {
  return !bodies.kind &&
         (bodies.uniform_kind == ShapeKind::sphere || bodies.uniform_kind == ShapeKind::aabb);
}

}  // namespace carom
