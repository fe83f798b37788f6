// Reduces many contact points to at most four: the scalar form.
#pragma once

#include "narrowphase/manifolds/clip_scalar.h"

namespace carom::scalar {

// Up to four points: the deepest, the point farthest from it, and on each side of the line through
// both the point farthest from that line. `limit`: the squared distance below which points count as
// one.
inline ClipPoints reduce(const ClipPoints& all, float limit) {
  if (all.empty()) return {};
  ClipPoint first = all[0];
  for (const ClipPoint& c : all) {
    if (c.s < first.s) first = c;
  }
  ClipPoint second = first;
  float farthest = 0;
  for (const ClipPoint& c : all) {
    const float dx = c.x - first.x, dy = c.y - first.y;
    const float squared = dx * dx + dy * dy;
    if (squared > farthest) {
      farthest = squared;
      second = c;
    }
  }
  if (!(farthest > limit)) return {first};
  ClipPoint left = first, right = first;
  float most = 0, least = 0;
  for (const ClipPoint& c : all) {
    const float area = area_left(xy(first), xy(second), c.x, c.y);
    if (area > most) {
      most = area;
      left = c;
    }
    if (area < least) {
      least = area;
      right = c;
    }
  }
  ClipPoints few = {first, second};
  if (most * most > limit * farthest) few.push_back(left);
  if (least * least > limit * farthest) few.push_back(right);
  return few;
}

}  // namespace carom::scalar
