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

// Up to so many points, trying all faces costs less than choosing among them.
constexpr size_t kFewPoints = 16;

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

  // The best of those that are better than the least gap.
  BestFace try_faces(const Side& side, float least) {
    if (side.others.count > kFewPoints) return try_best_faces(side, least);
    const BestFace best = steps_.try_all(side.features(), scale_, side.others, side.bounds);
    return best.gap > least ? best : BestFace{least, 0};
  }

  // The most promising first: the point that each finds says something of the others.
  BestFace try_best_faces(const Side& side, float least) {
    FaceBounds& bounds = side.bounds;
    bounds.count = 0;
    Ball ball = side.inside;
    BestFace best{least, 0};
    while (true) {
      const BestFace next = steps_.bound(side.features(), scale_, ball, bounds);
      if (!(next.gap > best.gap)) return best;
      is_doubtful_ = bounds.count == FaceBounds::kMostBalls;
      if (is_doubtful_) return best;
      const FurthestOfHull lowest =
          steps_.furthest(side.others, -side.features().normal(next.face));
      const float gap = -lowest.height - side.features().height(next.face) * scale_;
      bounds.closed[next.face] = kLargest;
      ball = {side.others[lowest.index], 0};
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

  // Those beside which some axis may be better than the best face: no ball settles both faces.
  // Without branches, which nobody could predict.
  void find_edges_to_cross(const Side& side, Edges& edges) const {
    steps_.settle(side.features(), gap_, side.bounds);
    const auto& settled = side.bounds.settled;
    size_t count = 0;
    uint16_t e = 0;
    for (const auto& [left, right] : side.features().sides()) {
      edges.index[count] = e++;
      count += (settled[left] & settled[right]) == 0 ? 1 : 0;
    }
    edges.count = count;
  }

  void cross_edges(const Side& a, const Side& b) {
    Edges edges_a, edges_b;
    find_edges_to_cross(a, edges_a);
    find_edges_to_cross(b, edges_b);
    is_doubtful_ = edges_a.count > EdgeColumns::kMost || edges_b.count > EdgeColumns::kMost;
    if (is_doubtful_ || edges_a.count == 0 || edges_b.count == 0) return;
    EdgeColumns of_a, of_b;
    for (size_t i = 0; i < edges_a.count; ++i) of_a.push_back(edge_of(a, edges_a.index[i]));
    for (size_t i = 0; i < edges_b.count; ++i) {
      of_b.push_back(in_frame_of_a(edge_of(b, edges_b.index[i])));
    }
    const BestCrossing best = steps_.cross(of_a, of_b);
    is_doubtful_ = best.is_doubtful;
    if (best.gap > gap_) keep_crossing(best.gap, of_a[best.a], of_b[best.b]);
  }

  void keep_crossing(float gap, const EdgeOfHull& a, const EdgeOfHull& b) {
    has_crossing_ = true;
    gap_ = gap;
    edge_a_ = a;
    edge_b_ = b;
    across_ = cross(a.direction, b.direction);
    if (dot(across_, Vector3f(a.left + a.right)) < 0) across_ = -across_;
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
      const float along =
          dot(cross<float>(edge_b_.from - edge_a_.from, edge_b_.direction), across_) /
          dot(cross(edge_a_.direction, edge_b_.direction), across_);
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
  EdgeOfHull edge_a_, edge_b_;
  Vector3f across_;
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
