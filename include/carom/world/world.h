/// @file
/// The collision world: bodies in flat arrays, one step a frame, contacts and events out.
#pragma once

#include <array>
#include <concepts>
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
#include "carom/results/contact_identity.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "carom/results/pair.h"
#include "carom/results/space_groups.h"
#include "carom/results/tier.h"
#include "carom/shapes/body.h"
#include "carom/shapes/dop.h"
#include "carom/world/step_report.h"

namespace carom {

/// Settings of a World. Only `dt` can be changed later (World::set_dt()).
struct WorldSettings {
  PositionType positions = PositionType::float32;             ///< how positions are stored
  Detail detail = Detail::contact;                            ///< what a step finds of each pair
  BroadphaseMethod broadphase = BroadphaseMethod::automatic;  ///< how candidate pairs are found
  Parallelism parallelism = Parallelism::arena;               ///< which threads a step may use
  RegionLimits region_limits = {};  ///< how contacts are divided at Detail::regions

  /// Metres, finite, >= 0. Separate pairs with at most this separation have contacts, too, before
  /// they touch: with a positive separation, points, and at details with manifolds all points that
  /// are this near. Bounds grow by it, so there are more candidate pairs. Overlaps and events do
  /// not change. BodyDesc::contact_distance raises it for the pairs of one body: the larger
  /// distance counts, so that a body with a wide one changes no pair of other bodies. Costs nothing
  /// while all distances are 0. dop_bounds are not used with contact distances.
  float contact_distance = 0;
  bool events = true;           ///< find begins and ends of overlaps
  bool persist_events = false;  ///< with `events`: also one event for each overlap that goes on
  bool carry_results = true;    ///< false: every step finds and tests every pair anew

  /// Metres by which bounds are fattened, finite and >= 0. A body keeps its fat bounds, and the
  /// pairs that they make, until its true bounds leave them: for many bodies that move little at a
  /// time. Which candidate pairs there are then depends on the paths of the bodies. Overlaps,
  /// contacts and events are those of a world without margin.
  float margin = 0;

  /// Pairs with separate k-DOPs are not tested: tighter bounds, for shapes whose boxes are mostly
  /// empty and whose tests cost more than that (docs/dop_bounds.md). Pairs and all results are the
  /// same with and without. A 6-DOP equals the bounds, and drops nothing.
  std::optional<DopKind> dop_bounds = std::nullopt;

  /// The tier and the tolerance. Undecided pairs (Tier::certified) are kUndecided in overlaps(),
  /// and make neither contacts nor events.
  /// With a tolerance, a step holds on to the bounds of bodies and to the results of pairs while
  /// these have moved too little to matter; with carry_results alone. Bounds are then larger than
  /// bodies, so there may be more candidate pairs. Contacts that are kept stay as they were tested,
  /// arms and points relative to the bodies included. At one-sided triangles and inner edges, where
  /// results depend on the side from which a body comes, they are those of a body that is within
  /// the tolerance of this one. Results then depend on the paths of the bodies. After a change of
  /// its shape, or a call of set_motion(), set_filter() or set_sensor(), the pairs of a body are
  /// tested again. A step that looks ahead holds on to nothing.
  Accuracy accuracy = {};

  FilterRule filter_rule = FilterRule::both;  ///< what layers and masks must say for a pair

  /// The order of pairs(). Any order is for Detail::pairs without pair_changes, half-spaces and
  /// excluded pairs; other worlds need their pairs sorted, and have them so.
  PairOrder pair_order = PairOrder::sorted;

  bool identities = false;    ///< provide World::identities(), at details with contacts
  bool pair_changes = false;  ///< provide World::added_pairs() and removed_pairs()

  /// The limit of candidate pairs, those of excluded pairs and of the predicate counted with them.
  /// A step that finds more is incomplete (StepReport::search): it has no pairs, like a step in
  /// which nothing meets. Earlier overlaps end, and begin again in the next complete step.
  size_t most_pairs = PairFinder::kMostPairs;

