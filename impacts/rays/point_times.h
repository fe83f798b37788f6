// First times of impact of points with meshes of thin triangles, when both move in straight lines.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "impacts/impact.h"
#include "impacts/linear/linear_rows.h"
#include "impacts/moving_body.h"
#include "impacts/rays/ray_in_mesh.h"

namespace carom {

// A triangle that a kernel leaves to advancement, and the index of its pair's time.
struct LeftTriangle {
  size_t owner;
  Pair pair;
  uint32_t triangle;
};

class PointTimes {
 public:
  // Times that are found replace later ones in `times`. With `any`, a pair may get any time up to
  // its limit if the two certainly meet by then.
  PointTimes(const MovingSide& a, const MovingSide& b, bool any, std::span<FirstTime> times);

  // Searches a pair up to a limit; times[owner] must be set. False, and nothing is done, if its
  // bodies are others or not valid.
  bool add(size_t owner, Pair pair, double limit);

  // Tests what is left, and returns what is left after that.
  const std::vector<LeftTriangle>& finish();

 private:
  struct Scratch;
  static Scratch& scratch_of_thread();

  // The rows of a ray need this beside its columns.
  struct Point {
    size_t owner;
    Pair pair;
    Row orientation;  // of the mesh
  };

  // Starts the searches of the rays at the last mesh.
  void cut();
  void search();
  // Takes the mesh of a pair, mostly that of the last pair. False if it does not serve.
  bool take_mesh(bool is_a, uint32_t body);
  void add_row(const RaySearch& search, uint32_t triangle);
  void test_rows();
  bool passes(size_t row, double time) const;

  const MovingReader a_, b_;
  const bool any_;
  const std::span<FirstTime> times_;
  Scratch& scratch_;

  // The last mesh.
  bool mesh_is_a_ = false, mesh_serves_ = false;
  uint32_t mesh_body_ = 0xffffffffu;
  Row orientation_;
  Turn turn_;
  std::optional<RayTarget> target_;
};

}  // namespace carom
