#include "cli/run/replay.h"

#include <chrono>

#include "cli/support/resource_usage.h"

namespace carom::cli {
namespace {

class Recorder {
 public:
  Recorder(const World& world, uint64_t bodies, bool looks_ahead)
      : world_(world), looks_ahead_(looks_ahead), was_quarantined_(bodies) {}

  void note(const StepReport& report, double frame_ms, uint64_t page_faults) {
    record_.frame_ms.push_back(frame_ms);
    record_.page_faults.push_back(page_faults);
    for (int stage = 0; stage < kStageCount; ++stage) {
      record_.stage_ms[stage].push_back(static_cast<double>(report.stage_ns[stage]) * 1e-6);
      record_.serial_ms[stage].push_back(static_cast<double>(report.serial_ns[stage]) * 1e-6);
    }
    record_.pairs.push_back(report.pairs);
    record_.undecided.push_back(report.undecided);
    record_.tested.push_back(report.tested);
    record_.by_models.push_back(report.by_models);
    for (size_t k = 0; k < kCountedRungs; ++k) record_.by_rung[k].push_back(report.by_rung[k]);
    record_.by_shells.push_back(report.by_shells);
    record_.kept.push_back(report.kept);
    record_.dropped.push_back(report.dropped);
    record_.quarantined.push_back(report.quarantined);
    Detail detail = world_.settings().detail;
    if (detail >= Detail::contact) record_.contacts.push_back(report.contacts);
    if (detail == Detail::overlap) record_.contacts.push_back(report.overlaps);
    record_.search = report.search;
    record_.searched.push_back(report.ran(Stage::broadphase) ? report.search.searched : 0);
    record_.stages_run |= report.stages_run;
    note_events(report);
    for (BodyId id : world_.quarantined()) was_quarantined_[id.index] = true;
    record_.hash.add(world_.pairs());
    record_.hash.add(world_.overlaps());
    record_.hash.add(world_.contacts());
    if (has_manifolds(detail)) record_.hash.add(world_.manifolds());
    if (looks_ahead_) note_what_is_ahead(report);
  }

  RunRecord finish() {
    for (size_t i = 0; i < was_quarantined_.size(); ++i) {
      if (was_quarantined_[i]) record_.quarantined_bodies.push_back(static_cast<uint32_t>(i));
    }
    return std::move(record_);
  }

 private:
  void note_what_is_ahead(const StepReport& report) {
    record_.swept.push_back(report.swept);
    record_.impacts.push_back(report.impacts);
    record_.speculative.push_back(report.speculative);
    record_.hash.add(world_.impacts());
    record_.hash.add(world_.speculative_contacts());
  }

  // The world writes no persist events; every overlap that does not begin persists.
  void note_events(const StepReport& report) {
    std::array<uint64_t, kEventKindCount> counts{};
    for (const Event& event : world_.events()) ++counts[static_cast<size_t>(event.kind)];
    if (world_.settings().events) {
      counts[static_cast<size_t>(EventKind::persist)] =
          report.overlaps - counts[static_cast<size_t>(EventKind::begin)];
    }
    for (size_t kind = 0; kind < counts.size(); ++kind) {
      record_.events[kind].push_back(counts[kind]);
    }
  }

  const World& world_;
  bool looks_ahead_;
  std::vector<bool> was_quarantined_;
  RunRecord record_;
};

}  // namespace

Result<RunRecord> replay(io::SceneReader& scene, const Player& player, World& world,
                         uint64_t frames, std::optional<PairsOutput>& pairs_out, Progress& progress,
                         Detection detection, MotionTrack* track) {
  using Clock = std::chrono::steady_clock;
  Recorder recorder(world, scene.info().bodies, detection != Detection::discrete);
  io::SceneFrame frame;
  for (uint64_t i = 0; i < frames; ++i) {
    progress.update(i);
    if (Result<void> read = scene.read_frame(frame); !read) return read.error();
    if (i == 0) {
      player.start(frame, world, detection);
    } else {
      player.move(frame, world);
    }
    const uint64_t faults_before = page_faults();
    const Clock::time_point begin = Clock::now();
    const StepReport& report = world.step();
    const Clock::time_point end = Clock::now();
    const uint64_t faults = page_faults() - faults_before;
    if (!report.search.complete) {
      return Error{"frame " + std::to_string(i) + " has " + std::to_string(report.search.pairs) +
                   " pairs of overlapping bounds, more than the limit of " +
                   std::to_string(world.settings().most_pairs)};
    }
    recorder.note(report, std::chrono::duration<double, std::milli>(end - begin).count(), faults);
    if (track) track->note(world, i);
    if (!pairs_out) continue;
    if (Result<void> added = pairs_out->add_frame(world.pairs()); !added) return added.error();
  }
  return recorder.finish();
}

}  // namespace carom::cli