  /// Seconds that a step looks ahead for bodies with a Detection other than discrete; finite, >= 0.
  /// Without such bodies, this setting and those below cost and change nothing. In the interval
  /// from now to dt later every body moves with its velocities, whatever its own Detection:
  /// displacement and rotation are velocity x dt, rounded to float32.
  double dt = 1.0 / 60;
  /// For Detection::automatic: a body is fast, and then continuous, if its points may move by more
  /// than this share of the diameter of a ball that fits into it (0 for triangles and meshes). A
  /// point may move by the displacement plus the angle times the distance of the furthest point.
  /// Half-spaces are never fast.
  float fast_share = 0.5f;
  Impacts impacts = Impacts::earliest;  ///< which impacts are kept
};

/// Writable arrays of a world, indexed by BodyId::index. They move when bodies are added or
/// removed: ask for them again then. Rows of indices without a body (World::is_alive()) are
/// ignored.
struct BodyArrays {
  size_t count = 0;  ///< highest living index + 1
  /// Records of x, y, z, w, world frame, metres; nullptr if the world stores float64. w is the
  /// radius of a sphere, and nothing for other kinds.
  float* record32 = nullptr;
  double* record64 = nullptr;  ///< likewise; nullptr if the world stores float32
  /// Quaternions x, y, z, w, which need not be unit ones; nullptr until there is a body of a kind
  /// that has an orientation (all but sphere and aabb). Those of spheres and aabbs are ignored.
  float* orientation = nullptr;
};

/// Corners of aabb bodies relative to their positions, metres, in records indexed by box slot
/// (World::box_slot()). A body keeps its slot for as long as its shape is an aabb.
struct BoxArrays {
  size_t count = 0;          ///< highest slot in use + 1
  float* corners = nullptr;  ///< 8 * count floats: lower x, y, z, 0, upper x, y, z, 0

  /// The lower corner in a slot; the upper one is lower(slot) + 4.
  float* lower(size_t slot) const { return corners + 8 * slot; }
  float* upper(size_t slot) const { return corners + 8 * slot + 4; }  ///< the upper corner
};

/// Parameters of all kinds but spheres and aabbs in rows of four floats, laid out as ShapeRows
/// says. A body keeps its rows (World::first_row()) for as long as its kind has as many.
struct ShapeRowArrays {
  size_t count = 0;       ///< highest row in use + 1
  float* rows = nullptr;  ///< 4 * count floats
};

/// A point inside a body or on its surface.
struct PointHit {
  uint32_t point;    ///< index into the query
  uint32_t body;     ///< body index
  float separation;  ///< metres, <= 0: minus the depth of the point
};

/// Memory of a world, in bytes.
struct WorldMemory {
  size_t bodies = 0;             ///< bodies, and the copies that show which bodies changed
  size_t bounds = 0;             ///< bounds, swept and fat ones and k-DOPs included
  size_t broadphase = 0;         ///< search structures and the pairs that they keep
  size_t pairs_and_results = 0;  ///< of this step and the last one; contacts and events, too

  /// The sum of all.
  size_t total() const { return bodies + bounds + broadphase + pairs_and_results; }
};

/// Bodies and their collisions. All functions take ids of living bodies unless they say otherwise;
/// a dead id is a programming mistake. Spans of results are those of the last step, and valid until
/// the next one. Queries (find_points(), cast(), find_overlaps(), find_nearest()) read the bounds
/// of the last step: bodies must not have changed since. Any number of threads may call functions
/// that are const at the same time; while one calls a function that is not, no other may use the
/// World.
class CAROM_EXPORT World {
 public:
  /// An empty world. Throws std::invalid_argument if the tolerance is negative or not finite.
  explicit World(const WorldSettings& settings = {});
  ~World();
  /// Moves all bodies and results.
  World(World&&) noexcept;
  /// Moves all bodies and results.
  World& operator=(World&&) noexcept;

  /// The settings, with the current dt.
  const WorldSettings& settings() const;

  // Bodies.

  /// Adds a body. Throws std::invalid_argument, and adds none, if its tolerance is negative or not
  /// finite. Indices start at 0; the lowest free one is used again first. A body that is not
  /// valid is added, too, and quarantined by the next step.
  BodyId add(const BodyDesc& body);
  /// Adds bodies in order and appends their ids to `ids`; none if the tolerance of one is bad.
  void add(std::span<const BodyDesc> bodies, std::vector<BodyId>& ids);
  /// Removes a body; false if it is dead already.
  bool remove(BodyId id);
  /// Removes bodies and returns how many of them were alive.
  size_t remove(std::span<const BodyId> ids);
  /// Whether the body of this id lives.
  bool contains(BodyId id) const;
  /// How many bodies live.
  size_t size() const;
  /// Whether a body lives at this index.
  bool is_alive(uint32_t index) const;
  /// The id of the body that lives at this index.
  BodyId id_of(uint32_t index) const;

