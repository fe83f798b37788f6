#include "narrowphase/hulls/hull_depth.h"

#include <algorithm>
#include <memory>

#include "base/few_of.h"
#include "narrowphase/doubles/convex.h"
#include "narrowphase/hulls/shell_growth.h"

namespace carom {
namespace {

using namespace scalar;

// One solid, in its own frame, and the points of the other one there.
struct Side {
  const Solid& solid;
  const HullPoints& others;
  const Ball& inside;  // a ball inside the other solid
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

// The search for the depth of one pair, step by step.
class DepthSearch {
 public:
  // Writes place i of the frames.
  void begin(const DeepPair& pair, const HullSteps& steps, DeepFrames& frames, size_t i) {
    a_ = pair.a;
    b_ = pair.b;
    steps_ = &steps;
    slack_ = pair.slack;
    shell_ = pair.shell;
    is_doubtful_ = !a_->is_known() || !b_->is_known();
    may_cross_ = has_crossing_ = false;
    const Quaternion<float> unturned{Vector3f::Zero(), 1};
    DeepFrames::put(pair.d, frames.d, i);
    DeepFrames::put(a_->is_turned ? pair.turn_a : unturned, frames.turn_a, i);
    DeepFrames::put(b_->is_turned ? pair.turn_b : unturned, frames.turn_b, i);
    if (is_doubtful_) return;
    DeepFrames::put(a_->middle * a_->scale, frames.middle_a, i);
    DeepFrames::put(b_->middle * b_->scale, frames.middle_b, i);
  }

  // After the set-up of the frames.
  void place_points(const DeepFrames& frames, size_t i) {
    if (is_doubtful_) return;
    place_in_a(frames, i);
    DeepFrames::get(frames.middle_a_in_b, i, in_a_.middle);
    DeepFrames::get(frames.middle_b_in_a, i, in_b_.middle);
    in_a_.radius = a_->inner_radius * a_->scale;
    in_b_.radius = b_->inner_radius * b_->scale;
    Rotation<float> back;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<int>(axis);
      back.x[k] = frames.b_to_a[axis][0][i];
      back.y[k] = frames.b_to_a[axis][1][i];
      back.z[k] = frames.b_to_a[axis][2][i];
    }
    Vector3f a_from_b;
    DeepFrames::get(frames.a_from_b, i, a_from_b);
    steps_->place(*a_, back, a_from_b, a_in_b_);
  }

  // Takes the depth that the pair's shell proves, or a new one, and writes place i of the frames.
  // After the set-up of the frames, in place of all other steps.
  void measure_shell(ShellSpace& space, DeepFrames& frames, size_t i) {
    is_doubtful_ = is_doubtful_ || !shell_ || shell_->was_in_vain() || a_->dop || b_->dop;
    if (is_doubtful_) return;
    place_b_in_a(frames, i);
    const ShellHulls hulls{*a_, b_in_a_, *steps_};
    ShellDepth found;
    ShellAnswer answer = ShellAnswer::none;
    if (shell_->is_of(a_->point_count, b_->point_count)) {
      answer = ShellGrowth(*shell_, hulls, space).measure(slack_, found);
    }
    if (answer == ShellAnswer::none) answer = measure_new_shell(hulls, space, frames, i, found);
    is_doubtful_ = answer != ShellAnswer::depth || !(found.depth > kSureGap);
    if (is_doubtful_) return shell_->end_in_vain();
    gap_ = -found.depth;
    normal_ = found.normal;
    put(found.on_a, frames, i);
  }

  // Finds the best face, and the edges whose axes may be better, or as good up to rounding.
  void find_faces(FaceBounds& bounds_a, FaceBounds& bounds_b) {
    if (is_doubtful_) return;
    const Side a = {*a_, b_in_a_, in_b_, bounds_a};
    const Side b = {*b_, a_in_b_, in_a_, bounds_b};
    BestFace best_a, best_b;
    try_faces(a, best_a, b, best_b);
    if (is_doubtful_) return;
    keep_faces(best_a, best_b);
    steps_->find_open(*a_, least_crossing(), bounds_a, open_a_);
    steps_->find_open(*b_, least_crossing(), bounds_b, open_b_);
    is_doubtful_ = open_a_.count > kMostCrossed || open_b_.count > kMostCrossed;
  }

  void cross_edges(DopEdges& dop_a, DopEdges& dop_b) {
    if (is_doubtful_ || open_a_.count == 0 || open_b_.count == 0) return;
    const CrossedEdges a(*a_, open_a_, dop_a), b(*b_, open_b_, dop_b);
    const Crossing crossing = steps_->cross(a, b, turn_, centre_, least_crossing());
    is_doubtful_ = crossing.is_doubtful;
    may_cross_ = crossing.exists;
    if (crossing.exists && crossing.gap > gap_) {
      take_crossing(crossing.gap, a.edge(crossing.of_a), b.edge(crossing.of_b));
    }
  }

