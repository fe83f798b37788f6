// libccd alone, in double precision: for decisions its test of overlap, for contacts its depth. It
// has no distances, and finds one contact, so manifolds are left out.
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <ccd/vec3.h>

#include <cmath>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

ccd_vec3_t vector(const float* v) { return {{v[0], v[1], v[2]}}; }

// A body as libccd sees it. Hulls' points are tried in turn: they are few.
struct Body {
  PeerShape shape;
  std::array<float, 9> size;
  const std::vector<ccd_vec3_t>* points;
  ccd_vec3_t position;
  std::array<ccd_vec3_t, 3> axes;  // of the body, in the world
};

ccd_vec3_t farthest_point(const std::vector<ccd_vec3_t>& points, const ccd_vec3_t& way) {
  const ccd_vec3_t* farthest = points.data();
  ccd_real_t most = ccdVec3Dot(farthest, &way);
  for (const ccd_vec3_t& point : points) {
    const ccd_real_t along = ccdVec3Dot(&point, &way);
    if (along > most) {
      most = along;
      farthest = &point;
    }
  }
  return *farthest;
}

ccd_vec3_t rounded(const Body& body, ccd_real_t half_length, ccd_vec3_t way) {
  const ccd_real_t length = std::sqrt(ccdVec3Len2(&way));
  const ccd_real_t end = std::copysign(half_length, way.v[1]);
  if (length > 0) ccdVec3Scale(&way, body.size[0] / length);
  way.v[1] += end;
  return way;
}

ccd_vec3_t on_rim(const Body& body, const ccd_vec3_t& way, ccd_real_t height) {
  const ccd_real_t across = std::hypot(way.v[0], way.v[1]);
  const ccd_real_t share = across > 0 ? body.size[0] / across : 0;
  return {{way.v[0] * share, way.v[1] * share, height}};
}

ccd_vec3_t tip_or_rim(const Body& body, const ccd_vec3_t& way) {
  const ccd_real_t across = std::hypot(way.v[0], way.v[1]);
  if (2 * body.size[1] * way.v[2] > body.size[0] * across) return {{0, 0, body.size[1]}};
  return on_rim(body, way, -body.size[1]);
}

ccd_vec3_t on_ellipsoid(const Body& body, const ccd_vec3_t& way) {
  ccd_vec3_t point;
  ccd_real_t squared = 0;
  for (size_t i = 0; i < 3; ++i) {
    point.v[i] = body.size[i] * body.size[i] * way.v[i];
    squared += point.v[i] * way.v[i];
  }
  ccdVec3Scale(&point, squared > 0 ? 1 / std::sqrt(squared) : 0);
  return point;
}

// In the body's frame.
ccd_vec3_t local_support(const Body& body, const ccd_vec3_t& way) {
  switch (body.shape) {
    case PeerShape::sphere:
      return rounded(body, 0, way);
    case PeerShape::capsule:
      return rounded(body, body.size[1], way);
    case PeerShape::hull:
      return farthest_point(*body.points, way);
    case PeerShape::cylinder:
      return on_rim(body, way, std::copysign(body.size[1], way.v[2]));
    case PeerShape::cone:
      return tip_or_rim(body, way);
    case PeerShape::ellipsoid:
      return on_ellipsoid(body, way);
    default:
      return {{std::copysign(body.size[0], way.v[0]), std::copysign(body.size[1], way.v[1]),
               std::copysign(body.size[2], way.v[2])}};
  }
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Body& body = *static_cast<const Body*>(object);
  ccd_vec3_t way;
  for (size_t i = 0; i < 3; ++i) way.v[i] = ccdVec3Dot(&body.axes[i], direction);
  const ccd_vec3_t local = local_support(body, way);
  *out = body.position;
  for (size_t i = 0; i < 3; ++i) {
    ccd_vec3_t step = body.axes[i];
    ccdVec3Scale(&step, local.v[i]);
    ccdVec3Add(out, &step);
  }
}

void center(const void* object, ccd_vec3_t* out) {
  *out = static_cast<const Body*>(object)->position;
}

class Bodies {
 public:
  explicit Bodies(const PeerBodies& source) {
    for (const PeerHull& hull : source.hulls) {
      std::vector<ccd_vec3_t>& points = hulls_.emplace_back();
      for (const auto& point : hull.points) points.push_back(vector(point.data()));
    }
    for (const PeerBody& body : source.bodies) {
      const auto& q = body.orientation;
      const ccd_quat_t turn = {{q[0], q[1], q[2], q[3]}};
      std::array<ccd_vec3_t, 3> axes = {{{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}};
      for (ccd_vec3_t& axis : axes) ccdQuatRotVec(&axis, &turn);
      bodies_.push_back({source.shape, body.size, hulls_.empty() ? nullptr : &hulls_[body.hull],
                         vector(body.position.data()), axes});
    }
  }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  size_t count() const { return bodies_.size(); }
  const Body* body(size_t i) const { return &bodies_[i]; }

 private:
  std::vector<std::vector<ccd_vec3_t>> hulls_;
  std::vector<Body> bodies_;
};

struct Method {
  decltype(&ccdGJKIntersect) intersects;
  decltype(&ccdGJKPenetration) penetrates;  // returns 0 if the bodies overlap
};
constexpr Method kGjk = {ccdGJKIntersect, ccdGJKPenetration};
constexpr Method kMpr = {ccdMPRIntersect, ccdMPRPenetration};

class CcdPairs final : public PairPeer {
 public:
  CcdPairs(const PeerBodies& a, const PeerBodies& b, PeerDetail detail, const Method& method)
      : a_(a), b_(b), measures_(detail != PeerDetail::overlap), method_(method) {
    CCD_INIT(&settings_);
    settings_.support1 = settings_.support2 = support;
    settings_.center1 = settings_.center2 = center;
    // FCL's settings.
    settings_.max_iterations = 500;
    settings_.mpr_tolerance = settings_.epa_tolerance = 1e-6;
  }

  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.count(); ++i) {
      answers.separations[i] = kNotReported;
      answers.overlaps[i] = (measures_ ? measure(i, answers.separations[i]) : overlaps(i)) ? 1 : 0;
    }
  }

 private:
  bool overlaps(size_t i) const {
    return method_.intersects(a_.body(i), b_.body(i), &settings_) != 0;
  }

  bool measure(size_t i, float& separation) const {
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    if (method_.penetrates(a_.body(i), b_.body(i), &settings_, &depth, &direction, &position) !=
        0) {
      return false;
    }
    separation = static_cast<float>(-depth);
    return true;
  }

  const Bodies a_, b_;
  const bool measures_;
  const Method method_;
  ccd_t settings_;
};

bool is_known(PeerShape shape) { return shape != PeerShape::triangle && shape != PeerShape::mesh; }

std::unique_ptr<PairPeer> make_pairs(const PeerBodies& a, const PeerBodies& b, PeerDetail detail,
                                     const Method& method) {
  const bool has_call = detail == PeerDetail::overlap || detail == PeerDetail::contact;
  if (!has_call || !is_known(a.shape) || !is_known(b.shape)) return nullptr;
  return std::make_unique<CcdPairs>(a, b, detail, method);
}

}  // namespace

std::unique_ptr<PairPeer> make_ccd_gjk_pairs(const PeerBodies& a, const PeerBodies& b,
                                             PeerDetail detail) {
  return make_pairs(a, b, detail, kGjk);
}

std::unique_ptr<PairPeer> make_ccd_mpr_pairs(const PeerBodies& a, const PeerBodies& b,
                                             PeerDetail detail) {
  return make_pairs(a, b, detail, kMpr);
}

}  // namespace carom::bench
