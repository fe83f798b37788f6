// The bodies of a world in flat arrays. A column that no body needs does not exist.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/shapes/body.h"
#include "carom/shapes/rungs.h"
#include "carom/shapes/views.h"
#include "world/store/dop_geometries.h"
#include "world/store/index_pool.h"
#include "world/store/row_pool.h"

namespace carom {

class BodyStore {
 public:
  using Row = std::array<float, 4>;  // a row of shape_rows(), or a quaternion x, y, z, w
  static constexpr Row kIdentity = {0, 0, 0, 1};
  // The corners of an aabb and a zero each. A record lies in one line of the cache.
  struct alignas(32) BoxRecord {
    Row lower, upper;
  };

  // `tolerance`: of bodies that have none of their own, metres. `uses_models`: whether the rungs of
  // ladders may stand for shapes.
  explicit BodyStore(PositionType positions, float tolerance = 0, bool uses_models = false)
      : positions_(positions), tolerance_of_world_(tolerance), uses_models_(uses_models) {}

  BodyId add(const BodyDesc& body);
  void remove(BodyId id);
  bool contains(BodyId id) const {
    return id.index < rows() && is_alive(id.index) && generation_[id.index] == id.generation;
  }

  size_t rows() const { return alive_.end(); }  // highest living index + 1
  size_t size() const { return alive_.size(); }
  bool is_alive(uint32_t index) const { return alive_.is_used(index); }
  BodyId id_of(uint32_t index) const { return {index, generation_[index]}; }
  std::span<const uint32_t> generations() const { return generation_; }
  // Whether a body was ever removed. Until then all generations are 0.
  bool any_removed() const { return any_removed_; }

  Eigen::Vector3d position(uint32_t index) const;
  void set_position(uint32_t index, const Eigen::Vector3d& position);
  // For bodies of kinds that have one. The others have the identity, and setting another has no
  // effect.
  Orientation orientation(uint32_t index) const;
  void set_orientation(uint32_t index, const Orientation& orientation);
  Shape shape(uint32_t index) const;
  void set_shape(uint32_t index, const Shape& shape);
  uint32_t box_slot(uint32_t index) const { return box_slot_[index]; }
  uint32_t first_row(uint32_t index) const { return first_row_[index]; }

  Motion motion(uint32_t index) const;
  void set_motion(uint32_t index, Motion motion);
  void set_filter(uint32_t index, uint32_t layer, uint32_t mask, uint32_t owner);
  void set_group(uint32_t index, int32_t group);
  std::span<const uint32_t> spaces() const { return space_; }  // empty: all are in space 0
  void set_space(uint32_t index, uint32_t space);
  bool is_sensor(uint32_t index) const { return !sensor_.empty() && sensor_[index]; }
  // Whether some body is, or was, a sensor.
  bool knows_sensors() const { return !sensor_.empty(); }
  void set_sensor(uint32_t index, bool sensor);
  float contact_distance(uint32_t index) const {
    return contact_distance_.empty() ? 0 : contact_distance_[index];
  }
  void set_contact_distance(uint32_t index, float distance);
  // The shape that tests see: itself, or the model that stands for it.
  Shape tested_shape(uint32_t index) const;
  // The geometry of that, of bodies that have one.
  const std::shared_ptr<const void>& geometry(uint32_t index) const { return geometry_[index]; }
  // How far the model that stands for the shape of a body may be from it, metres; 0: none does.
  double model_error(uint32_t index) const { return model_.empty() ? 0 : model_[index].error; }
  // The models of a pair leave at least this of its tolerance, metres. 0 where a body has its own.
  float spare_tolerance() const {
    if (!tolerance_.empty()) return 0;
    return static_cast<float>((tolerance_of_world_ - 2 * greatest_model_error_) * (1 - 0x1p-20));
  }
  // Counts the pairs that have a body for which a model stands: StepReport::by_rung.
  void count_by_rung(std::span<const Pair> pairs, std::span<size_t, kCountedRungs> counts) const;
  // None: that of the world.
  std::optional<float> tolerance(uint32_t index) const {
    if (tolerance_.empty() || tolerance_[index] < 0) return std::nullopt;
    return tolerance_[index];
  }
  void set_tolerance(uint32_t index, std::optional<float> tolerance);
  // Whether some body has one of its own that is more than 0.
  bool has_tolerances() const { return tolerant_ > 0; }
  uint64_t user(uint32_t index) const { return user_.empty() ? 0 : user_[index]; }
  void set_user(uint32_t index, uint64_t user);
  Eigen::Vector3f linear_velocity(uint32_t index) const;
  void set_linear_velocity(uint32_t index, const Eigen::Vector3f& velocity);
  Eigen::Vector3f angular_velocity(uint32_t index) const;
  void set_angular_velocity(uint32_t index, const Eigen::Vector3f& velocity);
  Detection detection(uint32_t index) const;
  void set_detection(uint32_t index, Detection detection);