  // Locates the contact, and writes place i of the frames unless the result is unsure. False if the
  // axis that was found early does not locate one: the search has to go on to the end.
  bool locate(DeepFrames& frames, size_t i) {
    Vector3f on_a;
    if (is_doubtful_) return true;
    is_doubtful_ = !find_location(on_a);
    if (is_doubtful_) return slack_ == 0;
    put(on_a, frames, i);
    return true;
  }

  // Begins again, without a slack. Points stay where they are.
  void begin_again() {
    slack_ = 0;
    is_doubtful_ = may_cross_ = has_crossing_ = false;
  }

  // After the frames are finished.
  Separation contact(const DeepFrames& frames, size_t i) const {
    if (is_doubtful_) return not_in_float<float>();
    Separation s;
    s.separation = gap_;
    DeepFrames::get(frames.normal, i, s.normal);
    DeepFrames::get(frames.arm_a, i, s.arm_a);
    DeepFrames::get(frames.arm_b, i, s.arm_b);
    return s;
  }

 private:
  void place_b_in_a(const DeepFrames& frames, size_t i) {
    DeepFrames::get(frames.b_to_a, i, turn_);
    DeepFrames::get(frames.b_from_a, i, centre_);
    steps_->place(*b_, turn_, centre_, b_in_a_);
  }

