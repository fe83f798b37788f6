// The corners of what two box faces cover, against a clipper of polygons in double precision that
// shares no code with it: each of its corners must be found, and nothing outside the region.
#include "narrowphase/manifolds/rectangles_scalar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using scalar::ClipPoint;
using scalar::ClipPoints;
using scalar::Rectangle;

constexpr double kNear = 4 * kClipSlack;

struct Corner {
  Vector2d at;
  double s;
};
using Region = std::vector<Corner>;

// A face of the unit frame turned by `q`, with its centre at `centre`.
Rectangle face_at(const Eigen::Quaternionf& q, const Vector3f& centre, float half_x, float half_y) {
  const Eigen::Matrix3f m = q.toRotationMatrix();
  Rectangle face;
  face.frame = {centre, m.col(0), m.col(1), m.col(2), 0};
  face.lower = {-half_x, -half_y};
  face.upper = {half_x, half_y};
  return face;
}

// The corners of `other`, seen along m, in coordinates of `face`.
Region seen(const Rectangle& face, const Rectangle& other, const Vector3d& m) {
  Region region;
  const auto& f = face.frame;
  const Vector3d u = f.u.cast<double>(), v = f.v.cast<double>(), n = f.n.cast<double>();
  for (const auto& c : other.corners()) {
    const Vector3d p =
        (other.frame.point(c.x, c.y)).cast<double>() - (f.origin + f.n * f.height).cast<double>();
    const double s = n.dot(p) / n.dot(m);
    const Vector3d on_face = p - m * s;
    region.push_back({{u.dot(on_face), v.dot(on_face)}, s});
  }
  return region;
}

// The part of a region where inside(corner) >= 0, a linear function.
template <class Inside>
Region cut(const Region& region, const Inside& inside) {
  Region kept;
  for (size_t i = 0; i < region.size(); ++i) {
    const Corner &a = region[i], &b = region[(i + 1) % region.size()];
    const double at_a = inside(a.at), at_b = inside(b.at);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const double t = at_a / (at_a - at_b);
    kept.push_back({a.at + t * (b.at - a.at), a.s + t * (b.s - a.s)});
  }
  return kept;
}

Region covered(const Rectangle& face, const Rectangle& other, const Vector3d& m, double wider) {
  Region region = seen(face, other, m);
  region = cut(region, [&](const Vector2d& p) { return p.x() - face.lower.x + wider; });
  region = cut(region, [&](const Vector2d& p) { return face.upper.x - p.x() + wider; });
  region = cut(region, [&](const Vector2d& p) { return p.y() - face.lower.y + wider; });
  return cut(region, [&](const Vector2d& p) { return face.upper.y - p.y() + wider; });
}

// The distance of a point from a convex region; 0 inside.
double distance(const Region& region, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  bool left = true, right = true;
  for (size_t i = 0; i < region.size(); ++i) {
    const Vector2d a = region[i].at, way = region[(i + 1) % region.size()].at - a, r = p - a;
    const double side = way.x() * r.y() - way.y() * r.x();
    left = left && side >= 0;
    right = right && side <= 0;
    const double t =
        way.squaredNorm() > 0 ? std::clamp(way.dot(r) / way.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (r - t * way).norm());
  }
  return left || right ? 0 : least;
}

// Whether a point lies at a place, at this height.
bool holds(const ClipPoints& points, const Corner& corner) {
  return std::any_of(points.begin(), points.end(), [&](const ClipPoint& c) {
    return (Vector2d(c.x, c.y) - corner.at).norm() < 1e-4 && std::abs(c.s - corner.s) < 1e-4;
  });
}

// The points in order around their middle.
Region around(const ClipPoints& points) {
  Region region;
  Vector2d middle = Vector2d::Zero();
  for (const ClipPoint& c : points) {
    region.push_back({{c.x, c.y}, c.s});
    middle += Vector2d(c.x, c.y) / static_cast<double>(points.size());
  }
  const auto angle = [&](const Corner& c) {
    return std::atan2(c.at.y() - middle.y(), c.at.x() - middle.x());
  };
  std::sort(region.begin(), region.end(),
            [&](const Corner& p, const Corner& q) { return angle(p) < angle(q); });
  return region;
}

void check_inside(const Rectangle& face, const Rectangle& other, const Vector3f& m,
                  const ClipPoints& points) {
  const Region wide = covered(face, other, m.cast<double>(), kNear);
  for (const ClipPoint& c : points) {
    EXPECT_GE(c.x, face.lower.x);
    EXPECT_LE(c.x, face.upper.x);
    EXPECT_GE(c.y, face.lower.y);
    EXPECT_LE(c.y, face.upper.y);
    EXPECT_LT(distance(wide, {c.x, c.y}), 1e-4) << c.x << ", " << c.y;
  }
}

