// Judges casts whose hits differ, with separations by brute force in long double.
#pragma once

#include <cstddef>

#include "bench/peers/queries/cast_scene.h"

namespace carom::bench {

struct Judgement {
  // Metres: the gap at the peer's hit if it is early, else how deep the query is on the way from
  // Carom's hit to the peer's, or to the end.
  double error_of_peer = 0;
  // The query overlaps a body before Carom's hit, or touches none at it.
  bool carom_is_wrong = false;
};

class Referee {
 public:
  explicit Referee(const CastWorld& world);

  // Times of hits, above 1 if there is none.
  Judgement judge(const CastBody& query, const std::array<float, 3>& displacement, float carom,
                  float peer) const;
  // Whether the query touches a body at this time, but for the rounding of the time.
  bool touches(const CastBody& query, const std::array<float, 3>& displacement, float time) const;

 private:
  struct Item {
    Eigen::Vector3d middle;
    double radius;  // of a ball around it
    Shape shape;
    Pose pose;
  };

  // The least separation from all bodies and triangles, if it is below kNear.
  double separation(const CastBody& query, const std::array<float, 3>& displacement,
                    double time) const;

  const CastWorld& world_;
  std::vector<Item> items_;
};

}  // namespace carom::bench
