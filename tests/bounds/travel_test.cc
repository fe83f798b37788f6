// Odometers: upper bounds of how far points have moved, against long double; the same on every
// instruction set.
#include "bounds/travel.h"

#include <gtest/gtest.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

template <class T>
const T* numbers_of(const std::vector<std::array<T, 4>>& records) {
  return records.empty() ? nullptr : records[0].data();
}

template <class T>
struct Odometers {
  std::vector<std::array<T, 4>> position;
  std::array<std::vector<T>, 3> anchor;
  std::vector<std::array<float, 4>> turn;
  std::array<std::vector<float>, 4> anchor_turn;
  std::vector<float> radius;
  std::vector<uint32_t> anchored, travelled, before;

  void add(const std::array<T, 4>& from, const std::array<T, 4>& to,
           const std::array<float, 4>& from_turn, const std::array<float, 4>& to_turn, float r) {
    position.push_back(to);
    turn.push_back(to_turn);
    for (size_t c = 0; c < 3; ++c) anchor[c].push_back(from[c]);
    for (size_t c = 0; c < 4; ++c) anchor_turn[c].push_back(from_turn[c]);
    radius.push_back(r);
    anchored.push_back(static_cast<uint32_t>(-100 * static_cast<int>(radius.size())));
    travelled.push_back(7);
    before.push_back(0);
  }

  uint32_t update(const TravelUnit& unit, size_t begin, size_t end, bool turns = true) {
    auto& q = anchor_turn;
    return add_travel(
        TravelColumns<T>{.position = numbers_of(position),
                         .orientation = turns ? numbers_of(turn) : nullptr,
                         .turn_radius = radius.data(),
                         .anchor_position = {anchor[0].data(), anchor[1].data(), anchor[2].data()},
                         .anchor_orientation = {q[0].data(), q[1].data(), q[2].data(), q[3].data()},
                         .anchored = anchored.data(),
                         .travelled = travelled.data(),
                         .travelled_before = before.data()},
        unit, begin, end);
  }

  friend bool operator==(const Odometers&, const Odometers&) = default;
};

std::array<float, 4> any_turn(Random& random) {
  std::array<float, 4> q;
  const double length = std::exp2(random.uniform(-6, 6));
  for (float& x : q) x = static_cast<float>(length * random.uniform(-1, 1));
  return q;
}

// q, turned by up to `most` and of another length and sign.
std::array<float, 4> turned(const std::array<float, 4>& q, double most, Random& random) {
  const double factor = random.uniform(-3, 3);
  std::array<float, 4> r;
  for (size_t i = 0; i < 4; ++i) {
    r[i] = static_cast<float>(factor * (q[i] + most * random.uniform(-1, 1) * std::fabs(q[0])));
  }
  return r;
}

// The way of the position and the chord of a point at the radius, which lies across the axis, in
// long double.
template <class T>
long double way_of(const Odometers<T>& bodies, size_t i) {
  using Wide = long double;
  const std::array<float, 4> p = {bodies.anchor_turn[0][i], bodies.anchor_turn[1][i],
                                  bodies.anchor_turn[2][i], bodies.anchor_turn[3][i]};
  const auto& [px, py, pz, pw] = p;
  const auto& [qx, qy, qz, qw] = bodies.turn[i];
  std::array<Wide, 3> d;
  for (size_t c = 0; c < 3; ++c) d[c] = Wide{bodies.position[i][c]} - bodies.anchor[c][i];
  const Wide way = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const Wide x = Wide{pw} * qx - Wide{px} * qw + (Wide{py} * qz - Wide{pz} * qy);
  const Wide y = Wide{pw} * qy - Wide{py} * qw + (Wide{pz} * qx - Wide{px} * qz);
  const Wide z = Wide{pw} * qz - Wide{pz} * qw + (Wide{px} * qy - Wide{py} * qx);
  const Wide w = Wide{pw} * qw + Wide{px} * qx + Wide{py} * qy + Wide{pz} * qz;
  const Wide axis = x * x + y * y + z * z;
  if (axis == 0) return std::sqrt(way);
  const Wide chord = 2 * Wide{bodies.radius[i]} * std::sqrt(axis / (axis + w * w));
  const Wide along = (d[0] * x + d[1] * y + d[2] * z) / std::sqrt(axis);
  const Wide across = std::sqrt(std::max(Wide{0}, way - along * along));
  return std::sqrt(way + 2 * across * chord + chord * chord);
}

