#include "cli/verify/verify_pairs.h"

#include <array>
#include <optional>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "carom/reference/reference.h"
#include "carom/results/result_row.h"
#include "cli/support/progress.h"
#include "cli/verify/exact_decision.h"
#include "cli/verify/verify_engines.h"
#include "cli/verify/verify_text.h"
#include "narrowphase/batch/stated_body.h"

namespace carom::cli {
namespace {

struct PairVariant {
  const char* name;
  bool shuffled;  // collide() with a list in another order; otherwise collide_rows()
  Detail detail;
  WitnessFrame frame;
  Tier tier = Tier::standard;
};

constexpr std::array kPairVariants = {
    PairVariant{"rows", false, Detail::contact, WitnessFrame::body},
    PairVariant{"world frame", false, Detail::contact, WitnessFrame::world},
    PairVariant{"shuffled", true, Detail::contact, WitnessFrame::body},
    PairVariant{"detail overlap", false, Detail::overlap, WitnessFrame::body},
    PairVariant{"detail manifold", false, Detail::manifold, WitnessFrame::body},
    PairVariant{"manifold shuffled in the world", true, Detail::manifold, WitnessFrame::world},
    PairVariant{"certified", false, Detail::overlap, WitnessFrame::body, Tier::certified},
    PairVariant{"exact", false, Detail::overlap, WitnessFrame::body, Tier::exact},
};

// The reference takes only pairs that have a kernel.
Result<void> check_kernels(const PairSet& pairs) {
  for (size_t i = 0; i < pairs.size(); ++i) {
    ShapeKind a = kind_of(pairs.a.shape(i));
    ShapeKind b = kind_of(pairs.b.shape(i));
    if (supports(a, b)) continue;
    return Error{"pair " + std::to_string(i) + ": no kernel for " + name(a) + " against " +
                 name(b)};
  }
  return {};
}

bool is_invalid(const ResultRow& row) {
  return row.status == static_cast<uint8_t>(Status::invalid);
}

std::array<float, 3> array_of(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// position + arm, rounded as in the library: a float64 position is split into a float32 and its
// remainder.
std::array<float, 3> in_world(const std::array<float, 3>& arm, const Eigen::Vector3d& position,
                              PositionType positions) {
  std::array<float, 3> point{};
  for (int axis = 0; axis < 3; ++axis) {
    float high = static_cast<float>(position[axis]);
    float low = static_cast<float>(position[axis] - double{high});
    point[axis] = positions == PositionType::float32 ? high + arm[axis] : high + (low + arm[axis]);
  }
  return point;
}

// Unused points of a manifold are zero in any frame, so they are not moved.
ManifoldPoints in_world(ManifoldPoints manifold, size_t count, const Eigen::Vector3d& position,
                        PositionType positions) {
  for (size_t i = 0; i < count; ++i) {
    manifold.point[i] = in_world(manifold.point[i], position, positions);
  }
  return manifold;
}

std::string vector_text(const std::array<float, 3>& v) {
  return text_of(Eigen::Vector3f(v[0], v[1], v[2]));
}

std::string row_text(const ResultRow& row) {
  return "overlap " + std::to_string(row.overlap) + " status " + std::to_string(row.status) +
         " separation " + text_of(double{row.separation}) + " normal " + vector_text(row.normal) +
         " point_a " + vector_text(row.point_a) + " point_b " + vector_text(row.point_b) +
         " manifold of " + std::to_string(row.manifold_count) + ": " + text_of(row.manifold) +
         " sub-shapes " + std::to_string(row.sub_a) + ", " + std::to_string(row.sub_b);
}

class PairVerifier {
 public:
  // Tests the pairs with the reference; `progress` counts them.
  PairVerifier(System& system, const PairSet& pairs, Progress progress)
      : system_(system),
        pairs_(pairs),
        overlap_(results_of(pairs, Detail::overlap)),
        contact_(results_of(pairs, Detail::contact)),
        manifold_(results_of(pairs, Detail::manifold)),
        order_(rows_spread_out(pairs.size())) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      progress.update(i);
      expected_.push_back(reference_row(i));
      exact_.push_back(exact_decision(i));
      is_decided_exactly_ = is_decided_exactly_ && is_decided_exactly(pairs.a.shape(i)) &&
                            is_decided_exactly(pairs.b.shape(i));
    }
  }

  // Returns false at a difference. `progress` counts the runs.
  Result<bool> verify(VerifyRow& row, Progress& progress) {
    force_isa(row.engine.isa);
    for (const PairVariant& variant : kPairVariants) {
      if (variant.tier == Tier::exact && !is_decided_exactly_) continue;
      progress.update(runs_++);
      if (Result<void> done = test(row.engine, variant); !done) return done.error();
      if (!compare(row, variant)) return false;
    }
    row.pairs = pairs_.size();
    for (const ResultRow& expected : expected_) row.overlaps += expected.overlap;
    return true;
  }

  std::optional<Difference> take_difference() { return std::move(difference_); }

 private:
  ResultRow reference_row(size_t index) const {
    const reference::PairResult result =
        reference::collide(pairs_.a.shape(index), pairs_.a.pose(index), pairs_.b.shape(index),
                           pairs_.b.pose(index), pairs_.a.positions());
    return {.overlap = static_cast<uint8_t>(result.overlap),
            .status = static_cast<uint8_t>(result.status),
            .separation = result.separation,
            .normal = array_of(result.normal),
            .point_a = array_of(result.arm_a),
            .point_b = array_of(result.arm_b),
            .manifold_count = result.manifold_count,
            .manifold = result.manifold,
            .sub_a = result.sub_a,
            .sub_b = result.sub_b};
  }

