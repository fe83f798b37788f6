/// @file
/// The geometry of height fields: a grid of heights, of which every cell is two triangles. No
/// triangle is stored; results are those of a mesh of the same triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "carom/base/result.h"
#include "carom/export.h"
#include "carom/shapes/height_field.h"

namespace carom {

class HeightPyramid;

/// The type of the numbers of a grid.
enum class HeightType : uint8_t {
  float32,  ///< metres; NaN makes holes
  int16     ///< steps of HeightGrid::scale above HeightGrid::offset; kHoleSample makes holes
};

/// The int16 sample that makes holes.
inline constexpr int16_t kHoleSample = std::numeric_limits<int16_t>::min();

/// Samples in the caller's memory, row by row: i along x is the fast index. They may lie at any
/// address.
struct HeightSamples {
  const void* data = nullptr;             ///< sample (0, 0)
  ptrdiff_t row_stride = 0;               ///< bytes from a row to the next; 0: without gaps
  HeightType type = HeightType::float32;  ///< the type of the samples
};

/// A grid of heights, from which make_height_field() makes a height field. Sample (i, j) lies at
/// ((i - (nx - 1) / 2) dx, (j - (ny - 1) / 2) dy, height) in the body's frame.
struct HeightGrid {
  uint32_t nx = 0;        ///< samples along x, 2 to kMostHeightSamples
  uint32_t ny = 0;        ///< samples along y, 2 to kMostHeightSamples
  float dx = 0;           ///< metres from sample to sample along x, > 0
  float dy = 0;           ///< metres from sample to sample along y, > 0
  HeightSamples samples;  ///< nx x ny of them
  float scale = 1;        ///< int16 only: metres in a step, > 0
  float offset = 0;       ///< int16 only: height of sample 0, metres
  /// Whether the samples stay in the caller's memory. It must then outlive the geometry, and may
  /// change only as HeightFieldGeometry::update() says. Otherwise they are copied.
  bool borrow = false;
  /// The material of each cell, (nx - 1) x (ny - 1) numbers row by row, copied; nullptr: all are 0.
  const uint8_t* materials = nullptr;
};

/// So many samples a row or a column may have at most. The triangles must be fewer than 2^31.
inline constexpr uint32_t kMostHeightSamples = uint32_t{1} << 22;

/// A rectangle of samples.
struct HeightWindow {
  uint32_t i = 0;   ///< first sample along x
  uint32_t j = 0;   ///< first sample along y
  uint32_t ni = 0;  ///< samples along x
  uint32_t nj = 0;  ///< samples along y
};

/// A grid of heights. Cell (i, j) has the number c = j (nx - 1) + i and lies between the samples
/// (i, j) and (i + 1, j + 1), whose diagonal parts it into two triangles, fronts towards +z:
/// triangle 2 c has the corners (i, j), (i + 1, j), (i + 1, j + 1), and triangle 2 c + 1 the
/// corners (i, j), (i + 1, j + 1), (i, j + 1). Sub-shape indices are these numbers. A cell with a
/// corner that is a hole is not part of the surface. Threads may share it while none updates it. A
/// field that scaled() made (carom/shapes/scaled.h) shares the samples of another one, and has a
/// scale: what is asked by samples is then before the scale; triangles and bounds are after it.
class CAROM_EXPORT HeightFieldGeometry {
 public:
  ~HeightFieldGeometry();
  HeightFieldGeometry(const HeightFieldGeometry&) = delete;
  HeightFieldGeometry& operator=(const HeightFieldGeometry&) = delete;

  uint32_t nx() const { return nx_; }           ///< samples along x
  uint32_t ny() const { return ny_; }           ///< samples along y
  float dx() const { return dx_; }              ///< metres between samples along x
  float dy() const { return dy_; }              ///< metres between samples along y
  HeightType type() const { return type_; }     ///< of the samples
  uint32_t cells_x() const { return nx_ - 1; }  ///< cells along x
  uint32_t cells_y() const { return ny_ - 1; }  ///< cells along y
  /// How many triangles are numbered: two a cell, those of holes too.
  uint32_t triangle_count() const { return 2 * cells_x() * cells_y(); }

  /// The x of samples (i, .), metres, rounded to the nearest float.
  float x(uint32_t i) const { return place(i, middle_x_, dx_); }
  /// The y of samples (., j), metres, rounded to the nearest float.
  float y(uint32_t j) const { return place(j, middle_y_, dy_); }
  /// The height of sample (i, j), metres; NaN for a hole.
  float height(uint32_t i, uint32_t j) const {
    const std::byte* const row = samples_ + static_cast<ptrdiff_t>(j) * row_stride_;
    if (type_ == HeightType::float32) {
      float height;
      std::memcpy(&height, row + sizeof height * i, sizeof height);
      return height;
    }
    int16_t steps;
    std::memcpy(&steps, row + sizeof steps * i, sizeof steps);
    return height_of(steps);
  }
  /// Sample (i, j) as a point of the body's frame.
  Eigen::Vector3f point(uint32_t i, uint32_t j) const { return {x(i), y(j), height(i, j)}; }

