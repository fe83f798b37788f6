// carom verify: passes for carom, and finds every planted fault.
#include "cli/verify/verify.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "cli/verify/verify_builtin.h"
#include "io/pairs_file.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using VerifyTest = CliTest;

struct Verdict {
  int code;
  std::string out;
  std::string err;
};

Verdict verify_with(System& system, std::vector<std::string> sources) {
  std::ostringstream out, err;
  const Console console{out, err};
  const auto code =
      verify({.sources = std::move(sources), .frames = 0, .threads = 2}, system, console);
  EXPECT_TRUE(code);
  return {*code, out.str(), err.str()};
}

void expect_found(const Verdict& verdict, std::initializer_list<std::string> parts) {
  EXPECT_EQ(verdict.code, 1);
  EXPECT_NE(verdict.out.find("DIFFERS"), std::string::npos) << verdict.out;
  EXPECT_NE(verdict.out.find("0x1."), std::string::npos) << verdict.out;
  EXPECT_NE(verdict.out.find("reference: "), std::string::npos) << verdict.out;
  for (const std::string& part : parts) {
    EXPECT_NE(verdict.out.find(part), std::string::npos) << part << "\n" << verdict.out;
  }
  EXPECT_EQ(verdict.err.rfind("carom: verify: ", 0), 0u) << verdict.err;
  EXPECT_EQ(verdict.err.find('\n'), verdict.err.size() - 1);
}

// A world with tampered results.
class BrokenStepper : public Stepper {
 public:
  using Break =
      std::function<void(int frame, std::vector<Pair>&, std::vector<uint8_t>&,
                         std::vector<Contact>&, std::vector<ManifoldPoints>&, std::vector<Event>&)>;
  BrokenStepper(std::unique_ptr<Stepper> base, Break damage)
      : base_(std::move(base)), break_(std::move(damage)) {}

  FrameView step(const io::SceneFrame& frame) override {
    const FrameView view = base_->step(frame);
    pairs_.assign(view.pairs.begin(), view.pairs.end());
    overlaps_.assign(view.overlaps.begin(), view.overlaps.end());
    contacts_.assign(view.contacts.begin(), view.contacts.end());
    manifolds_.assign(view.manifolds.begin(), view.manifolds.end());
    events_.assign(view.events.begin(), view.events.end());
    break_(frame_++, pairs_, overlaps_, contacts_, manifolds_, events_);
    return {pairs_, overlaps_, contacts_, manifolds_, events_, view.quarantined};
  }

 private:
  std::unique_ptr<Stepper> base_;
  Break break_;
  std::vector<Pair> pairs_;
  std::vector<uint8_t> overlaps_;
  std::vector<Contact> contacts_;
  std::vector<ManifoldPoints> manifolds_;
  std::vector<Event> events_;
  int frame_ = 0;
};

class BrokenWorld : public System {
 public:
  explicit BrokenWorld(BrokenStepper::Break damage) : break_(std::move(damage)) {}
  std::unique_ptr<Stepper> make_stepper(const Player& player,
                                        const WorldSettings& settings) override {
    return std::make_unique<BrokenStepper>(System::make_stepper(player, settings), break_);
  }

 private:
  BrokenStepper::Break break_;
};

constexpr char kScene[] = "brownian:n=200,frames=4,density=0.6,shape=sphere";