  // Properties, one body at a time.

  /// World frame, metres, as it is stored.
  Eigen::Vector3d position(BodyId id) const;
  /// Sets a position: world frame, metres. PositionType::float32 rounds it.
  void set_position(BodyId id, const Eigen::Vector3d& position);
  /// Sets one position for each id.
  void set_positions(std::span<const BodyId> ids, std::span<const Eigen::Vector3d> positions);
  /// The rotation from the body's frame to the world. Spheres and aabbs have none: they return the
  /// identity. A body that changes from one of these kinds to another starts with the identity.
  Orientation orientation(BodyId id) const;
  /// Sets an orientation, which need not be a unit quaternion. Spheres and aabbs ignore it.
  void set_orientation(BodyId id, const Orientation& orientation);
  /// The shape; it shares the geometry of the body.
  Shape shape(BodyId id) const;
  /// Replaces the shape. Throws std::invalid_argument at Tier::exact if it does not decide the
  /// shape (is_decided_exactly()), as add() does.
  void set_shape(BodyId id, const Shape& shape);
  /// World frame, metres a second.
  Eigen::Vector3f linear_velocity(BodyId id) const;
  /// Sets a velocity: world frame, metres a second.
  void set_linear_velocity(BodyId id, const Eigen::Vector3f& velocity);
  /// World frame, radians a second. Spheres and aabbs do not turn, whatever it is.
  Eigen::Vector3f angular_velocity(BodyId id) const;
  /// Sets an angular velocity: world frame, radians a second.
  void set_angular_velocity(BodyId id, const Eigen::Vector3f& velocity);
  /// How steps look after this body.
  Detection detection(BodyId id) const;
  /// Sets how steps look after this body.
  void set_detection(BodyId id, Detection detection);
  /// Who moves this body.
  Motion motion(BodyId id) const;
  /// Sets who moves this body.
  void set_motion(BodyId id, Motion motion);
  /// Sets the properties of the same names in BodyDesc.
  void set_filter(BodyId id, uint32_t layer, uint32_t mask, uint32_t owner);
  /// Metres, as it was set.
  float contact_distance(BodyId id) const;
  /// Sets BodyDesc::contact_distance.
  void set_contact_distance(BodyId id, float distance);
  /// Metres, as it was set.
  std::optional<float> tolerance(BodyId id) const;
  /// Sets BodyDesc::tolerance. Throws std::invalid_argument if it is negative or not finite.
  void set_tolerance(BodyId id, std::optional<float> tolerance);
  /// Sets BodyDesc::group.
  void set_group(BodyId id, int32_t group);
  /// Sets BodyDesc::space.
  void set_space(BodyId id, uint32_t space);
  /// Makes a body a sensor or not: sensors have overlaps and events, but no contacts.
  void set_sensor(BodyId id, bool sensor);
  /// Whether this body is a sensor.
  bool is_sensor(BodyId id) const;
  /// The number that the caller gave to this body.
  uint64_t user(BodyId id) const;
  /// Sets the number that user() returns.
  void set_user(BodyId id, uint64_t user);

  // Properties, straight in the arrays. Until the caller asks for an array of poses, boxes or shape
  // rows, a step compares few but those that were set or added; from then on all of that array.

  /// Positions, radii and orientations. From the first call on, steps look at the poses of all
  /// bodies.
  BodyArrays arrays();
  /// Corners of aabb bodies. The step after the first call takes all of them as changed.
  BoxArrays boxes();
  /// The box slot of an aabb body.
  uint32_t box_slot(BodyId id) const;
  /// Parameters of all other kinds but spheres. The step after the first call takes all of them as
  /// changed.
  ShapeRowArrays shape_rows();
  /// The first shape row of a body that is no sphere and no aabb.
  uint32_t first_row(BodyId id) const;
  /// Linear velocities, indexed by BodyId::index; world frame, metres a second. The first call
  /// makes the array, and contacts carry normal velocities from then on. The span moves when bodies
  /// are added or removed.
  std::span<Eigen::Vector3f> linear_velocities();
  /// Angular velocities, likewise, in radians a second. Once the array is there, the normal
  /// velocities of contacts are those of the turning bodies' points.
  std::span<Eigen::Vector3f> angular_velocities();

