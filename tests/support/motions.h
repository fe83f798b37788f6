// Random pairs of moving bodies of every two kinds, in families that say in which respects the
// motions are hard.
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "oracle/convex_random.h"
#include "oracle/motion_oracle.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/show.h"

namespace carom::test {

struct MovedPair {
  TestPair bodies;
  Sweep sweep_a;
  Sweep sweep_b;
};

MovedPair swapped(const MovedPair& pair);

template <class R>
MovingPair<R> moving_pair(const MovedPair& pair);

Judgement judge(const MovedPair& pair, float toi);

// Judges a time that may be early by any amount.
Judgement judge_bound(const MovedPair& pair, float toi);

// Brackets the time of impact; long double where double cannot decide.
ImpactBracket<double> impact(const MovedPair& pair);

std::string show(const MovedPair& pair);

enum class MotionPlan {
  aimed,       // towards each other, or past each other
  grazing,     // the least separation is within 1e-12 to 1e-3 sizes of zero
  sliding,     // starts within that distance of touching, and moves nearly along the surface
  touching,    // starts within that distance of touching, and moves in any direction
  parting,     // starts separate, and moves away
  coincident,  // starts at the same position
  crossing,    // an edge of each meets the other's, or misses it by that distance, while both turn
};

struct MotionFamily {
  const char* name;
  MotionPlan plan = MotionPlan::aimed;
  PositionType positions = PositionType::float32;
  double smallest = 0.5;  // sizes, log-uniform
  double largest = 2;
  double ratio = 1;              // greatest ratio of the two sizes
  double aspect = 4;             // greatest ratio of lengths, radii and half extents
  double least_travel = 4;       // displacements in sizes, log-uniform
  double most_travel = 20;       // 0: none
  double most_turn = 0;          // greatest rotation of each body, radians
  double distance = 0;           // of A from the origin, in sizes
  bool degenerate = false;       // zero radii, zero lengths, flat boxes, triangles without area
  bool near_parallel = false;    // orientations of the two differ by 0, 1e-8 or 1e-4
  bool through_contact = false;  // B turns about an axis through its point nearest to A
  bool turn_together = false;    // rotations of the two differ by 1e-6 to 1 of A's
};

// The name of a family in failures.
void PrintTo(const MotionFamily& family, std::ostream* out);

// Aimed motions of simple kinds, for tests that count hits and misses.
std::vector<MotionFamily> plain_motions();

std::vector<MotionFamily> hard_motions();

class MotionMaker {
 public:
  MotionMaker(const MotionFamily& family, KindPair kinds, uint64_t seed);
  MotionMaker(const MotionMaker&) = delete;
  MotionMaker& operator=(const MotionMaker&) = delete;

  MovedPair next();

 private:
  using Vec = Eigen::Vector3d;

  struct Shapes {
    Shape a, b;
    double size;  // of the larger one
  };

  PlacedShape& a() { return pair_.bodies.a; }
  PlacedShape& b() { return pair_.bodies.b; }
  bool is_plane(const PlacedShape& body) const;
  static Vec eigen(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
  double sign() { return random_.chance(0.5) ? 1 : -1; }

  Vec stored(const Vec& position) const { return test::stored(position, family_.positions); }

  // ---- bodies and sweeps

  void make_bodies();

  // Mostly new shapes at first, then mostly known ones, since hulls are slow to make.
  const Shapes& some_shapes();

  Eigen::Quaternionf turned_a_little(const Eigen::Quaternionf& q);

  void make_sweeps();

  Vec turn() { return random_.direction() * random_.uniform(0, family_.most_turn); }

  // Motion of B relative to A, in sizes. In half of the pairs A moves, too.
  void move(const Vec& way);

  Vec velocity() const;

  // ---- placing B

  // Spheres fill their bounding ball, so they need a larger miss.
  double most_miss() const;

  // Makes a point of each body coincide at some time, or miss by up to `miss` times the reach of
  // both. A body that moves into a half-space may reach it after the interval.
  void aim(double miss);

  void move_inwards();

  // The sum of both bounding radii; half-spaces do not count.
  double reach() const;

  // A random point of the core, or of the plane, at time t, relative to the position.
  Vec point_in(const PlacedShape& body, const Sweep& sweep, double t);

  // A separation near zero, in sizes; some are 0, some negative.
  double near_gap();

  // Places B beside A with this separation, in sizes.
  void place_near(double gap);

  // Moves B by the least separation until time `until`, so that `gap` remains. The least separation
  // must be positive.
  void pull(double until, double gap);

  // A vector from A to a position where B is separate, if both bodies together reach as far as
  // `reach`.
  Vec way_out(double reach);
  static Vec out_of(const PlacedShape& plane, double height);
  static Vec plane_normal(const PlacedShape& plane);

  // Moves B so far off its path that it passes A by, and then back until it grazes A.
  void graze();

  Vec normal() const { return normal_; }
  Vec tangent();

  // Places B so that an edge of A and one of B cross at some time, and lets the gap close slowly.
  void cross_edges();

  void turn_on_contact();

  MotionFamily family_;
  KindPair kinds_;
  Random random_;
  ConvexRandom shapes_;
  std::vector<Shapes> stock_;
  MovedPair pair_;
  double size_ = 1;
  Vec normal_ = Vec::UnitX();  // from A to B, after B was placed beside A
};

std::vector<MovedPair> make_motions(const MotionFamily& family, const KindPair& kinds, size_t count,
                                    uint64_t seed = 1);

}  // namespace carom::test