  /// Whether cell (i, j) is a hole.
  bool is_hole(uint32_t i, uint32_t j) const {
    return !(is_height(height(i, j)) && is_height(height(i + 1, j)) &&
             is_height(height(i, j + 1)) && is_height(height(i + 1, j + 1)));
  }
  /// Whether a number may be a height of this field: not NaN, and not so great that a triangle had
  /// no area.
  bool is_height(float height) const { return height <= most_ && height >= -most_; }

  /// The greatest magnitude that is_height() takes.
  float greatest_height() const { return most_; }

  /// The factors of the samples along the axes of the body's frame; (1, 1, 1) unless scaled() made
  /// this field.
  const Eigen::Vector3f& scale() const { return factors_; }
  /// Whether a factor of scale() is not 1.
  bool is_scaled() const { return is_scaled_; }

  /// The corners of a triangle, metres, counter-clockwise as seen from its front. If scale()
  /// mirrors, the second and the third corner have changed places.
  std::array<Eigen::Vector3f, 3> corners(size_t triangle) const;
  /// The corners of a triangle before the scale, in the order of the grid. For Carom's own use.
  std::array<Eigen::Vector3f, 3> grid_corners(size_t triangle) const;
  /// The numbers j nx + i of the corners of a triangle.
  std::array<uint32_t, 3> corner_numbers(size_t triangle) const;
  /// As MeshGeometry::inner_edges(): found from the heights around the triangle.
  uint8_t inner_edges(size_t triangle, bool from_front) const;
  /// One of them: that from corner `edge` to the next.
  bool is_inner_edge(size_t triangle, unsigned edge, bool from_front) const;
  /// The material of the cell that has this triangle.
  uint8_t material(size_t triangle) const { return materials_ ? materials_[triangle / 2] : 0; }

  /// Lower corner of a box that contains the grid: all samples along x and y, the triangles along z
  /// (zero if all cells are holes).
  const Eigen::Vector3f& lower() const { return lower_; }
  /// Upper corner of the same box.
  const Eigen::Vector3f& upper() const { return upper_; }

  /// Memory of this geometry in bytes, without samples in the caller's memory, and of a field with
  /// a scale without what it shares.
  size_t bytes() const;

  /// Changes the samples of a window. `samples` are those of the window, of the type of the field.
  /// If the field borrows its memory they are left out: the caller has changed that memory already.
  /// Fails, and changes nothing, if the window is not inside the grid, or a sample is infinite or
  /// too great; one that the caller has written is a hole then. While it runs no other thread may
  /// use the geometry. A world must be told afterwards: World::set_shape() with the same geometry.
  /// Compounds that have it as a child, and fields that scaled() made of it, must be made again.
  Result<void> update(const HeightWindow& window, const HeightSamples& samples = {});

  /// Heights of blocks of cells. For Carom's own use.
  const HeightPyramid& pyramid() const { return *pyramid_; }
  /// The samples of one row, of the type of the field. For Carom's own use.
  const std::byte* row(uint32_t j) const {
    return samples_ + static_cast<ptrdiff_t>(j) * row_stride_;
  }
  /// The height of an int16 sample. For Carom's own use.
  float height_of(int16_t steps) const {
    if (steps == kHoleSample) return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>(steps * double{scale_} + double{offset_});
  }

 private:
  friend class HeightFieldMaker;
  friend class ScaledFieldMaker;
  HeightFieldGeometry();

  static float place(uint32_t index, double middle, float step) {
    return static_cast<float>((index - middle) * double{step});
  }

  uint32_t nx_ = 0, ny_ = 0;
  float dx_ = 0, dy_ = 0;
  double middle_x_ = 0, middle_y_ = 0;  // in samples
  HeightType type_ = HeightType::float32;
  bool borrows_ = false;
  float scale_ = 1, offset_ = 0;
  float most_ = 0;  // of a height
  bool is_scaled_ = false, is_mirrored_ = false;
  const std::byte* samples_ = nullptr;
  ptrdiff_t row_stride_ = 0;
  std::unique_ptr<std::byte[]> own_samples_;
  std::shared_ptr<uint8_t[]> materials_;
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  std::shared_ptr<HeightPyramid> pyramid_;
  Eigen::Vector3f factors_ = Eigen::Vector3f::Ones();
  std::shared_ptr<const HeightFieldGeometry> source_;  // of a field with a scale
};

/// Makes a height field. Fails if a count or a spacing is out of range, a spacing is more than 2^40
/// times the other one, the grid reaches beyond the range of float32, a row stride is less than a
/// row, there are no samples, `scale` or `offset` is not valid, or a sample is infinite or greater
/// than 2^40 times the least spacing.
CAROM_EXPORT Result<std::shared_ptr<HeightFieldGeometry>> make_height_field(const HeightGrid& grid);

}  // namespace carom
