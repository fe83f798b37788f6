#include "ladders/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "carom/shapes/scaled.h"
#include "trees/tree.h"

namespace carom::ladders {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostDivisions = 9;
// Bounds of pieces are accepted once they are this near to what is possible, a share of `most`.
constexpr double kGoodEnough = 0.02;
// The rounding of distances, a share of the greatest coordinate.
constexpr double kRounding = 1e-13;

Corners corners_of(const MeshGeometry& mesh, uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles()[triangle];
  const auto at = [&](uint32_t v) -> Vector3d { return mesh.vertices()[v].cast<double>(); };
  return {at(a), at(b), at(c)};
}

double square_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (a + t * ab - p).squaredNorm();
}

// The squared distance of a point from a triangle with an area. Any point of the triangle gives an
// upper bound, so that rounding which picks another edge does no harm.
double square_to_triangle(const Vector3d& p, const Corners& t) {
  const Vector3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const Vector3d normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double v = ap.cross(ac).dot(normal), w = ab.cross(ap).dot(normal);
  if (v >= 0 && w >= 0 && v + w <= area) return (v / area * ab + w / area * ac - ap).squaredNorm();
  return std::min({square_to_segment(p, t[0], t[1]), square_to_segment(p, t[1], t[2]),
                   square_to_segment(p, t[2], t[0])});
}

class Distance {
 public:
  Distance(const MeshGeometry& to, double most, double size)
      : to_(to), most_(most), slack_(kRounding * size) {}

  // Takes a triangle into account. False: some of it may be too far.
  bool add(const Corners& piece, int divisions) {
    const Bounds bounds = bounds_of(piece);
    if (bounds.upper <= worst_) return true;
    const bool is_good =
        bounds.upper <= most_ && bounds.upper - bounds.lower <= kGoodEnough * most_;
    if (is_good || divisions == 0) {
      worst_ = std::max(worst_, bounds.upper);
      return bounds.upper <= most_;
    }
    if (bounds.lower > most_) return false;
    const Vector3d ab = (piece[0] + piece[1]) / 2, bc = (piece[1] + piece[2]) / 2,
                   ca = (piece[2] + piece[0]) / 2;
    return add({piece[0], ab, ca}, divisions - 1) && add({ab, piece[1], bc}, divisions - 1) &&
           add({ca, bc, piece[2]}, divisions - 1) && add({ab, bc, ca}, divisions - 1);
  }

  double worst() const { return worst_; }

 private:
  // Bounds of the distance of the furthest point of a piece.
  struct Bounds {
    double lower, upper;
  };

  Bounds bounds_of(const Corners& piece) const {
    const Vector3d low = piece[0].cwiseMin(piece[1]).cwiseMin(piece[2]);
    const Vector3d high = piece[0].cwiseMax(piece[1]).cwiseMax(piece[2]);
    std::array<double, 3> least = {kInfinity, kInfinity, kInfinity};  // of each corner, squared
    double together = kInfinity;  // to one triangle, of the furthest corner
    for_each_near(low, high, [&](uint32_t triangle) {
      const Corners corners = corners_of(to_, triangle);
      double furthest = 0;
      for (size_t i = 0; i < 3; ++i) {
        const double square = square_to_triangle(piece[i], corners);
        least[i] = std::min(least[i], square);
        furthest = std::max(furthest, square);
      }
      together = std::min(together, furthest);
    });
    return {std::sqrt(*std::max_element(least.begin(), least.end())) - slack_,
            std::sqrt(together) + slack_};
  }

  // Calls visit(triangle) for all triangles of the other surface that are within `most_` of a box,
  // and some that are further.
  template <class Visit>
  void for_each_near(const Vector3d& low, const Vector3d& high, const Visit& visit) const {
    const std::span<const BoxTree::Node> nodes = to_.tree().nodes();
    std::vector<uint32_t> open;
    if (!nodes.empty()) open.push_back(0);
    while (!open.empty()) {
      const BoxTree::Node& node = nodes[open.back()];
      open.pop_back();
      for (size_t i = 0; i < BoxTree::kChildren; ++i) {
        bool is_near = true;
        for (int axis = 0; axis < 3; ++axis) {
          is_near &= node.lower[axis][i] <= high[axis] + most_ + slack_ &&
                     node.upper[axis][i] >= low[axis] - most_ - slack_;
        }
        if (!is_near) continue;
        const uint32_t child = node.child[i];
        child >= BoxTree::kItem ? visit(child - BoxTree::kItem) : open.push_back(child);
      }
    }
  }

  const MeshGeometry& to_;
  const double most_, slack_;
  double worst_ = 0;
};

}  // namespace

double furthest(const MeshGeometry& from, const MeshGeometry& to, double most) {
  // Trees and vertices are those before a scale.
  if (from.is_scaled()) return furthest(**unshared(from), to, most);
  if (to.is_scaled()) return furthest(from, **unshared(to), most);
  const auto size_of = [](const MeshGeometry& mesh) -> double {
    return std::max(mesh.lower().cwiseAbs().maxCoeff(), mesh.upper().cwiseAbs().maxCoeff());
  };
  Distance distance(to, most, size_of(from) + size_of(to));
  for (uint32_t i = 0; i < from.triangles().size(); ++i) {
    if (from.is_degenerate(i)) continue;
    if (!distance.add(corners_of(from, i), kMostDivisions)) return kInfinity;
  }
  return distance.worst();
}

}  // namespace carom::ladders
