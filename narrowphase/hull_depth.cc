#include "narrowphase/hull_depth.h"

#include "narrowphase/convex_ref.h"

namespace carom {
namespace {

using namespace reference;

// A point of the other hull, and how far it lies over the plane of a face: no axis at the face, and
// none between it and its neighbours, has more.
struct FaceBound {
  Vector3f point;
  float gap;
  bool is_tried;
};

// One hull, in its own frame, and the other one's points there.
struct Side {
  const HullFeatures& features;
  const HullPoints& own;
  const HullPoints& others;
  float scale;
  std::vector<FaceBound>& bounds;

  float height_of(const HullFeatures::Face& face) const { return face.height * scale; }
};

struct BestFace {
  float gap = -kLargest;
  size_t face = 0;
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
    const Side a{*a_.geometry->features(), memory.a, memory.b_in_a, scale_, memory.bounds_a};
    const Side b{*b_.geometry->features(), memory.b, memory.a_in_b, scale_, memory.bounds_b};
    const Vector3f middle_a = middle_of(a_), middle_b = middle_of(b_);
    const Vector3f from_b = rotate_back(turn_, Vector3f(middle_a - centre_));
    const BestFace guess_a = bound_faces(a, rotate(turn_, middle_b) + centre_);
    const BestFace guess_b = bound_faces(b, from_b);
    const float guess = max(try_face(a, guess_a.face), try_face(b, guess_b.face));
    const BestFace best_a = try_faces(a, guess), best_b = try_faces(b, guess);
    keep_faces(a, best_a, b, best_b);
    cross_edges(a, b);
    return is_doubtful_ ? not_in_float<float>() : contact(a);
  }

 private:
  struct Memory {
    HullPoints a, b, b_in_a, a_in_b;
    std::vector<FaceBound> bounds_a, bounds_b;
  };

  void place_points(Memory& memory) const {
    const Vector3f zero = Vector3f::Zero();
    const Rotation<float> back = {{turn_.x.x(), turn_.y.x(), turn_.z.x()},
                                  {turn_.x.y(), turn_.y.y(), turn_.z.y()},
                                  {turn_.x.z(), turn_.y.z(), turn_.z.z()}};
    const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
    steps_.place(*a_.geometry, scale_, unturned, zero, memory.a);
    steps_.place(*b_.geometry, scale_, unturned, zero, memory.b);
    steps_.place(*b_.geometry, scale_, turn_, centre_, memory.b_in_a);
    steps_.place(*a_.geometry, scale_, back, -rotate_back(turn_, centre_), memory.a_in_b);
  }

  Vector3f middle_of(const HullShape<float>& hull) const {
    const std::array<float, 4>& middle = hull.geometry->records()[hull.geometry->points().size()];
    return Vector3f(middle[0], middle[1], middle[2]) * scale_;
  }

  // --- Faces ---

  // By a point of the other hull; the face with the greatest bound.
  static BestFace bound_faces(const Side& side, const Vector3f& point) {
    const auto faces = side.features.faces();
    side.bounds.resize(faces.size());
    BestFace best;
    for (size_t f = 0; f < faces.size(); ++f) {
      const float gap = dot(faces[f].normal, point) - side.height_of(faces[f]);
      side.bounds[f] = {point, gap, false};
      if (gap > best.gap) best = {gap, f};
    }
    return best;
  }

  float try_face(const Side& side, size_t f) const {
    FaceBound& bound = side.bounds[f];
    if (bound.is_tried) return bound.gap;
    const HullFeatures::Face& face = side.features.faces()[f];
    const FurthestOfHull lowest = steps_.furthest(side.others, -face.normal);
    bound = {side.others[lowest.index], -lowest.height - side.height_of(face), true};
    return bound.gap;
  }

  // Those that may be better than the guess.
  BestFace try_faces(const Side& side, float guess) const {
    BestFace best;
    for (size_t f = 0; f < side.bounds.size(); ++f) {
      if (side.bounds[f].gap < guess) continue;
      const float gap = try_face(side, f);
      if (gap > best.gap) best = {gap, f};
    }
    return best;
  }

  void keep_faces(const Side& a, const BestFace& best_a, const Side& b, const BestFace& best_b) {
    if (best_a.gap >= best_b.gap) {
      gap_ = best_a.gap;
      normal_ = a.features.faces()[best_a.face].normal;
    } else {
      gap_ = best_b.gap;
      normal_ = -rotate(turn_, b.features.faces()[best_b.face].normal);
    }
  }

  // --- Edges ---

