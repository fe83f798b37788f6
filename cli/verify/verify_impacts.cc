#include "cli/verify/verify_impacts.h"

#include <array>
#include <cstring>
#include <optional>
#include <vector>

#include "carom/reference/reference.h"
#include "carom/results/result_row.h"
#include "cli/pairs/impact_arrays.h"
#include "cli/support/progress.h"
#include "cli/verify/verify_engines.h"
#include "cli/verify/verify_text.h"

namespace carom::cli {
namespace {

using reference::Impact;

struct Variant {
  const char* name;
  bool shuffled;
  bool contacts;
};

constexpr std::array kVariants = {Variant{"times of impact", false, true},
                                  Variant{"impacts shuffled", true, true},
                                  Variant{"times alone", false, false}};

// In body frames the contact's points are arms.
Impact impact_at(const ImpactArrays& arrays, size_t row) {
  const ResultRow contact = result_row(arrays.contacts.columns(), row);
  return {.toi = arrays.toi[row],
          .status = static_cast<Status>(contact.status),
          .separation = contact.separation,
          .normal = Eigen::Vector3f(contact.normal.data()),
          .arm_a = Eigen::Vector3f(contact.point_a.data()),
          .arm_b = Eigen::Vector3f(contact.point_b.data()),
          .sub_a = contact.sub_a,
          .sub_b = contact.sub_b};
}

bool same_bits(float x, float y) { return std::memcmp(&x, &y, sizeof x) == 0; }

bool same_bits(const Eigen::Vector3f& x, const Eigen::Vector3f& y) {
  return std::memcmp(x.data(), y.data(), 3 * sizeof(float)) == 0;
}

bool same_times(const Impact& x, const Impact& y) {
  return same_bits(x.toi, y.toi) && x.status == y.status;
}

bool same_contacts(const Impact& x, const Impact& y) {
  return same_bits(x.separation, y.separation) && same_bits(x.normal, y.normal) &&
         same_bits(x.arm_a, y.arm_a) && same_bits(x.arm_b, y.arm_b) && x.sub_a == y.sub_a &&
         x.sub_b == y.sub_b;
}

std::string impact_text(const Impact& impact, bool with_contact) {
  const std::string time = "toi " + text_of(double{impact.toi}) + " status " +
                           std::to_string(static_cast<int>(impact.status));
  if (!with_contact) return time;
  return time + " separation " + text_of(double{impact.separation}) + " normal " +
         text_of(impact.normal) + " arm_a " + text_of(impact.arm_a) + " arm_b " +
         text_of(impact.arm_b) + " sub-shapes " + std::to_string(impact.sub_a) + ", " +
         std::to_string(impact.sub_b);
}

class ImpactVerifier {
 public:
  // Finds the impacts with the reference; `progress` counts the pairs.
  ImpactVerifier(System& system, const PairSet& pairs, Progress progress)
      : system_(system),
        pairs_(pairs),
        arrays_(pairs),
        in_order_(rows_in_order(pairs.size())),
        spread_out_(rows_spread_out(pairs.size())) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      progress.update(i);
      expected_.push_back(reference::time_of_impact(
          pairs.a.shape(i), pairs.a.pose(i), pairs.motions_a.sweep(i), pairs.b.shape(i),
          pairs.b.pose(i), pairs.motions_b.sweep(i), pairs.a.positions()));
    }
  }

  // Returns false at a difference. `progress` counts the runs.
  Result<bool> verify(VerifyRow& row, Progress& progress) {
    force_isa(row.engine.isa);
    for (const Variant& variant : kVariants) {
      progress.update(runs_++);
      if (Result<void> done = run(row.engine, variant); !done) return done.error();
      if (!compare(row, variant)) return false;
    }
    row.pairs = pairs_.size();
    for (const Impact& expected : expected_) row.overlaps += meets(expected.toi);
    return true;
  }

  std::optional<Difference> take_difference() { return std::move(difference_); }

 private:
  const std::vector<Pair>& order(const Variant& variant) const {
    return variant.shuffled ? spread_out_ : in_order_;
  }

  Result<void> run(const Engine& engine, const Variant& variant) {
    const Collidables a = pairs_.a.view();
    const Collidables b = pairs_.b.view();
    const ImpactColumns all = arrays_.columns();
    const ImpactColumns out =
        variant.contacts ? all : ImpactColumns{.toi = all.toi, .status = all.status};
    Result<void> done;
    engine.arena->run([&] {
      done = system_.time_of_impact(a, pairs_.motions_a.view(), b, pairs_.motions_b.view(),
                                    order(variant), out, WitnessFrame::body,
                                    engine.arena->parallelism());
    });
    return done;
  }

  bool compare(VerifyRow& row, const Variant& variant) {
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const size_t index = order(variant)[i].a;
      const Impact& want = expected_[index];
      const Impact got = impact_at(arrays_, i);
      if (same_times(want, got) && (!variant.contacts || same_contacts(want, got))) continue;
      row.differs = true;
      difference_ = describe(row.engine, variant, index, got);
      return false;
    }
    return true;
  }

  static std::string body_text(const BodyColumns& bodies, const Motions& motions, size_t index) {
    return text_of(bodies.shape(index), bodies.pose(index), bodies.positions()) + ' ' +
           text_of(motions.sweep(index));
  }

  Difference describe(const Engine& engine, const Variant& variant, size_t index,
                      const Impact& got) const {
    std::string text;
    text += "  a: " + body_text(pairs_.a, pairs_.motions_a, index) + '\n';
    text += "  b: " + body_text(pairs_.b, pairs_.motions_b, index) + '\n';
    text += "  reference: " + impact_text(expected_[index], variant.contacts) + '\n';
    text += "  carom:     " + impact_text(got, variant.contacts) + '\n';
    return {std::string(name(engine.isa)) + ", threads " + std::to_string(engine.threads) + ", " +
                variant.name + ": pair " + std::to_string(index) + " differs",
            text};
  }

  System& system_;
  const PairSet& pairs_;
  ImpactArrays arrays_;
  std::vector<Pair> in_order_;
  std::vector<Pair> spread_out_;
  std::vector<Impact> expected_;
  uint64_t runs_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace

Result<VerifyOutcome> verify_impacts(System& system, const Engines& engines, const PairSet& pairs,
                                     const std::string& source, const Console& console) {
  ImpactVerifier verifier(system, pairs, Progress(console, source + ": motion", pairs.size()));
  return verify_engines(std::move(verifier), kVariants, engines, source, console);
}

}  // namespace carom::cli
