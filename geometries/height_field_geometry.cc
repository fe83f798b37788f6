#include "carom/shapes/height_field_geometry.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>
#include <utility>

#include "base/float_environment.h"
#include "base/fresh_pages.h"
#include "geometries/height_field_limits.h"
#include "geometries/height_pyramid.h"
#include "geometries/inner_edges.h"
#include "geometries/part.h"
#include "trees/tree.h"

namespace carom {
namespace {

size_t size_of(HeightType type) {
  return type == HeightType::float32 ? sizeof(float) : sizeof(int16_t);
}

Error bad_field(const std::string& what) { return {"the height field has " + what}; }

// The least stride that rows of so many samples may have, in either direction.
bool is_stride(ptrdiff_t stride, size_t row_bytes, size_t rows) {
  const auto magnitude = stride < 0 ? size_t{0} - static_cast<size_t>(stride) : size_t(stride);
  return stride == 0 || (magnitude >= row_bytes && magnitude <= PTRDIFF_MAX / rows);
}

Result<void> check(const HeightGrid& grid) {
  const auto is_count = [](uint32_t n) { return n >= 2 && n <= kMostHeightSamples; };
  if (!is_count(grid.nx) || !is_count(grid.ny)) {
    return bad_field(std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " samples (2 to " +
                     std::to_string(kMostHeightSamples) + " along each side were expected)");
  }
  if (uint64_t{2} * (grid.nx - 1) * (grid.ny - 1) >= BoxTree::kMostItems) {
    return bad_field("too many cells");
  }
  if (!is_spacing(grid.dx) || !is_spacing(grid.dy)) {
    return bad_field("a spacing that is not positive, or out of range");
  }
  const auto [least, most] = std::minmax(grid.dx, grid.dy);
  if (double{most} > kMostAspect * least) return bad_field("cells that are too narrow");
  if ((grid.nx - 1) * double{grid.dx} > FLT_MAX || (grid.ny - 1) * double{grid.dy} > FLT_MAX) {
    return bad_field("samples beyond the range of float32");
  }
  const HeightSamples& samples = grid.samples;
  if (samples.type != HeightType::float32 && samples.type != HeightType::int16) {
    return bad_field("samples of an unknown type");
  }
  if (!samples.data) return bad_field("no samples");
  if (!is_stride(samples.row_stride, size_of(samples.type) * grid.nx, grid.ny)) {
    return bad_field("a row stride that is less than a row, or too great");
  }
  if (samples.type == HeightType::int16) {
    const bool is_scale = grid.scale > 0 && grid.scale <= FLT_MAX;
    if (!is_scale || !(std::fabs(grid.offset) <= FLT_MAX)) {
      return bad_field("a scale that is not positive, or a scale or an offset that is not finite");
    }
  }
  return {};
}

// A rectangle of samples in memory.
struct Samples {
  const std::byte* first;
  ptrdiff_t stride;
  size_t row_bytes;