TEST_F(VerifyTest, BuiltinSetPasses) {
  const CommandResult result = run_command({"verify", "--threads", "2"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out.find("DIFFERS"), std::string::npos);
  for (const Isa isa : usable_isas()) {
    EXPECT_NE(result.out.find(name(isa)), std::string::npos) << name(isa);
  }
}

// The built-in pairs must be worth testing: 30 to 70 % of them overlap.
TEST_F(VerifyTest, BuiltinPairsHitAndMiss) {
  for (const BuiltinPairs& set : builtin_pairs()) {
    size_t overlaps = 0;
    for (size_t i = 0; i < set.pairs.size(); ++i) {
      overlaps +=
          reference::collide(set.pairs.a.shape(i), set.pairs.a.pose(i), set.pairs.b.shape(i),
                             set.pairs.b.pose(i), set.pairs.a.positions())
              .overlap;
    }
    EXPECT_GT(overlaps, set.pairs.size() * 3 / 10) << set.name;
    EXPECT_LT(overlaps, set.pairs.size() * 7 / 10) << set.name;
  }
}

// 30 to 70 % of the built-in moving pairs meet.
TEST_F(VerifyTest, BuiltinMotionsHitAndMiss) {
  for (const BuiltinPairs& set : builtin_motions()) {
    size_t impacts = 0;
    for (size_t i = 0; i < set.pairs.size(); ++i) {
      impacts +=
          std::isfinite(reference::time_of_impact(
                            set.pairs.a.shape(i), set.pairs.a.pose(i), set.pairs.motions_a.sweep(i),
                            set.pairs.b.shape(i), set.pairs.b.pose(i), set.pairs.motions_b.sweep(i),
                            set.pairs.a.positions())
                            .toi);
    }
    EXPECT_GT(impacts, set.pairs.size() * 3 / 10) << set.name;
    EXPECT_LT(impacts, set.pairs.size() * 7 / 10) << set.name;
  }
}

TEST_F(VerifyTest, OneBitOfAContact) {
  BrokenWorld system([](int frame, auto&, auto&, std::vector<Contact>& contacts, auto&, auto&) {
    if (frame == 2 && contacts.size() > 5) {
      contacts[5].separation = std::nextafter(contacts[5].separation, 1.0f);
    }
  });
  expect_found(verify_with(system, {kScene}),
               {"frame 2: contacts differ at pair (", "sphere radius 0x1p-1", "separation -0x"});
}

TEST_F(VerifyTest, OneBitOfAManifold) {
  BrokenWorld system(
      [](int frame, auto&, auto&, auto&, std::vector<ManifoldPoints>& manifolds, auto&) {
        if (frame != 1 || manifolds.size() <= 7) return;
        float& x = manifolds[7].point[0][2];
        x = std::nextafter(x, 1e9f);
      });
  expect_found(verify_with(system, {kScene}),
               {"detail manifold", "frame 1: manifolds differ at pair (", " manifold of 1: ("});
}

TEST_F(VerifyTest, AMissingPair) {
  BrokenWorld system([](int frame, std::vector<Pair>& pairs, auto&, auto&, auto&, auto&) {
    if (frame == 1) pairs.pop_back();
  });
  expect_found(verify_with(system, {kScene}),
               {"frame 1: pairs differ", "carom:     no candidate pair", "bounds ("});
}

TEST_F(VerifyTest, AWrongDecision) {
  BrokenWorld system(
      [](int, auto&, std::vector<uint8_t>& overlaps, auto&, auto&, auto&) { overlaps[3] ^= 1; });
  expect_found(verify_with(system, {kScene}), {"frame 0: overlaps differ"});
}

TEST_F(VerifyTest, AWrongEvent) {
  BrokenWorld system([](int frame, auto&, auto&, auto&, auto&, std::vector<Event>& events) {
    if (frame == 3) events[0].kind = EventKind::end;
  });
  expect_found(verify_with(system, {kScene}), {"frame 3: events differ", "event end"});
}

// Kernels that are wrong in one lane, on one instruction set, at one detail, or at one position.
class BrokenKernel : public System {
 public:
  enum class Flaw { last_bit, overlap_only, list_only, threads, manifold, certified, exact };
  explicit BrokenKernel(Flaw flaw) : flaw_(flaw) {}

  Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                            const ResultColumns& out, WitnessFrame frame, Parallelism parallelism,
                            Tier tier) override {
    Result<void> done = System::collide_rows(a, b, detail, out, frame, parallelism, tier);
    if (flaw_ == Flaw::last_bit && detail == Detail::contact) {
      out.normal[1][17] = std::nextafter(out.normal[1][17], 2.0f);
    }
    if (flaw_ == Flaw::overlap_only && detail == Detail::overlap) out.overlap[17] ^= 1;
    if (flaw_ == Flaw::certified && tier == Tier::certified) out.overlap[17] ^= 1;
    if (flaw_ == Flaw::exact && tier == Tier::exact) out.overlap[17] = kUndecided;
    if (flaw_ == Flaw::threads && parallelism == Parallelism::arena) out.overlap[17] ^= 1;
    if (flaw_ == Flaw::manifold && out.manifold) out.manifold[17].separation[3] += 1;
    return done;
  }

  Result<void> collide(const Collidables& a, const Collidables& b, std::span<const Pair> pairs,
                       Detail detail, const ResultColumns& out, WitnessFrame frame,
                       Parallelism parallelism, Tier tier) override {
    Result<void> done = System::collide(a, b, pairs, detail, out, frame, parallelism, tier);
    if (flaw_ == Flaw::list_only) out.point_a[2][17] += 1;
    return done;
  }

 private:
  Flaw flaw_;
};

