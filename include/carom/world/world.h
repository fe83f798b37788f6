// The collision world: bodies in flat arrays, one step a frame, contacts and events out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/export.h"
#include "carom/queries/cast.h"
#include "carom/queries/queries.h"
#include "carom/results/contact.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "carom/results/pair.h"
#include "carom/results/tier.h"
#include "carom/shapes/body.h"
#include "carom/shapes/dop.h"
#include "carom/world/step_report.h"

namespace carom {

struct WorldSettings {
  PositionType positions = PositionType::float32;
  Detail detail = Detail::contact;
  BroadphaseMethod broadphase = BroadphaseMethod::automatic;
  Parallelism parallelism = Parallelism::arena;
  bool events = true;         // begin, persist and end of overlaps
  bool carry_results = true;  // false: every pair is found and tested anew every step

  // Metres by which bounds are fattened, finite and >= 0. A body keeps its fat bounds, and the
  // pairs they make, until its true bounds leave them: for many bodies that move little at a time.
  // Pairs are candidates then, and which ones depends on the way the bodies took; overlaps,
  // contacts and events are those of a world without margin.
  float margin = 0;

  // Pairs whose k-DOPs are apart are not tested: tighter bounds, for shapes whose boxes are mostly
  // empty and whose tests cost more than that (docs/dop_bounds.md). Pairs and all results are the
  // same with and without. A 6-DOP is the bounds, and drops nothing.
  std::optional<DopKind> dop_bounds = std::nullopt;

  // Undecided pairs (Tier::certified) are kUndecided in overlaps(), and make neither contacts nor
  // events.
  // What FastKnobs mean for a world; candidate pairs are those of the true bounds, always:
  // proxy_spheres     of these pairs the balls are tested, and contacts are those of the balls. So
  //                   every overlap is found, and of balls whose bounds lie apart none.
  //                   find_points() and bounds know the shapes themselves. dop_bounds are not used
  // motion_tolerance  carried contacts stay as they were tested, arms and points included. Results
  //                   depend on the way that the bodies took, and so on the margin. A change of the
  //                   shape, or a call of set_motion(), set_filter() or set_sensor(), has the pairs
  //                   tested again. Separations are off by twice the tolerance at most, except of
  //                   one-sided triangles and inner edges, which see from which side a body comes.
  //                   Nothing without carry_results
  Accuracy accuracy = {};

  bool pair_changes = false;  // World::added_pairs() and removed_pairs()

  // A step that finds more is incomplete (StepReport::search): it has no pairs, like a step in
  // which nothing meets. What overlapped before ends, and begins again in the next complete step.
  size_t most_pairs = PairFinder::kMostPairs;

  // Looking ahead, for bodies with a Detection; without any, nothing below costs or changes
  // anything. A step looks at the interval from now to dt seconds later, in which every body moves
  // with its velocities, whether it is looked after itself or not: displacement and rotation are
  // velocity x dt, rounded to float32. Finite, >= 0.
  double dt = 1.0 / 60;
  // Detection::automatic: a body is fast, and continuous, if its points move by more than this
  // share of the diameter of a ball that fits into it (of triangles and meshes none does). A point
  // moves by the displacement, and by the angle times the distance of the farthest one. Half-spaces
  // are never fast.
  float fast_share = 0.5f;
  Impacts impacts = Impacts::earliest;
};

// Writable arrays of a world, indexed by BodyId::index. They move when bodies are added or
// removed: ask again then. Rows of indices that no body has (World::is_alive) are ignored.
struct BodyArrays {
  size_t count = 0;  // highest living index + 1
  // Records of x, y, z, w, in the world's position type (the other pointer is nullptr). w is the
  // radius of a sphere; leave it alone for other kinds, where FastKnobs::proxy_spheres may use it.
  float* record32 = nullptr;
  double* record64 = nullptr;
  // Quaternions x, y, z, w, which need not be unit ones; nullptr until there is a body of a kind
  // that has an orientation: capsule, box, half-space, triangle. Those of spheres and aabbs are
  // ignored.
  float* orientation = nullptr;
};

// Corners of aabb bodies relative to their positions, in six columns, indexed by box slot. A body
// keeps its slot for as long as its shape is a box.
struct BoxArrays {
  size_t count = 0;  // highest slot in use + 1
  std::array<float*, 3> lower{};
  std::array<float*, 3> upper{};
};

// Parameters of capsules, boxes, half-spaces and triangles in rows of four floats, as ShapeRows
// says. A body keeps its rows for as long as its kind has as many.
struct ShapeRowArrays {
  size_t count = 0;  // highest row in use + 1
  float* rows = nullptr;
};

// A point inside a body or on its surface.
struct PointHit {
  uint32_t point;    // index into the query
  uint32_t body;     // body index
  float separation;  // <= 0: how deep it lies, in metres
};

// Memory of a world, in bytes.
struct WorldMemory {
  size_t bodies = 0;             // bodies, and the copies that say what changed
  size_t bounds = 0;             // swept and fat ones and k-DOPs included
  size_t broadphase = 0;         // search structures and what they keep
  size_t pairs_and_results = 0;  // of this step and the last one; contacts and events, too