  // The arrays themselves.
  LargeVector<float>& records32() { return records32_; }
  const LargeVector<float>& records32() const { return records32_; }
  LargeVector<double>& records64() { return records64_; }
  const LargeVector<double>& records64() const { return records64_; }
  LargeVector<BoxRecord>& boxes() { return boxes_; }
  const LargeVector<BoxRecord>& boxes() const { return boxes_; }
  LargeVector<Row>& orientations() { return orientation_; }
  const LargeVector<Row>& orientations() const { return orientation_; }
  // Callers may write poses, boxes, or rows of shapes, from now on and as long as they like.
  void share_poses() { shares_poses_ = true; }
  void share_boxes() { shares_boxes_ = true; }
  void share_shape_rows() { shares_shape_rows_ = true; }
  bool shares_poses() const { return shares_poses_; }
  bool shares_boxes() const { return shares_boxes_; }
  bool shares_shape_rows() const { return shares_shape_rows_; }
  std::span<Row> shape_rows() { return {rows_.data(), row_pool_.end()}; }
  std::span<const Row> shape_rows() const { return {rows_.data(), row_pool_.end()}; }
  // Finds the geometry of k-DOPs whose rows a caller wrote.
  void find_geometries();
  std::span<Eigen::Vector3f> linear_velocities();
  bool has_velocities() const { return has_velocities_; }
  std::span<Eigen::Vector3f> angular_velocities();
  bool has_angular_velocities() const { return has_angular_velocities_; }
  // Whether some body has a detection that is not discrete.
  bool has_detections() const { return detected_ > 0; }

  // One a row; of a row without a body, too.
  std::span<const ShapeKind> kinds() const { return kind_; }
  // One a row; nullptr if every body has 0.
  const float* contact_distances() const {
    return contact_distance_.empty() ? nullptr : contact_distance_.data();
  }

  // Inputs of the stages.
  size_t count_of(ShapeKind kind) const { return bodies_of_kind_[static_cast<size_t>(kind)]; }
  bool has_kind(ShapeKind kind) const { return count_of(kind) > 0; }
  bool has_composites() const {
    return has_kind(ShapeKind::mesh) || has_kind(ShapeKind::height_field) ||
           has_kind(ShapeKind::compound);
  }
  Collidables view() const;
  // The columns of the filter; its other parts are those of a default one.
  PairFilter filter() const;
  const std::vector<uint32_t>& free_indices() { return alive_.free_indices(); }
  const std::vector<uint32_t>& halfspaces() const { return halfspaces_; }  // indices, ascending

  // One byte a row: what the calls above have done since clear_touched(). It does not cover writes
  // into the arrays.
  static constexpr uint8_t kShapeTouched = 1;  // shape, or another input of results beside the pose
  static constexpr uint8_t kReplaced = 2;      // the body was added or removed since the last step
  uint8_t touched(uint32_t index) const { return touched_[index] & (kShapeTouched | kReplaced); }
  bool any_touched() const { return !touched_indices_.empty(); }
  // The rows with a byte that is not zero. Rows of removed bodies at rows() and beyond may be among
  // them.
  const std::vector<uint32_t>& touched_indices() const { return touched_indices_; }
  // Other rows whose pose was set to another one, unless poses are shared. touched() is 0 for them
  // unless they were touched later. Rows at rows() and beyond may be among them.
  const std::vector<uint32_t>& moved_indices() const { return moved_indices_; }
  void clear_touched();
  void touch_all();  // as if all bodies had been added since the last step

  void give_back();
  size_t bytes() const;

