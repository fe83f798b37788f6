// CGAL: exact decisions. Its kernel computes with intervals, and in rationals where these do not
// decide. Poses are exact as in Carom: R(q) = M(q) / |q|^2.
#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Surface = CGAL::Surface_mesh<Point>;

struct Ball {
  Point centre;
  Number radius;
};

Point point(const float* p) { return {p[0], p[1], p[2]}; }

CGAL::Aff_transformation_3<Kernel> pose_of(const PeerBody& body) {
  const Number x = body.orientation[0], y = body.orientation[1], z = body.orientation[2],
               w = body.orientation[3];
  const Number xx = x * x, yy = y * y, zz = z * z, ww = w * w, length = xx + yy + zz + ww;
  const auto& p = body.position;
  return {ww + xx - yy - zz,
          2 * (x * y - w * z),
          2 * (x * z + w * y),
          p[0] * length,
          2 * (x * y + w * z),
          ww - xx + yy - zz,
          2 * (y * z - w * x),
          p[1] * length,
          2 * (x * z - w * y),
          2 * (y * z + w * x),
          ww - xx - yy + zz,
          p[2] * length,
          length};
}

Surface surface_around(const std::vector<Point>& points) {
  Surface surface;
  CGAL::convex_hull_3(points.begin(), points.end(), surface);
  return surface;
}

Surface box_surface(const PeerBody& body) {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) {
    const float x = body.size[0], y = body.size[1], z = body.size[2];
    corners.emplace_back((i & 1) != 0 ? x : -x, (i & 2) != 0 ? y : -y, (i & 4) != 0 ? z : -z);
  }
  return surface_around(corners);
}

std::vector<Surface> hull_surfaces(const std::vector<PeerHull>& hulls) {
  std::vector<Surface> surfaces;
  for (const PeerHull& hull : hulls) {
    std::vector<Point> points;
    for (const auto& p : hull.points) points.push_back(point(p.data()));
    surfaces.push_back(surface_around(points));
  }
  return surfaces;
}

std::vector<Ball> balls(const PeerBodies& source) {
  std::vector<Ball> all;
  for (const PeerBody& body : source.bodies) {
    all.push_back({point(body.position.data()), body.size[0]});
  }
  return all;
}

std::vector<Triangle> triangles(const PeerBodies& source) {
  std::vector<Triangle> all;
  for (const PeerBody& body : source.bodies) {
    const float* const p = body.size.data();
    all.push_back(Triangle(point(p), point(p + 3), point(p + 6)).transform(pose_of(body)));
  }
  return all;
}

// Boxes and hulls.
std::vector<Surface> solids(const PeerBodies& source) {
  const std::vector<Surface> hulls = hull_surfaces(source.hulls);
  std::vector<Surface> all;
  for (const PeerBody& body : source.bodies) {
    const auto pose = pose_of(body);
    Surface surface = source.shape == PeerShape::hull ? hulls[body.hull] : box_surface(body);
    for (Point& corner : surface.points()) corner = pose(corner);
    all.push_back(std::move(surface));
  }
  return all;
}

bool overlap(const Ball& a, const Ball& b) {
  const Number reach = a.radius + b.radius;
  return CGAL::compare_squared_distance(a.centre, b.centre, reach * reach) != CGAL::LARGER;
}

bool overlap(const Ball& a, const Triangle& b) {
  return CGAL::squared_distance(a.centre, b) <= a.radius * a.radius;
}

bool overlap(const Triangle& a, const Triangle& b) { return CGAL::do_intersect(a, b); }

bool overlap(const Surface& a, const Surface& b) {
  namespace meshes = CGAL::Polygon_mesh_processing;
  return meshes::do_intersect(a, b, CGAL::parameters::do_overlap_test_of_bounded_sides(true));
}

template <class A, class B>
class CgalPairs final : public PairPeer {
 public:
  CgalPairs(std::vector<A> a, std::vector<B> b) : a_(std::move(a)), b_(std::move(b)) {}

  void run(PairAnswers& answers) override {
    for (size_t i = 0; i < a_.size(); ++i) {
      answers.overlaps[i] = overlap(a_[i], b_[i]) ? 1 : 0;
      answers.separations[i] = kNotReported;
    }
  }

 private:
  const std::vector<A> a_;
  const std::vector<B> b_;
};

template <class A, class B>
std::unique_ptr<PairPeer> pairs_of(std::vector<A> a, std::vector<B> b) {
  return std::make_unique<CgalPairs<A, B>>(std::move(a), std::move(b));
}

bool is_solid(PeerShape shape) { return shape == PeerShape::box || shape == PeerShape::hull; }

}  // namespace

std::unique_ptr<PairPeer> make_cgal_pairs(const PeerBodies& a, const PeerBodies& b,
                                          PeerDetail detail) {
  if (detail != PeerDetail::overlap) return nullptr;
  if (is_solid(a.shape) && is_solid(b.shape)) return pairs_of(solids(a), solids(b));
  if (a.shape == PeerShape::triangle && b.shape == PeerShape::triangle) {
    return pairs_of(triangles(a), triangles(b));
  }
  if (a.shape != PeerShape::sphere) return nullptr;
  if (b.shape == PeerShape::sphere) return pairs_of(balls(a), balls(b));
  return b.shape == PeerShape::triangle ? pairs_of(balls(a), triangles(b)) : nullptr;
}

}  // namespace carom::bench
