#include "accuracy/tiers/contenders.h"

#include <cassert>
#include <utility>

#include "accuracy/tiers/bullet.h"
#include "carom/narrowphase/collide.h"
#include "carom/reference/reference.h"

namespace carom::accuracy {
namespace {

bool is_boxlike(ShapeKind kind) { return kind == ShapeKind::box || kind == ShapeKind::aabb; }

class ScalarReference final : public Contender {
 public:
  const char* setting() const override { return "scalar reference"; }
  const char* tier() const override { return "standard"; }
  Promise promise() const override { return Promise::standard; }
  bool serves(const KindPair&) const override { return true; }

  void run(const PairSet& pairs, Detail /*detail*/, Answers& out) override {
    for (size_t i = 0; i < pairs.size(); ++i) {
      const ConvexPair& pair = pairs[i];
      const reference::PairResult result = reference::collide(
          pair.shape_a, pair.pose_a, pair.shape_b, pair.pose_b, pairs.positions());
      out.overlap[i] = result.overlap ? 1 : 0;
      out.status[i] = static_cast<uint8_t>(result.status);
      out.separation[i] = result.separation;
      Answers::set_row(out.normal, i, result.normal);
      Answers::set_row(out.point_a, i, result.arm_a);
      Answers::set_row(out.point_b, i, result.arm_b);
      out.manifold_count[i] = result.manifold_count;
      out.manifold[i] = result.manifold;
    }
  }
};

// Kinds whose results change at the fast tier.
bool may_be_fast(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::capsule || is_boxlike(kind);
}

}  // namespace

bool LibrarySetting::serves(const KindPair& kinds) const {
  return accuracy_.tier != Tier::fast || (may_be_fast(kinds.a) && may_be_fast(kinds.b));
}

void LibrarySetting::run(const PairSet& pairs, Detail detail, Answers& out) {
  [[maybe_unused]] const Result<void> done = collide_rows(
      pairs.a(), pairs.b(), detail, out, {.frame = WitnessFrame::body, .accuracy = accuracy_});
  assert(done);
}

LibrarySetting standard_setting() {
  return {"standard", "standard", Promise::standard, Accuracy{}};
}
LibrarySetting certified_setting() {
  return {"certified", "certified", Promise::proven, {.tier = Tier::certified}};
}
LibrarySetting exact_setting() { return {"exact", "exact", Promise::exact, {.tier = Tier::exact}}; }
LibrarySetting single_precision_setting() {
  return {"single precision", "fast", Promise::finite, {.tier = Tier::fast}};
}

std::vector<std::unique_ptr<Contender>> contenders_for(const KindPair& kinds) {
  std::vector<std::unique_ptr<Contender>> all;
  const auto add = [&](std::unique_ptr<Contender> contender) {
    if (contender && contender->serves(kinds)) all.push_back(std::move(contender));
  };
  add(std::make_unique<ScalarReference>());
  for (const LibrarySetting& setting :
       {standard_setting(), certified_setting(), exact_setting(), single_precision_setting()}) {
    add(std::make_unique<LibrarySetting>(setting));
  }
  add(make_bullet());
  return all;
}

}  // namespace carom::accuracy
