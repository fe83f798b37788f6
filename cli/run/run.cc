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

namespace carom::cli {
namespace {

constexpr NamedDetail kDetails[] = {{"pairs", Detail::pairs},
                                    {"overlap", Detail::overlap},
                                    {"contact", Detail::contact},
                                    {"manifold", Detail::manifold}};

struct RunOptions {
  std::string scene;
  uint64_t frames = 0;  // 0: not given
  EngineOptions engine;
  std::string broadphase = "auto";
  double margin = 0;
  int dop_bounds = 0;  // directions; 0: none
  std::string detection = "discrete";
  bool no_cache = false;
  std::string json;
  std::string pairs_out;
  std::string page;
};

Result<WorldSettings> world_settings(const RunOptions& options) {
  if (Result<void> threads = check_threads(options.engine.threads); !threads) {
    return threads.error();
  }
  Result<Accuracy> accuracy = parse_accuracy(options.engine, KnobsOf::worlds);
  if (!accuracy) return accuracy.error();
  Result<Detail> detail = parse_detail(options.engine.detail, kDetails);
  if (!detail) return detail.error();
  if (!options.page.empty() && !has_contacts(*detail)) {
    return Error{"--page shows contacts: it needs --detail contact or manifold, not " +
                 options.engine.detail};
  }
  Result<BroadphaseMethod> broadphase = parse_broadphase(options.broadphase);
  if (!broadphase) return broadphase.error();
  if (Result<void> margin = check_margin(options.margin); !margin) return margin.error();
  Result<std::optional<DopKind>> dop_bounds = parse_dop_bounds(options.dop_bounds);
  if (!dop_bounds) return dop_bounds.error();
  WorldSettings settings;
  settings.detail = *detail;
  settings.broadphase = *broadphase;
  settings.margin = static_cast<float>(options.margin);
  settings.dop_bounds = *dop_bounds;
  settings.accuracy = *accuracy;
  settings.carry_results = !options.no_cache;
  return settings;
}

struct Outputs {
  JsonOutput json;
  std::optional<PairsOutput> pairs;
  std::optional<ScenePage> page;
};

Result<Outputs> open_outputs(const RunOptions& options) {
  Result<void> apart = check_apart(std::array<OutputFile, 3>{
      {{"--json", options.json}, {"--pairs-out", options.pairs_out}, {"--page", options.page}}});
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
Result<void> check_velocities(const io::SceneInfo& info, const RunOptions& options,
                              Detection detection) {
  if (detection == Detection::discrete) return {};
  if (info.has_linear_velocity || info.has_angular_velocity) return {};
  return Error{options.scene + ": has no velocities: --detection " + options.detection +
               " needs them"};
}

Result<RunReport> run_scene(const RunOptions& options, WorldSettings settings, Outputs& outputs,
                            const Console& console) {
  const Result<Detection> detection = parse_detection(options.detection);
  if (!detection) return detection.error();
  Result<std::unique_ptr<io::SceneReader>> scene = open_source(options.scene);
  if (!scene) return scene.error();
  const io::SceneInfo& info = (*scene)->info();
  Result<Player> player = Player::create(info, options.scene);
  if (!player) return player.error();
  if (Result<void> known = check_velocities(info, options, *detection); !known) {
    return known.error();
  }
  (*scene)->want(player->wanted(settings.detail, *detection != Detection::discrete));

  ThreadArena arena(options.engine.threads);
  settings.positions = player->positions();
  settings.parallelism = arena.parallelism();
  settings.dt = info.dt;
  World world(settings);
  RunReport report{.scene = options.scene,
                   .bodies = info.bodies,
                   .frames = options.frames ? options.frames : info.frames,
                   .threads = options.engine.threads,
                   .isa = name(active_isa()),
                   .tier = options.engine.tier,
                   .accuracy = settings.accuracy,
                   .detail = options.engine.detail,
                   .detection = options.detection,
                   .pair_kinds = pair_kinds(player->bodies_of_kind()),
                   .margin = settings.margin,
                   .dop_bounds = options.dop_bounds,
                   .memory = {},
                   .record = {}};
  Progress progress(console, "frame", report.frames);
  std::optional<Error> failure;
  arena.run([&] {
    auto record =
        replay(**scene, *player, world, report.frames, outputs.pairs, progress, *detection);
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
    Result<void> added = outputs.page->add_frame(world, report.scene, report.frames - 1);
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
  Result<WorldSettings> settings = world_settings(options);
  if (!settings) return settings.error();
  Result<ForcedIsa> isa = ForcedIsa::create(options.engine.isa);
  if (!isa) return isa.error();
  Result<Outputs> outputs = open_outputs(options);
  if (!outputs) return outputs.error();

  Result<RunReport> report = run_scene(options, *settings, *outputs, console);
  if (!report) return report.error();
  warn_of_quarantined(report->record.quarantined_bodies, console);
  if (Result<void> finished = finish(*outputs); !finished) return finished.error();
  Result<void> written = write_report(*report, outputs->json, console);
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
  command.add_option("--detail", options->engine.detail, "pairs, overlap, contact or manifold")
      .show_default();
  command
      .add_option("--motion-tolerance", options->engine.motion_tolerance,
                  "Metres that bodies may move before they are tested again; fast tier only")
      .show_default();
  command.add_option("--broadphase", options->broadphase, "auto, grid, sweep or brute")
      .show_default();
  command
      .add_option("--margin", options->margin, "Metres to fatten bounds by; pairs are kept longer")
      .show_default();
  command
      .add_option("--dop-bounds", options->dop_bounds,
                  "Drop pairs whose k-DOPs of 6, 14, 18 or 26 directions are apart; 0: none")
      .show_default();
  command
      .add_option("--detection", options->detection,
                  "How dynamic bodies are looked after between frames: discrete, swept, continuous "
                  "or automatic")
      .show_default();
  command.add_flag("--no-cache", options->no_cache,
                   "Test every pair anew and drop the sort order between frames");
  add_json_option(command, options->json);
  command.add_option("--pairs-out", options->pairs_out, "Write the pairs of every frame (.npz)")
      .file_name();
  command
      .add_option("--page", options->page,
                  "Write a page that shows the last frame and its contacts in 3D (.html)")
      .file_name();
  command.run([options](const Console& console) { return run(*options, console); });
}

}  // namespace carom::cli
