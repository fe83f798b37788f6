// Pairs with k-DOPs: the kernels of hulls, on the hulls of their corners.
#include "narrowphase/pairs/dop/hull_side.h"

namespace carom {

void run_sphere_dop(const Batch& batch) { run_with_hulls(batch, {.b = true}, run_sphere_hull); }
void run_capsule_dop(const Batch& batch) { run_with_hulls(batch, {.b = true}, run_capsule_hull); }
void run_aabb_dop(const Batch& batch) { run_with_hulls(batch, {.b = true}, run_aabb_hull); }
void run_box_dop(const Batch& batch) { run_with_hulls(batch, {.b = true}, run_box_hull); }
void run_dop_dop(const Batch& batch) { run_with_hulls(batch, {true, true}, run_hull_hull); }
void run_dop_hull(const Batch& batch) { run_with_hulls(batch, {.a = true}, run_hull_hull); }
void run_dop_halfspace(const Batch& batch) {
  run_with_hulls(batch, {.a = true}, run_hull_halfspace);
}
void run_dop_triangle(const Batch& batch) { run_with_hulls(batch, {.a = true}, run_hull_triangle); }

}  // namespace carom