// How far one point of a body has moved, of which `x` is where it is in the body's frame.
template <class T>
long double way_of_point(const Odometers<T>& bodies, size_t i,
                         const std::array<long double, 3>& x) {
  using Wide = long double;
  const auto placed = [&](const auto& q) {
    const Wide square =
        Wide{q[0]} * q[0] + Wide{q[1]} * q[1] + Wide{q[2]} * q[2] + Wide{q[3]} * q[3];
    const auto cross = [&](const std::array<Wide, 3>& v) -> std::array<Wide, 3> {
      return {q[1] * v[2] - q[2] * v[1], q[2] * v[0] - q[0] * v[2], q[0] * v[1] - q[1] * v[0]};
    };
    const std::array<Wide, 3> u = cross(x), v = cross(u);
    std::array<Wide, 3> result;
    for (size_t c = 0; c < 3; ++c) result[c] = x[c] + 2 * (q[3] * u[c] + v[c]) / square;
    return result;
  };
  const auto& a = bodies.anchor_turn;
  const std::array<Wide, 3> from = placed(std::array{a[0][i], a[1][i], a[2][i], a[3][i]});
  const std::array<Wide, 3> to = placed(bodies.turn[i]);
  Wide way = 0;
  for (size_t c = 0; c < 3; ++c) {
    const Wide d = Wide{bodies.position[i][c]} - bodies.anchor[c][i] + to[c] - from[c];
    way += d * d;
  }
  return std::sqrt(way);
}

template <class T>
Odometers<T> random_bodies(size_t count, Random& random) {
  Odometers<T> bodies;
  for (size_t i = 0; i < count; ++i) {
    std::array<T, 4> from, to;
    const double far = std::exp2(random.uniform(-3, 12)), way = std::exp2(random.uniform(-20, 3));
    const bool rests = random.chance(0.2), turns = random.chance(0.7);
    for (size_t c = 0; c < 4; ++c) {
      from[c] = static_cast<T>(far * random.uniform(-1, 1));
      to[c] = rests ? from[c] : static_cast<T>(from[c] + way * random.uniform(-1, 1));
    }
    const std::array<float, 4> q = any_turn(random);
    bodies.add(from, to, q, turns ? turned(q, std::exp2(random.uniform(-22, 1)), random) : q,
               static_cast<float>(std::exp2(random.uniform(-4, 6))));
  }
  return bodies;
}

template <class T>
void check_bounds(uint64_t seed) {
  Random random(seed);
  const TravelUnit unit = {1000, 64};
  const Odometers<T> before = random_bodies<T>(100, random);
  Odometers<T> after = before;
  after.update(unit, 0, 100);
  for (size_t i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const long double ticks = way_of(before, i) * unit.ticks_per_metre;
    const uint32_t gone = after.travelled[i] - before.anchored[i];
    EXPECT_GE(gone, ticks);
    // The rounding of the turn counts as 2^-20 of the diameter, and as much beside the way.
    const long double rounding = 6e-6L * before.radius[i] * unit.ticks_per_metre;
    EXPECT_LE(gone, ticks * (1 + 1e-5L) + rounding + 1);
    const bool leaves = gone > unit.leash;
    EXPECT_EQ(after.anchored[i], leaves ? after.travelled[i] : before.anchored[i]);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(after.anchor[c][i], leaves ? before.position[i][c] : before.anchor[c][i]);
    }
    for (size_t c = 0; c < 4; ++c) {
      EXPECT_EQ(after.anchor_turn[c][i], leaves ? before.turn[i][c] : before.anchor_turn[c][i]);
    }
  }
}

// What the odometers gain, where some go back towards their anchors, of any number of bodies.
TEST(Travel, SaysNoLessThanAnyOdometerGains) {
  Random random(4);
  const TravelUnit unit = {1000, 1u << 27};
  for (size_t count = 0; count < 40; ++count) {
    Odometers<float> bodies = random_bodies<float>(count, random);
    for (uint32_t& odometer : bodies.travelled) {
      odometer = static_cast<uint32_t>(random.below(5000));
    }
    for_each_isa([&] {
      Odometers<float> after = bodies;
      const uint32_t gained = after.update(unit, 0, count);
      EXPECT_EQ(after.before, bodies.travelled);
      uint32_t all = 0;
      for (size_t i = 0; i < count; ++i) {
        const auto gain = static_cast<int32_t>(after.travelled[i] - bodies.travelled[i]);
        all |= static_cast<uint32_t>(std::max(gain, 0));
      }
      EXPECT_EQ(gained, all) << count;
    });
  }
}

