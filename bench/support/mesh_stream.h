// Streams of bodies on a terrain of 10,000 triangles, half of which touch it: a mesh, or a height
// field of the same triangles.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bodies.h"
#include "bench/support/pair_stream.h"

namespace carom::bench {

struct MeshSpec {
  ShapeKind kind;  // of the bodies
  size_t count = 0;
  size_t vertices = 16;   // of hulls
  bool is_field = false;  // the terrain is a height field

  friend bool operator==(const MeshSpec&, const MeshSpec&) = default;
};

// A terrain of squares of two triangles over x and y, in metres, around the origin.
struct Terrain {
  static constexpr int kSquares = 71;  // along each side: 10,082 triangles
  static constexpr float kSide = 1.8f;

  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;  // fronts face up; as a height field has them
  std::vector<float> heights;                      // row by row, along x
};

class MeshStream {
 public:
  explicit MeshStream(const MeshSpec& spec);

  const MeshSpec& spec() const { return spec_; }
  const Terrain& terrain() const { return terrain_; }
  const std::vector<PlacedShape>& bodies() const { return bodies_; }
  double hit_percent() const { return hit_percent_; }
  // The library's separation of body i and the terrain.
  float separation(size_t i) const { return separations_[i]; }
  // Time of one pass of the reference, extrapolated from a few pairs, because it tries all
  // triangles.
  double reference_seconds() const { return reference_seconds_; }

  // Runs one pass: row i is body i and the terrain.
  Result<void> run(Detail detail, const ResultColumns& out,
                   Measured measured = Measured::all) const;

  // A message on the first of a few rows that does not have the bits of the reference.
  std::optional<std::string> difference(Detail detail, const ResultColumns& out) const;

 private:
  void draw();
  void ask_reference();
  std::vector<uint8_t> overlaps_of(const std::vector<PlacedShape>& bodies) const;

  MeshSpec spec_;
  Terrain terrain_;
  PlacedShape ground_;
  std::vector<PlacedShape> bodies_;
  std::unique_ptr<DenseBodies> a_;
  std::unique_ptr<DenseBodies> b_;
  std::vector<float> separations_;
  double hit_percent_ = 0;
  std::vector<reference::PairResult> expected_;  // of the first few rows
  double reference_seconds_ = 0;
};

}  // namespace carom::bench
