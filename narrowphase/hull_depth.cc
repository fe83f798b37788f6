#include "narrowphase/hull_depth.h"

#include <algorithm>

#include "narrowphase/convex_ref.h"

namespace carom {
namespace {

using namespace reference;

// One hull, in its own frame, and the other one's points there.
struct Side {
  const HullGeometry& hull;
  const HullPoints& others;
  float scale;
  Ball inside;  // of the other one
  FaceBounds& bounds;

  const HullFeatures& features() const { return *hull.features(); }
  Vector3f own(uint32_t i) const { return hull.points()[i] * scale; }
};

class DepthSearch {
 public:
  DepthSearch(const HullShape<float>& a, const HullShape<float>& b, const PairPose<float>& pose,
              const HullSteps& steps)
      : a_(a), b_(b), pose_(pose), steps_(steps), scale_(static_cast<float>(a.scale)) {}

  Separation run() {
    turn_a_ = rotation_of(pose_.a);
    turn_ = rotation_of(relative_rotation(pose_.a, pose_.b));
    centre_ = rotate_back(turn_a_, pose_.d);
    thread_local Memory memory;
    place_points(memory);
    const Side a =
        side(a_, memory.b_in_a, rotate(turn_, middle_of(b_)) + centre_, b_, memory.bounds_a);
    const Side b = side(b_, memory.a_in_b, rotate_back(turn_, Vector3f(middle_of(a_) - centre_)),
                        a_, memory.bounds_b);
    const BestFace best_a = try_faces(a, -kLargest);
    if (is_doubtful_) return not_in_float<float>();
    const BestFace best_b = try_faces(b, best_a.gap);
    if (is_doubtful_) return not_in_float<float>();
    keep_faces(a, best_a, b, best_b);
    cross_edges(a, b);
    return is_doubtful_ ? not_in_float<float>() : contact(memory.a, memory.b_in_a);
  }

 private:
  struct Edges {
    static constexpr size_t kMost = 3 * kMostLanePoints;
    size_t count;
    std::array<uint16_t, kMost> index;
  };

  struct Memory {
    HullPoints a, b_in_a, a_in_b;
    FaceBounds bounds_a, bounds_b;
  };

  void place_points(Memory& memory) const {
    const Rotation<float> back = {{turn_.x.x(), turn_.y.x(), turn_.z.x()},
                                  {turn_.x.y(), turn_.y.y(), turn_.z.y()},
                                  {turn_.x.z(), turn_.y.z(), turn_.z.z()}};
    const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
    steps_.place(*a_.geometry, scale_, unturned, Vector3f::Zero(), memory.a);
    steps_.place(*b_.geometry, scale_, turn_, centre_, memory.b_in_a);
    steps_.place(*a_.geometry, scale_, back, -rotate_back(turn_, centre_), memory.a_in_b);
  }

  Side side(const HullShape<float>& hull, const HullPoints& others, const Vector3f& middle,
            const HullShape<float>& other, FaceBounds& bounds) const {
    const float radius = other.geometry->features()->inner_radius() * scale_;
    return {*hull.geometry, others, scale_, {middle, radius}, bounds};
  }

  Vector3f middle_of(const HullShape<float>& hull) const {
    const std::array<float, 4>& middle = hull.geometry->records()[hull.geometry->points().size()];
    return Vector3f(middle[0], middle[1], middle[2]) * scale_;
  }

  // --- Faces ---

  float try_face(const Side& side, size_t f) const {
    FaceBounds& bounds = side.bounds;
    const FurthestOfHull lowest = steps_.furthest(side.others, -side.features().normal(f));
    const float gap = -lowest.height - side.features().height(f) * scale_;
    bounds.closed[f] = kLargest;
    bounds.balls.push_back({side.others[lowest.index], 0});
    return gap;
  }

  // The best of those that may be better than the least gap: the most promising first, each of
  // which says something of the others.
  BestFace try_faces(const Side& side, float least) {
    FaceBounds& bounds = side.bounds;
    bounds.balls = {side.inside};
    BestFace best{least, 0};
    while (true) {
      const BestFace next = steps_.bound(side.features(), scale_, bounds);
      if (!(next.gap > best.gap)) return best;
      is_doubtful_ = bounds.balls.is_full();
      if (is_doubtful_) return best;
      const float gap = try_face(side, next.face);
      if (gap > best.gap) best = {gap, next.face};
    }
  }

  void keep_faces(const Side& a, const BestFace& best_a, const Side& b, const BestFace& best_b) {
    if (!(best_b.gap > best_a.gap)) {
      gap_ = best_a.gap;
      normal_ = a.features().normal(best_a.face);
    } else {
      gap_ = best_b.gap;
      normal_ = -rotate(turn_, b.features().normal(best_b.face));
    }
  }

  // --- Edges ---

  static EdgeOfHull edge_of(const Side& side, uint32_t e) {
    const HullFeatures::Edge& edge = side.features().edge(e);
    return {edge.direction, side.own(edge.from), side.features().normal(edge.left),
            side.features().normal(edge.right)};
  }

  EdgeOfHull in_frame_of_a(const EdgeOfHull& edge) const {
    return {rotate(turn_, edge.direction), rotate(turn_, edge.from) + centre_,
            rotate(turn_, edge.left), rotate(turn_, edge.right)};
  }

