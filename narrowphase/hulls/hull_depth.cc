#include "narrowphase/hulls/hull_depth.h"

#include <algorithm>

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
    const BestFace best_a = try_faces(a, -kLargest);
    if (is_doubtful_) return not_in_float<float>();
    const BestFace best_b = try_faces(b, best_a.gap);
    if (is_doubtful_) return not_in_float<float>();
    keep_faces(a, best_a, b, best_b);
    cross_edges(a, b, memory);
    return is_doubtful_ ? not_in_float<float>() : contact(memory.a, memory.b_in_a);
  }

 private:
  struct Edges {
    size_t count;
    std::array<uint16_t, Solid::kMostEdges> index;
  };

  struct Memory {
    HullPoints a, b_in_a, a_in_b;
    FaceBounds bounds_a, bounds_b;
    EdgeColumns edges_a, edges_b;
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

  // The best face whose gap is greater than `least`.
  BestFace try_faces(const Side& side, float least) {
    if (!has_few_features(side)) return try_best_faces(side, least);
    const BestFace best = steps_.try_all(side.solid, side.others, side.bounds);
    return best.gap > least ? best : BestFace{least, 0};
  }

  static bool has_few_features(const Side& side) {
    constexpr size_t kFacesAtOnce = 8;
    const size_t groups = (side.solid.face_count + kFacesAtOnce - 1) / kFacesAtOnce;
    return side.others.count <= FaceBounds::kMostBalls &&
           side.others.count * groups <= kFewFeatures;
  }

  // Tries the face with the greatest bound first. The point it finds lowers the bounds of the
  // others.
  BestFace try_best_faces(const Side& side, float least) {
    FaceBounds& bounds = side.bounds;
    bounds.count = 0;
    Ball ball = side.inside;
    BestFace best{least, 0};
    while (true) {
      const BestFace next = steps_.bound(side.solid, ball, bounds);
      if (!(next.gap > best.gap)) return best;
      is_doubtful_ = bounds.count == FaceBounds::kMostBalls;
      if (is_doubtful_) return best;
      const FurthestOfHull lowest = steps_.furthest(side.others, -side.solid.normal(next.face));
      const float gap = -lowest.height - side.solid.height(next.face);
      bounds.gap[next.face] = -kLargest;
      ball = {side.others[lowest.index], 0};
      if (gap > best.gap) best = {gap, next.face};
    }
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

  // Finds the edges whose axes may be better than the best face, or as good up to rounding: no ball
  // settles both faces. The loop has no branches, because they would be unpredictable.
  void find_edges_to_cross(const Side& side, Edges& edges) const {
    steps_.settle(side.solid, gap_ - kSameGapInFloat, side.bounds);
    const auto& settled = side.bounds.settled;
    size_t count = 0;
    uint16_t e = 0;
    for (const auto& [left, right] : side.solid.sides) {
      edges.index[count] = e++;
      count += (settled[left] & settled[right]) == 0 ? 1 : 0;
    }
    edges.count = count;
  }

  // `corners`: in the frame of A.
  static void put_edges(const Solid& solid, const HullPoints& corners, const Edges& edges,
                        EdgeColumns& columns) {
    columns.count = edges.count;
    for (size_t k = 0; k < edges.count; ++k) {
      const Solid::Edge& edge = solid.edges[edges.index[k]];
      for (size_t axis = 0; axis < 3; ++axis) {
        columns.direction[axis][k] = edge.direction[static_cast<int>(axis)];
        columns.left[axis][k] = solid.plane[axis][edge.left];
        columns.right[axis][k] = solid.plane[axis][edge.right];
      }
      columns.from[0][k] = corners.x[edge.from];
      columns.from[1][k] = corners.y[edge.from];
      columns.from[2][k] = corners.z[edge.from];
    }
  }

  void cross_edges(const Side& a, const Side& b, Memory& memory) {
    Edges edges_a, edges_b;
    find_edges_to_cross(a, edges_a);
    find_edges_to_cross(b, edges_b);
    is_doubtful_ = edges_a.count > kMostCrossed || edges_b.count > kMostCrossed;
    if (is_doubtful_ || edges_a.count == 0 || edges_b.count == 0) return;
    put_edges(a_, memory.a, edges_a, memory.edges_a);
    put_edges(b_, memory.b_in_a, edges_b, memory.edges_b);
    const Crossing crossing =
        steps_.cross(memory.edges_a, memory.edges_b, turn_, gap_ - kSameGapInFloat);
    is_doubtful_ = crossing.is_doubtful;
    may_cross_ = crossing.exists;
    if (crossing.exists && crossing.gap > gap_) {
      take_crossing(crossing, memory.edges_a, memory.edges_b);
    }
  }

  void take_crossing(const Crossing& crossing, const EdgeColumns& a, const EdgeColumns& b) {
    const auto of = [](const EdgeColumns::Column3& column, size_t k) -> Vector3f {
      return {column[0][k], column[1][k], column[2][k]};
    };
    const size_t i = crossing.of_a, k = crossing.of_b;
    has_crossing_ = true;
    gap_ = crossing.gap;
    edge_a_ = {of(a.direction, i), of(a.from, i)};
    edge_b_ = {rotate(turn_, of(b.direction, k)), of(b.from, k)};
    across_ = cross(edge_a_.direction, edge_b_.direction);
    if (dot(across_, Vector3f(of(a.left, i) + of(a.right, i))) < 0) across_ = -across_;
    normal_ = across_ * (1 / std::sqrt(dot(across_, across_)));
  }

  // --- The contact ---

  Separation contact(const HullPoints& a, const HullPoints& b) const {
    const auto [of_a, count_a] = steps_.facing(a, normal_);
    const auto [of_b, count_b] = steps_.facing(b, -normal_);
    const float gap = -(of_a.height + of_b.height);
    if (!(std::fabs(gap - gap_) <= kSameGapInFloat && gap_ < -kSureGap)) {
      return not_in_float<float>();
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
