// carom advise on scenes whose best settings are known.
#include <iterator>
#include <set>
#include <sstream>

#include "cli/advise/advice.h"
#include "io/scene.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using nlohmann::json;
using AdviseTest = CliTest;

json advise_json(const std::string& scene, const std::string& tolerance) {
  const CommandResult result = run_command({"advise", scene, "--tolerance", tolerance, "--frames",
                                            "6", "--threads", "2", "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.err;
  return result.json();
}

// The row of this name in a list of rows; null if there is none.
json row(const json& list, const std::string& key, const std::string& what) {
  for (const json& entry : list) {
    if (entry[key] == what) return entry;
  }
  return nullptr;
}

std::set<std::string> names(const json& list, const std::string& key) {
  std::set<std::string> all;
  for (const json& entry : list) all.insert(entry[key].get<std::string>());
  return all;
}

// Runs the command that the advice names, in this process.
CommandResult run_named_command(const json& advice) {
  std::istringstream words(advice["command"].get<std::string>());
  std::vector<std::string> arguments(std::istream_iterator<std::string>(words), {});
  EXPECT_EQ(arguments.front(), "carom");
  arguments.erase(arguments.begin());
  arguments.insert(arguments.end(), {"--json", "-"});
  return run_command(arguments);
}

TEST_F(AdviseTest, SpheresNeedNeitherOrientationsNorManifolds) {
  const json advice =
      advise_json("brownian:n=400,frames=6,density=0.3,shape=sphere,speed=3", "1e-3");
  const json& survey = advice["survey"];
  EXPECT_EQ(survey["bodies"], 400);
  EXPECT_EQ(survey["frames"], 6);
  EXPECT_EQ(survey["kinds"], json({{"sphere", 400}}));
  EXPECT_DOUBLE_EQ(survey["radius"]["median"], 0.5);
  EXPECT_EQ(survey["aspect"]["max"], 1);
  EXPECT_EQ(survey["moving_share"], 1);
  // The displacement is speed * dt, except in frames in which a body hits a wall.
  EXPECT_LE(survey["displacement"]["max"].get<double>(), 0.1001);
  EXPECT_GT(survey["displacement"]["median"].get<double>(), 0.01);
  EXPECT_EQ(survey["pairs"]["kinds"].size(), 1u);
  EXPECT_EQ(survey["pairs"]["kinds"][0]["pair"], "sphere-sphere");
  EXPECT_GT(survey["pairs"]["overlapping_share"].get<double>(), 0.1);
  EXPECT_LT(survey["pairs"]["overlapping_share"].get<double>(), 0.9);

  const auto not_needed = names(advice["not_needed"], "what");
  for (const char* what : {"orientations", "manifolds", "cache", "filters", "sensors"}) {
    EXPECT_EQ(not_needed.count(what), 1u) << what;
  }
  const auto tried = names(advice["trials"], "settings");
  for (const char* what :
       {"standard", "no cache", "2 threads", "tolerance 0.001", "certified", "exact"}) {
    EXPECT_EQ(tried.count(what), 1u) << what;
  }
}

TEST_F(AdviseTest, SettingsWithoutLossAreWithoutLoss) {
  const json advice = advise_json("brownian:n=600,frames=6,density=0.3,shape=box,speed=1", "1e-3");
  size_t compared = 0;
  for (const char* lossless : {"no cache", "broadphase sweep", "broadphase grid",
                               "broadphase brute", "14-DOPs as bounds", "2 threads"}) {
    const json tried = row(advice["trials"], "settings", lossless);
    if (tried.is_null() || !tried["tried"]) continue;
    ++compared;
    EXPECT_EQ(tried["lost"], 0) << lossless;
    EXPECT_EQ(tried["gained"], 0) << lossless;
    EXPECT_EQ(tried["error_worst"], 0) << lossless;
    EXPECT_EQ(tried["events_moved"], 0) << lossless;
  }
  EXPECT_GE(compared, 4u);
}

TEST_F(AdviseTest, WhatIsChosenMeetsTheTolerance) {
  for (const char* tolerance : {"1e-6", "0.01", "10"}) {
    const json advice =
        advise_json("brownian:n=600,frames=6,density=0.3,shape=box,speed=1", tolerance);
    EXPECT_LE(advice["choice"]["error_worst"].get<double>(), std::stod(tolerance));
    for (const json& tried : advice["trials"]) {
      if (!tried["tried"]) continue;
      EXPECT_EQ(tried["meets"].get<bool>(),
                tried["error_worst"].get<double>() <= std::stod(tolerance))
          << tried["settings"];
    }
    EXPECT_LE(advice["measured_error"], advice["guaranteed_error"]);
    EXPECT_LE(
        advice["guaranteed_error"].get<double>(),
        std::stod(tolerance) + advice["survey"]["pairs"]["standard_error_bound"].get<double>());
    EXPECT_FALSE(advice.contains("front"));
    EXPECT_EQ(run_named_command(advice).code, 0) << advice["command"];
  }
}

TEST_F(AdviseTest, StillScenesAreTold) {
  const json advice = advise_json("still:n=300,frames=6,density=0.5", "1e-3");
  EXPECT_EQ(advice["survey"]["moving_share"], 0);
  EXPECT_FALSE(row(advice["not_needed"], "what", "margin, tolerance").is_null());
  EXPECT_FALSE(row(advice["not_needed"], "what", "events").is_null());
  EXPECT_EQ(row(advice["settings"], "what", "margin")["reason"], "nothing moves");
  EXPECT_TRUE(row(advice["trials"], "settings", "tolerance 0.001").is_null());
}

TEST_F(AdviseTest, PositionsAreFloatsWhereTheyCanBe) {
  const auto positions_of = [&](const std::vector<double>& x, const std::string& tolerance) {
    io::SceneInfo info;
    info.bodies = x.size();
    info.float64_positions = true;
    info.shapes.kind = {0};
    info.shapes.params = {{1}};
    info.body_shape.assign(x.size(), 0);
    auto writer = io::SceneWriter::create(path("scene.npz"), info);
    EXPECT_TRUE(writer);
    io::SceneFrame frame;
    for (const double coordinate : x) {
      frame.position64.insert(frame.position64.end(), {coordinate, 0, 0});
    }
    EXPECT_TRUE(writer->write_frame(frame));
    EXPECT_TRUE(writer->finish());
    return row(advise_json(path("scene.npz"), tolerance)["settings"], "what", "positions")["value"];
  };
  EXPECT_EQ(positions_of({0, 1.5, 1e6}, "1e-6"), "float32");
  EXPECT_EQ(positions_of({0, 1.1, 1e6}, "1e-6"), "float64");
  EXPECT_EQ(positions_of({0, 1.1, 1e6}, "1"), "float32");
}

TEST_F(AdviseTest, PrintsATableAndTheCommand) {
  const CommandResult result = run_command(
      {"advise", "brownian:n=200,frames=4,density=0.3", "--tolerance", "0.001", "--frames", "4"});
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"near touching", "tried", "meets", "broadphase", "Not needed here",
                           " of the time at tolerance 0", " m seen"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(result.out.find("carom run brownian:n=200,frames=4,density=0.3"), 0u);
}

// Errors and times of the front: guaranteed errors ascend, times descend, and none is exceeded.
TEST_F(AdviseTest, TheFrontHasWhatNothingBeats) {
  const std::string scene = "brownian:n=600,frames=8,density=0.3,shape=box,speed=0.01,spin=0.01";
  const CommandResult result = run_command(
      {"advise", scene, "--tolerance", "0.001", "--frames", "8", "--front", "--json", "-"});
  ASSERT_EQ(result.code, 0) << result.err;
  const json front = json::parse(result.out)["front"];
  ASSERT_GE(front.size(), 2u);
  EXPECT_EQ(front[0]["tolerance"], 0);
  for (size_t i = 0; i < front.size(); ++i) {
    EXPECT_LE(front[i]["measured_error"], front[i]["guaranteed_error"]);
    EXPECT_GE(front[i]["guaranteed_error"], front[i]["tolerance"]);
    EXPECT_EQ(front[i]["settings"].get<std::string>().find("--tolerance "), 0u);
    if (i == 0) continue;
    EXPECT_GT(front[i]["guaranteed_error"], front[i - 1]["guaranteed_error"]);
    EXPECT_LT(front[i]["frame_ms"], front[i - 1]["frame_ms"]);
  }
  const CommandResult text =
      run_command({"advise", scene, "--tolerance", "0.001", "--frames", "8", "--front"});
  EXPECT_NE(text.out.find("guaranteed, m"), std::string::npos);
  EXPECT_NE(text.out.find("* guaranteed, o measured"), std::string::npos);
}

TEST_F(AdviseTest, JsonGoesToAFile) {
  const CommandResult result =
      run_command({"advise", "brownian:n=100,frames=4,density=0.3", "--tolerance", "0.001",
                   "--frames", "2", "--json", path("advice.json")});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(read_json(path("advice.json"))["tolerance"], 0.001);
}

TEST_F(AdviseTest, ScenesOfOneFrameOrWithoutPairsAreNoTrouble) {
  for (const char* scene : {"still:n=1,frames=1", "still:n=2,frames=1,density=1e-6",
                            "brownian:n=50,frames=1,density=0.5"}) {
    const json advice = advise_json(scene, "1e-3");
    EXPECT_EQ(advice["survey"]["frames"], 1) << scene;
    EXPECT_EQ(run_named_command(advice).code, 0) << scene;
  }
}

TEST_F(AdviseTest, ErrorsAreOneLine) {
  expect_error({"advise", "brownian:n=10", "--tolerance", "0"}, {"--tolerance 0", "above 0"});
  expect_error({"advise", "brownian:n=10", "--tolerance", "-1"}, {"--tolerance -1"});
  expect_error({"advise", "brownian:n=10", "--tolerance", "inf"}, {"--tolerance inf"});
  expect_error({"advise", "brownian:n=10"}, {"--tolerance"});
  expect_error({"advise", path("none.npz"), "--tolerance", "1"}, {"none.npz"});
  expect_error({"advise", "brownian:n=10", "--tolerance", "1", "--threads", "2000"}, {"--threads"});
  EXPECT_EQ(run_command({"advise", "brownian:n=10", "--tolerance", "x"}).code, 2);
  EXPECT_EQ(run_command({"advise", path("none.npz"), "--tolerance", "1"}).code, 1);
}

TEST(RunCommandText, QuotesWhatAShellWouldTakeApart) {
  accuracy::Trial trial;
  EXPECT_EQ(run_command("a b.npz", trial), "carom run 'a b.npz'");
  EXPECT_EQ(run_command("it's", trial), "carom run 'it'\\''s'");
  trial.threads = 2;
  trial.settings.margin = 0.1f;
  trial.settings.broadphase = BroadphaseMethod::sweep;
  trial.settings.dop_bounds = DopKind::k14;
  trial.settings.carry_results = false;
  trial.settings.accuracy.tier = Tier::fast;
  trial.settings.accuracy.tolerance = 0.005f;
  EXPECT_EQ(run_command("s.npz", trial),
            "carom run s.npz --tier fast --tolerance "
            "0.005 --broadphase sweep --margin 0.1 --dop-bounds 14 --no-cache --threads 2");
}

}  // namespace
}  // namespace carom::cli
