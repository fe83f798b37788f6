// Models as scenes on the command line.
#include <fstream>

#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using ModelsTest = CliTest;

constexpr char kRobot[] = R"(<robot name="r">
  <link name="world"><collision><geometry><box size="9 9 1"/></geometry></collision></link>
  <link name="arm"><collision><geometry><mesh filename="arm.obj" scale="2 2 2"/></geometry></collision></link>
  <link name="hand"><collision><geometry><sphere radius="0.5"/></geometry></collision>
    <collision><origin xyz="0 0 1"/><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="a" type="revolute"><parent link="world"/><child link="arm"/><origin xyz="0 0 0.4"/></joint>
  <joint name="b" type="fixed"><parent link="arm"/><child link="hand"/><origin xyz="0 0 -0.6"/></joint>
</robot>)";

constexpr char kBalls[] = R"(<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1"/>
  <body name="low" pos="0 0 0.5"><freejoint/><geom size="1"/></body>
  <body name="high" pos="0 0 2"><freejoint/><geom size="1"/></body></worldbody></mujoco>)";

class WithModels : public ModelsTest {
 protected:
  WithModels() {
    std::ofstream(path("r.urdf")) << kRobot;
    std::ofstream(path("arm.obj"))
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream(path("m.xml")) << kBalls;
  }
};

TEST_F(WithModels, Run) {
  const auto robot = run_command({"run", path("r.urdf"), "--json", "-"}).json();
  EXPECT_EQ(robot["bodies"], 3);
  // The arm does not meet what it is joined to, and the hand is rigid with it: the hand and the
  // static base are left.
  EXPECT_EQ(robot["pairs_per_frame"], nlohmann::json({1}));
  EXPECT_EQ(robot["contacts_per_frame"], nlohmann::json({1}));
  const auto balls = run_command({"run", path("m.xml"), "--json", "-"}).json();
  EXPECT_EQ(balls["pairs_per_frame"], nlohmann::json({2}));
  EXPECT_EQ(balls["contacts_per_frame"], nlohmann::json({2}));
}

TEST_F(WithModels, Check) {
  const CommandResult result = run_command({"check", path("r.urdf"), "--json", "-"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto shapes = result.json()["shapes"];
  const std::pair<const char*, const char*> expected[] = {
      {"box", "world"}, {"mesh", "arm"}, {"sphere", "hand"}, {"box", "hand"}, {"compound", "hand"}};
  ASSERT_EQ(shapes.size(), std::size(expected));
  for (size_t i = 0; i < shapes.size(); ++i) {
    EXPECT_EQ(shapes[i]["kind"], expected[i].first);
    EXPECT_EQ(shapes[i]["name"], expected[i].second);
    EXPECT_EQ(shapes[i]["valid"], true);
  }
  EXPECT_EQ(shapes[1]["watertight"], true);
  EXPECT_EQ(shapes[1]["inside_out"], false);
}

TEST_F(WithModels, OtherCommandsTakeThem) {
  EXPECT_EQ(run_command({"verify", path("r.urdf"), path("m.xml")}).code, 0);
  EXPECT_EQ(run_command({"advise", path("m.xml"), "--tolerance", "0.001"}).code, 0);
  EXPECT_EQ(run_command({"run", path("m.xml"), "--page", path("page.html")}).code, 0);
}

TEST_F(WithModels, Errors) {
  std::ofstream(path("bad.xml"))
      << "<mujoco>\n<worldbody>\n<geom type='sdf'/></worldbody></mujoco>";
  for (const char* command : {"run", "check", "verify"}) {
    expect_error({command, path("bad.xml")}, {"bad.xml:3: <geom>", "'sdf' is not supported"});
  }
  expect_error({"run", path("none.urdf")}, {"none.urdf"});
  std::ofstream(path("other.xml")) << "<sdf/>";
  expect_error({"run", path("other.xml")}, {"other.xml:1", "a robot or mujoco element"});
}

}  // namespace
}  // namespace carom::cli