  // Pairs that never meet, whatever the properties of their bodies allow.

  /// Excludes the pair of two bodies, in any order, from the next step on: they are no candidate
  /// pair. Without effect if it is excluded. When one of the two is removed, the pair is forgotten;
  /// a later body with its index does not inherit it. The next step sorts all that was excluded or
  /// included again in between; any number of pairs may be excluded.
  void exclude(BodyId a, BodyId b);
  /// Excludes pairs of indices of living bodies; a != b, in any order.
  void exclude(std::span<const Pair> pairs);
  /// Takes exclude() back. Without effect if the pair is not excluded.
  void include_again(BodyId a, BodyId b);
  /// Takes exclude() back for pairs of indices of living bodies; a != b, in any order.
  void include_again(std::span<const Pair> pairs);
  /// Whether the pair is excluded. Looks through all changes since the last step.
  bool is_excluded(BodyId a, BodyId b) const;

  /// Sets the predicate that a step asks last about its candidate pairs; an empty function: none.
  /// It gets body indices, and may call is_alive(), id_of() and user() of this world. Set it again
  /// when its answers change: a step in which no body changed does not ask it.
  void set_pair_predicate(PairPredicate predicate);

  /// Sets WorldSettings::dt for the next step and those that follow.
  void set_dt(double dt);

  /// Finds pairs, contacts and events for the bodies as they are now. Memory grows as needed and is
  /// kept: a step like the last one allocates nothing. Results do not depend on threads. If memory
  /// runs out (std::bad_alloc), or what the caller supplies throws, the exception passes on; the
  /// world then has its bodies, exclusions and predicate and no results, and the next step begins
  /// as that of a new world.
  const StepReport& step();

  // Results of the last step, valid until the next one.

  /// Candidate pairs, sorted by (a, b): bodies whose bounds (grown by contact distances, and fat if
  /// there is a margin) overlap, and half-spaces with bodies whose bounds (never fat ones) reach
  /// into them. Two half-spaces are no pair. In a step that looks ahead, a pair with a body that is
  /// looked after uses the bounds over the interval, any other pair the bounds of now; overlaps,
  /// contacts and manifolds are of now in any case.
  std::span<const Pair> pairs() const;
  /// One a pair: 1 overlap, 0 separate, or kUndecided.
  std::span<const uint8_t> overlaps() const;
  /// The contacts of all pairs without sensors that overlap or are within their contact distance,
  /// sorted by (a, b). At Detail::regions those of a pair follow one another, the deepest first.
  std::span<const Contact> contacts() const;
  /// The indices of pairs(), space by space, by the spaces that bodies are in now; those of bodies
  /// removed since the step may count to space 0.
  void group_pairs(SpaceGroups& groups) const;
  /// Likewise of contacts().
  void group_contacts(SpaceGroups& groups) const;
  /// One a contact if WorldSettings::identities, else none: which contact and points of the last
  /// step each one continues.
  std::span<const ContactIdentity> identities() const;
  /// At details with manifolds one a contact, else none; points are relative to the position of
  /// body A.
  std::span<const ManifoldPoints> manifolds() const;
  /// Begins and ends, and persists if asked for, sorted by (a, b), then impacts; as Event says.
  std::span<const Event> events() const;

  /// The pairs with a continuous body that will meet in the interval ahead if all bodies go on as
  /// they are, and those that overlap now; sorted by (toi, a, b). At details with a narrow phase.
  /// None is missed, and none is late (time_of_impact()). A body whose motion is not finite stays
  /// where it is and has no impacts (StepReport::unswept).
  std::span<const Impact> impacts() const;
  /// The first impact that stops the body: not with a sensor, and not with a body that it overlaps
  /// now (contacts() has those). nullptr: there is none.
  const Impact* first_impact(BodyId id) const;
  /// Contacts of swept bodies that may close before the interval ends, sorted by (a, b). The bodies
  /// do not overlap yet; their witness points would close the gap in time if they went on straight
  /// at their present velocity: separation + normal_velocity x dt <= 0. Here the normal velocity is
  /// that of the points, rotation included. At details with contacts; without manifolds, and
  /// without pairs with sensors or continuous bodies. They promise nothing: bodies that turn, or
  /// pass each other by, may meet elsewhere, or not at all.
  std::span<const Contact> speculative_contacts() const;

