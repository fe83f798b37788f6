// Makes the shell of two hulls, and grows it until it proves a depth.
#pragma once

#include "narrowphase/hulls/hull_depth.h"
#include "narrowphase/hulls/shell.h"

namespace carom {

// Two hulls: the points of B in scaled units and the frame of A.
struct ShellHulls {
  const Solid& a;
  const HullPoints& b;
  const HullSteps& steps;
};

// A contact in the frame of A: moving B by depth * normal makes the hulls touch, up to the slack.
struct ShellDepth {
  float depth;
  Vector3f normal, on_a;
};

// What a shell tells of its hulls; `apart` is so up to rounding.
enum class ShellAnswer : uint8_t { none, depth, apart };

class ShellGrowth {
 public:
  // The points of the shell, if it has any, must be points of these hulls.
  ShellGrowth(Shell& shell, const ShellHulls& hulls, ShellSpace& space);

  // Starts an empty shell with six corners: furthest along this way, against it, and around it. The
  // nearer it is to the axis of least overlap, the better.
  void begin(const Vector3f& way);

  // Grows the shell, if it has to, until the depth is known within the slack. It is not found if
  // that takes too many steps or corners: the shell is still closed.
  ShellAnswer measure(float slack, ShellDepth& found);

  // Leaves room for a few more corners. A shell that needs more has many that it no longer needs.
  void end();

 private:
  // A corner of A - B that reaches furthest along some way, by its points.
  struct Support {
    size_t of_a, of_b;
    Vector3f point;
    float height;
  };
  // The point of a triangle that is nearest to zero.
  struct Nearest {
    size_t triangle;
    bool is_inside;              // not on an edge
    std::array<float, 3> share;  // of the corners, times anything above zero
    float distance;
    Vector3f way;  // from zero to the point, a unit vector
  };
  // Triangles to be removed, and their edges: bit j of edges[i] is one from corner i to j.
  struct Cut {
    uint64_t triangles = 0;
    uint32_t corners = 0;
    std::array<uint32_t, Shell::kMostCorners> edges{};
  };

  Support support(const Vector3f& way) const;
  bool is_proved(const ShellCheck& planes, float slack, Nearest& nearest, Support& next) const;
  bool fills_dent(size_t triangle, Support& next) const;
  Nearest nearest_on(size_t triangle) const;
  void locate(const Nearest& nearest, ShellDepth& found) const;
  Vector3f way_out() const;
  bool grow(const Support& support);
  bool cut(uint64_t triangles, Cut& cut) const;
  uint32_t gone(const Cut& cut, uint32_t rim) const;
  size_t place_of(const Support& support, uint32_t used) const;
  void put_corner(const Support& support, size_t place);
  void put_triangle(size_t place, size_t i, size_t j, size_t k);

  Shell& shell_;
  const ShellHulls hulls_;
  ShellSpace& space_;
};

}  // namespace carom
