#include "accuracy/tunnelling/meetings.h"

#include <algorithm>

#include "carom/reference/reference.h"

namespace carom::accuracy {
namespace {

bool is_dynamic(const MovingBody& body) { return body.desc.motion == Motion::dynamic; }

bool is_halfspace(const MovingBody& body) {
  return kind_of(body.desc.shape) == ShapeKind::halfspace;
}

bool is_valid(const MovingBody& body, PositionType positions) {
  return body.sweep.displacement.allFinite() && body.sweep.rotation.allFinite() &&
         reference::is_valid(body.desc.shape, {body.desc.position, body.desc.orientation},
                             positions);
}

bool may_meet(const MovingBody& a, const MovingBody& b) {
  return (is_dynamic(a) || is_dynamic(b)) && !(is_halfspace(a) && is_halfspace(b)) &&
         reference::may_meet(a.desc, b.desc);
}

// A world box that contains all parts of a body at all times.
struct WayBox {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(kNever);
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-kNever);

  WayBox(const MovingBody& body, std::span<const MovingPart> parts) {
    for (const MovingPart& part : parts) {
      lower = lower.cwiseMin(part.lower());
      upper = upper.cwiseMax(part.upper());
    }
    lower += body.desc.position;
    upper += body.desc.position;
    // Room for the rounding of the sums and for grazes.
    const double room = 1e-5 * (upper - lower).cwiseAbs().maxCoeff();
    if (!(room < kNever)) return;
    lower -= Eigen::Vector3d::Constant(room);
    upper += Eigen::Vector3d::Constant(room);
  }

  bool meets(const WayBox& other) const {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
};

Eigen::Vector3f over_interval(const Eigen::Vector3f& velocity, double dt) {
  return (velocity.cast<double>() * dt).cast<float>();
}

}  // namespace

std::vector<MovingBody> moving_bodies(std::span<const BodyDesc> bodies, double dt) {
  std::vector<MovingBody> moving;
  for (const BodyDesc& body : bodies) {
    moving.push_back({body,
                      {.displacement = over_interval(body.linear_velocity, dt),
                       .rotation = over_interval(body.angular_velocity, dt)}});
  }
  return moving;
}

std::vector<PairMeeting> find_meetings(std::span<const MovingBody> bodies,
                                       std::span<const Pair> excluded, PositionType positions,
                                       MeetingSearch& search) {
  std::vector<std::vector<MovingPart>> parts(bodies.size());
  std::vector<WayBox> boxes;
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (is_valid(bodies[i], positions)) parts[i] = moving_parts(bodies[i]);
    boxes.emplace_back(bodies[i], parts[i]);
  }
  std::vector<PairMeeting> meetings;
  for (size_t a = 0; a < bodies.size(); ++a) {
    for (size_t b = a + 1; b < bodies.size(); ++b) {
      const Pair pair = {static_cast<uint32_t>(a), static_cast<uint32_t>(b)};
      if (!boxes[a].meets(boxes[b]) || !may_meet(bodies[a], bodies[b])) continue;
      if (std::binary_search(excluded.begin(), excluded.end(), pair)) continue;
      const MeetingTime time = search(bodies[a], parts[a], bodies[b], parts[b]);
      if (time.meeting == Meeting::none) continue;
      meetings.push_back({pair, time});
    }
  }
  return meetings;
}

}  // namespace carom::accuracy