  const std::byte* row(uint32_t j) const { return first + static_cast<ptrdiff_t>(j) * stride; }
};

Samples samples_of(const HeightSamples& samples, uint32_t ni) {
  const size_t row_bytes = size_of(samples.type) * ni;
  return {static_cast<const std::byte*>(samples.data),
          samples.row_stride != 0 ? samples.row_stride : static_cast<ptrdiff_t>(row_bytes),
          row_bytes};
}

// The index of the first sample of a row that is neither a height nor a hole; `count` if there is
// none.
uint32_t first_bad(const HeightFieldGeometry& field, const std::byte* row, uint32_t count) {
  if (field.type() == HeightType::int16) {
    constexpr int16_t kMost = std::numeric_limits<int16_t>::max();
    const bool are_all_good =
        field.is_height(field.height_of(-kMost)) && field.is_height(field.height_of(kMost));
    if (are_all_good) return count;
    for (uint32_t i = 0; i < count; ++i) {
      int16_t steps;
      std::memcpy(&steps, row + sizeof steps * i, sizeof steps);
      if (steps != kHoleSample && !field.is_height(field.height_of(steps))) return i;
    }
    return count;
  }
  const auto at = [row](uint32_t i) {
    float height;
    std::memcpy(&height, row + sizeof height * i, sizeof height);
    return height;
  };
  const auto is_bad = [&](float height) { return height == height && !field.is_height(height); };
  constexpr uint32_t kSome = 64;  // without branches
  for (uint32_t first = 0; first < count; first += kSome) {
    const uint32_t end = std::min(first + kSome, count);
    uint32_t bad = 0;
    for (uint32_t i = first; i < end; ++i) bad |= uint32_t(is_bad(at(i)));
    for (uint32_t i = first; bad != 0 && i < end; ++i) {
      if (is_bad(at(i))) return i;
    }
  }
  return count;
}

}  // namespace

class HeightFieldMaker {
 public:
  static Result<std::shared_ptr<HeightFieldGeometry>> make(const HeightGrid& grid) {
    const std::shared_ptr<HeightFieldGeometry> made(new HeightFieldGeometry());
    HeightFieldGeometry& field = *made;
    field.nx_ = grid.nx;
    field.ny_ = grid.ny;
    field.dx_ = grid.dx;
    field.dy_ = grid.dy;
    field.middle_x_ = (grid.nx - 1) / 2.0;
    field.middle_y_ = (grid.ny - 1) / 2.0;
    field.type_ = grid.samples.type;
    field.borrows_ = grid.borrow;
    field.scale_ = grid.scale;
    field.offset_ = grid.offset;
    const double most = kMostSlope * std::min(grid.dx, grid.dy);
    field.most_ = static_cast<float>(std::min(most, double{FLT_MAX}));
    const Samples given = samples_of(grid.samples, grid.nx);
    field.samples_ = given.first;
    field.row_stride_ = given.stride;
    if (!grid.borrow) {
      const size_t bytes = given.row_bytes * grid.ny;
      field.own_samples_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
      prepare_pages(field.own_samples_.get(), bytes);
      field.samples_ = field.own_samples_.get();
      field.row_stride_ = static_cast<ptrdiff_t>(given.row_bytes);
    }
    if (grid.materials) {
      const size_t cells = size_t{field.cells_x()} * field.cells_y();
      field.materials_ = std::make_unique_for_overwrite<uint8_t[]>(cells);
      std::copy_n(grid.materials, cells, field.materials_.get());
    }
    field.pyramid_ = std::make_shared<HeightPyramid>(field.cells_x(), field.cells_y());
    if (Result<void> taken = take_all(given, field); !taken) return taken.error();
    return made;
  }

  static Result<void> update(const HeightWindow& window, const HeightSamples& samples,
                             HeightFieldGeometry& field) {
    const bool is_inside = window.ni >= 1 && window.nj >= 1 && window.i < field.nx_ &&
                           window.j < field.ny_ && window.ni <= field.nx_ - window.i &&
                           window.nj <= field.ny_ - window.j;
    if (!is_inside) return Error{"the window of samples is not inside the height field"};
    return field.borrows_ ? take_written(window, samples, field) : copy(window, samples, field);
  }

 private:
  // The caller has changed the memory that the field borrows: what is not valid there is a hole.
  static Result<void> take_written(const HeightWindow& window, const HeightSamples& samples,
                                   HeightFieldGeometry& field) {
    if (samples.data) return bad_field("samples in memory that the caller changes");
    const size_t bytes = size_of(field.type_);
    const Samples written = {field.row(window.j) + bytes * window.i, field.row_stride_,
                             bytes * window.ni};
    take_window(window, field);
    return check_rows(field, written, window);
  }

  static Result<void> copy(const HeightWindow& window, const HeightSamples& samples,
                           HeightFieldGeometry& field) {
    if (!samples.data) return bad_field("no samples for the window");
    if (samples.type != field.type_) return bad_field("samples of another type for the window");
    const size_t bytes = size_of(field.type_);
    if (!is_stride(samples.row_stride, bytes * window.ni, window.nj)) {
      return bad_field("a row stride for the window that is less than a row, or too great");
    }
    const Samples given = samples_of(samples, window.ni);
    Result<void> checked = check_rows(field, given, window);
    if (!checked) return checked;
    for (uint32_t j = 0; j < window.nj; ++j) {
      const size_t to = static_cast<size_t>(field.row_stride_) * (window.j + j) + bytes * window.i;
      std::memmove(field.own_samples_.get() + to, given.row(j), given.row_bytes);
    }
    take_window(window, field);
    return {};
  }