  /// Bodies that the step left out: NaN, infinite or negative size, a quaternion or a plane's
  /// normal of zero.
  std::span<const BodyId> quarantined() const;
  /// The report of the last step.
  const StepReport& report() const;

  /// With WorldSettings::pair_changes: pairs of this step that the step before did not have. A pair
  /// is added and removed if one of its bodies was replaced by another one with the same index.
  std::span<const Pair> added_pairs() const;
  /// With WorldSettings::pair_changes: pairs of the step before that this step does not have.
  std::span<const Pair> removed_pairs() const;

  // Queries. They read the bounds of the last step: bodies must not have changed since. Between two
  // steps any number of threads may call them at the same time; nothing else may run then but
  // functions that are const.

  /// Replaces `hits` by all bodies that contain each point (`count` records of x, y, z float32,
  /// world frame, metres, `stride` bytes apart) and that the filter of the options lets through,
  /// sorted by (point, body). Points that are not finite are in no body. Unlike step(), every call
  /// allocates its memory.
  void find_points(const float* xyz, size_t count, size_t stride, std::vector<PointHit>& hits,
                   const QueryOptions& options = {}) const;

  /// carom::cast() (carom/queries/cast.h) against the bodies of the world that the filter of the
  /// options lets through. The world keeps an index of its bodies. The first query after a step
  /// brings it up to date on its own thread, while other queries wait (prepare_queries()); later
  /// calls cost little more than their queries.
  void cast(const Collidables& queries, const SweepView& sweep, std::vector<CastHit>& hits,
            const CastOptions& options = {}) const;
  /// carom::find_overlaps() (carom/queries/queries.h), likewise.
  void find_overlaps(const Collidables& queries, std::vector<OverlapHit>& hits,
                     const QueryOptions& options = {}) const;
  /// carom::find_nearest() (carom/queries/queries.h), likewise.
  void find_nearest(const Collidables& queries, float within, std::vector<NearestHit>& hits,
                    const QueryOptions& options = {}) const;
  /// Brings the index of queries up to date with the last step, with the threads of the world.
  /// Queries do it themselves otherwise. Hits are the same.
  void prepare_queries();

  /// The forms of version 0.2, which use the threads of the world's settings. Templates, so that
  /// `{}` in the last place is options.
  [[deprecated("pass CastOptions")]] void cast(const Collidables& queries, const SweepView& sweep,
                                               CastHits which, std::vector<CastHit>& hits,
                                               uint32_t mask = ~0u) const {
    cast(queries, sweep, hits,
         CastOptions{
             .hits = which, .filter = {.mask = mask}, .parallelism = settings().parallelism});
  }
  /// Likewise.
  template <std::integral Mask>
  [[deprecated("pass QueryOptions")]] void find_overlaps(const Collidables& queries,
                                                         std::vector<OverlapHit>& hits,
                                                         Mask mask) const {
    find_overlaps(queries, hits,
                  QueryOptions{.filter = {.mask = static_cast<uint32_t>(mask)},
                               .parallelism = settings().parallelism});
  }
  /// Likewise.
  template <std::integral Mask>
  [[deprecated("pass QueryOptions")]] void find_nearest(const Collidables& queries, float within,
                                                        std::vector<NearestHit>& hits,
                                                        Mask mask) const {
    find_nearest(queries, within, hits,
                 QueryOptions{.filter = {.mask = static_cast<uint32_t>(mask)},
                              .parallelism = settings().parallelism});
  }

  /// Memory held, in bytes, by purpose.
  WorldMemory memory() const;
  /// Memory held, in bytes.
  size_t bytes() const { return memory().total(); }
  /// Gives back memory that the bodies and the results of the last step do not need. A world never
  /// does so by itself: a scene that shrinks and grows again takes no new memory. (Steps free what
  /// looking ahead has used once no body has a detection, and queries build a smaller index once
  /// half of the bodies are gone.) Views of arrays and spans of results
  /// end; results stay. The next step and the next query take as long as first ones.
  void give_back_memory();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom
