// Cylinders and capsules whose axes are nearly parallel, as in stacks and in rows: float32 finds
// them, and on every instruction set the same.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "narrowphase/pairs/any_pair.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using oracle::Random;

enum class Neighbour { on_top, crossing_rims, beside, anywhere };

struct ParallelCase {
  std::string name;
  bool is_capsule;  // A
  Neighbour neighbour;
  double tilt;  // radians, at most
};

class ParallelCylinders : public testing::TestWithParam<ParallelCase> {
 protected:
  Shape upright(bool is_capsule) {
    const auto radius = static_cast<float>(random_.uniform(0.25, 1));
    const auto half = static_cast<float>(random_.uniform(0.25, 1));
    if (is_capsule) return Capsule{{0, 0, -half}, {0, 0, half}, radius};
    return Cylinder{radius, half};
  }

  TestPair draw() {
    TestPair pair;
    pair.a.shape = upright(GetParam().is_capsule);
    pair.b.shape = random_.chance(0.3) ? pair.a.shape : upright(false);
    if (random_.chance(0.5)) pair.b.shape = upright(false);
    const Quaterniond all =
        random_.chance(0.3) ? about(Vector3d::UnitZ(), 3) : about(random_.direction(), 3);
    const double way = random_.uniform(0, 2 * std::numbers::pi);
    const Vector3d across(std::cos(way), std::sin(way), 0);
    const Quaterniond tilt(Eigen::AngleAxisd(GetParam().tilt * random_.uniform(0.3, 1), across));
    const Quaterniond turned =
        random_.chance(0.2) ? about(Vector3d::UnitX(), 0) : about(Vector3d::UnitZ(), 3);
    const Quaterniond over(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
    pair.a.orientation = all.cast<float>();
    pair.b.orientation = (all * tilt * (random_.chance(0.2) ? over : turned)).cast<float>();
    pair.b.position = (all * place(pair)).cast<float>().cast<double>();
    return pair;
  }

 private:
  Quaterniond about(const Vector3d& axis, double most) {
    return Quaterniond(Eigen::AngleAxisd(random_.uniform(-most, most), axis));
  }

  static double radius_of(const Shape& shape) {
    const auto* capsule = std::get_if<Capsule>(&shape);
    return capsule ? capsule->radius : std::get<Cylinder>(shape).radius;
  }
  static double height_of(const Shape& shape) {
    const auto* capsule = std::get_if<Capsule>(&shape);
    return capsule ? capsule->b.z() + capsule->radius : std::get<Cylinder>(shape).half_length;
  }

  // The place of B's middle, where A stands upright. B is a little in A, or a little apart.
  Vector3d place(const TestPair& pair) {
    const double radii = radius_of(pair.a.shape) + radius_of(pair.b.shape);
    const double heights = height_of(pair.a.shape) + height_of(pair.b.shape);
    const double most = random_.chance(0.5) ? 0.1 : 0.002;
    const double gap = random_.uniform(-most, most), share = random_.uniform(0, 1);
    const double way = random_.uniform(0, 2 * std::numbers::pi);
    const double side = random_.chance(0.5) ? 1 : -1;
    double aside = 0, along = side * (heights + gap);
    switch (GetParam().neighbour) {
      case Neighbour::on_top:
        aside = random_.chance(0.1) ? 0 : share * share * share * radii / 2;
        break;
      case Neighbour::crossing_rims:
        aside = share * radii;
        break;
      case Neighbour::beside:
        aside = radii + gap;
        along = side * share * heights;
        break;
      case Neighbour::anywhere:
        aside = 1.2 * share * radii;
        along = random_.uniform(-1.2, 1.2) * heights;
        break;
    }
    return {aside * std::cos(way), aside * std::sin(way), along};
  }

  Random random_{3};
};

template <class Real>
scalar::SeparationAs<Real> separation_of_pair(const TestPair& pair) {
  const auto turn = [](const Eigen::Quaternionf& q) {
    return scalar::Quaternion<Real>{q.vec().cast<Real>(), static_cast<Real>(q.w())};
  };
  const Eigen::Matrix<Real, 3, 1> d = pair.b.position.cast<Real>();
  return scalar::separation_of<Real>(pair.a.shape, pair.b.shape,
                                     {d, turn(pair.a.orientation), turn(pair.b.orientation), -d});
}

// Directions part the shapes by their gaps, so that no depth is too small; none is too great here.
TEST_P(ParallelCylinders, AreFoundInFloats) {
  const uint32_t count = rounds(3000);
  uint32_t overlapping = 0, unsure = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const TestPair pair = draw();
    const auto exact = separation_of_pair<double>(pair);
    const auto found = separation_of_pair<float>(pair);
    overlapping += exact.separation <= 0;
    unsure += found.is_unsure;
    if (found.is_unsure) continue;
    ASSERT_NEAR(found.separation, exact.separation, 8e-6) << i;
    const Vector3d way = found.normal.cast<double>() * found.separation;
    EXPECT_LE(
        (found.arm_a.cast<double>() + way - found.arm_b.cast<double>() - pair.b.position).norm(),
        1e-6);
  }
  EXPECT_GT(overlapping * 4, count);
  // Where rounding hides which of two features is the first, doubles decide.
  EXPECT_LT(unsure * (GetParam().tilt == 0 ? 50 : 5), count);
}

