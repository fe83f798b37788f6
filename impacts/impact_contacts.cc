#include "impacts/impact_contacts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "geometries/mesh_memory.h"
#include "impacts/composite_times.h"
#include "impacts/moving_body.h"
#include "impacts/placed_side.h"
#include "impacts/rays/point_contact.h"
#include "midphase/part_batch.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct ContactScratch {
  MeetingRows meeting;  // simple bodies
  PlacedSide a, b;
  TestColumns columns;
  PartBatch parts;
  std::array<std::array<Double3, 2>, kPairsPerBlock> arms;  // of the parts of every pair
};

class ImpactContacts {
 public:
  ImpactContacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                 const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out,
                 ContactScratch& scratch)
      : side_a_(a),
        side_b_(b),
        a_{a},
        b_{b},
        pairs_(pairs),
        first_(first),
        frame_(frame),
        out_(out),
        scratch_(scratch) {}

  void run() {
    scratch_.parts.begin({.counts_near = false});
    write_nothing();
    sort_rows();
    run_bodies();
    run_parts();
  }

 private:
  // Whether A is a point and B a surface, and neither turns. Rays at meshes are common, and need
  // less than other parts.
  bool is_point_at_surface(size_t row) const {
    const Pair pair = pairs_[row];
    return a_.body().kind(pair.a) == ShapeKind::sphere && a_.body().radius(pair.a) == 0 &&
           is_surface(b_.body().kind(pair.b)) && !a_.turns(pair.a) && !b_.turns(pair.b);
  }

  bool is_composite(size_t row) const {
    return carom::is_composite(a_.body().kind(pairs_[row].a)) ||
           carom::is_composite(b_.body().kind(pairs_[row].b));
  }

  // For the rows that do not meet; the others are overwritten.
  void write_nothing() {
    const auto fill = [this](float* column) {
      if (column) std::fill_n(column, first_.count, kNan);
    };
    fill(out_.separation);
    for (const std::array<float*, 3>& columns : {out_.normal, out_.point_a, out_.point_b}) {
      std::for_each(columns.begin(), columns.end(), fill);
    }
  }

  void sort_rows() {
    MeetingRows& meeting = scratch_.meeting;
    const bool may_have_parts =
        may_be_composite(side_a_.bodies) || may_be_composite(side_b_.bodies);
    size_t count = 0;
    for (size_t row = 0; row < first_.count; ++row) {
      bool is_simple = first_.time[row] <= 1;
      if (may_have_parts) is_simple = !take_parts(row) && is_simple;
      meeting.row[count] = static_cast<uint16_t>(row);
      count += is_simple;
    }
    meeting.count = count;
    for (size_t i = 0; i < count; ++i) {
      const size_t row = meeting.row[i];
      meeting.body_a[i] = pairs_[row].a;
      meeting.body_b[i] = pairs_[row].b;
      meeting.time[i] = first_.time[row];
    }
  }

  static bool may_be_composite(const Collidables& bodies) {
    return bodies.kind || carom::is_composite(bodies.uniform_kind);
  }

  // Returns whether the row meets and has parts.
  bool take_parts(size_t row) {
    prefetch(row);
    if (!(first_.time[row] <= 1)) return false;
    if (is_point_at_surface(row)) {
      take_triangle(row);
      return true;
    }
    if (!is_composite(row)) return false;
    add_parts(row);
    return true;
  }

  void run_bodies() {
    const MeetingRows& meeting = scratch_.meeting;
    if (meeting.count == 0) return;
    scratch_.a.start_at_a(meeting);
    scratch_.b.start_at_b(side_a_, side_b_, meeting);
    scratch_.a.place(side_a_, meeting.body_a.data(), meeting);
    scratch_.b.place(side_b_, meeting.body_b.data(), meeting);
    const ResultColumns found = test(scratch_.a.view(), scratch_.b.view(), meeting.count);
    if (frame_ == WitnessFrame::body) return write_bodies(found);
    for (size_t i = 0; i < meeting.count; ++i) write(meeting.row[i], found, i, {});
  }

  // Points relative to the bodies, column by column.
  void write_bodies(const ResultColumns& found) {
    const auto as_found = [](float number) { return number; };
    const auto of_point = [](float number) { return number + 0.0f; };  // no zero is negative
    write_column(found.separation, as_found, out_.separation);
    for (size_t axis = 0; axis < 3; ++axis) {
      write_column(found.normal[axis], as_found, out_.normal[axis]);
      write_column(found.point_a[axis], of_point, out_.point_a[axis]);
      write_column(found.point_b[axis], of_point, out_.point_b[axis]);
    }
  }
  template <class Number>
  void write_column(const float* found, const Number& number, float* column) {
    if (!column) return;
    const MeetingRows& meeting = scratch_.meeting;
    for (size_t i = 0; i < meeting.count; ++i) column[meeting.row[i]] = number(found[i]);
  }

  void take_triangle(size_t row) {
    const Pair pair = pairs_[row];
    const double t = first_.time[row];
    const Double3 between = place_between(a_, b_, pair), way = way_between(a_, b_, pair);
    const Row orientation = b_.body().orientation(pair.b);
    if (orientation != last_orientation_) {
      last_orientation_ = orientation;
      last_turn_ = rotation_of(orientation);
    }
    scalar::Separation found;
    find_point_contact({.surface = surface_of(row),
                        .place = plus(between, {way[0] * t, way[1] * t, way[2] * t}),
                        .orientation = orientation,
                        .turn = last_turn_,
                        .one_sided = side_b_.one_sided},
                       triangle_of(row), found);
    write(row, found, {});
  }

  Surface surface_of(size_t row) const {
    const uint32_t body = pairs_[row].b;
    return surface_at(b_.body().kind(body), b_.body().row(body, 0));
  }
  const MeshGeometry& mesh_of(size_t row) const {
    return *geometry_at<MeshGeometry>(b_.body().row(pairs_[row].b, 0));
  }
  uint32_t triangle_of(size_t row) const { return static_cast<uint32_t>(first_.parts[row][1]); }

  // Triangles that rays meet lie far apart in memory.
  void prefetch(size_t row) const {
    constexpr size_t kIndicesAhead = 16, kCornersAhead = 8;
    const auto takes = [&](size_t i) {
      return first_.time[i] <= 1 && b_.body().kind(pairs_[i].b) == ShapeKind::mesh;
    };
    if (row + kIndicesAhead < first_.count && takes(row + kIndicesAhead)) {
      prefetch_indices(mesh_of(row + kIndicesAhead), triangle_of(row + kIndicesAhead));
    }
    if (row + kCornersAhead < first_.count && takes(row + kCornersAhead)) {
      prefetch_corners(mesh_of(row + kCornersAhead), triangle_of(row + kCornersAhead));
    }
  }

  // Tests row i of A with row i of B.
  ResultColumns test(const Collidables& a, const Collidables& b, size_t count) {
    const ResultColumns found = scratch_.columns.columns();
    run_pair_block({.a = a,
                    .b = b,
                    .pairs = nullptr,
                    .first = 0,
                    .count = count,
                    .detail = Detail::contact,
                    .frame = WitnessFrame::body,
                    .accuracy = {},
                    .out = found});
    return found;
  }

  // Adds the two parts that meet. Positions are relative to A at the start.
  void add_parts(size_t row) {
    const PlacedBodies bodies(side_a_, side_b_, pairs_[row]);
    const size_t i = scratch_.parts.count();
    PlacedPart a = part_at(bodies.a, first_.parts[row][0]);
    PlacedPart b = part_at(bodies.b, first_.parts[row][1]);
    scratch_.arms[i] = {place(a, bodies.a.position, a_, pairs_[row].a, row),
                        place(b, bodies.b.position, b_, pairs_[row].b, row)};
    scratch_.parts.add(row, a, b, 0);
  }

  // Moves a part to its time of impact; `pivot` is its body's pivot at the start. Returns the arm
  // then.
  Double3 place(PlacedPart& part, const Double3& pivot, const MovingReader& side, size_t body,
                size_t row) {
    const PlaceInTime place =
        place_at(pivot, part.arm, part.orientation, side, body, first_.time[row]);
    part.position = place.position;
    part.orientation = place.orientation;
    part.turn = part.part->is_turned() ? rotation_of(place.orientation) : kNotTurned;
    return place.arm;
  }

  void run_parts() {
    scratch_.parts.run();
    for (size_t i = 0; i < scratch_.parts.count(); ++i) {
      write(scratch_.parts.owner(i), scratch_.parts.results(), i, scratch_.arms[i]);
    }
  }

  void write(size_t row, const ResultColumns& found, size_t i, const std::array<Double3, 2>& arms) {
    const auto vector = [i](const std::array<float*, 3>& columns) -> Eigen::Vector3f {
      return {columns[0][i], columns[1][i], columns[2][i]};
    };
    write(row,
          {.separation = found.separation[i],
           .normal = vector(found.normal),
           .arm_a = vector(found.point_a),
           .arm_b = vector(found.point_b)},
          arms);
  }

  // `arms`: from the bodies' positions at the time of impact to the origins of the found points.
  void write(size_t row, const scalar::Separation& found, const std::array<Double3, 2>& arms) {
    if (frame_ == WitnessFrame::body) return write_about(row, found, arms[0], arms[1]);
    const auto then = [this, row](const MovingReader& side, size_t body, const Double3& arm) {
      return plus(position_then(side, body, first_.time[row]), arm);
    };
    write_about(row, found, then(a_, pairs_[row].a, arms[0]), then(b_, pairs_[row].b, arms[1]));
  }

  void write_about(size_t row, const scalar::Separation& found, const Double3& arm_a,
                   const Double3& arm_b) {
    if (out_.separation) out_.separation[row] = found.separation;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const auto seen = [](float point, double arm) { return static_cast<float>(point + arm); };
      if (out_.normal[axis]) out_.normal[axis][row] = found.normal[i];
      if (out_.point_a[axis]) out_.point_a[axis][row] = seen(found.arm_a[i], arm_a[axis]);
      if (out_.point_b[axis]) out_.point_b[axis][row] = seen(found.arm_b[i], arm_b[axis]);
    }
  }

  static Double3 position_then(const MovingReader& side, size_t body, double t) {
    const Position<double> p = side.body().position<double>(body);
    const Position<float> d = side.displacement(body);
    return {p.x + d.x * t, p.y + d.y * t, p.z + d.z * t};
  }

  const MovingSide &side_a_, &side_b_;
  const MovingReader a_, b_;
  const Pair* pairs_;
  const FirstTimes first_;
  const WitnessFrame frame_;
  const ImpactColumns& out_;
  ContactScratch& scratch_;

  // Rays mostly meet one mesh after another.
  Row last_orientation_{};  // none that a mesh can have
  Turn last_turn_;
};

}  // namespace

void find_impact_contacts(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          const FirstTimes& first, WitnessFrame frame, const ImpactColumns& out) {
  static thread_local const auto scratch = std::make_unique_for_overwrite<ContactScratch>();
  ImpactContacts(a, b, pairs, first, frame, out, *scratch).run();
}

}  // namespace carom
