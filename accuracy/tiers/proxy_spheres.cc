#include "accuracy/tiers/proxy_spheres.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "accuracy/pairs/body_size.h"

namespace carom::accuracy {
namespace {

// One float larger than needed, as in worlds, because the tests round too.
Shape ball_around(const Shape& shape) {
  if (std::holds_alternative<Sphere>(shape) || std::holds_alternative<Halfspace>(shape)) {
    return shape;
  }
  const double radius = bounding_radius(shape);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return Sphere{std::nextafter(std::nextafter(static_cast<float>(radius), kInfinity), kInfinity)};
}

class ProxySpheres final : public Contender {
 public:
  const char* setting() const override { return "proxy spheres"; }
  const char* tier() const override { return "fast"; }
  Promise promise() const override { return Promise::finite; }

  bool serves(const KindPair& kinds) const override {
    const auto is_itself = [](ShapeKind kind) {
      return kind == ShapeKind::sphere || kind == ShapeKind::halfspace;
    };
    return !is_itself(kinds.a) || !is_itself(kinds.b);
  }

  void prepare(const PairSet& pairs) override {
    std::vector<ConvexPair> balls;
    for (size_t i = 0; i < pairs.size(); ++i) {
      balls.push_back(pairs[i]);
      balls.back().shape_a = ball_around(balls.back().shape_a);
      balls.back().shape_b = ball_around(balls.back().shape_b);
    }
    balls_ = std::make_unique<PairSet>(std::move(balls), pairs.positions());
  }

  void run(const PairSet& /*pairs*/, Detail detail, Answers& out) override {
    standard_.run(*balls_, detail, out);
  }

 private:
  LibrarySetting standard_ = standard_setting();
  std::unique_ptr<PairSet> balls_;
};

}  // namespace

std::unique_ptr<Contender> make_proxy_spheres() { return std::make_unique<ProxySpheres>(); }

}  // namespace carom::accuracy