TEST_F(VerifyTest, BrokenKernels) {
  using Flaw = BrokenKernel::Flaw;
  const std::pair<Flaw, std::string> kCases[] = {{Flaw::last_bit, "rows: pair 17 differs"},
                                                 {Flaw::overlap_only, "detail overlap: pair 17"},
                                                 {Flaw::list_only, "shuffled: pair "},
                                                 {Flaw::threads, "threads 2, rows: pair 17"},
                                                 {Flaw::manifold, "detail manifold: pair 17"},
                                                 {Flaw::certified, "certified: pair 17"},
                                                 {Flaw::exact, "exact: pair 17"}};
  for (const auto& [flaw, text] : kCases) {
    BrokenKernel system(flaw);
    expect_found(verify_with(system, {test_data("pairs_sample.npz")}),
                 {"pairs_sample.npz: ", text, "  a: ", "reference: ", "carom: "});
  }
}

// Printed inputs can be pasted back: they contain orientations and all parameters.
TEST_F(VerifyTest, DifferencesShowOrientedShapes) {
  io::PairsFile file;
  file.pairs = 18;
  file.shapes.kind = {1, 6};
  file.shapes.params = {{1, 0, 0, -1, 0, 0, 0.75f}, {1, 0.25f}};
  file.shapes.vertex_range = {{0, 0}, {0, 3}};
  file.shapes.vertices = {{4, 0, 0}, {0, 8, 0}, {0, 0, 16}};
  file.shapes.triangle_range = {{0, 0}, {0, 1}};
  file.shapes.triangles = {{0, 1, 2}};
  for (io::PairSide* side : {&file.a, &file.b}) {
    side->shape.assign(18, side == &file.b);
    side->position32.assign(18, {0, 0, 0});
    side->orientation.assign(18, {0, 2, 0, 1});
  }
  ASSERT_TRUE(io::write_pairs(path("in.npz"), file));
  BrokenKernel system(BrokenKernel::Flaw::threads);
  expect_found(
      verify_with(system, {path("in.npz")}),
      {"  a: capsule a (0x1p+0, 0x0p+0, 0x0p+0) b (-0x1p+0, 0x0p+0, 0x0p+0) radius 0x1.8p-1",
       "orientation (0x0p+0, 0x1p+1, 0x0p+0, 0x1p+0) float32",
       "  b: triangle (0x1p+2, 0x0p+0, 0x0p+0) (0x0p+0, 0x1p+3, 0x0p+0) (0x0p+0, 0x0p+0, "
       "0x1p+4) thickness 0x1p-2 one-sided inner edges 0"});
}

