// carom run: its report, and that results do not depend on how it runs.
#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "carom/reference/reference.h"
#include "carom/simd/isa.h"
#include "cli/run/replay.h"
#include "cli/scenes/scene_source.h"
#include "io/files/npz.h"
#include "io/recording.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using nlohmann::json;
using RunTest = CliTest;

json run_json(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = run_command(arguments);
  EXPECT_EQ(result.code, 0) << result.err;
  return result.json();
}

TEST_F(RunTest, JsonHasTheKeysOfTheContract) {
  const json report = run_json({"brownian:n=300,frames=4,density=0.5,shape=sphere"});
  for (const char* key : {"scene", "bodies", "frames", "threads", "isa", "tier", "detail",
                          "broadphase", "pipeline", "frame_ms", "stage_ms", "pairs_per_frame",
                          "contacts_per_frame", "state_hash", "bytes_per_body", "peak_rss_bytes"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["bodies"], 300);
  EXPECT_EQ(report["frames"], 4);
  EXPECT_EQ(report["threads"], 1);
  EXPECT_EQ(report["isa"], name(active_isa()));
  EXPECT_EQ(report["tier"], "standard");
  EXPECT_EQ(report["detail"], "contact");
  EXPECT_NE(report["broadphase"], "auto");
  for (const char* key : {"median", "min", "p99", "mean"}) {
    EXPECT_GT(report["frame_ms"][key], 0) << key;
  }
  EXPECT_EQ(report["pairs_per_frame"].size(), 4u);
  EXPECT_EQ(report["contacts_per_frame"].size(), 4u);
  EXPECT_GT(report["contacts_per_frame"][0], 0);
  EXPECT_GE(report["pairs_per_frame"][0], report["contacts_per_frame"][0]);
  EXPECT_EQ(report["events_per_frame"]["begin"][0], report["contacts_per_frame"][0]);
  EXPECT_EQ(report["state_hash"].get<std::string>().size(), 16u);
  EXPECT_GT(report["bytes_per_body"], 0);
  EXPECT_GT(report["peak_rss_bytes"], 1 << 20);
  for (const json& stage : report["pipeline"]) EXPECT_TRUE(report["stage_ms"].contains(stage));
}

TEST_F(RunTest, PipelineHoldsOnlyWhatTheDetailNeeds) {
  const auto stages = [](const char* detail) {
    const json report = run_json({"brownian:n=200,frames=3,density=0.5", "--detail", detail});
    return report["pipeline"].get<std::set<std::string>>();
  };
  EXPECT_TRUE(stages("contact").count("results"));
  EXPECT_TRUE(stages("contact").count("velocities"));
  EXPECT_EQ(stages("manifold"), stages("contact"));
  EXPECT_TRUE(stages("overlap").count("narrowphase"));
  EXPECT_FALSE(stages("overlap").count("velocities"));
  EXPECT_FALSE(stages("pairs").count("narrowphase"));
}

uint64_t sum_of(const json& list) {
  uint64_t sum = 0;
  for (const json& item : list) sum += item.get<uint64_t>();
  return sum;
}

TEST_F(RunTest, ScenesOfAllKindsDoNotDependOnHowTheyAreRun) {
  for (const char* positions : {"float32", "float64"}) {
    write_builtin(std::string("all kinds, ") + positions, path("scene.npz"));
    const auto hash_with = [&](std::vector<std::string> options) {
      options.insert(options.begin(), {path("scene.npz"), "--detail", "manifold"});
      return run_json(options)["state_hash"].get<std::string>();
    };
    const std::string hash = hash_with({});
    for (const Isa isa : usable_isas()) {
      for (const char* threads : {"1", "3"}) {
        EXPECT_EQ(hash_with({"--isa", name(isa), "--threads", threads}), hash) << name(isa);
      }
    }
    EXPECT_EQ(hash_with({"--no-cache"}), hash);
    EXPECT_EQ(hash_with({"--broadphase", "brute"}), hash);
    EXPECT_EQ(hash_with({"--broadphase", "sweep"}), hash);
  }
}

TEST_F(RunTest, Tiers) {
  const std::string scene = "brownian:n=300,frames=6,density=0.5,shape=box,speed=0.01,spin=0.2";
  const json standard = run_json({scene});
  for (const char* key : {"tolerance", "undecided_per_frame", "share_not_tested"}) {
    EXPECT_FALSE(standard.contains(key)) << key;
  }
  const json fast = run_json({scene, "--tier", "fast", "--tolerance", "0"});
  EXPECT_EQ(fast["tier"], "fast");
  EXPECT_FALSE(fast.contains("tolerance"));
  EXPECT_EQ(fast["pairs_per_frame"], standard["pairs_per_frame"]);

  const json lazy = run_json({scene, "--tolerance", "0.125"});
  EXPECT_EQ(lazy["tier"], "standard");
  EXPECT_EQ(lazy["tolerance"], 0.125);
  EXPECT_GE(sum_of(lazy["pairs_per_frame"]), sum_of(standard["pairs_per_frame"]));
  EXPECT_EQ(sum_of(standard["kept_pairs_per_frame"]), 0u);
  EXPECT_GT(sum_of(lazy["kept_pairs_per_frame"]), sum_of(lazy["tested_pairs_per_frame"]));
  EXPECT_GT(lazy["share_not_tested"], 0.5);
  EXPECT_LE(lazy["share_not_tested"], 1);

  for (const char* bad : {"-1", "nan", "inf", "1e39"}) {
    const CommandResult refused = run_command({"run", scene, "--tolerance", bad});
    EXPECT_EQ(refused.code, 1) << bad;
    EXPECT_NE(refused.err.find("--tolerance"), std::string::npos) << refused.err;
  }
  const CommandResult proven = run_command({"run", scene, "--tier", "exact", "--tolerance", "0.1"});
  EXPECT_EQ(proven.code, 1);
  EXPECT_NE(proven.err.find("not with --tier exact"), std::string::npos) << proven.err;
  EXPECT_EQ(run_command({"run", scene, "--tolerance", "x"}).code, 2);

  const json certified = run_json({scene, "--tier", "certified"});
  EXPECT_EQ(certified["undecided_per_frame"].size(), 6u);
  const json exact = run_json({scene, "--tier", "exact"});
  EXPECT_EQ(exact["tier"], "exact");
  EXPECT_FALSE(exact.contains("undecided_per_frame"));
}

TEST_F(RunTest, TheTableNamesTierAndTolerance) {
  const std::string scene = "brownian:n=50,frames=2";
  EXPECT_EQ(run_command({"run", scene}).out.find("tier"), std::string::npos);
  const CommandResult fast = run_command({"run", scene, "--tier", "fast", "--tolerance", "0.01"});
  EXPECT_NE(fast.out.find("fast, within 0.01 m"), std::string::npos);
  const CommandResult certified = run_command({"run", scene, "--tier", "certified"});
  EXPECT_NE(certified.out.find("undecided"), std::string::npos);
}

TEST_F(RunTest, DopBoundsDropTestsAlone) {
  write_builtin("all kinds, float32", path("scene.npz"));
  const json plain = run_json({path("scene.npz"), "--detail", "manifold"});
  EXPECT_EQ(plain["dop_bounds"], 0);
  // Without k-DOPs the hulls of its meshes and compounds are looked at.
  const auto apart = sum_of(plain["dropped_pairs_per_frame"]);
  uint64_t last = 0;
  for (const char* directions : {"6", "14", "26"}) {
    const json tight =
        run_json({path("scene.npz"), "--detail", "manifold", "--dop-bounds", directions});
    EXPECT_EQ(std::to_string(tight["dop_bounds"].get<int>()), directions);
    EXPECT_EQ(tight["state_hash"], plain["state_hash"]);
    EXPECT_EQ(tight["pairs_per_frame"], plain["pairs_per_frame"]);
    const auto dropped = sum_of(tight["dropped_pairs_per_frame"]);
    EXPECT_EQ(sum_of(tight["tested_pairs_per_frame"]) + dropped,
              sum_of(plain["tested_pairs_per_frame"]) + apart);
    if (std::string(directions) == "6") {
      EXPECT_EQ(dropped, apart);
      continue;
    }
    EXPECT_TRUE(tight["stage_ms"].contains("dops"));
    EXPECT_GT(dropped, last);
    last = dropped;
  }
  const json simple = run_json({"brownian:n=50,frames=3,shape=hull"});
  EXPECT_FALSE(simple["stage_ms"].contains("dops"));
}

TEST_F(RunTest, DetailsAgreeForAllKinds) {
  write_builtin("all kinds, float32", path("scene.npz"));
  const json manifold = run_json({path("scene.npz"), "--detail", "manifold"});
  EXPECT_EQ(manifold["detail"], "manifold");
  const json contact = run_json({path("scene.npz")});
  const json overlap = run_json({path("scene.npz"), "--detail", "overlap"});
  EXPECT_EQ(manifold["contacts_per_frame"], contact["contacts_per_frame"]);
  EXPECT_EQ(manifold["events_per_frame"], contact["events_per_frame"]);
  EXPECT_EQ(manifold["events_per_frame"], overlap["events_per_frame"]);
  EXPECT_EQ(manifold["pairs_per_frame"], overlap["pairs_per_frame"]);
  EXPECT_NE(manifold["state_hash"], contact["state_hash"]);
}

TEST_F(RunTest, PairKindsAreThoseOfTheBodies) {
  EXPECT_EQ(run_json({"still:n=9,frames=1,shape=sphere"})["pair_kinds"],
            json::array({"sphere-sphere"}));
  EXPECT_EQ(run_json({"still:n=1,frames=1"})["pair_kinds"], json::array());
  write_builtin("spheres and aabbs, float32", path("scene.npz"));
  EXPECT_EQ(run_json({path("scene.npz")})["pair_kinds"],
            json::array({"sphere-sphere", "sphere-aabb", "aabb-aabb"}));
}

// A ball beside a box that turns by 45 degrees and back.
TEST_F(RunTest, BodiesTurnFromFrameToFrame) {
  io::SceneInfo info;
  info.bodies = 2;
  info.has_orientation = true;
  info.shapes.kind = {0, 3};
  info.shapes.params = {{0.25f}, {1, 1, 1}};
  info.body_shape = {0, 1};
  auto writer = io::SceneWriter::create(path("scene.npz"), info);
  ASSERT_TRUE(writer) << writer.error().message;
  for (const float turn : {0.0f, 0.41421356f, 0.0f, -0.41421356f}) {
    io::SceneFrame frame;
    frame.position32 = {1.5f, 0, 0, 0, 0, 0};
    frame.orientation = {0, 0, 0, 1, 0, 0, turn, 1};
    ASSERT_TRUE(writer->write_frame(frame));
  }
  ASSERT_TRUE(writer->finish());
  const json report = run_json({path("scene.npz"), "--frames", "6"});
  EXPECT_EQ(report["contacts_per_frame"].get<std::vector<int>>(),
            (std::vector<int>{0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(report["pair_kinds"], json::array({"sphere-box"}));
}

// Four balls that all overlap; the filters of the file part some.
TEST_F(RunTest, ExcludedPairsAndSpacesOfAFile) {
  const auto pairs_with = [&](const std::function<void(io::SceneInfo&)>& change) {
    io::SceneInfo info;
    info.bodies = 4;
    info.shapes.kind = {0};
    info.shapes.params = {{1}};
    info.body_shape = {0, 0, 0, 0};
    change(info);
    auto writer = io::SceneWriter::create(path("filtered.npz"), info);
    EXPECT_TRUE(writer) << writer.error().message;
    io::SceneFrame frame;
    frame.position32.resize(12);
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(writer->write_frame(frame));
    EXPECT_TRUE(writer->finish());
    EXPECT_EQ(run_command({"verify", path("filtered.npz")}).code, 0);
    EXPECT_EQ(run_json({path("filtered.npz"), "--detail", "pairs"})["pairs_per_frame"],
              run_json({path("filtered.npz")})["contacts_per_frame"]);
    return run_json({path("filtered.npz")})["pairs_per_frame"][1].get<int>();
  };
  EXPECT_EQ(pairs_with([](io::SceneInfo&) {}), 6);
  EXPECT_EQ(pairs_with([](io::SceneInfo& i) { i.excluded_pairs = {{2, 3}, {0, 1}, {2, 3}}; }), 4);
  EXPECT_EQ(pairs_with([](io::SceneInfo& i) { i.space = {7, 0, 7, 0}; }), 2);
  EXPECT_EQ(pairs_with([](io::SceneInfo& i) {
              i.space = {7, 0, 7, 0};
              i.excluded_pairs = {{0, 2}};
            }),
            1);
}

TEST_F(RunTest, DetailsAgree) {
  const std::string scene = "brownian:n=400,frames=4,density=0.5,shape=sphere";
  const json contact = run_json({scene});
  const json overlap = run_json({scene, "--detail", "overlap"});
  const json pairs = run_json({scene, "--detail", "pairs"});
  EXPECT_EQ(contact["pairs_per_frame"], pairs["pairs_per_frame"]);
  EXPECT_EQ(contact["pairs_per_frame"], overlap["pairs_per_frame"]);
  EXPECT_EQ(contact["contacts_per_frame"], overlap["contacts_per_frame"]);
  EXPECT_TRUE(pairs["contacts_per_frame"].empty());
}

TEST_F(RunTest, HashDoesNotDependOnHowTheSceneIsRun) {
  for (const std::string& scene :
       {std::string("brownian:n=700,frames=6,density=0.5,shape=sphere"),
        std::string("static:n=1000,frames=6,motion=static,positions=float64")}) {
    const std::string hash = run_json({scene})["state_hash"];
    for (const Isa isa : usable_isas()) {
      for (const char* threads : {"1", "2", "3"}) {
        const json report = run_json({scene, "--isa", name(isa), "--threads", threads});
        EXPECT_EQ(report["state_hash"], hash) << scene << ' ' << name(isa) << ' ' << threads;
        EXPECT_EQ(report["isa"], name(isa));
      }
    }
    EXPECT_EQ(run_json({scene, "--no-cache"})["state_hash"], hash);
    EXPECT_EQ(run_json({scene, "--broadphase", "brute"})["state_hash"], hash);
    EXPECT_EQ(run_json({scene, "--broadphase", "sweep"})["state_hash"], hash);
    EXPECT_NE(run_json({scene + ",seed=2"})["state_hash"], hash);
  }
}

TEST_F(RunTest, PairsInAnyOrderAreTheSamePairs) {
  const std::vector<std::string> run = {"brownian:n=3000,frames=3", "--detail", "pairs"};
  const auto with_order = [&](const char* order) {
    std::vector<std::string> arguments = run;
    arguments.insert(arguments.end(), {"--pair-order", order});
    return run_json(arguments);
  };
  const json sorted = run_json(run), any = with_order("any");
  EXPECT_EQ(sorted["pair_order"], "sorted");
  EXPECT_EQ(any["pair_order"], "any");
  EXPECT_EQ(any["pairs_per_frame"], sorted["pairs_per_frame"]);
  EXPECT_NE(any["state_hash"], sorted["state_hash"]);
  EXPECT_EQ(with_order("sorted")["state_hash"], sorted["state_hash"]);
  const auto error_of = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", "brownian:n=30"});
    const CommandResult result = run_command(arguments);
    EXPECT_NE(result.code, 0);
    return result.err;
  };
  EXPECT_NE(error_of({"--pair-order", "any"}).find("needs --detail pairs"), std::string::npos);
  EXPECT_NE(error_of({"--detail", "pairs", "--pair-order", "none"}).find("pair order"),
            std::string::npos);
  EXPECT_NE(error_of({"--detail", "pairs", "--pair-order", "any", "--pairs-out", path("p.npz")})
                .find("writes sorted pairs"),
            std::string::npos);
}

// With a margin there are more candidate pairs and fewer searched bodies; overlaps stay the same.
TEST_F(RunTest, MarginsChangeTheCandidatesAlone) {
  const std::string scene = "brownian:n=1500,frames=30,density=0.2,shape=sphere,speed=0.3";
  const json exact = run_json({scene});
  const json fat = run_json({scene, "--margin", "0.2"});
  EXPECT_EQ(exact["margin"], 0);
  EXPECT_FLOAT_EQ(fat["margin"].get<float>(), 0.2f);
  EXPECT_FALSE(exact["stage_ms"].contains("margins"));
  EXPECT_TRUE(fat["stage_ms"].contains("margins"));
  EXPECT_EQ(fat["contacts_per_frame"], exact["contacts_per_frame"]);
  EXPECT_EQ(fat["events_per_frame"], exact["events_per_frame"]);
  EXPECT_GT(fat["pairs_per_frame"][29], exact["pairs_per_frame"][29]);
  EXPECT_LT(sum_of(fat["searched_bodies_per_frame"]), sum_of(exact["searched_bodies_per_frame"]));
}

TEST_F(RunTest, MemoryIsAccounted) {
  const json report = run_json({"brownian:n=3000,frames=3,density=0.5"});
  size_t sum = 0;
  for (const char* part : {"bodies", "bounds", "broadphase", "pairs_and_results"}) {
    EXPECT_GT(report["memory"][part], 0) << part;
    sum += report["memory"][part].get<size_t>();
  }
  EXPECT_DOUBLE_EQ(report["bytes_per_body"], static_cast<double>(sum) / 3000);
  EXPECT_DOUBLE_EQ(report["broadphase_bytes_per_body"],
                   report["memory"]["broadphase"].get<double>() / 3000);
  EXPECT_DOUBLE_EQ(report["bytes_per_pair"], report["memory"]["pairs_and_results"].get<double>() /
                                                 report["pairs_per_frame"][2].get<double>());
}

TEST_F(RunTest, NoPairsNoBytesAPair) {
  EXPECT_EQ(run_json({"still:n=1,frames=2"})["bytes_per_pair"], 0);
}

TEST_F(RunTest, StillScenesSearchNothingAtAnyDetail) {
  for (const char* detail : {"pairs", "overlap", "contact", "manifold"}) {
    const json report = run_json({"still:n=2000,frames=20", "--detail", detail});
    EXPECT_EQ(report["searched_bodies_per_frame"].back(), 0) << detail;
    EXPECT_EQ(report["stage_ms"]["broadphase"], 0) << detail;
  }
}

TEST_F(RunTest, MorePairsThanTheWorldMayFindAreAnError) {
  auto scene = open_source("brownian:n=50,frames=3,density=1000");
  ASSERT_TRUE(scene);
  auto player = Player::create((*scene)->info(), "heap");
  ASSERT_TRUE(player);
  (*scene)->want(player->wanted(Detail::pairs));
  World world({.detail = Detail::pairs, .most_pairs = 10});
  std::ostringstream out, err;
  Console console{out, err};
  Progress progress(console, "frame", 3);
  std::optional<PairsOutput> pairs_out;
  const auto record = replay(**scene, *player, world, 3, pairs_out, progress);
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("frame 0 has"), std::string::npos);
  EXPECT_NE(record.error().message.find("the limit of 10"), std::string::npos);
}

TEST_F(RunTest, ForcedIsaEndsWithTheCommand) {
  const Isa before = active_isa();
  run_json({"still:n=10,frames=1", "--isa", "scalar"});
  EXPECT_EQ(active_isa(), before);
}

TEST_F(RunTest, FramesWrapToTheFirst) {
  const json once = run_json({"brownian:n=300,frames=3,density=0.5"});
  const json twice = run_json({"brownian:n=300,frames=3,density=0.5", "--frames", "7"});
  const std::vector<int> pairs = once["pairs_per_frame"];
  const std::vector<int> expected = {pairs[0], pairs[1], pairs[2], pairs[0],
                                     pairs[1], pairs[2], pairs[0]};
  EXPECT_EQ(twice["frames"], 7);
  EXPECT_EQ(twice["pairs_per_frame"].get<std::vector<int>>(), expected);
  EXPECT_EQ(run_json({"brownian:n=300,frames=3", "--frames", "2"})["frames"], 2);
}

TEST_F(RunTest, StillScenesKeepAllResults) {
  const json report = run_json({"still:n=500,frames=4,density=0.5,shape=sphere"});
  const std::vector<int> pairs = report["pairs_per_frame"];
  EXPECT_EQ(report["kept_pairs_per_frame"].get<std::vector<int>>(),
            (std::vector<int>{0, pairs[1], pairs[2], pairs[3]}));
  const json anew = run_json({"still:n=500,frames=4,density=0.5,shape=sphere", "--no-cache"});
  EXPECT_EQ(anew["kept_pairs_per_frame"].get<std::vector<int>>(), (std::vector<int>(4, 0)));
  EXPECT_EQ(anew["tested_pairs_per_frame"], anew["pairs_per_frame"]);
}

// All pairs of bounds, by brute force with the reference's functions.
std::vector<Pair> brute_pairs(const io::SceneInfo& info, const io::SceneFrame& frame) {
  std::vector<reference::Box> boxes;
  for (size_t i = 0; i < info.bodies; ++i) {
    const std::array<float, 8>& params = info.shapes.params[info.body_shape[i]];
    boxes.push_back(reference::bounds(
        Aabb::from_half_extents({params[0], params[1], params[2]}),
        {.position = Eigen::Map<const Eigen::Vector3f>(&frame.position32[3 * i]).cast<double>()},
        PositionType::float32));
  }
  std::vector<Pair> pairs;
  for (uint32_t a = 0; a < boxes.size(); ++a) {
    for (uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (reference::overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST_F(RunTest, PairsOutHoldsThePairsOfEveryFrame) {
  const std::string spec = "brownian:n=300,frames=4,density=0.4";
  const CommandResult result = run_command({"run", spec, "--pairs-out", path("out.npz")});
  ASSERT_EQ(result.code, 0) << result.err;
  auto reader = io::NpzReader::open(path("out.npz"));
  ASSERT_TRUE(reader) << reader.error().message;
  const auto pairs = reader->read<std::array<uint32_t, 2>>("pairs", {io::kAny});
  const auto first = reader->read<uint64_t>("frame_first", {5});
  ASSERT_TRUE(pairs && first);
  ASSERT_EQ(first->back(), pairs->size());

  auto scene = open_source(spec);
  ASSERT_TRUE(scene);
  io::SceneFrame frame;
  for (size_t f = 0; f < 4; ++f) {
    ASSERT_TRUE((*scene)->read_frame(frame));
    const std::vector<Pair> expected = brute_pairs((*scene)->info(), frame);
    ASSERT_EQ((*first)[f + 1] - (*first)[f], expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ((*pairs)[(*first)[f] + i], (std::array{expected[i].a, expected[i].b}));
    }
  }
}

TEST_F(RunTest, BodiesThatAreLeftOutAreNamed) {
  auto writer = io::RecordingWriter::create(path("bad.aabb"), "bad", "Cubes", 4);
  ASSERT_TRUE(writer);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int frame = 0; frame < 3; ++frame) {
    const float x = frame == 1 ? nan : 0;
    const std::vector<float> boxes = {0, 0, 0, 0, 1, 1, 1, 0,   //
                                      x, 0, 0, 0, 1, 1, 1, 0,   //
                                      1, 1, 1, 0, 2, 2, 2, 0,   //
                                      5, 5, 5, 0, 4, 6, 6, 0};  // min > max
    ASSERT_TRUE(writer->write_frame(boxes));
  }
  ASSERT_TRUE(writer->finish());
  const CommandResult result = run_command({"run", path("bad.aabb"), "--json", "-"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err,
            "carom: warning: 2 bodies were left out of at least one frame (NaN, infinite or "
            "negative size): 1, 3\n");
  const json report = result.json();
  EXPECT_EQ(report["pairs_per_frame"].get<std::vector<int>>(), (std::vector<int>{3, 1, 3}));
  EXPECT_EQ(report["quarantined_per_frame"].get<std::vector<int>>(), (std::vector<int>{1, 2, 1}));
}

TEST_F(RunTest, SettlingHasTheExactNumberOfOverlaps) {
  const json report = run_json({test_data("settling.npz")});
  const json expected = read_json(test_data("settling.expected.json"));
  EXPECT_EQ(report["contacts_per_frame"], expected["overlaps_per_frame"]);
}

TEST_F(RunTest, PrintsATableWithoutJson) {
  const CommandResult result = run_command({"run", "brownian:n=100,frames=3"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* word : {"brownian:n=100,frames=3", "median", "broadphase", "state hash"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word;
  }
}

TEST_F(RunTest, JsonGoesToAFile) {
  const CommandResult result =
      run_command({"run", "still:n=10,frames=2", "--json", path("out.json")});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(read_json(path("out.json"))["bodies"], 10);
}

}  // namespace
}  // namespace carom::cli