  static Result<void> check_rows(const HeightFieldGeometry& field, const Samples& samples,
                                 const HeightWindow& window) {
    Result<void> checked;
    for (uint32_t j = 0; checked && j < window.nj; ++j) {
      checked = check_row(field, samples.row(j), window.i, window.j + j, window.ni);
    }
    return checked;
  }

  static Result<void> check_row(const HeightFieldGeometry& field, const std::byte* row,
                                uint32_t first_i, uint32_t j, uint32_t count) {
    const uint32_t i = first_bad(field, row, count);
    if (i == count) return {};
    return bad_field("a sample (" + std::to_string(first_i + i) + ", " + std::to_string(j) +
                     ") that is infinite or too great");
  }

  // Checks, copies and sums up some rows at a time, while they are in the cache.
  static Result<void> take_all(const Samples& given, HeightFieldGeometry& field) {
    HeightPyramid& pyramid = *field.pyramid_;
    const HeightPyramid::Level& blocks = pyramid.levels()[0];
    uint32_t taken = 0;
    for (uint32_t block = 0; block < blocks.ny; ++block) {
      const uint32_t end = std::min((block + 1) * HeightPyramid::kCells + 1, field.ny_);
      for (; taken < end; ++taken) {
        Result<void> checked = check_row(field, given.row(taken), 0, taken, field.nx_);
        if (!checked) return checked;
        if (field.borrows_) continue;
        std::memcpy(field.own_samples_.get() + given.row_bytes * taken, given.row(taken),
                    given.row_bytes);
      }
      pyramid.take_blocks(field, block, 0, blocks.nx);
    }
    pyramid.take_upper(0, blocks.nx, 0, blocks.ny);
    set_bounds(field);
    return {};
  }

  static void take_window(const HeightWindow& window, HeightFieldGeometry& field) {
    constexpr uint32_t kCells = HeightPyramid::kCells;
    const auto first = [](uint32_t sample) { return (std::max(sample, 1u) - 1) / kCells; };
    const auto end = [](uint32_t sample, uint32_t cells) {
      return std::min(sample - 1, cells - 1) / kCells + 1;
    };
    const uint32_t first_i = first(window.i), first_j = first(window.j);
    const uint32_t end_i = end(window.i + window.ni, field.cells_x());
    const uint32_t end_j = end(window.j + window.nj, field.cells_y());
    HeightPyramid& pyramid = *field.pyramid_;
    for (uint32_t j = first_j; j < end_j; ++j) pyramid.take_blocks(field, j, first_i, end_i);
    pyramid.take_upper(first_i, end_i, first_j, end_j);
    set_bounds(field);
  }