// A search for impacts that is wrong in one place.
class BrokenImpacts : public System {
 public:
  using Break =
      std::function<void(const ImpactColumns& out, Parallelism parallelism, bool shuffled)>;
  explicit BrokenImpacts(Break damage) : break_(std::move(damage)) {}

  Result<void> time_of_impact(const Collidables& a, const SweepView& sweep_a, const Collidables& b,
                              const SweepView& sweep_b, std::span<const Pair> pairs,
                              const ImpactColumns& out, WitnessFrame frame,
                              Parallelism parallelism) override {
    Result<void> done =
        System::time_of_impact(a, sweep_a, b, sweep_b, pairs, out, frame, parallelism);
    break_(out, parallelism, pairs[1].a != 1);
    return done;
  }

 private:
  Break break_;
};

TEST_F(VerifyTest, BrokenImpacts) {
  const auto next = [](float& x) { x = std::nextafter(x, 2.0f); };
  const std::pair<BrokenImpacts::Break, std::string> kCases[] = {
      {[&](const ImpactColumns& out, auto, bool) { next(out.toi[20]); },
       "times of impact: pair 20 differs"},
      {[](const ImpactColumns& out, auto, bool) { out.status[20] ^= 1; },
       "times of impact: pair 20 differs"},
      {[&](const ImpactColumns& out, auto, bool) {
         if (out.want_contacts()) next(out.point_b[2][20]);
       },
       "times of impact: pair 20 differs"},
      {[&](const ImpactColumns& out, auto, bool shuffled) {
         if (shuffled) next(out.separation[0]);
       },
       "impacts shuffled: pair 0 differs"},
      {[&](const ImpactColumns& out, auto, bool) {
         if (!out.want_contacts()) next(out.toi[20]);
       },
       "times alone: pair 20 differs"},
      {[&](const ImpactColumns& out, Parallelism parallelism, bool) {
         if (parallelism == Parallelism::arena) next(out.toi[20]);
       },
       "threads 2, times of impact: pair 20 differs"}};
  for (const auto& [damage, text] : kCases) {
    BrokenImpacts system(damage);
    expect_found(verify_with(system, {test_data("toi_sample.npz")}),
                 {"toi_sample.npz: ", text, "  a: ", " displacement (", " rotation (",
                  "reference: toi 0x", "carom:     toi 0x"});
  }
}

class SlowKernel : public System {
 public:
  Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                            const ResultColumns& out, WitnessFrame frame, Parallelism parallelism,
                            Tier tier) override {
    if (!slept_) std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    slept_ = true;
    return System::collide_rows(a, b, detail, out, frame, parallelism, tier);
  }

 private:
  bool slept_ = false;
};

TEST_F(VerifyTest, PairsShowProgressOnATerminal) {
  io::PairsFile file;
  file.pairs = 1;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  for (io::PairSide* side : {&file.a, &file.b}) {
    side->shape = {0};
    side->position32 = {{0, 0, 0}};
  }
  ASSERT_TRUE(io::write_pairs(path("in.npz"), file));
  for (const bool terminal : {true, false}) {
    SlowKernel system;
    std::ostringstream out, err;
    const Console console{out, err, terminal};
    EXPECT_TRUE(verify({.sources = {path("in.npz")}, .threads = 1}, system, console));
    EXPECT_EQ(err.str().find("in.npz: run 1/") != std::string::npos, terminal) << err.str();
  }
}

TEST_F(VerifyTest, SettlingPasses) {
  const CommandResult result =
      run_command({"verify", test_data("settling.npz"), "--frames", "3", "--threads", "2"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
}

TEST_F(VerifyTest, GoesOnAfterAFileItCannotRead) {
  const CommandResult result =
      run_command({"verify", path("absent.npz"), "still:n=20,frames=1", "--threads", "1"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("absent.npz"), std::string::npos);
  EXPECT_NE(result.out.find("same bits"), std::string::npos);
  EXPECT_EQ(result.out.find("Everything agrees"), std::string::npos);
}

}  // namespace
}  // namespace carom::cli
