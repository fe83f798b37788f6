// Models in MJCF as scenes. The expected places and pairs are those of MuJoCo.
#include <cmath>

#include "tests/io/models/model_test_util.h"

namespace carom::io {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using Pairs = std::vector<std::array<uint32_t, 2>>;

class MjcfTest : public ModelTest {
 protected:
  static std::string file(const std::string& sections, const std::string& world) {
    return "<mujoco>" + sections + "\n<worldbody>" + world + "</worldbody></mujoco>\n";
  }
  Model read(const std::string& world, const std::string& sections = "") {
    return model_of("m.xml", file(sections, world));
  }
  std::string error_in(const std::string& world, const std::string& sections = "") {
    return error_of("m.xml", file(sections, world));
  }
};

// A body that a joint lets move.
std::string moving(const std::string& attributes, const std::string& inside) {
  return "<body " + attributes + "><joint/>" + inside + "</body>";
}

// Whether the bodies of a scene may meet.
bool may_meet(const SceneInfo& info, uint32_t a, uint32_t b) {
  const auto at = [](const auto& values, size_t i, uint32_t usual) {
    return values.empty() ? usual : uint32_t{values[i]};
  };
  if (a > b) std::swap(a, b);
  const bool are_static = at(info.body_motion, a, 2) == 0 && at(info.body_motion, b, 2) == 0;
  const bool have_bits = (at(info.layer, a, ~0u) & at(info.mask, b, ~0u)) != 0 &&
                         (at(info.layer, b, ~0u) & at(info.mask, a, ~0u)) != 0;
  const uint32_t owner = at(info.owner, a, 0);
  const bool have_owner = owner != 0 && owner == at(info.owner, b, 0);
  const auto& excluded = info.excluded_pairs;
  return !are_static && have_bits && !have_owner &&
         std::find(excluded.begin(), excluded.end(), std::array{a, b}) == excluded.end();
}

Pairs meeting_pairs(const Model& model) {
  Pairs pairs;
  for (uint32_t a = 0; a < model.info.bodies; ++a) {
    for (uint32_t b = a + 1; b < model.info.bodies; ++b) {
      if (may_meet(model.info, a, b)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST_F(MjcfTest, SizesAreHalves) {
  const std::pair<const char*, std::pair<ShapeKind, std::array<float, 8>>> cases[] = {
      {"size='0.5'", {ShapeKind::sphere, {0.5f}}},
      {"type='sphere' size='0.5 9 9'", {ShapeKind::sphere, {0.5f}}},
      {"type='capsule' size='0.25 1.5'", {ShapeKind::capsule, {0, 0, -1.5f, 0, 0, 1.5f, 0.25f}}},
      {"type='cylinder' size='0.25 1.5'", {ShapeKind::cylinder, {0.25f, 1.5f}}},
      {"type='ellipsoid' size='1 2 3'", {ShapeKind::ellipsoid, {1, 2, 3}}},
      {"type='box' size='1 2 3'", {ShapeKind::box, {1, 2, 3}}},
      {"type='plane' size='0 0 1'", {ShapeKind::halfspace, {0, 0, 1, 0}}},
  };
  for (const auto& [text, expected] : cases) {
    const Model model = read("<geom name='g' " + std::string(text) + "/>");
    ASSERT_EQ(model.info.bodies, 1u);
    EXPECT_EQ(kind_of(model, 0), expected.first) << text;
    EXPECT_EQ(params_of(model, 0), expected.second) << text;
    EXPECT_EQ(model.shape_names, std::vector<std::string>{"g"});
    EXPECT_EQ(model.info.body_motion, std::vector<uint8_t>{0});
  }
}

TEST_F(MjcfTest, EndsGivePlaceAndLength) {
  for (const char* type : {"capsule", "cylinder", "box", "ellipsoid"}) {
    const Model model =
        read("<geom type='" + std::string(type) + "' size='0.1' fromto='1 2 3  4 6 3'/>");
    const std::array<float, 8> params = params_of(model, 0);
    const bool is_capsule = kind_of(model, 0) == ShapeKind::capsule;
    const bool is_cylinder = kind_of(model, 0) == ShapeKind::cylinder;
    EXPECT_EQ(is_capsule ? params[5] : is_cylinder ? params[1] : params[2], 2.5f) << type;
    EXPECT_EQ(is_capsule ? params[6] : params[0], 0.1f);
    const bool is_upwards = has_at(model, 0, {0, 0, 2.5}, {4, 6, 3});
    EXPECT_TRUE(has_at(model, 0, {0, 0, is_upwards ? -2.5 : 2.5}, {1, 2, 3}));
    EXPECT_TRUE(has_at(model, 0, {0, 0, is_upwards ? 2.5 : -2.5}, {4, 6, 3}));
  }
}

TEST_F(MjcfTest, OrientationsOfEveryForm) {
  const std::string box = "<geom type='box' size='1 1 1' ";
  const double c = std::cos(0.5), s = std::sin(0.5);
  const std::string in_radians = "<compiler angle='radian'/>";
  for (const char* turn :
       {"quat='0.8775825618903728 0 0 0.479425538604203'", "axisangle='0 0 3 1'", "euler='0 0 1'",
        "xyaxes='0.5403023058681398 0.8414709848078965 0 -1 1 0'"}) {
    const Model model = read(box + turn + "/>", in_radians);
    const double cosine = c * c - s * s, sine = 2 * c * s;
    EXPECT_TRUE(has_at(model, 0, {1, 0, 0}, {cosine, sine, 0})) << turn;
    EXPECT_TRUE(has_at(model, 0, {0, 0, 1}, {0, 0, 1})) << turn;
  }
  const Model along = read(box + "zaxis='0 3 0'/>");
  EXPECT_TRUE(has_at(along, 0, {0, 0, 1}, {0, 1, 0}));
  EXPECT_TRUE(has_at(along, 0, {1, 0, 0}, {1, 0, 0}));
  EXPECT_TRUE(has_at(read(box + "zaxis='0 0 -2'/>"), 0, {0, 1, 0}, {0, -1, 0}));
}

TEST_F(MjcfTest, AnglesAreDegreesAndAxesTurnAlong) {
  const std::string box = "<geom type='box' size='1 1 1' euler='90 90 0'/>";
  // First about x, then about the new y, which is z of the world.
  const Model along = read(box);
  EXPECT_TRUE(has_at(along, 0, {1, 0, 0}, {0, 1, 0}));
  EXPECT_TRUE(has_at(along, 0, {0, 1, 0}, {0, 0, 1}));
  // The same about fixed axes.
  const Model fixed = read(box, "<compiler eulerseq='XYZ'/>");
  EXPECT_TRUE(has_at(fixed, 0, {1, 0, 0}, {0, 0, -1}));
  EXPECT_TRUE(has_at(fixed, 0, {0, 1, 0}, {1, 0, 0}));
  EXPECT_TRUE(has_at(read(box, "<compiler eulerseq='zzx'/>"), 0, {1, 0, 0}, {-1, 0, 0}));
}

TEST_F(MjcfTest, BodiesAndFramesStandInEachOther) {
  const Model model = read(
      "<body pos='1 0 0' euler='0 0 90'><freejoint/><geom size='1' pos='1 0 0'/>"
      "<frame pos='0 1 0' euler='0 0 90'><geom size='2' pos='1 0 0'/>"
      "<body pos='0 0 5'><joint/><geom type='box' size='1 1 1' pos='1 0 "
      "0'/></body></frame></body>");
  ASSERT_EQ(model.info.bodies, 2u);
  EXPECT_EQ(kind_of(model, 0), ShapeKind::compound);
  EXPECT_TRUE(has_at(model, 0, {0, 0, 0}, {1, 0, 0}));
  const auto& children = model.info.shapes.child_position;
  ASSERT_EQ(children.size(), 2u);
  EXPECT_LT((Eigen::Vector3f(children[0].data()) - Eigen::Vector3f(1, 0, 0)).norm(), 1e-6);
  EXPECT_LT((Eigen::Vector3f(children[1].data()) - Eigen::Vector3f(0, 2, 0)).norm(), 1e-6);
  // The frame is at (0, 0, 0) and turned by 180 degrees.
  EXPECT_TRUE(has_at(model, 1, {0, 0, 0}, {-1, 0, 5}));
  EXPECT_EQ(model.info.excluded_pairs, (Pairs{{0, 1}}));
}

TEST_F(MjcfTest, ClassesInheritAndElementsOverwrite) {
  const std::string classes =
      "<default><geom size='1 2 3'/><default class='box'><geom type='box'/>"
      "<default class='flat'><geom size='5' pos='0 0 7'/></default></default>"
      "<default class='seen'><geom contype='0' conaffinity='0'/></default></default>";
  const Model model = read(
      "<geom/><geom class='box'/><geom class='flat'/><geom class='flat' size='6 6' pos='1 1 1'/>"
      "<geom class='seen'/><body childclass='box'><geom/><geom class='main'/>"
      "<body childclass='seen'><geom/><geom conaffinity='1'/></body></body>",
      classes);
  const SceneShapes& shapes = model.info.shapes;
  const auto kind_and_params = [&](size_t shape) {
    return std::pair(shapes.kind[shape], shapes.params[shape]);
  };
  using Expected = std::pair<uint8_t, std::array<float, 8>>;
  EXPECT_EQ(kind_and_params(model.info.body_shape[0]), (Expected{0, {1}}));
  EXPECT_EQ(kind_and_params(model.info.body_shape[1]), (Expected{3, {1, 2, 3}}));
  EXPECT_EQ(kind_and_params(model.info.body_shape[2]), (Expected{3, {5, 2, 3}}));
  EXPECT_EQ(position_of(model, 2), Vector3d(0, 0, 7));
  EXPECT_EQ(kind_and_params(model.info.body_shape[3]), (Expected{3, {6, 6, 3}}));
  EXPECT_EQ(position_of(model, 3), Vector3d(1, 1, 1));
  EXPECT_EQ(kind_of(model, 4), ShapeKind::compound);
  EXPECT_EQ(kind_and_params(shapes.child_shape[0]), (Expected{3, {1, 2, 3}}));
  EXPECT_EQ(kind_and_params(shapes.child_shape[1]), (Expected{0, {1}}));
  ASSERT_EQ(model.info.bodies, 6u);
  EXPECT_EQ(kind_of(model, 5), ShapeKind::sphere);
}

// MuJoCo collides the convex hull of a mesh.
TEST_F(MjcfTest, MeshesAreHulls) {
  write_file("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const std::string assets =
      "<compiler meshdir='.' /><default><default class='big'><mesh scale='2 2 2'/></default>"
      "</default><asset><mesh file='corner.obj'/>"
      "<mesh name='scaled' class='big' file='corner.obj'/>"
      "<mesh name='moved' file='corner.obj' refpos='1 0 0' refquat='0 0 0 1' scale='1 2 3'/>"
      "<mesh name='given' vertex='0 0 0  1 0 0  0 1 0  0 0 1'/>"
      "<texture name='t'/></asset>";
  const Model model = read(
      "<geom type='mesh' mesh='corner'/><geom type='mesh' mesh='scaled' pos='1 2 3'/>"
      "<geom type='mesh' mesh='moved'/><geom type='mesh' mesh='given'/>",
      assets);
  const SceneShapes& shapes = model.info.shapes;
  ASSERT_EQ(shapes.kind, (std::vector<uint8_t>{5, 5, 5, 5}));
  EXPECT_TRUE(shapes.triangles.empty());
  for (size_t i = 0; i < 4; ++i) {
    const auto [x, y, z] = shapes.vertices[i];
    EXPECT_EQ(shapes.vertices[4 + i], (std::array<float, 3>{2 * x, 2 * y, 2 * z}));
    EXPECT_EQ(shapes.vertices[8 + i], (std::array<float, 3>{1 - x, -2 * y, 3 * z}));
  }
  EXPECT_EQ(position_of(model, 1), Vector3d(1, 2, 3));
}

TEST_F(MjcfTest, WhoMeetsWhom) {
  // The ground; a body and its child; a hand that is fixed to the child; a neighbour.
  const std::string ball = "<geom size='1'/>";
  const std::string world =
      "<geom type='plane' size='0 0 1'/>" + ball +
      moving("name='a'", ball + moving("name='b'", ball + "<body name='hand'>" + ball + "</body>" +
                                                       moving("name='c'", ball))) +
      moving("name='d'", ball);
  // Indices: 0 plane, 1 ball of the world, 2 a, 3 b, 4 hand, 5 c, 6 d.
  const Pairs with_ground = {{0, 2}, {0, 3}, {0, 4}, {0, 5}, {0, 6},
                             {1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}};
  const auto expected = [&](Pairs others) {
    others.insert(others.begin(), with_ground.begin(), with_ground.end());
    return others;
  };
  EXPECT_EQ(meeting_pairs(read(world)), expected({{2, 5}, {2, 6}, {3, 6}, {4, 6}, {5, 6}}));
  const std::string unfiltered = "<option><flag filterparent='disable'/></option>";
  EXPECT_EQ(meeting_pairs(read(world, unfiltered)),
            expected({{2, 3}, {2, 4}, {2, 5}, {2, 6}, {3, 5}, {3, 6}, {4, 5}, {4, 6}, {5, 6}}));
  const std::string excluded = "<contact><exclude body1='d' body2='hand'/></contact>";
  EXPECT_EQ(meeting_pairs(read(world, excluded)), expected({{2, 5}, {2, 6}, {3, 6}, {5, 6}}));
  const std::string from_world = "<contact><exclude body1='world' body2='d'/></contact>";
  EXPECT_FALSE(may_meet(read(world, from_world).info, 0, 6));
}

// One bit of either in the other is enough.
TEST_F(MjcfTest, BitsOfContact) {
  const auto ball = [](int contype, int conaffinity) {
    return moving("", "<geom size='1' contype='" + std::to_string(contype) + "' conaffinity='" +
                          std::to_string(conaffinity) + "'/>");
  };
  const Model model = read(ball(1, 0) + ball(0, 1) + ball(2, 2) + ball(3, 0) + ball(1, 0) +
                           ball(0, 0) + ball(-1, 0));
  ASSERT_EQ(model.info.bodies, 6u);
  EXPECT_EQ(meeting_pairs(model), (Pairs{{0, 1}, {1, 3}, {1, 4}, {1, 5}, {2, 3}, {2, 5}}));
  EXPECT_TRUE(read(ball(1, 1) + ball(1, 1)).info.layer.empty());
  EXPECT_EQ(meeting_pairs(read(ball(1, 2) + ball(1, 2))), Pairs{});
}

TEST_F(MjcfTest, GeomsOfOtherBitsAreBodiesOfTheirOwn) {
  const Model model = read(moving("pos='1 0 0'",
                                  "<geom size='1'/><geom size='2' contype='2'/>"
                                  "<geom size='3'/>") +
                           moving("", "<geom size='4' contype='2' conaffinity='4'/>"));
  ASSERT_EQ(model.info.bodies, 3u);
  EXPECT_EQ(kind_of(model, 0), ShapeKind::compound);
  EXPECT_EQ(params_of(model, 1)[0], 2);
  EXPECT_EQ(model.info.owner[0], model.info.owner[1]);
  EXPECT_EQ(meeting_pairs(model), Pairs{});
}

TEST_F(MjcfTest, WhatMovesHow) {
  const Model model =
      read("<body><geom size='1'/></body><body mocap='true'><geom size='1'/></body>" +
           moving("", "<geom size='1'/><body><geom size='2'/></body>"));
  EXPECT_EQ(model.info.body_motion, (std::vector<uint8_t>{0, 1, 2, 2}));
  EXPECT_EQ(meeting_pairs(model), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}}));
}

TEST_F(MjcfTest, IncludesStandInPlace) {
  write_file("parts.xml",
             "<mujocoinclude><geom size='2'/><include file='more.xml'/>"
             "</mujocoinclude>");
  write_file("more.xml", "<mujocoinclude><geom size='3'/></mujocoinclude>");
  write_file("settings.xml", "<mujoco><compiler angle='radian'/></mujoco>");
  const Model model = read(
      "<geom size='1'/><include file='parts.xml'/><geom size='4'/>"
      "<geom type='box' size='1 1 1' euler='0 0 1.5707963267948966'/>",
      "<include file='settings.xml'/>");
  ASSERT_EQ(model.info.bodies, 5u);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(params_of(model, i)[0], float(i + 1));
  EXPECT_TRUE(has_at(model, 4, {1, 0, 0}, {0, 1, 0}));
}

TEST_F(MjcfTest, IncludesThatGoWrongAreErrors) {
  write_file("self.xml", "<mujoco><include file='./self.xml'/></mujoco>");
  EXPECT_EQ(error_in("<include file='self.xml'/>"),
            "self.xml:1: <include>: './self.xml' is included again");
  EXPECT_EQ(error_in("<include file='m.xml'/>"), "m.xml:2: <include>: 'm.xml' is included again");
  EXPECT_THAT(error_in("<include/>"), HasSubstr("<include>: has no file"));
  EXPECT_THAT(error_in("<include file='none.xml'/>"), HasSubstr("m.xml:2: <include>: none.xml"));
  write_file("broken.xml", "<mujoco>");
  EXPECT_THAT(error_in("<include file='broken.xml'/>"), HasSubstr("broken.xml:1: cannot be read"));
  write_file("wrong.xml", "<x>\n\n<geom size='-1'/></x>");
  EXPECT_EQ(error_in("<include file='wrong.xml'/>"), "wrong.xml:3: <geom>: size must be above 0");
}

std::vector<float> heights_of(const Model& model, size_t body) {
  const SceneShapes& shapes = model.info.shapes;
  const auto [first, count] = shapes.height_range[model.info.body_shape[body]];
  return {shapes.heights.begin() + first, shapes.heights.begin() + first + count};
}

// MuJoCo takes the first row of an elevation as that of the greatest y, and spreads the samples
// from 0 to 1.
TEST_F(MjcfTest, HeightFields) {
  const Model model = read(
      "<geom type='hfield' hfield='hill' pos='1 2 3'/><geom size='1'/>"
      "<geom type='hfield' hfield='hill'/><geom type='hfield' hfield='flat'/>",
      "<asset><hfield name='hill' nrow='3' ncol='4' size='3 2 11 0.1' "
      "elevation='-1 0 1 2 3 4 5 6 7 8 9 10'/>"
      "<hfield name='flat' nrow='2' ncol='2' size='1 1 1 1'/></asset>");
  ASSERT_EQ(model.info.bodies, 4u);
  EXPECT_EQ(kind_of(model, 0), ShapeKind::height_field);
  EXPECT_EQ(params_of(model, 0), (std::array<float, 8>{4, 3, 2, 2}));
  EXPECT_TRUE(has_at(model, 0, {0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(heights_of(model, 0), (std::vector<float>{8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3}));
  EXPECT_EQ(model.info.body_shape[0], model.info.body_shape[2]);
  EXPECT_EQ(heights_of(model, 3), std::vector<float>(4));
  EXPECT_TRUE(read("<geom size='1'/>").info.shapes.height_range.empty());
}

TEST_F(MjcfTest, HeightFieldsInFilesOfMuJoCo) {
  const int32_t counts[] = {2, 3};
  const float samples[] = {1, 2, 3, 4, 5, 6};
  std::string bytes(reinterpret_cast<const char*>(counts), sizeof counts);
  bytes.append(reinterpret_cast<const char*>(samples), sizeof samples);
  write_file("hill.bin", bytes);
  const auto asset = [](const std::string& attributes) {
    return "<asset><hfield file='hill.bin' size='1 1 5 1' " + attributes + "/></asset>";
  };
  const std::string geom = "<geom type='hfield' hfield='hill'/>";
  EXPECT_EQ(heights_of(read(geom, asset("")), 0), (std::vector<float>{0, 1, 2, 3, 4, 5}));
  for (const size_t length : {size_t{0}, size_t{7}, size_t{8}, bytes.size() - 1}) {
    write_file("hill.bin", bytes.substr(0, length));
    EXPECT_THAT(error_in(geom, asset("")), HasSubstr("<hfield>")) << length;
  }
  write_file("hill.bin", std::string(8, '\xff') + bytes.substr(8));
  EXPECT_THAT(error_in(geom, asset("")), HasSubstr("it says -1 rows of -1 samples"));
}

TEST_F(MjcfTest, WrongHeightFieldsAreErrors) {
  const auto error_of_asset = [&](const std::string& attributes) {
    return error_in("<geom type='hfield' hfield='h'/>",
                    "<asset><hfield name='h' " + attributes + "/></asset>");
  };
  EXPECT_THAT(error_of_asset("nrow='2' ncol='2' size='1 1 1 1' elevation='1 2 3'"),
              HasSubstr("elevation has 3 numbers for 2 rows of 2"));
  EXPECT_THAT(error_of_asset("nrow='2' size='1 1 1 1'"), HasSubstr("ncol must be a whole number"));
  EXPECT_THAT(error_of_asset("nrow='1' ncol='2' size='1 1 1 1'"), HasSubstr("nrow must be"));
  EXPECT_THAT(error_of_asset("nrow='1e6' ncol='1e6' size='1 1 1 1'"), HasSubstr("too many"));
  EXPECT_THAT(error_of_asset("nrow='2' ncol='2' size='1 1 0 1'"), HasSubstr("size must be four"));
  EXPECT_THAT(error_of_asset("nrow='2' ncol='2'"), HasSubstr("size must be four"));
  EXPECT_THAT(error_of_asset("file='a.PNG' size='1 1 1 1'"), HasSubstr("images are not read"));
  EXPECT_THAT(error_of_asset("file='none.bin' size='1 1 1 1'"), HasSubstr("none.bin"));
  EXPECT_THAT(error_of_asset("nrow='2' ncol='2' size='1 1 1 1' steep='1'"), HasSubstr("'steep'"));
  EXPECT_THAT(error_in("<geom type='hfield' hfield='none'/>"),
              HasSubstr("there is no height field 'none'"));
}

TEST_F(MjcfTest, WhatIsNotUnderstoodIsAnError) {
  EXPECT_EQ(
      error_in("<geom name='g' type='skin'/>"),
      "m.xml:2: <geom> 'g': the type 'skin' is not supported (plane, hfield, sphere, capsule, "
      "ellipsoid, cylinder, box and mesh are)");
  EXPECT_THAT(error_in("<geom type='sdf'/>"), HasSubstr("'sdf' is not supported"));
  EXPECT_EQ(error_in("<composite type='rope'/>"), "m.xml:2: <composite>: is not supported");
  EXPECT_THAT(error_in("<body><replicate count='3'/></body>"), HasSubstr("<replicate>"));
  EXPECT_THAT(error_in("<geom size='1' thickness='2'/>"),
              HasSubstr("has the unknown attribute 'thickness'"));
  EXPECT_THAT(error_in("<body shift='1'/>"), HasSubstr("unknown attribute 'shift'"));
  EXPECT_THAT(error_in("", "<deformable/>"), HasSubstr("<deformable>: is not supported"));
  EXPECT_THAT(error_in("", "<contact><pair geom1='a' geom2='b'/></contact>"),
              HasSubstr("<pair>: is not supported"));
  EXPECT_THAT(error_in("", "<option collision='predefined'/>"), HasSubstr("<option>"));
  EXPECT_THAT(error_in("", "<option><flag contact='disable'/></option>"),
              HasSubstr("switches all contacts off"));
  EXPECT_THAT(error_in("", "<compiler coordinate='global'/>"), HasSubstr("only local is read"));
  EXPECT_EQ(error_in("<geom type='hfield' contype='0' conaffinity='0'/>"), "");
}

TEST_F(MjcfTest, WrongNumbersAndNamesAreErrors) {
  EXPECT_THAT(error_in("<geom/>"), HasSubstr("size must be above 0"));
  EXPECT_THAT(error_in("<geom type='box' size='1 2'/>"), HasSubstr("size must be above 0"));
  EXPECT_THAT(error_in("<geom size='1 2 3 4'/>"), HasSubstr("size holds 4 numbers"));
  EXPECT_THAT(error_in("<geom size='1e40'/>"), HasSubstr("size holds '1e40'"));
  EXPECT_THAT(error_in("<geom size='1' quat='0 0 0 0'/>"), HasSubstr("quat is zero"));
  EXPECT_THAT(error_in("<geom size='1' zaxis='0 0 0'/>"), HasSubstr("zaxis has a vector without"));
  EXPECT_THAT(error_in("<geom size='1' quat='1 0 0 0' euler='0 0 0'/>"),
              HasSubstr("has more than one orientation"));
  EXPECT_THAT(error_in("<geom size='1' contype='0.5'/>"), HasSubstr("contype is no whole number"));
  EXPECT_THAT(error_in("<geom size='1' contype='4294967296'/>"), HasSubstr("contype is no whole"));
  EXPECT_THAT(error_in("<geom size='1' class='x'/>"), HasSubstr("there is no class 'x'"));
  EXPECT_THAT(error_in("<geom type='mesh' mesh='x'/>"), HasSubstr("there is no mesh 'x'"));
  EXPECT_THAT(error_in("<geom size='1' mesh='x'/>"), HasSubstr("fitted to a mesh"));
  EXPECT_THAT(error_in("<geom size='1' fromto='0 0 0 1 0 0'/>"), HasSubstr("fromto needs"));
  EXPECT_THAT(error_in("<geom type='box' size='1' fromto='1 0 0 1 0 0'/>"), HasSubstr("one point"));
  EXPECT_THAT(error_in("<geom type='box' size='1' pos='1 0 0' fromto='0 0 0 1 0 0'/>"),
              HasSubstr("both pos and fromto"));
  EXPECT_THAT(error_in(moving("", "<geom type='plane' size='1 1 1'/>")),
              HasSubstr("is a plane on a body that moves"));
  EXPECT_THAT(error_in("<body name='a'/><body name='a'/>"), HasSubstr("another body"));
  EXPECT_THAT(error_in("", "<contact><exclude body1='a' body2='b'/></contact>"),
              HasSubstr("there is no body 'a'"));
  EXPECT_THAT(error_in("", "<compiler eulerseq='abc'/>"), HasSubstr("eulerseq is 'abc'"));
  EXPECT_THAT(error_in("", "<compiler angle='turns'/>"), HasSubstr("angle is 'turns'"));
  EXPECT_THAT(error_in("", "<default><default/></default>"), HasSubstr("has no class"));
  EXPECT_THAT(error_in("", "<default><default class='a'/><default class='a'/></default>"),
              HasSubstr("there is another class 'a'"));
  EXPECT_THAT(error_in("", "<asset><mesh name='a'/></asset>"), HasSubstr(""));
  EXPECT_THAT(error_in("<geom type='mesh' mesh='a'/>", "<asset><mesh name='a'/></asset>"),
              HasSubstr("neither a file nor vertices"));
  EXPECT_THAT(error_in("", "<asset><mesh name='a'/><mesh name='a'/></asset>"),
              HasSubstr("there is another mesh 'a'"));
}

TEST_F(MjcfTest, TooManyCombinationsOfBits) {
  std::string world;
  for (int i = 1; i <= 33; ++i) world += "<geom size='1' contype='" + std::to_string(i) + "'/>";
  EXPECT_THAT(error_in(world), HasSubstr("is the 33rd combination of contype and conaffinity"));
}

}  // namespace
}  // namespace carom::io
