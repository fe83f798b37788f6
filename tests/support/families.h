// Families of random pairs: which shapes tests use, and in which respects their inputs are hard.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "oracle/random.h"
#include "tests/support/textbook.h"

namespace carom::test {

using namespace oracle;

// Kinds of the two sides. A point is a sphere of radius zero.
enum class Sides { sphere_sphere, point_sphere, sphere_aabb, aabb_sphere, point_aabb, aabb_aabb };

inline constexpr Sides kAllSides[] = {Sides::sphere_sphere, Sides::point_sphere, Sides::sphere_aabb,
                                      Sides::aabb_sphere,   Sides::point_aabb,   Sides::aabb_aabb};

const char* name(Sides sides);

enum class Placement {
  free,        // anywhere from concentric to twice the touching distance
  near_touch,  // touching, then moved by a few floats
  coincident,  // at the same position
  lattice,     // small integers: exact ties
};

struct Family {
  const char* name;
  double smallest = 0.5;  // sizes, log-uniform
  double largest = 2;
  double ratio = 1;      // greatest ratio of the two sizes
  double aspect = 4;     // of boxes
  double distance = 10;  // of A from the origin, in metres or in sizes
  bool distance_in_sizes = false;
  Placement placement = Placement::free;
  bool degenerate = false;  // zero radii, flat boxes
};

std::vector<Family> families();

class PairMaker {
 public:
  PairMaker(const Family& family, Sides sides, PositionType positions, uint64_t seed)
      : family_(family), sides_(sides), positions_(positions), random_(seed) {}

  TestPair next();

 private:
  bool is_box_a() const { return sides_ == Sides::aabb_sphere || sides_ == Sides::aabb_aabb; }
  bool is_box_b() const;

  Shape shape(bool is_box, bool is_point, double size);

  void place_on_lattice(TestPair& pair);

  void place(TestPair& pair, double size);

  // Within a few float32 steps of one.
  double near_one() { return 1 + 0x1p-23 * (static_cast<double>(random_.below(17)) - 8); }

  // A relative position at which the centres of both shapes coincide.
  static Eigen::Vector3d common_centre(const TestPair& pair);

  // A random direction, or one towards a face, an edge or a corner of a flat or long box.
  Eigen::Vector3d way(const TestPair& pair);

  static double distance_to_touch(const TestPair& pair, const Eigen::Vector3d& start,
                                  const Eigen::Vector3d& direction);

  // Moves one coordinate of B by up to four float steps.
  void nudge(TestPair& pair);

  Family family_;
  Sides sides_;
  PositionType positions_;
  Random random_;
};

std::vector<TestPair> make_pairs(const Family& family, Sides sides, PositionType positions,
                                 size_t count, uint64_t seed = 1);

// Floats with random bits, most of them valid: tests can only compare bits.
std::vector<TestPair> make_nonsense(Sides sides, size_t count, uint64_t seed = 1);

}  // namespace carom::test
