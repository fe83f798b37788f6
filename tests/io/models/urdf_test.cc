// Robots in URDF as scenes.
#include <filesystem>

#include "tests/io/models/model_test_util.h"

namespace carom::io {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Pairs = std::vector<std::array<uint32_t, 2>>;

// A link with this inside its collision.
std::string link(const std::string& name, const std::string& collision) {
  return "<link name='" + name + "'><collision>" + collision + "</collision></link>\n";
}
std::string shape(const std::string& text) { return "<geometry>" + text + "</geometry>"; }
std::string joint(const std::string& parent, const std::string& child,
                  const std::string& origin = "", const std::string& type = "revolute") {
  return "<joint name='j" + child + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + origin + "</joint>\n";
}
std::string robot(const std::string& text) { return "<robot name='r'>\n" + text + "</robot>\n"; }

const std::string kBall = shape("<sphere radius='0.5'/>");

class UrdfTest : public ModelTest {
 protected:
  Model read(const std::string& text) { return model_of("r.urdf", robot(text)); }
  std::string error_in(const std::string& text) { return error_of("r.urdf", robot(text)); }
};

TEST_F(UrdfTest, LengthsAreWholeLengths) {
  const std::pair<const char*, std::pair<ShapeKind, std::array<float, 8>>> cases[] = {
      {"<sphere radius='0.5'/>", {ShapeKind::sphere, {0.5f}}},
      {"<box size='1 2 3'/>", {ShapeKind::box, {0.5f, 1, 1.5f}}},
      {"<cylinder radius='0.25' length='3'/>", {ShapeKind::cylinder, {0.25f, 1.5f}}},
      {"<capsule radius='0.25' length='3'/>",
       {ShapeKind::capsule, {0, 0, -1.5f, 0, 0, 1.5f, 0.25f}}},
  };
  for (const auto& [text, expected] : cases) {
    const Model model = read(link("a", shape(text)));
    ASSERT_EQ(model.info.bodies, 1u);
    EXPECT_EQ(kind_of(model, 0), expected.first);
    EXPECT_EQ(params_of(model, 0), expected.second);
    EXPECT_EQ(model.shape_names, std::vector<std::string>{"a"});
  }
}

TEST_F(UrdfTest, JointsPlaceLinksAndOriginsPlaceShapes) {
  const std::string quarter = "1.5707963267948966";
  const Model model =
      read(link("c", "<origin xyz='0 0 1'/>" + kBall) + link("a", kBall) + link("b", kBall) +
           joint("a", "b", "<origin xyz='1 2 3' rpy='0 0 " + quarter + "'/>") +
           joint("b", "c", "<origin xyz='1 0 0' rpy='" + quarter + " 0 0'/>", "fixed"));
  ASSERT_EQ(model.info.bodies, 3u);  // in the order of the file
  EXPECT_TRUE(has_at(model, 1, {0, 0, 0}, {0, 0, 0}));
  EXPECT_TRUE(has_at(model, 2, {1, 0, 0}, {1, 3, 3}));
  EXPECT_TRUE(has_at(model, 0, {0, 0, 0}, {2, 3, 3}));  // z of c is x of the world
  EXPECT_TRUE(has_at(model, 0, {0, 1, 0}, {2, 3, 4}));
  EXPECT_EQ(model.info.frames, 1u);
  EXPECT_TRUE(model.info.float64_positions && model.info.has_orientation);
}

// First about x, then y, then z, which stay where they are.
TEST_F(UrdfTest, RollPitchYaw) {
  const Model model =
      read(link("a", "<origin rpy='0.3 -0.7 1.1'/>" + shape("<box size='1 1 1'/>")));
  const Eigen::Matrix3d expected = (Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(-0.7, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(has_at(model, 0, Eigen::Vector3d::Unit(axis), expected.col(axis)));
  }
}

TEST_F(UrdfTest, SeveralShapesAreACompound) {
  const Model model =
      read("<link name='a'><collision><origin xyz='1 0 0'/>" + kBall +
           "</collision><collision><origin xyz='0 2 0'/>" + shape("<box size='2 2 2'/>") +
           "</collision><visual>" + shape("<sphere radius='9'/>") + "</visual></link>" +
           link("b", kBall) + joint("a", "b", "<origin xyz='5 0 0'/>", "continuous"));
  ASSERT_EQ(model.info.bodies, 2u);
  EXPECT_EQ(kind_of(model, 0), ShapeKind::compound);
  EXPECT_EQ(position_of(model, 0), Eigen::Vector3d(0, 0, 0));
  const SceneShapes& shapes = model.info.shapes;
  EXPECT_EQ(shapes.kind, (std::vector<uint8_t>{0, 3, 7}));  // the ball of b is that of a
  EXPECT_EQ(shapes.child_shape, (std::vector<uint32_t>{0, 1}));
  EXPECT_EQ(shapes.child_position, (std::vector<std::array<float, 3>>{{1, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(model.info.body_shape, (std::vector<uint32_t>{2, 0}));
}

TEST_F(UrdfTest, JoinedLinksDoNotMeet) {
  const Model model =
      read(link("a", kBall) + link("b", kBall) + link("c", kBall) + "<link name='empty'/>" +
           link("d", kBall) + joint("a", "b") + joint("b", "c", "", "prismatic") +
           joint("c", "empty", "", "fixed") + joint("empty", "d", "", "fixed"));
  EXPECT_EQ(model.info.excluded_pairs, (Pairs{{0, 1}, {1, 2}}));
  // c and d are rigid together; the others have nobody.
  ASSERT_EQ(model.info.owner.size(), 4u);
  EXPECT_EQ(model.info.owner[0], 0u);
  EXPECT_EQ(model.info.owner[1], 0u);
  EXPECT_NE(model.info.owner[2], 0u);
  EXPECT_EQ(model.info.owner[2], model.info.owner[3]);
  EXPECT_TRUE(model.info.body_motion.empty() && model.info.layer.empty());
}

TEST_F(UrdfTest, WhatIsFixedToTheWorldIsStatic) {
  const Model model = read("<link name='world'/>" + link("a", kBall) + link("b", kBall) +
                           joint("world", "a", "", "fixed") + joint("a", "b"));
  EXPECT_EQ(model.info.body_motion, (std::vector<uint8_t>{0, 2}));
}

TEST_F(UrdfTest, MeshesAreFoundAndScaled) {
  std::filesystem::create_directories(path("pack/urdf"));
  std::filesystem::create_directories(path("pack/meshes"));
  write_file("pack/meshes/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n");
  for (const char* name :
       {"package://pack/meshes/t.obj", "../meshes/t.obj", "model://pack/meshes/t.obj"}) {
    const Model model = model_of(
        "pack/urdf/r.urdf",
        robot(link("a", shape("<mesh filename='" + std::string(name) + "'/>")) +
              link("b", shape("<mesh filename='" + std::string(name) + "' scale='2 3 -4'/>")) +
              link("c", shape("<mesh filename='" + std::string(name) + "'/>")) + joint("a", "b") +
              joint("a", "c")));
    const SceneShapes& shapes = model.info.shapes;
    ASSERT_EQ(shapes.kind, (std::vector<uint8_t>{6, 6})) << name;
    EXPECT_EQ(model.info.body_shape, (std::vector<uint32_t>{0, 1, 0}));
    EXPECT_EQ(shapes.vertex_range, (std::vector<std::array<uint32_t, 2>>{{0, 4}, {4, 4}}));
    for (size_t i = 0; i < 4; ++i) {
      const auto [x, y, z] = shapes.vertices[i];
      EXPECT_EQ(shapes.vertices[4 + i], (std::array<float, 3>{2 * x, 3 * y, -4 * z}));
    }
    for (size_t i = 0; i < 2; ++i) {
      const auto [a, b, c] = shapes.triangles[i];
      EXPECT_EQ(shapes.triangles[2 + i], (std::array<uint32_t, 3>{a, c, b}));
    }
  }
}

TEST_F(UrdfTest, ErrorsNameElementAndLine) {
  EXPECT_EQ(error_in(link("a", shape("<torus radius='1'/>"))),
            "r.urdf:2: <torus>: is no shape that is known (box, cylinder, sphere, capsule or "
            "mesh)");
  EXPECT_EQ(error_in("\n" + link("a", shape("<sphere radius='-1'/>"))),
            "r.urdf:3: <sphere>: radius is missing or negative");
  EXPECT_THAT(error_in(link("a", shape("<sphere/>"))), HasSubstr("radius is missing"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='1' axis='x'/>"))),
              HasSubstr("has the unknown attribute 'axis'"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='nan'/>"))),
              HasSubstr("radius holds 'nan' (a finite number was expected)"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='1e39'/>"))), HasSubstr("holds '1e39'"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='1e999'/>"))), HasSubstr("holds '1e999'"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='1 2'/>"))),
              HasSubstr("radius holds 2 numbers (1 number expected)"));
  EXPECT_THAT(error_in(link("a", shape("<sphere radius='1,5'/>"))), HasSubstr("'1,5'"));
  EXPECT_THAT(error_in(link("a", shape("<box size='1 2'/>"))), HasSubstr("<box>: size holds 2"));
  EXPECT_THAT(error_in(link("a", shape("<box size='1 2 -3'/>"))), HasSubstr("negative"));
  EXPECT_THAT(error_in(link("a", shape(""))), HasSubstr("<collision>: has no geometry"));
  EXPECT_THAT(error_in(link("a", "")), HasSubstr("has no geometry"));
  EXPECT_THAT(error_in(link("a", "<origin xyz='0 0 0' quat='1 0 0 0'/>" + kBall)),
              HasSubstr("<origin>: has the unknown attribute 'quat'"));
  EXPECT_THAT(error_in("<link/>"), HasSubstr("<link>: has no name"));
  EXPECT_EQ(error_in(link("a", kBall) + link("a", kBall)),
            "r.urdf:3: <link> 'a': there is another link of this name");
  EXPECT_EQ(error_in(""), "r.urdf:1: <robot> 'r': has no link");
  EXPECT_THAT(error_in("<xacro:include filename='x'/>"), HasSubstr("run it through xacro first"));
}

TEST_F(UrdfTest, MeshesThatCannotBeReadAreErrors) {
  const auto error_with = [&](const std::string& mesh) { return error_in(link("a", shape(mesh))); };
  EXPECT_THAT(error_with("<mesh filename='no.obj'/>"), StartsWith("r.urdf:2: <mesh>: no.obj: "));
  EXPECT_THAT(error_with("<mesh filename='a.msh'/>"), HasSubstr("of no known kind (.obj, .stl"));
  EXPECT_THAT(error_with("<mesh filename='package://none/a.obj'/>"),
              HasSubstr("no folder from here upwards has the file of 'package://none/a.obj'"));
  EXPECT_THAT(error_with("<mesh/>"), HasSubstr("has no filename"));
  EXPECT_THAT(error_with("<mesh filename='a.obj' scale='1 0 1'/>"), HasSubstr("scale is zero"));
  write_file("empty.obj", "v 0 0 0\n");
  EXPECT_THAT(error_with("<mesh filename='empty.obj'/>"), HasSubstr("<mesh>: empty.obj"));
}

TEST_F(UrdfTest, LinksThatAreNoTreeAreErrors) {
  const std::string links = link("a", kBall) + link("b", kBall) + link("c", kBall);
  EXPECT_EQ(error_in(links + joint("a", "b") + joint("b", "c") + joint("c", "a")),
            "r.urdf:2: <link> 'a': is part of a loop of joints");
  EXPECT_EQ(error_in(links + joint("b", "c") + joint("c", "b")),
            "r.urdf:3: <link> 'b': is part of a loop of joints");
  EXPECT_EQ(error_in(links + joint("a", "c") + joint("b", "c")),
            "r.urdf:6: <joint> 'jc': its child 'c' is the child of another joint");
  EXPECT_THAT(error_in(links + joint("a", "b")), HasSubstr("<link> 'c': no joint has this link"));
  EXPECT_THAT(error_in(links + joint("a", "x")), HasSubstr("child is 'x', which is no link"));
  EXPECT_THAT(error_in(links + joint("x", "a")), HasSubstr("parent is 'x', which is no link"));
  EXPECT_THAT(error_in(links + "<joint name='j' type='fixed'/>"), HasSubstr("parent is ''"));
  EXPECT_THAT(error_in(links + joint("a", "b", "", "elastic") + joint("a", "c")),
              HasSubstr("is of the unknown type 'elastic'"));
  EXPECT_THAT(error_in(link("a", kBall) + joint("a", "a")), HasSubstr("loop"));
}

TEST_F(UrdfTest, WhatIsNoModelIsRefused) {
  EXPECT_EQ(error_of("r.urdf", "<robot>\n<link>\n</robot>"),
            "r.urdf:2: cannot be read as XML (XML_ERROR_MISMATCHED_ELEMENT)");
  EXPECT_THAT(error_of("r.urdf", ""), HasSubstr("r.urdf: is empty"));
  EXPECT_THAT(error_of("r.urdf", " "), HasSubstr("XML_ERROR_EMPTY_DOCUMENT"));
  EXPECT_THAT(error_of("r.urdf", "<!-- nothing -->"), HasSubstr("holds no XML element"));
  EXPECT_EQ(error_of("r.xml", "<sdf/>"),
            "r.xml:1: <sdf>: is no model (a robot or mujoco element was expected)");
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<a>";
  EXPECT_THAT(error_of("r.urdf", deep), HasSubstr("cannot be read as XML"));
  EXPECT_THAT(message_of(read_model(path("none.urdf"))), HasSubstr("none.urdf"));
}

TEST_F(UrdfTest, AModelIsAScene) {
  const std::string file = write_file("r.urdf", robot(link("a", "<origin xyz='1 0 0'/>" + kBall)));
  const auto scene = open_scene(file, {.orientation = false});
  ASSERT_TRUE(succeeds(scene));
  EXPECT_EQ((*scene)->info().name, "r");
  SceneFrame frame;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(succeeds((*scene)->read_frame(frame)));
    EXPECT_EQ(frame.position64, (std::vector<double>{1, 0, 0}));
    EXPECT_TRUE(frame.orientation.empty());
  }
}

}  // namespace
}  // namespace carom::io