 private:
  template <class Self, class Visit>
  static void for_each_column(Self& self, const Visit& visit);
  void add_row();
  void drop_rows();
  static constexpr uint8_t kMoved = 4;  // in moved_indices_
  void touch(uint32_t index, uint8_t how);
  void note_move(uint32_t index);
  void count_kind(uint32_t index, int change);
  void change_kind(uint32_t index, ShapeKind kind);
  void change_rows(uint32_t index, uint32_t last_count, uint32_t count);
  void store_tolerance(uint32_t index, std::optional<float> tolerance);
  void store_shape(uint32_t index, const Shape& shape);
  void store_model(uint32_t index, const Shape& shape);
  void store_box(uint32_t index, const Aabb& box);
  void store_geometry(uint32_t index, const Shape& shape);
  void set_dop_geometry(uint32_t index, const Dop& dop);
  bool knows_geometry(uint32_t index) const;
  Dop owning_dop(uint32_t index) const;
  void take_box(uint32_t index);
  void release_box(uint32_t index);
  void add_halfspace(uint32_t index);
  void remove_halfspace(uint32_t index);
  void resize_rows();
  void store_detection(uint32_t index, Detection detection);
  float radius(uint32_t index) const;
  void set_radius(uint32_t index, float radius);

  // The model that stands for the shape of a body.
  struct Model {
    double error = 0;
    uint32_t rung = 0;                      // of the ladder, from 1; 0: the shape itself
    std::shared_ptr<const Shape> original;  // with its ladder; nullptr: it has none
  };

  PositionType positions_;
  float tolerance_of_world_;
  double greatest_model_error_ = 0;  // so far
  bool uses_models_;
  IndexPool alive_;
  std::vector<uint32_t> generation_;
  // generation of new rows, above those of all bodies that dropped rows had
  uint32_t first_generation_ = 0;
  bool any_removed_ = false;
  std::vector<ShapeKind> kind_;  // sphere for a row without a body
  std::array<size_t, kShapeKindCount> bodies_of_kind_{};
  std::vector<uint8_t> touched_;  // includes rows that were dropped since clear_touched()
  std::vector<uint32_t> touched_indices_, moved_indices_;
  bool shares_poses_ = false;

  LargeVector<float> records32_;  // x, y, z, w a row; one of the two columns is empty
  LargeVector<double> records64_;

  // Rows are slots, which only aabb bodies get.
  IndexPool slots_;
  LargeVector<BoxRecord> boxes_;
  std::vector<uint32_t> box_slot_;  // empty until there is a box; 0 for other kinds
  size_t boxes_elsewhere_ = 0;      // aabb bodies whose slot is not their index
  bool shares_boxes_ = false;

  // Parameters of all kinds but spheres and aabbs, in blocks of rows. After the last block follow
  // kMostRows - 1 rows of zero, so that kMostRows rows can be read from any row.
  RowPool row_pool_;
  LargeVector<Row> rows_;
  bool shares_shape_rows_ = false;
  std::vector<uint32_t> first_row_;  // empty until there is such a body; 0 for other kinds
  size_t rows_elsewhere_ = 0;        // bodies whose rows do not begin at their index x row_count()
  LargeVector<Row> orientation_;     // likewise; the identity for other kinds

  std::vector<uint32_t> halfspaces_;

  // Keeps the geometries alive whose addresses are in the rows. Empty until there is one.
  std::vector<std::shared_ptr<const void>> geometry_;
  // Those of k-DOPs. Empty until there is one; nullptr for other kinds.
  std::vector<const DopGeometry*> dop_;
  DopGeometries dop_geometries_;

  // These are empty while every body has the default.
  std::vector<Motion> motion_;
  std::vector<uint32_t> layer_, mask_, owner_, space_;
  std::vector<int32_t> group_;
  std::vector<uint8_t> sensor_;
  std::vector<float> contact_distance_;
  std::vector<float> tolerance_;
  size_t tolerant_ = 0;       // bodies with more than 0
  std::vector<Model> model_;  // empty while no body has one
  std::vector<uint64_t> user_;
  std::vector<Detection> detection_;
  size_t detected_ = 0;  // bodies whose detection is not discrete
  LargeVector<Eigen::Vector3f> velocity_, angular_velocity_;
  bool has_velocities_ = false;
  bool has_angular_velocities_ = false;
};

}  // namespace carom
