#include "narrowphase/hulls/hull_depth.h"

#include <algorithm>

#include "base/few_of.h"
#include "narrowphase/doubles/convex.h"

namespace carom {
namespace {

using namespace scalar;

// One solid, in its own frame, and the points of the other one there.
struct Side {
  const Solid& solid;
  const HullPoints& others;
  Ball inside;  // a ball inside the other solid
  FaceBounds& bounds;
};

// Up to this product of points and groups of faces, trying all faces costs less than choosing among
// them.
constexpr size_t kFewFeatures = 64;

// In how many groups lie the points that reach as far as the furthest: 1, 2, or 3 for more.
size_t count_groups(const HullPoints& points, const Vector3f& way, const FurthestOfHull& furthest) {
  FewOf<Vector3f, 3> groups{points[furthest.index]};
  for (size_t i = 0; i < points.count && !groups.is_full(); ++i) {
    const Vector3f p = points[i];
    const bool is_new = std::none_of(groups.begin(), groups.end(), [&](const Vector3f& group) {
      const Vector3f apart = p - group;
      return dot(apart, apart) <= kOneCorner * kOneCorner;
    });
    if (is_new && furthest.height - dot(way, p) <= kFacingSlack) groups.push_back(p);
  }
  return groups.size();
}

// An edge in the frame of A.
struct CrossedEdge {
  Vector3f direction, from;
};

class DepthSearch {
 public:
  DepthSearch(const Solid& a, const Solid& b, const PairPose<float>& pose, const HullSteps& steps)
      : a_(a), b_(b), pose_(pose), steps_(steps) {}

  Separation run() {
    const Quaternion<float> unturned{Vector3f::Zero(), 1};
    const Quaternion<float>& q = a_.is_turned ? pose_.a : unturned;
    turn_a_ = rotation_of(q);
    turn_ = rotation_of(relative_rotation(q, b_.is_turned ? pose_.b : unturned));
    centre_ = rotate_back(turn_a_, pose_.d);
    Memory& memory = memory_of_thread();
    place_points(memory);
    const Side a = {a_, memory.b_in_a, inside(b_, rotate(turn_, middle_of(b_)) + centre_),
                    memory.bounds_a};
    const Side b = {b_, memory.a_in_b,
                    inside(a_, rotate_back(turn_, Vector3f(middle_of(a_) - centre_))),
                    memory.bounds_b};
    BestFace best_a, best_b;
    try_faces(a, best_a, b, best_b);
    if (is_doubtful_) return not_in_float<float>();
    keep_faces(a, best_a, b, best_b);
    cross_edges(a, b, memory);
    return is_doubtful_ ? not_in_float<float>() : contact(memory.a, memory.b_in_a);
  }

 private:
  struct Memory {
    HullPoints a, b_in_a, a_in_b;
    FaceBounds bounds_a, bounds_b;
    OpenEdges open_a, open_b;
  };

  // Not inlined, because every loop would look up its address again.
  [[gnu::noinline]] static Memory& memory_of_thread() {
    thread_local Memory memory;
    return memory;
  }

  void place_points(Memory& memory) const {
    const Rotation<float> back = {{turn_.x.x(), turn_.y.x(), turn_.z.x()},
                                  {turn_.x.y(), turn_.y.y(), turn_.z.y()},
                                  {turn_.x.z(), turn_.y.z(), turn_.z.z()}};
    const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
    steps_.place(a_, unturned, Vector3f::Zero(), memory.a);
    steps_.place(b_, turn_, centre_, memory.b_in_a);
    steps_.place(a_, back, -rotate_back(turn_, centre_), memory.a_in_b);
  }

  static Vector3f middle_of(const Solid& solid) { return solid.middle * solid.scale; }
  static Ball inside(const Solid& solid, const Vector3f& middle) {
    return {middle, solid.inner_radius * solid.scale};
  }

  // --- Faces ---

  // The best faces of both solids. Of the one that is less than the other's, it only finds that.
  // The two searches take turns, so that the processor works on both.
  void try_faces(const Side& a, BestFace& best_a, const Side& b, BestFace& best_b) {
    BestFace next_a = first_face(a, best_a), next_b = first_face(b, best_b);
    while (!is_doubtful_) {
      const float least = std::max(best_a.gap, best_b.gap);
      const bool goes_on_a = next_a.gap > least, goes_on_b = next_b.gap > least;
      if (!goes_on_a && !goes_on_b) return;
      if (goes_on_a) try_next(a, next_a, best_a);
      if (goes_on_b) try_next(b, next_b, best_b);
    }
  }

  // The face to try first. Where features are few, it tries all, and none is next.
  BestFace first_face(const Side& side, BestFace& best) const {
    if (!has_few_features(side)) {
      side.bounds.count = 0;
      return steps_.bound(side.solid, side.inside, side.bounds);
    }
    best = steps_.try_all(side.solid, side.others, side.bounds);
    return {};
  }

  static bool has_few_features(const Side& side) {
    constexpr size_t kFacesAtOnce = 8;
    const size_t groups = (side.solid.face_count + kFacesAtOnce - 1) / kFacesAtOnce;
    return side.others.count <= FaceBounds::kMostBalls &&
           side.others.count * groups <= kFewFeatures;
  }

  // Tries the face with the greatest bound. The point it finds lowers the bounds of the others.
  void try_next(const Side& side, BestFace& next, BestFace& best) {
    is_doubtful_ = is_doubtful_ || side.bounds.count == FaceBounds::kMostBalls;
    if (is_doubtful_) return;
    const TriedFace tried = steps_.try_face(side.solid, side.others, next.face, side.bounds);
    if (tried.gap > best.gap) best = {tried.gap, next.face};
    next = tried.next;
  }

