#include "cli/verify/verify_scene.h"

#include <array>
#include <optional>
#include <vector>

#include "carom/reference/reference.h"
#include "cli/verify/verify_compare.h"

namespace carom::cli {
namespace {

struct SceneVariant {
  const char* name;
  BroadphaseMethod broadphase;
  bool carry_results;
  Detail detail;
};

constexpr std::array kSceneVariants = {
    SceneVariant{"grid", BroadphaseMethod::grid, true, Detail::contact},
    SceneVariant{"grid without cache", BroadphaseMethod::grid, false, Detail::contact},
    SceneVariant{"sweep", BroadphaseMethod::sweep, true, Detail::contact},
    SceneVariant{"sweep without cache", BroadphaseMethod::sweep, false, Detail::contact},
    SceneVariant{"brute", BroadphaseMethod::brute, true, Detail::contact},
    SceneVariant{"sweep at detail overlap", BroadphaseMethod::sweep, true, Detail::overlap},
    SceneVariant{"grid at detail manifold", BroadphaseMethod::grid, true, Detail::manifold},
    SceneVariant{"grid at detail manifold without cache", BroadphaseMethod::grid, false,
                 Detail::manifold},
    SceneVariant{"sweep at detail regions", BroadphaseMethod::sweep, true, Detail::regions},
    SceneVariant{"sweep at detail regions without cache", BroadphaseMethod::sweep, false,
                 Detail::regions},
};

// With more bodies the brute broadphase would take minutes a frame on every engine, so it is left
// out. The reference still compares all boxes.
constexpr uint64_t kMaxBruteBodies = 20'000;

// At detail overlap contact distances do not count, and a scene that has them has other pairs.
std::vector<SceneVariant> variants_for(const io::SceneInfo& scene) {
  std::vector<SceneVariant> variants;
  for (const SceneVariant& variant : kSceneVariants) {
    const bool brute = variant.broadphase == BroadphaseMethod::brute;
    if (brute && scene.bodies > kMaxBruteBodies) continue;
    if (variant.detail == Detail::overlap && !scene.contact_distance.empty()) continue;
    variants.push_back(variant);
  }
  return variants;
}

std::string names_of(const std::vector<SceneVariant>& variants) {
  std::string text;
  for (const SceneVariant& variant : variants) {
    text += (text.empty() ? "" : ", ") + std::string(variant.name);
  }
  return text;
}

// The reference's frame at detail manifold, made from detail regions: the first contact of each
// pair.
reference::Frame without_more_regions(reference::Frame frame) {
  std::vector<uint32_t> place;
  std::vector<Contact> contacts;
  std::vector<ManifoldPoints> manifolds;
  for (size_t i = 0; i < frame.contacts.size(); ++i) {
    const Contact& contact = frame.contacts[i];
    place.push_back(static_cast<uint32_t>(contacts.size()));
    if (!contacts.empty() && contacts.back().a == contact.a && contacts.back().b == contact.b) {
      continue;
    }
    contacts.push_back(contact);
    contacts.back().left_out = 0;
    manifolds.push_back(frame.manifolds[i]);
  }
  frame.contacts = std::move(contacts);
  frame.manifolds = std::move(manifolds);
  for (Event& event : frame.events) {
    if (event.kind != EventKind::impact && event.contact != kNoContact) {
      event.contact = place[event.contact];
    }
  }
  return frame;
}

// The reference's frame at detail contact, made from detail manifold.
reference::Frame without_manifolds(reference::Frame frame) {
  frame.manifolds.clear();
  for (Contact& contact : frame.contacts) contact.manifold_count = 0;
  return frame;
}

// The reference's frame at detail overlap.
reference::Frame without_contacts(reference::Frame frame) {
  frame.contacts.clear();
  for (Event& event : frame.events) event.contact = kNoContact;
  return frame;
}

class SceneVerifier {
 public:
  SceneVerifier(System& system, const Engines& engines, const Player& player)
      : player_(player), variants_(variants_for(player.info())) {
    for (const Engine& engine : engines.list()) {
      rows_.push_back({.engine = engine});
      for (const SceneVariant& variant : variants_) {
        steppers_.push_back(system.make_stepper(player, settings(engine, variant)));
      }
    }
  }