  static void set_bounds(HeightFieldGeometry& field) {
    const HeightRange& range = field.pyramid_->whole();
    const bool is_empty = range.is_empty();
    field.lower_ = {field.x(0), field.y(0), is_empty ? 0 : range.low};
    field.upper_ = {field.x(field.nx_ - 1), field.y(field.ny_ - 1), is_empty ? 0 : range.high};
  }
};

HeightFieldGeometry::HeightFieldGeometry() = default;
HeightFieldGeometry::~HeightFieldGeometry() = default;

std::array<Eigen::Vector3f, 3> HeightFieldGeometry::corners(size_t triangle) const {
  std::array<Eigen::Vector3f, 3> corners = grid_corners(triangle);
  if (!is_scaled_) return corners;
  for (Eigen::Vector3f& corner : corners) corner = corner.cwiseProduct(factors_).eval();
  if (is_mirrored_) std::swap(corners[1], corners[2]);
  return corners;
}

std::array<Eigen::Vector3f, 3> HeightFieldGeometry::grid_corners(size_t triangle) const {
  const auto cell = static_cast<uint32_t>(triangle / 2);
  const uint32_t j = cell / cells_x(), i = cell - j * cells_x();
  // Number by number: copies of points would wait for the stores of their numbers.
  const float x0 = x(i), x1 = x(i + 1), y0 = y(j), y1 = y(j + 1);
  const float first = height(i, j), last = height(i + 1, j + 1);
  const bool is_below = triangle % 2 == 0;
  const size_t place_of_last = is_below ? 2 : 1;
  std::array<Eigen::Vector3f, 3> corners;
  corners[0] << x0, y0, first;
  corners[place_of_last] << x1, y1, last;
  corners[3 - place_of_last] << (is_below ? x1 : x0), (is_below ? y0 : y1),
      is_below ? height(i + 1, j) : height(i, j + 1);
  return corners;
}

std::array<uint32_t, 3> HeightFieldGeometry::corner_numbers(size_t triangle) const {
  const auto cell = static_cast<uint32_t>(triangle / 2);
  const uint32_t first = cell + cell / cells_x(), last = first + nx_ + 1;
  std::array<uint32_t, 3> numbers =
      triangle % 2 == 0 ? std::array{first, first + 1, last} : std::array{first, last, first + nx_};
  if (is_mirrored_) std::swap(numbers[1], numbers[2]);
  return numbers;
}

bool HeightFieldGeometry::is_inner_edge(size_t triangle, unsigned edge, bool from_front) const {
  // Over each edge, from the cell of the triangle: the cell of the neighbour and the sample at its
  // third corner.
  struct Neighbour {
    int32_t cell_i, cell_j, i, j;
  };
  static constexpr Neighbour kNeighbours[2][3] = {{{0, -1, 0, -1}, {1, 0, 2, 1}, {0, 0, 0, 1}},
                                                  {{0, 0, 1, 0}, {0, 1, 1, 2}, {-1, 0, -1, 0}}};
  const auto cell = static_cast<uint32_t>(triangle / 2);
  const uint32_t j = cell / cells_x(), i = cell - j * cells_x();
  // The corners of a mirrored triangle are 0, 2, 1 of the grid, so that its edges are 2, 1, 0.
  const Neighbour& over = kNeighbours[triangle % 2][is_mirrored_ ? 2 - edge : edge];
  const uint32_t cell_i = i + over.cell_i, cell_j = j + over.cell_j;
  // Less than zero is greater than all.
  if (cell_i >= cells_x() || cell_j >= cells_y() || is_hole(cell_i, cell_j)) return false;
  const auto [a, b, c] = corners(triangle);
  const Eigen::Vector3f across = point(i + over.i, j + over.j).cwiseProduct(factors_);
  const InnerSides inner = inner_sides({wide(a), wide(b), wide(c)}, edge, wide(across));
  return from_front ? inner.from_front : inner.from_back;
}

uint8_t HeightFieldGeometry::inner_edges(size_t triangle, bool from_front) const {
  unsigned edges = 0;
  for (unsigned i = 0; i < 3; ++i) {
    edges |= is_inner_edge(triangle, i, from_front) ? 1u << i : 0;
  }
  return static_cast<uint8_t>(edges);
}

size_t HeightFieldGeometry::bytes() const {
  if (is_scaled_) return sizeof *this;
  const size_t samples = own_samples_ ? static_cast<size_t>(row_stride_) * ny_ : 0;
  const size_t materials = materials_ ? size_t{cells_x()} * cells_y() : 0;
  return sizeof *this + samples + materials + pyramid_->bytes();
}

Result<void> HeightFieldGeometry::update(const HeightWindow& window, const HeightSamples& samples) {
  const FloatEnvironment environment;
  if (is_scaled_) return bad_field("a scale: the field that has the samples is to be updated");
  return HeightFieldMaker::update(window, samples, *this);
}

Result<std::shared_ptr<HeightFieldGeometry>> make_height_field(const HeightGrid& grid) {
  const FloatEnvironment environment;
  if (Result<void> checked = check(grid); !checked) return checked.error();
  return HeightFieldMaker::make(grid);
}

}  // namespace carom
