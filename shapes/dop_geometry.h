// What a k-DOP's slabs imply, found once and kept with the shape.
#pragma once

#include "base/fetch_ahead.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/hull.h"
#include "shapes/body_reader.h"
#include "shapes/dop_polytope.h"
#include "shapes/dop_solid.h"

namespace carom {

class DopGeometry {
 public:
  // The k-DOP is valid.
  explicit DopGeometry(const Dop& dop);

  DopGeometry(const DopGeometry&) = delete;
  DopGeometry& operator=(const DopGeometry&) = delete;

  // Whether it was found from these slabs, bit for bit.
  bool is_of(const Dop& dop) const { return is_of(shape_rows(dop).data()); }
  // The same for row_count(ShapeKind::dop) rows.
  bool is_of(const Row* rows) const { return is_of(rows->data()); }
  bool is_of(const float* rows) const { return std::memcmp(rows, rows_.data(), sizeof rows_) == 0; }

  // The greatest absolute coordinate in the first three slabs, once they are tight.
  double size() const { return size_; }
  const DopPolytope& polytope() const { return polytope_; }
  // The polytope with its corners rounded to float32. The narrow phase tests it in its place. In
  // the unit of a test (scale_of()) the rounding is at most 2^-24, also of the smallest k-DOPs.
  // nullptr if no corner is left.
  const HullGeometry* hull() const {
    return hull_.geometry.points().empty() ? nullptr : &hull_.geometry;
  }

  // Asks for what is_of() and the tests in lanes read.
  [[gnu::always_inline]] void fetch() const {
    fetch_lines(&rows_, sizeof rows_);
    fetch_lines(&hull_.geometry, HullGeometry::kBytesOfLanes);
    fetch_lines(&hull_.solid, DopSolid::kBytesOfPoints);
  }

  size_t bytes() const;

 private:
  // Side by side, so that tests find them in few lines of the cache and few pages.
  std::array<Row, row_count(ShapeKind::dop)> rows_;
  DopHull hull_;
  double size_;
  DopPolytope polytope_;
};

// The geometry of the k-DOP if it was found from its slabs; else nullptr.
const DopGeometry* known_geometry(const Dop& dop);

// use(geometry): the one that is known, or one that is found for this call.
template <class Use>
auto with_geometry(const Dop& dop, const Use& use) {
  const DopGeometry* known = known_geometry(dop);
  return known ? use(*known) : use(DopGeometry(dop));
}

// The hull of the k-DOP's corners, as DopGeometry::hull(). The k-DOP is valid.
Hull hull_of(const Dop& dop);

// The k-DOP of body i. It does not own its geometry, which is nullptr unless `reader` has one that
// was found from the slabs of now.
Dop read_dop(const BodyReader& reader, size_t i);

}  // namespace carom