  void keep_faces(const Side& a, const BestFace& best_a, const Side& b, const BestFace& best_b) {
    if (!(best_b.gap > best_a.gap)) {
      gap_ = best_a.gap;
      normal_ = a.solid.normal(best_a.face);
    } else {
      gap_ = best_b.gap;
      normal_ = -rotate(turn_, b.solid.normal(best_b.face));
    }
  }

  // --- Edges ---

  // Crosses the edges whose axes may be better than the best face, or as good up to rounding.
  void cross_edges(const Side& a, const Side& b, Memory& memory) {
    const float gap = gap_ - kSameGapInFloat;
    steps_.find_open(a_, gap, a.bounds, memory.open_a);
    steps_.find_open(b_, gap, b.bounds, memory.open_b);
    const size_t count_a = memory.open_a.count, count_b = memory.open_b.count;
    is_doubtful_ = count_a > kMostCrossed || count_b > kMostCrossed;
    if (is_doubtful_ || count_a == 0 || count_b == 0) return;
    const CrossedEdges edges_a{a_, memory.open_a}, edges_b{b_, memory.open_b};
    const Crossing crossing = steps_.cross(edges_a, edges_b, turn_, centre_, gap);
    is_doubtful_ = crossing.is_doubtful;
    may_cross_ = crossing.exists;
    if (crossing.exists && crossing.gap > gap_) {
      take_crossing(crossing.gap, edges_a.edge(crossing.of_a), edges_b.edge(crossing.of_b));
    }
  }

  void take_crossing(float gap, const Solid::Edge& a, const Solid::Edge& b) {
    has_crossing_ = true;
    gap_ = gap;
    edge_a_ = {a.direction.head<3>(), a_.corner(a.from)};
    edge_b_ = {rotate<float>(turn_, b.direction.head<3>()),
               rotate(turn_, b_.corner(b.from)) + centre_};
    across_ = cross(edge_a_.direction, edge_b_.direction);
    if (dot(across_, Vector3f(a_.normal(a.left) + a_.normal(a.right))) < 0) across_ = -across_;
    normal_ = across_ * (1 / std::sqrt(dot(across_, across_)));
  }

  // --- The contact ---

  Separation contact(const HullPoints& a, const HullPoints& b) const {
    auto [of_a, count_a] = steps_.facing(a, normal_);
    auto [of_b, count_b] = steps_.facing(b, -normal_);
    const float gap = -(of_a.height + of_b.height);
    if (!(std::fabs(gap - gap_) <= kSameGapInFloat && gap_ < -kSureGap)) {
      return not_in_float<float>();
    }
    // Few hulls have corners so near to each other. k-DOPs have many.
    const bool has_groups =
        count_a > 1 && count_b > 1 && !(has_crossing_ && count_a == 2 && count_b == 2);
    if (has_groups) {
      count_a = count_groups(a, normal_, of_a);
      count_b = count_groups(b, -normal_, of_b);
    }
    Vector3f on_a;
    if (count_b == 1) {
      on_a = b[of_b.index] - normal_ * gap_;
      if (may_cross_ && !is_inside(a_, on_a)) return not_in_float<float>();
    } else if (count_a == 1) {
      on_a = a[of_a.index];
      const Vector3f on_b = on_a + normal_ * gap_;
      if (may_cross_ && !is_inside(b_, rotate_back(turn_, Vector3f(on_b - centre_)))) {
        return not_in_float<float>();
      }
    } else if (has_crossing_ && count_a == 2 && count_b == 2 &&
               dot(across_, across_) > kSmallCrossing) {
      const float along =
          dot(cross<float>(edge_b_.from - edge_a_.from, edge_b_.direction), across_) /
          dot(cross(edge_a_.direction, edge_b_.direction), across_);
      on_a = edge_a_.from + edge_a_.direction * along;
      // The edges may lie within a group.
      const Vector3f on_b = on_a + normal_ * gap_;
      if (has_groups &&
          !(is_inside(a_, on_a) && is_inside(b_, rotate_back(turn_, Vector3f(on_b - centre_))))) {
        return not_in_float<float>();
      }
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

  // Whether the point is inside, up to rounding; in the frame of the solid.
  static bool is_inside(const Solid& solid, const Vector3f& point) {
    for (size_t f = 0; f < solid.face_count; ++f) {
      if (dot(solid.normal(f), point) - solid.height(f) > kSameGapInFloat) return false;
    }
    return true;
  }

  const Solid &a_, &b_;
  const PairPose<float>& pose_;
  const HullSteps& steps_;
  Rotation<float> turn_a_, turn_;  // from A to the world, from B to A
  Vector3f centre_;                // position of B in the frame of A
  bool is_doubtful_ = false;
  // The best axis, in the frame of A.
  float gap_ = 0;
  Vector3f normal_;
  // An axis of two edges is as good as that of a face up to rounding, or better. The point that
  // faces the other solid may then lie beside that face, the further the more parallel the edges
  // are.
  bool may_cross_ = false;
  // The best axis of two edges.
  bool has_crossing_ = false;
  CrossedEdge edge_a_, edge_b_;
  Vector3f across_;
};

}  // namespace

Separation solid_depth(const Solid& a, const Solid& b, const PairPose<float>& pose,
                       const HullSteps& steps) {
  if (!a.is_known() || !b.is_known()) return not_in_float<float>();
  return DepthSearch(a, b, pose, steps).run();
}

}  // namespace carom