  size_t total() const { return bodies + bounds + broadphase + pairs_and_results; }
};

// All functions take ids of living bodies unless they say otherwise; a dead id is a programming
// mistake where it is not answered with false. A World is used by one thread at a time.
class CAROM_EXPORT World {
 public:
  explicit World(const WorldSettings& settings = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  const WorldSettings& settings() const;

  // Bodies. Indices are handed out from 0; the lowest free one is used again first.
  BodyId add(const BodyDesc& body);
  void add(std::span<const BodyDesc> bodies, std::vector<BodyId>& ids);  // appends to ids
  bool remove(BodyId id);                      // false if it is dead already
  size_t remove(std::span<const BodyId> ids);  // how many were alive
  bool contains(BodyId id) const;
  size_t size() const;                  // living bodies
  bool is_alive(uint32_t index) const;  // whether a body lives at this index
  BodyId id_of(uint32_t index) const;   // of the body that lives there

  // Properties, one body at a time.
  Eigen::Vector3d position(BodyId id) const;
  void set_position(BodyId id, const Eigen::Vector3d& position);
  void set_positions(std::span<const BodyId> ids, std::span<const Eigen::Vector3d> positions);
  // Spheres and aabbs have no orientation: they answer with the identity, and keep no other. A body
  // that changes from one of these kinds begins with the identity.
  Eigen::Quaternionf orientation(BodyId id) const;
  void set_orientation(BodyId id, const Eigen::Quaternionf& orientation);
  Shape shape(BodyId id) const;
  void set_shape(BodyId id, const Shape& shape);
  Eigen::Vector3f linear_velocity(BodyId id) const;
  void set_linear_velocity(BodyId id, const Eigen::Vector3f& velocity);
  // Spheres and aabbs do not turn, whatever it is.
  Eigen::Vector3f angular_velocity(BodyId id) const;
  void set_angular_velocity(BodyId id, const Eigen::Vector3f& velocity);
  Detection detection(BodyId id) const;
  void set_detection(BodyId id, Detection detection);
  Motion motion(BodyId id) const;
  void set_motion(BodyId id, Motion motion);
  void set_filter(BodyId id, uint32_t layer, uint32_t mask, uint32_t owner);
  void set_sensor(BodyId id, bool sensor);
  bool is_sensor(BodyId id) const;
  uint64_t user(BodyId id) const;
  void set_user(BodyId id, uint64_t user);

  // Properties, straight in the arrays. Changes are noticed by comparing with the last step.
  BodyArrays arrays();
  BoxArrays boxes();
  uint32_t box_slot(BodyId id) const;  // of an aabb body
  ShapeRowArrays shape_rows();
  uint32_t first_row(BodyId id) const;  // of a capsule, box, half-space or triangle
  // One a body index; made on first use, and contacts carry normal velocities from then on. The
  // span moves when bodies are added or removed.
  std::span<Eigen::Vector3f> linear_velocities();
  // Likewise; normal velocities of contacts are those of the linear ones alone.
  std::span<Eigen::Vector3f> angular_velocities();

  // WorldSettings::dt of the next step and those that follow.
  void set_dt(double dt);

  // Finds pairs, contacts and events for the bodies as they are now. Memory grows as needed and is
  // kept: a step like the last one allocates nothing.
  const StepReport& step();

  // Results of the last step, sorted by (a, b); valid until the next one.
  // Bodies whose bounds (fat ones, if any) overlap; half-spaces with those whose bounds (never fat
  // ones) reach into them. Two half-spaces are no pair. In a step that looks ahead, pairs of which
  // one body is looked after are those whose bounds over the interval do so, and the others those
  // whose bounds do so now; overlaps, contacts and manifolds are of now in any case.
  std::span<const Pair> pairs() const;
  std::span<const uint8_t> overlaps() const;  // one a pair: 1 overlap, 0 separate, or kUndecided
  std::span<const Contact> contacts() const;  // overlapping pairs without sensors
  // At Detail::manifold one a contact, else none; points are relative to the position of body A.
  std::span<const ManifoldPoints> manifolds() const;
  std::span<const Event> events() const;

  // The pairs with a continuous body that meet in the interval ahead, if all bodies go on as they
  // are, and those that overlap now; sorted by (toi, a, b). At details with a narrow phase. None is
  // missed, and none is late (time_of_impact()), but for bodies whose motion is not finite: they
  // are where they are, and have no impacts (StepReport::unswept). With FastKnobs::proxy_spheres
  // these are impacts of the balls.
  std::span<const Impact> impacts() const;
  // The first of them that stops the body: with no sensor, and nothing that overlaps it now, which
  // contacts() are about. nullptr: there is none.
  const Impact* first_impact(BodyId id) const;
  // Contacts of swept bodies that are not there yet and may be before the interval ends, sorted by
  // (a, b): the bodies do not overlap, and their witness points, going on straight at the velocity
  // that they have, close the gap in time: separation + normal_velocity x dt <= 0. Here the normal
  // velocity is that of the points, rotation included. At details with contacts; no manifolds, and
  // no pairs with sensors or continuous bodies. They promise nothing: bodies that turn, or pass
  // each other by, may meet elsewhere, or not at all.
  std::span<const Contact> speculative_contacts() const;

  // Bodies left out: NaN, infinite or negative size, a quaternion or a plane's normal of zero.
  std::span<const BodyId> quarantined() const;
  const StepReport& report() const;

  // With WorldSettings::pair_changes: pairs that the step before had not, and those that it alone
  // had. If one of its bodies was replaced by another one with the same index, a pair is in both.
  std::span<const Pair> added_pairs() const;
  std::span<const Pair> removed_pairs() const;

  // Replaces `hits` by all bodies that hold each point (x, y, z float32, `stride` bytes apart),
  // sorted by (point, body). Asks the bounds of the last step: bodies must not have changed since.
  // Points that are not finite are in no body. Works in memory of its own, unlike step().
  void find_points(const float* xyz, size_t count, size_t stride,
                   std::vector<PointHit>& hits) const;

  // cast(), find_overlaps() and find_nearest() (carom/queries/cast.h, carom/queries/queries.h)
  // against the bodies whose layer has a bit of `mask`, sensors included. They ask the bounds of
  // the last step as well: bodies must not have changed since. The first call after a step sorts
  // the bodies into a tree, which is kept until the next step; a call costs little more than its
  // queries then.
  void cast(const Collidables& queries, const SweepView& sweep, CastHits which,
            std::vector<CastHit>& hits, uint32_t mask = ~0u) const;
  void find_overlaps(const Collidables& queries, std::vector<OverlapHit>& hits,
                     uint32_t mask = ~0u) const;
  void find_nearest(const Collidables& queries, float within, std::vector<NearestHit>& hits,
                    uint32_t mask = ~0u) const;

  // Memory held, in bytes.
  WorldMemory memory() const;
  size_t bytes() const { return memory().total(); }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
