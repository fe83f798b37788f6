#include "tests/support/cast_checks.h"

namespace carom::test {

SweepView Sweeps::view() const {
  return {.displacement = displacement.empty() ? nullptr : displacement[0].data(),
          .rotation = rotation.empty() ? nullptr : rotation[0].data()};
}

Sweeps make_sweeps(size_t count, double length, bool turn, uint64_t seed) {
  oracle::Random random(seed);
  Sweeps sweeps;
  for (size_t i = 0; i < count; ++i) {
    Eigen::Vector3d way = random.direction() * random.uniform(0, length);
    if (random.chance(0.1)) way *= random.log_uniform(1e-30, 1e30);
    for (int axis = 0; axis < 3; ++axis) {
      if (random.chance(0.15)) way[axis] = 0;
    }
    Eigen::Vector3f displacement = way.cast<float>();
    if (random.chance(0.02)) displacement.x() = std::numeric_limits<float>::quiet_NaN();
    if (random.chance(0.02)) displacement.y() = std::numeric_limits<float>::infinity();
    sweeps.displacement.push_back(displacement);
    if (!turn) continue;
    Eigen::Vector3d rotation = random.direction() * random.uniform(0, 4);
    if (random.chance(0.1)) rotation *= random.log_uniform(1e-20, 30);
    if (random.chance(0.2)) rotation.setZero();
    sweeps.rotation.push_back(rotation.cast<float>());
  }
  return sweeps;
}

std::vector<CastHit> brute_force(const Collidables& queries, const SweepView& sweep,
                                 const Collidables& bodies, const std::vector<Pair>& pairs) {
  const size_t count = pairs.size();
  std::vector<float> toi(count), separation(count);
  std::array<std::vector<float>, 6> vectors;
  for (std::vector<float>& column : vectors) column.resize(count);
  std::vector<uint8_t> status(count);
  std::vector<uint32_t> sub_shape(count);
  const auto three = [&](size_t i) -> std::array<float*, 3> {
    return {vectors[i].data(), vectors[i + 1].data(), vectors[i + 2].data()};
  };
  const Result<void> done = time_of_impact(queries, sweep, bodies, {}, pairs,
                                           {.toi = toi.data(),
                                            .status = status.data(),
                                            .separation = separation.data(),
                                            .normal = three(0),
                                            .point_b = three(3),
                                            .sub_b = sub_shape.data()},
                                           {.frame = WitnessFrame::body});
  EXPECT_TRUE(bool(done)) << done.error().message;
  std::vector<CastHit> hits;
  for (size_t i = 0; i < count; ++i) {
    if (!(toi[i] <= 1)) continue;
    hits.push_back({.query = pairs[i].a,
                    .body = pairs[i].b,
                    .sub_shape = sub_shape[i],
                    .toi = toi[i],
                    .normal = {vectors[0][i], vectors[1][i], vectors[2][i]},
                    .point = {vectors[3][i], vectors[4][i], vectors[5][i]},
                    .separation = separation[i],
                    .status = static_cast<Status>(status[i])});
  }
  std::sort(hits.begin(), hits.end(), [](const CastHit& a, const CastHit& b) {
    return std::tie(a.query, a.toi, a.body) < std::tie(b.query, b.toi, b.body);
  });
  return hits;
}

std::vector<CastHit> closest_of(const std::vector<CastHit>& all) {
  std::vector<CastHit> closest;
  for (const CastHit& hit : all) {
    if (closest.empty() || closest.back().query != hit.query) closest.push_back(hit);
  }
  return closest;
}

std::string bits_of(const std::vector<CastHit>& hits) {
  std::string bits;
  const auto add = [&](const auto& value) {
    bits.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const CastHit& hit : hits) {
    add(hit.query);
    add(hit.body);
    add(hit.sub_shape);
    add(hit.toi);
    for (int axis = 0; axis < 3; ++axis) add(hit.normal[axis]);
    for (int axis = 0; axis < 3; ++axis) add(hit.point[axis]);
    add(hit.separation);
    add(hit.status);
  }
  return bits;
}

std::string show(const std::vector<CastHit>& hits, const std::vector<CastHit>& expected) {
  const auto name = [](const CastHit& hit) {
    return "query " + std::to_string(hit.query) + ", body " + std::to_string(hit.body) + ", time " +
           std::to_string(hit.toi);
  };
  const size_t both = std::min(hits.size(), expected.size());
  std::string text =
      std::to_string(hits.size()) + " hits instead of " + std::to_string(expected.size());
  for (size_t i = 0; i < both; ++i) {
    if (bits_of({hits[i]}) == bits_of({expected[i]})) continue;
    return text + "; " + name(hits[i]) + " instead of " + name(expected[i]);
  }
  return text;
}

}  // namespace carom::test