  // Returns false at a difference.
  bool verify_frame(const io::SceneFrame& frame) {
    step_reference(frame);
    size_t next = 0;
    for (VerifyRow& row : rows_) {
      for (const SceneVariant& variant : variants_) {
        if (!verify_engine(row, variant, *steppers_[next++], frame)) return false;
      }
      ++row.frames;
      row.pairs += expected_.pairs.size();
      row.overlaps += expected_.touching.size();
    }
    ++frame_;
    return true;
  }

  VerifyOutcome finish(const std::string& source) {
    return {source, names_of(variants_), std::move(rows_), std::move(difference_)};
  }

 private:
  WorldSettings settings(const Engine& engine, const SceneVariant& variant) const {
    return {.positions = player_.positions(),
            .detail = variant.detail,
            .broadphase = variant.broadphase,
            .parallelism = engine.arena->parallelism(),
            .persist_events = true,
            .carry_results = variant.carry_results};
  }

  void step_reference(const io::SceneFrame& frame) {
    bodies_.resize(player_.info().bodies);
    for (size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i] = {BodyId{static_cast<uint32_t>(i), 0}, player_.body(frame, i)};
    }
    expected_ = reference::step(bodies_, {.positions = player_.positions(),
                                          .detail = Detail::regions,
                                          .velocities = player_.info().has_linear_velocity,
                                          .previous = frame_ == 0 ? nullptr : &expected_,
                                          .filters = {.excluded = player_.excluded()}});
    expected_manifold_ = without_more_regions(expected_);
    expected_contact_ = without_manifolds(expected_manifold_);
    expected_overlap_ = without_contacts(expected_contact_);
  }

  const reference::Frame& expected_at(Detail detail) const {
    if (detail == Detail::overlap) return expected_overlap_;
    if (detail == Detail::contact) return expected_contact_;
    return detail == Detail::manifold ? expected_manifold_ : expected_;
  }

  bool verify_engine(VerifyRow& row, const SceneVariant& variant, Stepper& stepper,
                     const io::SceneFrame& frame) {
    force_isa(row.engine.isa);
    FrameView actual;
    row.engine.arena->run([&] { actual = stepper.step(frame); });
    FrameView expected = view_of(expected_at(variant.detail));
    std::optional<Mismatch> mismatch = compare(expected, actual);
    if (!mismatch) return true;
    row.differs = true;
    difference_ = Difference{std::string(name(row.engine.isa)) + ", threads " +
                                 std::to_string(row.engine.threads) + ", " + variant.name +
                                 ", frame " + std::to_string(frame_) + ": " + mismatch->what +
                                 " differ at pair (" + std::to_string(mismatch->pair.a) + ", " +
                                 std::to_string(mismatch->pair.b) + ")",
                             describe(*mismatch, bodies_, player_.positions(), expected, actual)};
    return false;
  }

  const Player& player_;
  std::vector<SceneVariant> variants_;
  std::vector<VerifyRow> rows_;
  std::vector<std::unique_ptr<Stepper>> steppers_;  // variants_.size() for each row
  std::vector<reference::Body> bodies_;
  reference::Frame expected_;  // at detail regions
  reference::Frame expected_manifold_;
  reference::Frame expected_contact_;
  reference::Frame expected_overlap_;
  uint64_t frame_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace

Result<VerifyOutcome> verify_scene(System& system, const Engines& engines, io::SceneReader& scene,
                                   const std::string& source, uint64_t frames,
                                   const Console& console) {
  Result<Player> player = Player::create(scene.info(), source);
  if (!player) return player.error();
  scene.want(player->wanted(Detail::manifold));
  SceneVerifier verifier(system, engines, *player);
  Progress progress(console, source + ": frame", frames);
  io::SceneFrame frame;
  for (uint64_t i = 0; i < frames; ++i) {
    progress.update(i);
    if (Result<void> read = scene.read_frame(frame); !read) return read.error();
    if (!verifier.verify_frame(frame)) break;
  }
  unforce_isa();
  return verifier.finish(source);
}

}  // namespace carom::cli