  void place_in_a(const DeepFrames& frames, size_t i) {
    place_b_in_a(frames, i);
    const Rotation<float> unturned{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
    steps_->place(*a_, unturned, Vector3f::Zero(), own_a_);
  }

  ShellAnswer measure_new_shell(const ShellHulls& hulls, ShellSpace& space,
                                const DeepFrames& frames, size_t i, ShellDepth& found) {
    Vector3f from_a_to_b;
    DeepFrames::get(frames.middle_b_in_a, i, from_a_to_b);
    from_a_to_b -= a_->middle * a_->scale;
    *shell_ = {};
    ShellGrowth growth(*shell_, hulls, space);
    growth.begin(from_a_to_b);
    const ShellAnswer answer = growth.measure(slack_, found);
    growth.end();
    return answer;
  }

  void put(const Vector3f& on_a, DeepFrames& frames, size_t i) const {
    DeepFrames::put(normal_, frames.normal, i);
    DeepFrames::put(on_a, frames.arm_a, i);
    frames.gap[i] = gap_;
  }

  // --- Faces ---

  // The best faces of both solids. Of the one that is less than the other's, it only finds that.
  // The two searches take turns, so that the processor works on both.
  void try_faces(const Side& a, BestFace& best_a, const Side& b, BestFace& best_b) {
    BestFace next_a = first_face(a, best_a), next_b = first_face(b, best_b);
    while (!is_doubtful_) {
      const float least = std::max(best_a.gap, best_b.gap) + slack_;
      const bool goes_on_a = next_a.gap > least, goes_on_b = next_b.gap > least;
      if (!goes_on_a && !goes_on_b) return;
      if (goes_on_a) try_next(a, next_a, best_a);
      if (goes_on_b) try_next(b, next_b, best_b);
    }
  }

  // The face to try first. Where features are few, it tries all, and none is next.
  BestFace first_face(const Side& side, BestFace& best) const {
    side.bounds.begin(side.solid);
    if (!has_few_features(side)) {
      return steps_->bound(side.solid, side.inside, side.bounds);
    }
    best = steps_->try_all(side.solid, side.others, side.bounds);
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
    const TriedFace tried = steps_->try_face(side.solid, side.others, next.face, side.bounds);
    if (tried.gap > best.gap) best = {tried.gap, next.face};
    next = tried.next;
  }

  void keep_faces(const BestFace& best_a, const BestFace& best_b) {
    if (!(best_b.gap > best_a.gap)) {
      gap_ = best_a.gap;
      normal_ = a_->normal(best_a.face);
    } else {
      gap_ = best_b.gap;
      normal_ = -rotate(turn_, b_->normal(best_b.face));
    }
  }

  // --- Edges ---

  // An axis of two edges matters from this gap on.
  float least_crossing() const { return gap_ - kSameGapInFloat + slack_; }

  void take_crossing(float gap, const Solid::Edge& a, const Solid::Edge& b) {
    has_crossing_ = true;
    gap_ = gap;
    edge_a_ = {a.direction.head<3>(), a_->corner(a.from)};
    edge_b_ = {rotate<float>(turn_, b.direction.head<3>()),
               rotate(turn_, b_->corner(b.from)) + centre_};
    across_ = cross(edge_a_.direction, edge_b_.direction);
    if (dot(across_, Vector3f(a_->normal(a.left) + a_->normal(a.right))) < 0) across_ = -across_;
    normal_ = across_ * (1 / std::sqrt(dot(across_, across_)));
  }

  // --- The contact ---

  // A point of A where the solids face each other. Returns false if it is unsure.
  bool find_location(Vector3f& on_a) const {
    const HullPoints &a = own_a_, &b = b_in_a_;
    auto [of_a, count_a] = steps_->facing(a, normal_);
    auto [of_b, count_b] = steps_->facing(b, -normal_);
    const float gap = -(of_a.height + of_b.height);
    if (!(std::fabs(gap - gap_) <= kSameGapInFloat && gap_ < -kSureGap)) {
      return false;
    }
    // Few hulls have corners so near to each other. k-DOPs have many.
    const bool has_groups =
        count_a > 1 && count_b > 1 && !(has_crossing_ && count_a == 2 && count_b == 2);
    if (has_groups) {
      count_a = count_groups(a, normal_, of_a);
      count_b = count_groups(b, -normal_, of_b);
    }
    // The corner may be beside the face that it should lie over: of edges that are nearly as good,
    // or of an axis that was found early, so that a better one is nearer.
    const bool may_miss = may_cross_ || slack_ > 0;
    if (count_b == 1) {
      on_a = b[of_b.index] - normal_ * gap_;
      if (may_miss && !steps_->is_inside(*a_, on_a)) return false;
    } else if (count_a == 1) {
      on_a = a[of_a.index];
      const Vector3f on_b = on_a + normal_ * gap_;
      if (may_miss && !steps_->is_inside(*b_, rotate_back(turn_, Vector3f(on_b - centre_)))) {
        return false;
      }
    } else if (has_crossing_ && count_a == 2 && count_b == 2 &&
               dot(across_, across_) > kSmallCrossing) {
      const float along =
          dot(cross<float>(edge_b_.from - edge_a_.from, edge_b_.direction), across_) /
          dot(cross(edge_a_.direction, edge_b_.direction), across_);
      on_a = edge_a_.from + edge_a_.direction * along;
      // The edges may lie within a group, or cross beyond their ends.
      const Vector3f on_b = on_a + normal_ * gap_;
      if ((has_groups || slack_ > 0) &&
          !(steps_->is_inside(*a_, on_a) &&
            steps_->is_inside(*b_, rotate_back(turn_, Vector3f(on_b - centre_))))) {
        return false;
      }
    } else {
      return false;
    }
    return true;
  }

  const Solid *a_, *b_;
  const HullSteps* steps_;
  float slack_;
  Shell* shell_;
  Rotation<float> turn_;  // from B to A
  Vector3f centre_;       // position of B in the frame of A
  Ball in_a_, in_b_;      // inside A in the frame of B, and inside B in that of A
  bool is_doubtful_;
  // The best axis, in the frame of A.
  float gap_;
  Vector3f normal_;
  // An axis of two edges is as good as that of a face up to rounding, or better. The point that
  // faces the other solid may then lie beside that face, the further the more parallel the edges
  // are.
  bool may_cross_;
  // The best axis of two edges.
  bool has_crossing_;
  CrossedEdge edge_a_, edge_b_;
  Vector3f across_;
  HullPoints own_a_, b_in_a_, a_in_b_;
  OpenEdges open_a_, open_b_;
};

struct Memory {
  DeepFrames frames;
  std::array<DepthSearch, kMostDeepPairs> searches;
  FaceBounds bounds_a, bounds_b;
  DopEdges dop_a, dop_b;
  ShellSpace space;
};

// Not in the thread's own memory, which every thread of the program would get. Not inlined, because
// every loop would look up the address again.
[[gnu::noinline]] Memory& memory_of_thread() {
  thread_local const auto memory = std::make_unique<Memory>();
  return *memory;
}

std::span<DepthSearch> begin(std::span<const DeepPair> pairs, const HullSteps& steps,
                             Memory& memory) {
  memory.frames.count = pairs.size();
  for (size_t i = 0; i < pairs.size(); ++i) {
    memory.searches[i].begin(pairs[i], steps, memory.frames, i);
  }
  steps.set_up(memory.frames);
  return std::span(memory.searches).first(pairs.size());
}

}  // namespace

void solid_depths(std::span<const DeepPair> pairs, const HullSteps& steps, Separation* contacts) {
  Memory& memory = memory_of_thread();
  DeepFrames& frames = memory.frames;
  const std::span<DepthSearch> searches = begin(pairs, steps, memory);
  for (size_t i = 0; i < pairs.size(); ++i) {
    searches[i].place_points(frames, i);
    searches[i].find_faces(memory.bounds_a, memory.bounds_b);
  }
  for (DepthSearch& search : searches) search.cross_edges(memory.dop_a, memory.dop_b);
  for (size_t i = 0; i < pairs.size(); ++i) {
    DepthSearch& search = searches[i];
    if (search.locate(frames, i)) continue;
    search.begin_again();
    search.find_faces(memory.bounds_a, memory.bounds_b);
    search.cross_edges(memory.dop_a, memory.dop_b);
    search.locate(frames, i);
  }
  steps.finish(frames);
  for (size_t i = 0; i < pairs.size(); ++i) contacts[i] = searches[i].contact(frames, i);
}

void shell_depths(std::span<const DeepPair> pairs, const HullSteps& steps, Separation* contacts) {
  Memory& memory = memory_of_thread();
  DeepFrames& frames = memory.frames;
  const std::span<DepthSearch> searches = begin(pairs, steps, memory);
  for (size_t i = 0; i < pairs.size(); ++i) searches[i].measure_shell(memory.space, frames, i);
  steps.finish(frames);
  for (size_t i = 0; i < pairs.size(); ++i) contacts[i] = searches[i].contact(frames, i);
}

}  // namespace carom