  // Uses exact arithmetic if double precision proves nothing; 0 for invalid pairs.
  uint8_t exact_decision(size_t index) const {
    if (is_invalid(expected_[index])) return 0;
    const StatedBody a = stated_body(pairs_.a.view(), index);
    const StatedBody b = stated_body(pairs_.b.view(), index);
    return cli::exact_decision(a, b);
  }

  static StatedBody stated_body(const Collidables& bodies, size_t index) {
    return carom::stated_body(BodyReader{bodies}, index);
  }

  // A proving tier must report the exact decision, if there is one (of round shapes that touch
  // there is none); the certified tier may report undecided. A proof about bodies with parts ends
  // at the first overlapping part, whose status may differ from the part that the reference
  // reports.
  bool is_as_promised(const ResultRow& want, const ResultRow& got, Tier tier) const {
    if (same_bits(want, got)) return true;
    if (!has_proofs(tier) || is_invalid(want) || is_invalid(got)) return false;
    const bool abstains =
        tier == Tier::certified && (got.overlap == kUndecided || want.overlap == kUndecided);
    if (pairs_.has_composites()) return abstains || want.overlap == got.overlap;
    return abstains && want.status == got.status;
  }

  // The reference's result of a pair in the form that a variant gives.
  ResultRow expected(size_t index, const PairVariant& variant) const {
    ResultRow row = expected_[index];
    if (has_proofs(variant.tier)) row.overlap = exact_[index];
    if (variant.detail == Detail::overlap) {
      return {.overlap = row.overlap, .status = row.status};
    }
    if (variant.detail == Detail::contact) {
      row.manifold_count = 0;
      row.manifold = {};
    }
    if (variant.frame == WitnessFrame::body || is_invalid(row)) return row;
    const Eigen::Vector3d position_a = pairs_.a.pose(index).position;
    const PositionType positions = pairs_.a.positions();
    row.point_a = in_world(row.point_a, position_a, positions);
    row.point_b = in_world(row.point_b, pairs_.b.pose(index).position, positions);
    row.manifold = in_world(row.manifold, row.manifold_count, position_a, positions);
    return row;
  }

  const ResultColumns& columns(const PairVariant& variant) const {
    if (variant.detail == Detail::overlap) return overlap_.columns();
    return (variant.detail == Detail::contact ? contact_ : manifold_).columns();
  }

  Result<void> test(const Engine& engine, const PairVariant& variant) {
    Collidables a = pairs_.a.view();
    Collidables b = pairs_.b.view();
    const ResultColumns& out = columns(variant);
    Parallelism parallelism = engine.arena->parallelism();
    Result<void> done;
    engine.arena->run([&] {
      done = variant.shuffled ? system_.collide(a, b, order_, variant.detail, out, variant.frame,
                                                parallelism, variant.tier)
                              : system_.collide_rows(a, b, variant.detail, out, variant.frame,
                                                     parallelism, variant.tier);
    });
    return done;
  }

  bool compare(VerifyRow& row, const PairVariant& variant) {
    for (size_t i = 0; i < pairs_.size(); ++i) {
      size_t index = variant.shuffled ? order_[i].a : i;
      ResultRow want = expected(index, variant);
      ResultRow got = result_row(columns(variant), i);
      if (is_as_promised(want, got, variant.tier)) continue;
      row.differs = true;
      difference_ = describe(row.engine, variant, index, want, got);
      return false;
    }
    return true;
  }

  Difference describe(const Engine& engine, const PairVariant& variant, size_t index,
                      const ResultRow& want, const ResultRow& got) const {
    PositionType positions = pairs_.a.positions();
    std::string text;
    text += "  a: " + text_of(pairs_.a.shape(index), pairs_.a.pose(index), positions) + '\n';
    text += "  b: " + text_of(pairs_.b.shape(index), pairs_.b.pose(index), positions) + '\n';
    text += "  reference: " + row_text(want) + '\n';
    text += "  carom:     " + row_text(got) + '\n';
    return {std::string(name(engine.isa)) + ", threads " + std::to_string(engine.threads) + ", " +
                variant.name + ": pair " + std::to_string(index) + " differs",
            text};
  }

  System& system_;
  const PairSet& pairs_;
  ResultArrays overlap_;
  ResultArrays contact_;
  ResultArrays manifold_;
  std::vector<Pair> order_;
  std::vector<ResultRow> expected_;
  std::vector<uint8_t> exact_;
  bool is_decided_exactly_ = true;  // otherwise the exact tier refuses the pairs
  uint64_t runs_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace

Result<VerifyOutcome> verify_pairs(System& system, const Engines& engines, const PairSet& pairs,
                                   const std::string& source, const Console& console) {
  if (Result<void> kernels = check_kernels(pairs); !kernels) {
    return Error{source + ": " + kernels.error().message};
  }
  PairVerifier verifier(system, pairs, Progress(console, source + ": pair", pairs.size()));
  return verify_engines(std::move(verifier), kPairVariants, engines, source, console);
}

}  // namespace carom::cli