TEST_P(ParallelCylinders, EqualReferenceOnEveryIsa) {
  std::vector<TestPair> pairs;
  for (uint32_t i = 0; i < rounds_of_pairs(200); ++i) pairs.push_back(draw());
  Call call = call_with(PositionType::float32);
  const auto results = reference_results(pairs, PositionType::float32);
  for (const Detail detail : {Detail::contact, Detail::manifold}) {
    call.detail = detail;
    const std::vector<Row> expected =
        rows_of(results, pairs, PositionType::float32, detail, call.frame);
    const LaidOutListPairs list(pairs, call);
    for_each_isa([&] { EXPECT_TRUE(same_rows(expected, list.run(call), pairs)); });
  }
}

std::vector<ParallelCase> parallel_cases() {
  std::vector<ParallelCase> all;
  const char* const places[] = {"on_top", "crossing_rims", "beside", "anywhere"};
  const char* const tilts[] = {"parallel", "1e_8", "1e_6", "1e_5", "1e_4", "1e_3", "1e_2", "3e_2"};
  const double radians[] = {0, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2};
  for (const bool is_capsule : {false, true}) {
    for (size_t place = 0; place < 4; ++place) {
      for (size_t tilt = 0; tilt < 8; ++tilt) {
        all.push_back(
            {std::string(is_capsule ? "capsule_" : "cylinder_") + places[place] + "_" + tilts[tilt],
             is_capsule, static_cast<Neighbour>(place), radians[tilt]});
      }
    }
  }
  return all;
}

std::string parallel_name(const testing::TestParamInfo<ParallelCase>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, ParallelCylinders, testing::ValuesIn(parallel_cases()),
                         parallel_name);

// Discs that lie on one another touch in the middle of what they share, lines too.
TEST(ParallelCylinderPoints, AreInTheMiddle) {
  const Shape shape = Cylinder{1, 0.5f};
  const auto touch = [&](const Eigen::Vector3d& d) {
    TestPair pair{{shape}, {shape, d}};
    const auto found = separation_of_pair<float>(pair);
    EXPECT_FALSE(found.is_unsure);
    return found;
  };
  EXPECT_TRUE(touch({0.5, 0, 0.99}).arm_a.isApprox(Eigen::Vector3f(0.25f, 0, 0.5f), 1e-6f));
  EXPECT_NEAR(touch({0, 0, 0.99}).arm_a.head<2>().norm(), 0, 1e-6);
  EXPECT_TRUE(touch({0, 1.99, 0.6}).arm_a.isApprox(Eigen::Vector3f(0, 1, 0.3f), 1e-6f));
}

}  // namespace
}  // namespace carom::test