  // Those beside which some axis may be better than the best face, by each ball in turn: the last
  // ones know most. Without branches, which nobody could predict.
  Edges edges_to_cross(const Side& side) const {
    const auto sides = side.features().sides();
    Edges edges;
    edges.count = sides.size();
    for (size_t e = 0; e < sides.size(); ++e) edges.index[e] = static_cast<uint16_t>(e);
    for (size_t ball = side.bounds.balls.size(); ball-- > 0;) {
      const auto& between = side.bounds.between[ball];
      size_t left = 0;
      for (size_t i = 0; i < edges.count; ++i) {
        const uint16_t e = edges.index[i];
        edges.index[left] = e;
        left += max(between[sides[e][0]], between[sides[e][1]]) > gap_ ? 1 : 0;
      }
      edges.count = left;
    }
    return edges;
  }

  void cross_edges(const Side& a, const Side& b) {
    const Edges edges_b = edges_to_cross(b), edges_a = edges_to_cross(a);
    is_doubtful_ = edges_b.count > EdgeColumns::kMost;
    if (is_doubtful_ || edges_a.count == 0 || edges_b.count == 0) return;
    EdgeColumns of_b;
    for (; of_b.count < edges_b.count; ++of_b.count) {
      const EdgeOfHull e = in_frame_of_a(edge_of(b, edges_b.index[of_b.count]));
      const auto put = [&](size_t c, const Vector3f& v) {
        for (int axis = 0; axis < 3; ++axis)
          of_b.column[c + static_cast<size_t>(axis)][of_b.count] = v[axis];
      };
      put(0, e.direction);
      put(3, e.from);
      put(6, e.left);
      put(9, e.right);
    }
    for (size_t i = 0; i < edges_a.count; ++i) {
      const EdgeOfHull on_a = edge_of(a, edges_a.index[i]);
      const BestCrossing best = steps_.cross(on_a, of_b);
      is_doubtful_ = is_doubtful_ || best.is_doubtful;
      if (!(best.gap > gap_crossing_)) continue;
      gap_crossing_ = best.gap;
      edge_a_ = on_a;
      const auto vector = [&](size_t c) -> Vector3f {
        return {of_b.column[c][best.other], of_b.column[c + 1][best.other],
                of_b.column[c + 2][best.other]};
      };
      direction_b_ = vector(0);
      from_b_ = vector(3);
    }
    if (!(gap_crossing_ > gap_)) return;
    has_crossing_ = true;
    gap_ = gap_crossing_;
    across_ = cross(edge_a_.direction, direction_b_);
    const Vector3f outwards = edge_a_.left + edge_a_.right;
    if (dot(across_, outwards) < 0) across_ = -across_;
    normal_ = across_ * (1 / std::sqrt(dot(across_, across_)));
  }

  // --- The contact ---

  Separation contact(const HullPoints& a, const HullPoints& b) const {
    const FurthestOfHull of_a = steps_.furthest(a, normal_);
    const FurthestOfHull of_b = steps_.furthest(b, -normal_);
    const float gap = -(of_a.height + of_b.height);
    if (!(std::fabs(gap - gap_) <= kSameGapInFloat && gap_ < -kSureGap)) {
      return not_in_float<float>();
    }
    const size_t count_a = steps_.count_as_far(a, normal_, of_a.height);
    const size_t count_b = steps_.count_as_far(b, -normal_, of_b.height);
    Vector3f on_a;
    if (count_b == 1) {
      on_a = b[of_b.index] - normal_ * gap_;
    } else if (count_a == 1) {
      on_a = a[of_a.index];
    } else if (has_crossing_ && count_a == 2 && count_b == 2 &&
               dot(across_, across_) > kSmallCrossing) {
      const float along = dot(cross<float>(from_b_ - edge_a_.from, direction_b_), across_) /
                          dot(cross(edge_a_.direction, direction_b_), across_);
      on_a = edge_a_.from + edge_a_.direction * along;
    } else {
      return not_in_float<float>();
    }
    Separation result;
    result.separation = gap_;
    result.normal = rotate(turn_a_, normal_);
    result.arm_a = rotate(turn_a_, on_a);
    result.arm_b = (result.arm_a + result.normal * gap_) - pose_.d;
    return result;
  }

  const HullShape<float>&a_, &b_;
  const PairPose<float>& pose_;
  const HullSteps& steps_;
  const float scale_;
  Rotation<float> turn_a_, turn_;  // of A to the world, of B to A
  Vector3f centre_;                // of B, in the frame of A
  bool is_doubtful_ = false;
  // The best axis, in the frame of A.
  float gap_ = 0;
  Vector3f normal_;
  // The best one across two edges.
  bool has_crossing_ = false;
  float gap_crossing_ = -kLargest;
  EdgeOfHull edge_a_;
  Vector3f direction_b_, from_b_, across_;
};

}  // namespace

Separation hull_depth(const HullShape<float>& a, const HullShape<float>& b,
                      const PairPose<float>& pose, const HullSteps& steps) {
  const auto is_known = [](const HullShape<float>& hull) {
    const HullFeatures* const features = hull.geometry->features();
    return features && hull.geometry->points().size() <= kMostLanePoints &&
           features->face_count() <= FaceBounds::kMost &&
           features->edge_count() <= 3 * kMostLanePoints;
  };
  if (!is_known(a) || !is_known(b)) return not_in_float<float>();
  return DepthSearch(a, b, pose, steps).run();
}

}  // namespace carom
