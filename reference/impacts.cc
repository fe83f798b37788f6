#include "reference/impacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace carom::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

bool has_sensor(const MovingPair& pair) { return pair.a.desc.sensor || pair.b.desc.sensor; }

// Copies the contact from either kind of result.
template <class From>
void copy_contact(const From& from, carom::Impact& impact) {
  impact.sub_a = from.sub_a;
  impact.sub_b = from.sub_b;
  impact.normal = from.normal;
  impact.arm_a = from.arm_a;
  impact.arm_b = from.arm_b;
  impact.separation = from.separation;
}

void add_impact(const MovingPair& pair, const PairResult& now, bool overlap, PositionType positions,
                Detail detail, Frame& frame) {
  carom::Impact impact;
  impact.a = pair.a.id.index;
  impact.b = pair.b.id.index;
  impact.sensor = has_sensor(pair);
  impact.overlap = overlap;
  const bool wants_contact = has_contacts(detail) && !impact.sensor;
  if (overlap) {
    if (wants_contact) {
      copy_contact(now, impact);
      impact.status = now.status;
    }
  } else {
    const Impact found =
        time_of_impact(pair.a.desc.shape, pose_of(pair.a.desc), pair.motion_a.sweep,
                       pair.b.desc.shape, pose_of(pair.b.desc), pair.motion_b.sweep, positions);
    if (!(found.toi <= 1)) return;
    impact.toi = found.toi;
    impact.status = found.status;
    if (wants_contact) copy_contact(found, impact);
  }
  frame.impacts.push_back(impact);
}

// The displacement over the interval of a point of the body that goes on straight.
Vector3d way_of(const BodyMotion& motion, const Vector3f& arm) {
  const Vector3d w = motion.sweep.rotation.cast<double>(), r = arm.cast<double>();
  return motion.sweep.displacement.cast<double>() + w.cross(r);
}

void add_speculative(const MovingPair& pair, const PairResult& now, double dt, Frame& frame) {
  const Vector3d way = way_of(pair.motion_b, now.arm_b) - way_of(pair.motion_a, now.arm_a);
  const Vector3d n = now.normal.cast<double>();
  const double opens = (way.x() * n.x() + way.y() * n.y()) + way.z() * n.z();
  const float separation = std::fmax(now.separation, 0.0f);
  if (!(double{separation} + opens <= 0)) return;
  Contact contact{};
  contact.a = pair.a.id.index;
  contact.b = pair.b.id.index;
  contact.sub_a = now.sub_a;
  contact.sub_b = now.sub_b;
  contact.normal = now.normal;
  contact.separation = separation;
  contact.arm_a = now.arm_a;
  contact.normal_velocity = static_cast<float>(opens / dt);
  contact.arm_b = now.arm_b;
  contact.status = now.status;
  frame.speculative.push_back(contact);
}

}  // namespace

void look_ahead(const MovingPair& pair, const PairResult& now, bool overlap, bool near,
                PositionType positions, Detail detail, double dt, Frame& frame) {
  if (!pair.motion_a.is_finite || !pair.motion_b.is_finite) return;
  if (pair.motion_a.is_continuous() || pair.motion_b.is_continuous()) {
    add_impact(pair, now, overlap, positions, detail, frame);
  } else if (!overlap && !near && !has_sensor(pair) && has_contacts(detail) && dt > 0) {
    add_speculative(pair, now, dt, frame);
  }
}

void settle(Impacts impacts, std::vector<carom::Impact>& all) {
  std::sort(all.begin(), all.end(), [](const carom::Impact& x, const carom::Impact& y) {
    return std::tie(x.toi, x.a, x.b) < std::tie(y.toi, y.a, y.b);
  });
  if (impacts == Impacts::all) return;

  std::map<uint32_t, float> stopped;  // when another body first stops each body
  for (const carom::Impact& impact : all) {
    if (impact.sensor || impact.overlap) continue;
    stopped.emplace(impact.a, impact.toi);
    stopped.emplace(impact.b, impact.toi);
  }
  const auto is_stopped_before = [&](uint32_t body, float time) {
    const auto found = stopped.find(body);
    return found != stopped.end() && found->second < time;
  };
  std::erase_if(all, [&](const carom::Impact& impact) {
    if (impact.overlap) return false;
    const bool a = is_stopped_before(impact.a, impact.toi);
    const bool b = is_stopped_before(impact.b, impact.toi);
    return impact.sensor ? a || b : a && b;
  });
}

}  // namespace carom::reference
