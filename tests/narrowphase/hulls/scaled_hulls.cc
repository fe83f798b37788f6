#include "tests/narrowphase/hulls/scaled_hulls.h"

#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/hulls/solid.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;

scalar::Quaternion<double> in_double(const scalar::Quaternion<float>& q) {
  return {q.v.cast<double>(), q.w};
}

}  // namespace

scalar::Quaternion<float> random_turn(oracle::Random& random) {
  const Vector3f v = random.direction().cast<float>() * static_cast<float>(random.uniform(-1, 1));
  return {v, static_cast<float>(random.uniform(0.1, 1))};
}

scalar::SeparationAs<double> exact_separation(const HullPair& pair) {
  return core_separation(scalar::HullShape<double>{pair.a.geometry.get(), 1},
                         scalar::HullShape<double>{pair.b.geometry.get(), 1},
                         scalar::PairPose<double>{pair.pose.d.cast<double>(),
                                                  in_double(pair.pose.a), in_double(pair.pose.b)},
                         scalar::CoreTest());
}

bool holds(const Hull& hull, const scalar::Quaternion<float>& turn, const Vector3f& arm) {
  const SolidHull solid(scalar::HullShape<float>{hull.geometry.get(), 1});
  const Vector3f point = rotate_back(scalar::rotation_of(turn), arm);
  for (size_t f = 0; f < solid.view().face_count; ++f) {
    if (solid.view().normal(f).dot(point) > solid.view().height(f) + 4e-6f) return false;
  }
  return true;
}

}  // namespace carom::test