// No point at the turning radius goes further, and some go nearly as far.
TEST(Travel, BoundsTheWayOfEveryPoint) {
  Random random(3);
  const TravelUnit unit = {1e5f, 64};
  Odometers<double> bodies = random_bodies<double>(rounds(300), random);
  const Odometers<double> before = bodies;
  bodies.update(unit, 0, bodies.radius.size());
  size_t near = 0, all = 0;
  for (size_t i = 0; i < bodies.radius.size(); ++i) {
    const uint32_t gone = bodies.travelled[i] - before.anchored[i];
    if (gone >= kJump) continue;
    long double most = 0;
    for (int k = 0; k < 200; ++k) {
      std::array<long double, 3> x = {random.uniform(-1, 1), random.uniform(-1, 1),
                                      random.uniform(-1, 1)};
      const long double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      for (long double& c : x) c *= before.radius[i] / length;
      most = std::max(most, way_of_point(before, i, x));
    }
    EXPECT_GE(gone, most * unit.ticks_per_metre) << i;
    ++all;
    near += most * unit.ticks_per_metre > 0.95L * gone;
  }
  EXPECT_GT(all, rounds(250));
  EXPECT_GT(near, all / 2);
}

TEST(Travel, IsAnUpperBoundAndTight) {
  for (uint64_t seed = 0; seed < rounds(200); ++seed) {
    check_bounds<float>(seed);
    check_bounds<double>(seed);
    if (HasFailure()) return;
  }
}

template <class T>
void check_isas(size_t count) {
  Random random(count);
  const Odometers<T> before = random_bodies<T>(count + 2, random);
  Odometers<T> expected = before;
  for (size_t i = 1; i <= count; ++i) expected.update({1000, 64}, i, i + 1);
  for_each_isa([&] {
    Odometers<T> bodies = before;
    bodies.update({1000, 64}, 1, count + 1);
    EXPECT_TRUE(bodies == expected) << count;
  });
}

TEST(Travel, HasTheSameBitsOnEveryIsaAndOneByOne) {
  for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100}) {
    check_isas<float>(count);
    check_isas<double>(count);
  }
}

TEST(Travel, OfWhatDoesNotTurnIsThatOfThePosition) {
  Random random(1);
  Odometers<float> bodies = random_bodies<float>(40, random);
  Odometers<float> still = bodies;
  for (size_t i = 0; i < 40; ++i) {
    for (size_t c = 0; c < 4; ++c) still.turn[i][c] = still.anchor_turn[c][i];
  }
  bodies.update({1000, 64}, 0, 40, false);
  still.update({1000, 64}, 0, 40);
  EXPECT_EQ(bodies.travelled, still.travelled);
}

uint32_t ticks_gone(const std::array<double, 4>& to, const std::array<float, 4>& turn, float radius,
                    float ticks_per_metre = 1000) {
  Odometers<double> bodies;
  bodies.add({0, 0, 0, 0}, to, {0, 0, 0, 1}, turn, radius);
  bodies.update({ticks_per_metre, 64}, 0, 1);
  return bodies.travelled[0] + 100;
}

TEST(Travel, OfNumbersThatAreNotFiniteIsAJump) {
  const std::array<float, 4> none = {0, 0, 0, 1}, half = {1, 0, 0, 0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ticks_gone({nan, 0, 0, 0}, none, 1), kJump);
  EXPECT_EQ(ticks_gone({0, kInfinite, 0, 0}, none, 1), kJump);
  EXPECT_EQ(ticks_gone({0, 0, 1e300, 0}, none, 1), kJump);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, {0, 0, 0, 0}, 1), kJump);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, {NAN, 0, 0, 1}, 1), kJump);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, {NAN, 0, 0, 1}, 0), 0u);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, half, kInfinite), kJump);
  EXPECT_EQ(ticks_gone({1, 0, 0, 0}, none, kInfinite), 1001u);
  EXPECT_EQ(ticks_gone({0, 0, 0, 5}, none, kInfinite), 0u);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, half, FLT_MAX), kJump);
  EXPECT_EQ(ticks_gone({1e-30, 0, 0, 0}, none, 1), 1u);
  EXPECT_EQ(ticks_gone({1e-30, 0, 0, 0}, none, 1, FLT_MAX), kJump);
  EXPECT_EQ(ticks_gone({0, 0, 0, 0}, half, 1), 2001u);
  for_each_isa([&] { EXPECT_EQ(ticks_gone({0, 0, 0, 0}, half, NAN), kJump); });
}

// The squares of such a way vanish: its largest component is less than it is long.
TEST(Travel, OfVeryShortWaysIsAnUpperBound) {
  for (const double x : {0x1p-76, 0x1p-60, 0x1p-52, 0x1p-49}) {
    const auto ticks_per_metre = static_cast<float>(1e6 / x);
    const uint32_t ticks = ticks_gone({x, x, x, 0}, {0, 0, 0, 1}, 1, ticks_per_metre);
    EXPECT_GE(ticks, std::sqrt(3.0) * 1e6) << x;
    EXPECT_LE(ticks, 2.1e6) << x;
  }
}

}  // namespace
}  // namespace carom::test
