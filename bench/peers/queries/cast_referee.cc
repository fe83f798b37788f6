#include "bench/peers/queries/cast_referee.h"

#include <algorithm>
#include <cmath>

#include "oracle/convex_oracle.h"

namespace carom::bench {
namespace {

constexpr double kNear = 0.1;       // metres; larger gaps are as good as this one
constexpr int kSteps = 64;          // places on the way at which a missed body is looked at
constexpr double kExact = 1e-9;     // metres; what the oracle may err
constexpr double kRounding = 2e-6;  // metres of 20 that a float32 below 1 may err

double radius_of(const CastBody& body, const CastScene& scene) {
  const auto [x, y, z] = body.size;
  if (body.shape == CastShape::sphere) return x;
  if (body.shape == CastShape::capsule) return double{x} + y;
  if (body.shape == CastShape::box) return std::hypot(x, y, z);
  double radius = 0;
  for (const auto& [px, py, pz] : scene.hulls[body.hull].points) {
    radius = std::max<double>(radius, std::hypot(px, py, pz));
  }
  return radius;
}

}  // namespace

Referee::Referee(const CastWorld& world) : world_(world) {
  for (const CastBody& body : world.scene.bodies) {
    if (body.shape == CastShape::mesh) continue;
    const Pose pose = world.pose_of(body);
    items_.push_back({pose.position, radius_of(body, world.scene), world.shape_of(body), pose});
  }
  for (const auto& corners : world.scene.triangles) {
    Triangle triangle;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const auto& [x, y, z] = world.scene.vertices[corners[i]];
      triangle.corners[i] = {x, y, z};
      middle += triangle.corners[i].cast<double>() / 3;
    }
    double radius = 0;
    for (const auto& corner : triangle.corners) {
      radius = std::max(radius, (corner.cast<double>() - middle).norm());
    }
    items_.push_back({middle, radius, triangle, {}});
  }
}

double Referee::separation(const CastBody& query, const std::array<float, 3>& displacement,
                           double time) const {
  Pose pose = world_.pose_of(query);
  const auto& [dx, dy, dz] = displacement;
  pose.position += time * Eigen::Vector3d(dx, dy, dz);
  const double radius = radius_of(query, world_.scene);
  const Shape shape = world_.shape_of(query);
  double least = kNear;
  for (const Item& item : items_) {
    const double reach = radius + item.radius + least;
    if ((item.middle - pose.position).squaredNorm() > reach * reach) continue;
    const oracle::ConvexOracle<> pair(shape, pose, item.shape, item.pose);
    least = std::min(least, static_cast<double>(pair.separation().value));
  }
  return least;
}

Judgement Referee::judge(const CastBody& query, const std::array<float, 3>& displacement,
                         float carom, float peer) const {
  Judgement judgement;
  if (carom <= 1) judgement.carom_is_wrong = !touches(query, displacement, carom);
  if (peer < carom) {
    const double gap = separation(query, displacement, peer);
    judgement.error_of_peer = std::max(gap, 0.0);
    judgement.carom_is_wrong = judgement.carom_is_wrong || gap < -kExact;
    return judgement;
  }
  const double end = std::min(peer, 1.0f);
  for (int i = 1; i <= kSteps; ++i) {
    const double time = carom + (end - carom) * i / kSteps;
    judgement.error_of_peer =
        std::max(judgement.error_of_peer, -separation(query, displacement, time));
  }
  return judgement;
}

bool Referee::touches(const CastBody& query, const std::array<float, 3>& displacement,
                      float time) const {
  return separation(query, displacement, time) <= kRounding;
}

}  // namespace carom::bench
