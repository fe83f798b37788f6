// A view of some of the bodies of a view.
#pragma once

#include "carom/shapes/views.h"

namespace carom {

// The address so many bytes further on; nullptr stays.
template <class T>
const T* further(const T* base, size_t bytes) {
  if (!base) return nullptr;
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(base) + bytes);
}

// Bodies [first, first + count), at least one; the first of them gets index 0.
inline Collidables run_of_bodies(const Collidables& bodies, size_t first, size_t count) {
  Collidables run = bodies;
  run.count = count;
  run.position.data =
      further(static_cast<const char*>(bodies.position.data), first * bodies.position.stride);
  run.position.radius = further(bodies.position.radius, first * bodies.position.radius_stride);
  run.orientation.data = further(bodies.orientation.data, first * bodies.orientation.stride);
  if (bodies.kind) run.kind += first;
  if (bodies.dops) run.dops += first;
  if (bodies.box_slot) {
    run.box_slot += first;
  } else {
    for (size_t axis = 0; axis < 3; ++axis) {
      run.boxes.lower[axis] = further(bodies.boxes.lower[axis], first * bodies.boxes.stride);
      run.boxes.upper[axis] = further(bodies.boxes.upper[axis], first * bodies.boxes.stride);
    }
  }
  if (bodies.rows.first) {
    run.rows.first += first;
  } else if (bodies.rows.data) {
    // All bodies have one kind.
    run.rows.data += 4 * first * row_count(bodies.kind ? bodies.kind[first] : bodies.uniform_kind);
  }
  return run;
}

}  // namespace carom