  EdgeOfHull edge_of(const Side& side, const HullFeatures::Edge& edge) const {
    const auto faces = side.features.faces();
    return {edge.direction, side.own[edge.from], faces[edge.left].normal, faces[edge.right].normal};
  }

  EdgeOfHull in_frame_of_a(const EdgeOfHull& edge) const {
    return {rotate(turn_, edge.direction), rotate(turn_, edge.from) + centre_,
            rotate(turn_, edge.left), rotate(turn_, edge.right)};
  }

  // How far a point lies over a face.
  static float over(const Side& side, uint32_t f, const Vector3f& point) {
    const HullFeatures::Face& face = side.features.faces()[f];
    return dot(face.normal, point) - side.height_of(face);
  }

  // Whether some axis between the faces of the edge may be better than the best face.
  bool may_be_better(const Side& side, const HullFeatures::Edge& edge) const {
    const FaceBound &left = side.bounds[edge.left], &right = side.bounds[edge.right];
    return max(left.gap, over(side, edge.right, left.point)) > gap_ &&
           max(right.gap, over(side, edge.left, right.point)) > gap_;
  }

  // Once each, in the order of faces that were tried.
  template <class Visit>
  void for_each_edge(const Side& side, const Visit& visit) const {
    const auto faces = side.features.faces();
    for (uint32_t f = 0; f < faces.size(); ++f) {
      if (!side.bounds[f].is_tried) continue;
      for (const uint32_t e : side.features.edges(faces[f])) {
        const HullFeatures::Edge& edge = side.features.edge(e);
        const uint32_t beyond = edge.left == f ? edge.right : edge.left;
        const bool was_visited = side.bounds[beyond].is_tried && beyond < f;
        if (!was_visited && may_be_better(side, edge)) visit(edge);
      }
    }
  }

  void cross_edges(const Side& a, const Side& b) {
    EdgeColumns of_b;
    for_each_edge(b, [&](const HullFeatures::Edge& edge) {
      if (of_b.count == EdgeColumns::kMost) {
        is_doubtful_ = true;
        return;
      }
      const EdgeOfHull e = in_frame_of_a(edge_of(b, edge));
      size_t c = 0;
      for (const Vector3f& v : {e.direction, e.from, e.left, e.right}) {
        for (int axis = 0; axis < 3; ++axis) of_b.column[c++][of_b.count] = v[axis];
      }
      ++of_b.count;
    });
    if (of_b.count == 0 || is_doubtful_) return;
    for_each_edge(a, [&](const HullFeatures::Edge& edge) {
      const EdgeOfHull on_a = edge_of(a, edge);
      const BestCrossing best = steps_.cross(on_a, of_b);
      is_doubtful_ = is_doubtful_ || best.is_doubtful;
      if (!(best.gap > gap_crossing_)) return;
      gap_crossing_ = best.gap;
      edge_a_ = on_a;
      const auto vector = [&](size_t c) -> Vector3f {
        return {of_b.column[c][best.other], of_b.column[c + 1][best.other],
                of_b.column[c + 2][best.other]};
      };
      direction_b_ = vector(0);
      from_b_ = vector(3);
    });
    if (!(gap_crossing_ > gap_)) return;
    has_crossing_ = true;
    gap_ = gap_crossing_;
    across_ = cross(edge_a_.direction, direction_b_);
    const Vector3f outwards = edge_a_.left + edge_a_.right;
    if (dot(across_, outwards) < 0) across_ = -across_;
    normal_ = across_ * (1 / std::sqrt(dot(across_, across_)));
  }

  // --- The contact ---

  Separation contact(const Side& a) const {
    const FurthestOfHull of_a = steps_.furthest(a.own, normal_);
    const FurthestOfHull of_b = steps_.furthest(a.others, -normal_);
    const float gap = -(of_a.height + of_b.height);
    if (!(std::fabs(gap - gap_) <= kSameGapInFloat && gap_ < -kSureGap)) {
      return not_in_float<float>();
    }
    const size_t count_a = steps_.count_as_far(a.own, normal_, of_a.height);
    const size_t count_b = steps_.count_as_far(a.others, -normal_, of_b.height);
    Vector3f on_a;
    if (count_b == 1) {
      on_a = a.others[of_b.index] - normal_ * gap_;
    } else if (count_a == 1) {
      on_a = a.own[of_a.index];
    } else if (has_crossing_ && count_a == 2 && count_b == 2) {
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
    return hull.geometry->features() && hull.geometry->points().size() <= kMostLanePoints;
  };
  if (!is_known(a) || !is_known(b)) return not_in_float<float>();
  return DepthSearch(a, b, pose, steps).run();
}

}  // namespace carom
