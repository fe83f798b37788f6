// carom tunnelling: what ways of looking after fast bodies miss, and what they cost.
#include <algorithm>
#include <memory>
#include <optional>

#include "accuracy/pairs/round_pair.h"
#include "carom/base/thread_arena.h"
#include "cli/accuracy/tunnelling_output.h"
#include "cli/commands.h"
#include "cli/scenes/loaded_scene.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/options.h"
#include "cli/support/progress.h"

namespace carom::cli {
namespace {

constexpr int kMostSubsteps = 1'000'000;

struct TunnellingCommand {
  std::string scene;
  uint64_t frames = 0;  // 0: not given
  std::string isa = "auto";
  int threads = 1;
  accuracy::TunnellingOptions options;
  std::string json;
};

class FramesAhead : public accuracy::MovingScene {
 public:
  explicit FramesAhead(const LoadedScene& scene) : scene_(scene) {}

  const std::string& name() const override { return scene_.name(); }
  size_t frames() const override { return scene_.frames(); }
  PositionType positions() const override { return scene_.positions(); }
  double dt() const override { return scene_.info().dt; }

  std::vector<BodyDesc> bodies(size_t frame) const override {
    std::vector<BodyDesc> bodies;
    for (size_t i = 0; i < scene_.info().bodies; ++i) {
      bodies.push_back(scene_.player().body(scene_.frame(frame), i));
    }
    return bodies;
  }

  std::span<const Pair> excluded() const override { return scene_.player().excluded(); }

 private:
  const LoadedScene& scene_;
};

Result<std::unique_ptr<LoadedScene>> load(const TunnellingCommand& command) {
  Result<std::unique_ptr<LoadedScene>> scene = LoadedScene::open(command.scene, true);
  if (!scene) return scene.error();
  const io::SceneInfo& info = (*scene)->info();
  if (!info.has_linear_velocity && !info.has_angular_velocity) {
    return Error{command.scene + ": has no velocities, which say how bodies go on from a frame"};
  }
  // The oracle of motions knows polytopes with a radius alone.
  const BodiesOfKind bodies = (*scene)->player().bodies_of_kind();
  for (size_t i = 0; i < bodies.size(); ++i) {
    const auto kind = static_cast<ShapeKind>(i);
    if (bodies[i] == 0 || !is_round(kind)) continue;
    return Error{command.scene + ": has a " + name(kind) + ", of which meetings are not measured"};
  }
  const uint64_t frames = command.frames == 0 ? info.frames : command.frames;
  if (Result<void> read = (*scene)->load(frames); !read) return read.error();
  return scene;
}

Result<TunnellingRun> measure(TunnellingCommand command, const Console& console) {
  Result<std::unique_ptr<LoadedScene>> scene = load(command);
  if (!scene) return scene.error();
  const FramesAhead ahead(**scene);
  ThreadArena arena(command.threads);
  command.options.parallelism = arena.parallelism();
  std::optional<Progress> line;
  std::optional<Result<accuracy::TunnellingReport>> report;
  arena.run([&] {
    report = measure_tunnelling(ahead, command.options, [&](size_t done, size_t all) {
      if (!line) line.emplace(console, "frames and runs", all);
      line->update(done);
    });
  });
  if (!*report) return report->error();
  return TunnellingRun{.scene = command.scene,
                       .dt = ahead.dt(),
                       .threads = command.threads,
                       .isa = name(active_isa()),
                       .options = command.options,
                       .report = std::move(**report)};
}

Result<int> tunnelling(const TunnellingCommand& command, const Console& console) {
  if (Result<void> threads = check_threads(command.threads); !threads) return threads.error();
  Result<ForcedIsa> isa = ForcedIsa::create(command.isa);
  if (!isa) return isa.error();
  Result<JsonOutput> json = JsonOutput::open(command.json);
  if (!json) return json.error();
  const Result<TunnellingRun> run = measure(command, console);
  if (!run) return run.error();
  if (Result<void> written = write_run(*run, *json, console); !written) return written.error();
  return run->report.failures.empty() ? 0 : 1;
}

}  // namespace

void add_tunnelling_command(CommandLine& program) {
  auto command = std::make_shared<TunnellingCommand>();
  Command app = program.add_command(
      "tunnelling", "Measure what substeps, sweeps and times of impact miss, and what they cost");
  app.add_option("SCENE", command->scene, "A .npz file with velocities, or a generator").required();
  app.add_option("--frames", command->frames, "Frames to measure; all of the scene if not given")
      .between(uint64_t{1}, uint64_t{1'000'000'000});
  app.add_option("--substeps", command->options.substeps,
                 "Steps a frame of the discrete runs, separated by commas")
      .separated_by(',')
      .between(1, kMostSubsteps)
      .show_default();
  app.add_option("--reference-substeps", command->options.reference_substeps,
                 "Poses of an interval that the reference looks at")
      .between(1, kMostSubsteps)
      .show_default();
  add_threads_option(app, command->threads);
  app.add_option("--isa", command->isa, "auto, scalar, sse4, avx2, avx512 or neon").show_default();
  add_json_option(app, command->json);
  app.run([command](const Console& console) { return tunnelling(*command, console); });
}

}  // namespace carom::cli
