// Simple bodies at their times of impact, for the narrow phase.
#pragma once

#include <array>
#include <cstdint>

#include "impacts/body_columns.h"
#include "impacts/moving_body.h"
#include "midphase/placed_part.h"
#include "narrowphase/batch/column_memory.h"

namespace carom {

// The pose of a body, or of a part, at a time.
struct PlaceInTime {
  Double3 position;
  Double3 arm;  // from the pivot of the body
  Row orientation;
};

PlaceInTime place_at(const Double3& pivot, const Double3& arm, const Row& orientation,
                     const MovingReader& side, size_t body, double t);

// Rows of a block that meet: of each its bodies and its time.
struct MeetingRows {
  size_t count;
  std::array<uint16_t, kPairsPerBlock> row;
  std::array<uint32_t, kPairsPerBlock> body_a, body_b;
  std::array<double, kPairsPerBlock> time;
};

// The bodies of one side of these rows, packed. Their shape rows stay in the caller's arrays.
class PlacedSide {
 public:
  // Sets where the bodies are at the start, relative to those of A. So the contact does not depend
  // on where both are.
  void start_at_a(const MeetingRows& meeting);
  void start_at_b(const MovingSide& a, const MovingSide& b, const MeetingRows& meeting);
  // Moves the bodies to their times. `body`: of each row.
  void place(const MovingSide& side, const uint32_t* body, const MeetingRows& meeting);

  Collidables view() const;

 private:
  void move(const BodyColumns& side, const double* time);
  void put_radii(const BodyColumns& side);
  void put_orientations(const MovingSide& side, const double* time);
  void put_shapes(const BodyColumns& side);

  const MovingSide* side_;
  const uint32_t* body_;
  size_t count_ = 0;
  alignas(64) std::array<std::array<double, 4>, kPairsPerBlock> record_;
  std::array<Row, kPairsPerBlock> orientation_;
  std::array<ShapeKind, kPairsPerBlock> kind_;
  std::array<const DopGeometry*, kPairsPerBlock> dops_;
  std::array<uint32_t, kPairsPerBlock> first_row_, box_slot_;
};

}  // namespace carom
