// carom run: replays a scene and measures it.
#include <array>
#include <memory>
#include <optional>

#include "carom/base/thread_arena.h"
#include "cli/commands.h"
#include "cli/page/scene_page.h"
#include "cli/run/run_report.h"
#include "cli/scenes/scene_source.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/options.h"
#include "cli/support/resource_usage.h"

namespace carom::cli {
namespace {

struct RunOptions {
  std::string scene;
  uint64_t frames = 0;  // 0: not given
  EngineOptions engine;
  WorldOptions world;
  std::string json;
  std::string pairs_out;
  std::string page;
};

// Fails if a page is wanted and the detail finds nothing that it shows.
Result<void> check_page(const std::string& page, Detail detail) {
  if (page.empty() || has_contacts(detail)) return {};
  return Error{
      std::string("--page shows contacts: it needs --detail contact, manifold or regions, not ") +
      name_of(detail)};
}

Result<RunSettings> read_settings(const RunOptions& options) {
  if (Result<void> threads = check_threads(options.engine.threads); !threads) {
    return threads.error();
  }
  Result<RunSettings> settings = options.world.read();
  if (!settings) return settings;
  if (settings->world.pair_order == PairOrder::any && !options.pairs_out.empty()) {
    return Error{"--pairs-out writes sorted pairs: it cannot be used with --pair-order any"};
  }
  Result<void> page = check_page(options.page, settings->world.detail);
  return page ? settings : page.error();
}

struct Outputs {
  JsonOutput json;
  std::optional<PairsOutput> pairs;
  std::optional<ScenePage> page;
};

Result<Outputs> open_outputs(const RunOptions& options) {
  Result<void> apart = check_apart(std::array<NamedFile, 4>{{{"the scene", options.scene},
                                                             {"--json", options.json},
                                                             {"--pairs-out", options.pairs_out},
                                                             {"--page", options.page}}});
  if (!apart) return apart.error();
  Outputs outputs;
  Result<JsonOutput> json = JsonOutput::open(options.json);
  if (!json) return json.error();
  outputs.json = std::move(*json);
  if (!options.pairs_out.empty()) {
    Result<PairsOutput> pairs = PairsOutput::create(options.pairs_out);
    if (!pairs) return pairs.error();
    outputs.pairs.emplace(std::move(*pairs));
  }
  if (!options.page.empty()) {
    Result<ScenePage> page = ScenePage::create(options.page);
    if (!page) return page.error();
    outputs.page.emplace(std::move(*page));
  }
  return outputs;
}

// Fails if the detection needs velocities and the scene has none.
Result<void> check_velocities(const io::SceneInfo& info, const std::string& scene,
                              Detection detection) {
  if (detection == Detection::discrete) return {};
  if (info.has_linear_velocity || info.has_angular_velocity) return {};
  return Error{scene + ": has no velocities: --detection " + name_of(detection) + " needs them"};
}

Result<RunReport> run_scene(const RunOptions& options, RunSettings settings, Outputs& outputs,
                            const Console& console) {
  Result<std::unique_ptr<io::SceneReader>> scene = open_source(options.scene);
  if (!scene) return scene.error();
  const io::SceneInfo& info = (*scene)->info();
  Result<Player> player = Player::create(info, options.scene);
  if (!player) return player.error();
  if (Result<void> known = check_velocities(info, options.scene, settings.detection); !known) {
    return known.error();
  }
  std::vector<LadderReport> ladders;
  if (settings.world.accuracy.tolerance > 0) {
    const double most = error_within(settings.world.accuracy.tolerance);
    Result<std::vector<LadderReport>> built = player->add_ladders({&most, 1});
    if (!built) return built.error();
    ladders = std::move(*built);
  }
  const bool looks_ahead = settings.detection != Detection::discrete;
  (*scene)->want(player->wanted(settings.world.detail, looks_ahead));

  ThreadArena arena(options.engine.threads);
  settings.world.positions = player->positions();
  settings.world.parallelism = arena.parallelism();
  settings.world.dt = info.dt;
  World world(settings.world);
  RunReport report{.scene = options.scene,
                   .bodies = info.bodies,
                   .frames = options.frames ? options.frames : info.frames,
                   .threads = options.engine.threads,
                   .isa = name(active_isa()),
                   .settings = settings,
                   .pair_kinds = pair_kinds(player->bodies_of_kind()),
                   .ladders = std::move(ladders),
                   .memory = {},
                   .record = {}};
  Progress progress(console, "frame", report.frames);
  MotionTrack track(info.bodies, report.frames);
  std::optional<Error> failure;
  arena.run([&] {
    auto record = replay(**scene, *player, world, report.frames, outputs.pairs, progress,
                         settings.detection, outputs.page ? &track : nullptr);
    if (record) {
      report.record = std::move(*record);
    } else {
      failure = record.error();
    }
  });
  if (failure) return *failure;
  report.memory = world.memory();
  report.peak_rss_bytes = peak_rss_bytes();
  if (outputs.page) {
    Result<void> added =
        outputs.page->add_frame(world, report.scene, report.frames - 1, track, info.dt);
    if (!added) return added.error();
  }
  return report;
}

void warn_of_quarantined(const std::vector<uint32_t>& bodies, const Console& console) {
  constexpr size_t kNamed = 5;
  if (bodies.empty()) return;
  std::string text = std::to_string(bodies.size()) +
                     (bodies.size() == 1 ? " body was" : " bodies were") +
                     " left out of at least one frame (NaN, infinite or negative size):";
  for (size_t i = 0; i < bodies.size() && i < kNamed; ++i) {
    text += (i ? ", " : " ") + std::to_string(bodies[i]);
  }
  console.warning(text + (bodies.size() > kNamed ? ", ..." : ""));
}

// Finishes all outputs except the JSON, which is complete when it is written.
Result<void> finish(Outputs& outputs) {
  if (outputs.pairs) {
    if (Result<void> finished = outputs.pairs->finish(); !finished) return finished;
  }
  return outputs.page ? outputs.page->finish() : Result<void>();
}

Result<int> run(const RunOptions& options, const Console& console) {
  Result<RunSettings> settings = read_settings(options);
  if (!settings) return settings.error();
  Result<ForcedIsa> isa = ForcedIsa::create(options.engine.isa);
  if (!isa) return isa.error();
  Result<Outputs> outputs = open_outputs(options);
  if (!outputs) return outputs.error();

  Result<RunReport> report = run_scene(options, *settings, *outputs, console);
  if (!report) return report.error();
  warn_of_quarantined(report->record.quarantined_bodies, console);
  if (Result<void> finished = finish(*outputs); !finished) return finished.error();
  Result<void> written = write_report(*report, options.world, outputs->json, console);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_run_command(CommandLine& program) {
  auto options = std::make_shared<RunOptions>();
  Command command = program.add_command("run", "Replay a scene and measure it");
  command.add_option("SCENE", options->scene, "A .npz or .aabb file, or a generator").required();
  command.add_option("--frames", options->frames, "Frames to run; all of the scene if not given")
      .between(uint64_t{1}, uint64_t{1'000'000'000});
  add_engine_options(command, options->engine);
  options->world.add_to(command);
  add_json_option(command, options->json);
  command.add_option("--pairs-out", options->pairs_out, "Write the pairs of every frame (.npz)")
      .file_name();
  command
      .add_option(
          "--page", options->page,
          "Write a page that plays the frames in 3D and shows the last one's contacts (.html)")
      .file_name();
  command.run([options](const Console& console) { return run(*options, console); });
}

}  // namespace carom::cli