class Rectangles : public ::testing::Test {
 protected:
  float number(float from, float to) {
    return std::uniform_real_distribution<float>(from, to)(random_);
  }
  Eigen::Quaternionf turn() {
    std::normal_distribution<float> normal;
    const Eigen::Vector4f v{normal(random_), normal(random_), normal(random_), normal(random_)};
    return Eigen::Quaternionf(v).normalized();
  }
  Vector3f point(float size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }

  // Draws a face in an order that does not depend on the compiler.
  Rectangle face(const Eigen::Quaternionf& q, float spread) {
    const Vector3f centre = point(spread);
    const float half_x = number(0.1f, 1), half_y = number(0.1f, 1);
    return face_at(q, centre, half_x, half_y);
  }

  std::mt19937 random_{7};
};

TEST_F(Rectangles, CoverWhatAClipperInDoublesFinds) {
  int seen_from_behind = 0, of_eight = 0, apart = 0, inside = 0, corners = 0, exactly = 0;
  for (int i = 0; i < 20000; ++i) {
    const Rectangle face = this->face(turn(), 0.1f);
    Vector3f m = (face.frame.n + 0.5f * point(1)).normalized();
    // Faced the other way in half of the cases, as the face of a box below is.
    Eigen::Quaternionf q = turn();
    if (std::abs((q * Vector3f::UnitZ()).dot(m)) < 0.3f) continue;
    const Rectangle other = this->face(q, i % 2 ? 0.7f : 0.1f);
    seen_from_behind += (q * Vector3f::UnitZ()).dot(m) < 0;
    const Region exact = covered(face, other, m.cast<double>(), 0);
    of_eight += exact.size() == 8;
    inside += exact.size() == 4;
    apart += exact.empty();
    const ClipPoints points = scalar::clip(face, other, m, kNoPoint / 2);
    // Where sides cross at a small angle, the slack moves their crossing along them.
    const Region found = around(points);
    for (const Corner& corner : exact) {
      EXPECT_LT(distance(found, corner.at), kNear) << corner.at.transpose();
      exactly += holds(points, corner);
    }
    corners += static_cast<int>(exact.size());
    check_inside(face, other, m, points);
    if (HasFailure()) return;
  }
  EXPECT_GT(exactly, 0.999 * corners);
  EXPECT_GT(seen_from_behind, 5000);
  EXPECT_GT(of_eight, 20);
  EXPECT_GT(inside, 500);
  EXPECT_GT(apart, 500);
}

// Faces of equal boxes, turned by nothing or by quarters, that lie on each other with all, some or
// none of their sides on each other.
TEST_F(Rectangles, OfBoxesInAStack) {
  const Eigen::Quaternionf q = turn();
  for (const float step : {0.0f, 0.25f, 1.0f, 2.0f}) {
    for (const bool behind : {false, true}) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        const Eigen::Quaternionf spin(
            Eigen::AngleAxisf(static_cast<float>(quarter * EIGEN_PI / 2), Vector3f::UnitZ()));
        const Eigen::Quaternionf over(
            Eigen::AngleAxisf(behind ? static_cast<float>(EIGEN_PI) : 0.0f, Vector3f::UnitX()));
        const Rectangle face = face_at(q, {0, 0, 0}, 1, 1);
        const Rectangle other = face_at(q * spin * over, q * Vector3f(step, 0, 0), 1, 1);
        const ClipPoints points = scalar::clip(face, other, face.frame.n, 1);
        for (const double x : {step - 1.0, 1.0}) {
          for (const double y : {-1.0, 1.0}) {
            EXPECT_TRUE(holds(points, {{x, y}, 0})) << x << ", " << y << ", " << step;
          }
        }
        check_inside(face, other, face.frame.n, points);
      }
    }
  }
}

// A face that is seen edge-on covers a line, and one without a width does.
TEST_F(Rectangles, WithoutAnArea) {
  for (const bool is_first : {false, true}) {
    const Rectangle face = face_at(Eigen::Quaternionf::Identity(), {0, 0, 0}, is_first ? 0 : 1, 1);
    const Rectangle flat =
        face_at(Eigen::Quaternionf::Identity(), {0, 0.5f, 0}, is_first ? 1 : 0, 1);
    const ClipPoints points = scalar::clip(face, flat, face.frame.n, 1);
    for (const float y : {-0.5f, 1.0f}) {
      EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const ClipPoint& c) {
        return c.x == 0 && c.y == y;
      })) << y;
    }
  }
  const Rectangle face = face_at(Eigen::Quaternionf::Identity(), {0, 0, 0}, 1, 1);
  const Eigen::Quaternionf upright(
      Eigen::AngleAxisf(static_cast<float>(EIGEN_PI / 2), Vector3f::UnitX()));
  const ClipPoints points =
      scalar::clip(face, face_at(upright, {0, 0.5f, 0.5f}, 0.75f, 0.25f), face.frame.n, 1);
  for (const float x : {-0.75f, 0.75f}) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const ClipPoint& c) {
      return c.x == x && std::abs(c.s - 0.25f) < 1e-6f;
    })) << x;
  }
}

}  // namespace
}  // namespace carom::test
