// Every mistake gives one clear line, a non-zero exit code and no output file.
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/pairs_file.h"
#include "io/scene.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using ErrorsTest = CliTest;

// A sphere, and a shape of kind `kind`; a mesh has two triangles.
io::SceneShapes shapes_with(uint8_t kind) {
  io::SceneShapes shapes;
  shapes.kind = {0, kind};
  shapes.params = {{1}, {7, 0, 0, 1, 0, 0, 1}};
  shapes.vertex_range = {{0, 0}, {0, 4}};
  shapes.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  shapes.triangle_range = {{0, 0}, {0, 2}};
  shapes.triangles = {{0, 1, 2}, {1, 2, 3}};
  shapes.child_range = {{0, 0}, {0, 1}};
  shapes.child_shape = {0};
  shapes.child_position = {{0, 0, 0}};
  shapes.child_orientation = {{0, 0, 0, 1}};
  return shapes;
}

// A scene with one sphere in `frames` frames; frame `bad_frame` is all NaN.
void write_scene(const std::string& path, const io::SceneShapes& shapes, int frames = 2,
                 int bad_frame = -1) {
  io::SceneInfo info;
  info.bodies = 1;
  info.shapes = shapes;
  info.body_shape = {0};
  auto writer = io::SceneWriter::create(path, info);
  ASSERT_TRUE(writer) << writer.error().message;
  for (int i = 0; i < frames; ++i) {
    io::SceneFrame frame;
    const float x = i == bad_frame ? std::numeric_limits<float>::quiet_NaN() : 0;
    frame.position32 = {x, x, x};
    ASSERT_TRUE(writer->write_frame(frame));
  }
  ASSERT_TRUE(writer->finish());
}

void write_scene(const std::string& path, uint8_t kind, int frames = 2, int bad_frame = -1) {
  write_scene(path, shapes_with(kind), frames, bad_frame);
}

// One pair: the sphere, or the other shape, with itself.
void write_pairs(const std::string& path, const io::SceneShapes& shapes, uint32_t shape = 0) {
  io::PairsFile file;
  file.pairs = 1;
  file.shapes = shapes;
  for (io::PairSide* side : {&file.a, &file.b}) {
    side->shape = {shape};
    side->position32 = {{0, 0, 0}};
  }
  const auto written = io::write_pairs(path, file);
  ASSERT_TRUE(written) << written.error().message;
}

void write_pairs(const std::string& path, uint8_t kind, uint32_t shape = 0) {
  write_pairs(path, shapes_with(kind), shape);
}

TEST_F(ErrorsTest, Commands) {
  expect_error({}, {"no command",
                    "run, pairs, verify, advise, accuracy, tunnelling, check, generate, info"});
  expect_error({"frobnicate"}, {"unknown command 'frobnicate'", "run, pairs"});
  expect_error({"check", path("absent.obj")}, {"absent.obj"});
  expect_error({"--bogus"}, {"unknown command '--bogus'"});
  expect_error({"run", "still:n=5", "--bogus"}, {"--bogus"});
  expect_error({"run"}, {"SCENE"});
  expect_error({"pairs", "x.npz"}, {"--output"});
}

// A script may pass an unset variable: an empty file name is an error, not a request for no output.
TEST_F(ErrorsTest, EmptyFileNames) {
  const std::string scene = "still:n=5,frames=2";
  const std::string what = "the name of the file is empty";
  expect_error({"run", scene, "--json", ""}, {"--json", what});
  expect_error({"run", scene, "--pairs-out", ""}, {"--pairs-out", what});
  expect_error({"run", scene, "--page", ""}, {"--page", what});
  expect_error({"pairs", "x.npz", "-o", ""}, {"--output", what});
}

TEST_F(ErrorsTest, OptionsOfRun) {
  const std::string scene = "still:n=5,frames=2";
  expect_error({"run", scene, "--threads", "0"}, {"--threads 0"});
  expect_error({"run", scene, "--threads", "-3"}, {"--threads -3"});
  expect_error({"run", scene, "--threads", "two"}, {"--threads", "two"});
  expect_error({"run", scene, "--frames", "0"}, {"--frames"});
  expect_error({"run", scene, "--isa", "mmx"}, {"unknown ISA 'mmx'", "avx2"});
  expect_error({"run", scene, "--isa", "neon"}, {"'neon' cannot be used here", "scalar"});
  expect_error({"run", scene, "--tier", "best"},
               {"unknown tier 'best'", "fast, standard, certified, exact"});
  expect_error({"run", scene, "--detail", "toi"}, {"detail 'toi'", "carom pairs"});
  expect_error({"run", scene, "--detail", "distance"}, {"detail 'distance'", "carom pairs"});
  expect_error({"run", scene, "--detail", "some"}, {"unknown detail 'some'"});
  expect_error({"run", scene, "--broadphase", "octree"}, {"unknown broadphase 'octree'", "sweep"});
  for (const char* margin : {"-1", "nan", "inf", "1e39", "-1e-9"}) {
    expect_error({"run", scene, "--margin", margin}, {"--margin", "metres"});
  }
  expect_error({"run", scene, "--margin", "wide"}, {"--margin", "wide"});
  for (const char* directions : {"-14", "7", "15"}) {
    expect_error({"run", scene, "--dop-bounds", directions}, {"--dop-bounds", "6, 14, 18 and 26"});
  }
  expect_error({"run", scene, "--json", path("x"), "--pairs-out", path("x")}, {"the same file"});
  expect_error({"run", scene, "--json", path("x"), "--pairs-out", path("./x")}, {"the same file"});
  expect_error({"run", scene, "--json", "x", "--pairs-out", "./x"}, {"the same file"});
  expect_error({"run", scene, "--json", path("x"), "--page", path("./x")},
               {"--json and --page name the same file"});
  expect_error({"run", scene, "--pairs-out", path("x"), "--page", path("./x")},
               {"--pairs-out and --page name the same file"});
  expect_error({"run", scene, "--pairs-out", scene},
               {"the scene and --pairs-out", "the same file"});
  expect_error({"run", scene, "--json", scene}, {"the scene and --json name the same file"});
  // Where standard output is a file, this leads to a regular one.
  std::filesystem::create_symlink("/proc/self/fd/1", path("link"));
  expect_error({"run", scene, "--json", path("link")}, {"is a link to a device or a stream"});
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  std::filesystem::remove(path("link"));
  for (const char* detail : {"pairs", "overlap"}) {
    expect_error({"run", scene, "--detail", detail, "--page", path("x")},
                 {"--page", "--detail contact, manifold or regions", detail});
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(ErrorsTest, OptionsOfPairs) {
  write_pairs(path("in.npz"), 2);
  const auto fails = [&](const std::string& option, const std::string& value,
                         const std::string& part) {
    expect_error({"pairs", path("in.npz"), "-o", path("out.npz"), option, value}, {part});
  };
  fails("--detail", "pairs", "unknown detail 'pairs'");
  fails("--detail", "pairs", "(there are: overlap, contact, manifold, regions, distance, toi)");
  fails("--tier", "best", "unknown tier 'best'");
  fails("--isa", "mmx", "unknown ISA");
  fails("--threads", "0", "--threads 0");
  fails("--repeat", "0", "--repeat");
  fails("--json", path("out.npz"), "the same file");
  fails("--json", path("none/../out.npz"), "the same file");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, Tolerances) {
  const std::string scene = "still:n=5,frames=2";
  const auto fails = [&](const std::string& tier, const std::string& option,
                         const std::string& value, std::initializer_list<std::string> parts) {
    expect_error({"run", scene, "--tier", tier, option, value}, parts);
  };
  fails("certified", "--tolerance", "0.1", {"--tolerance 0.1: not with --tier certified"});
  for (const char* metres : {"-1", "nan", "inf", "1e39", "-1e-9"}) {
    fails("fast", "--tolerance", metres, {"--tolerance", "metres"});
  }
  fails("fast", "--tolerance", "wide", {"--tolerance", "wide"});

  write_pairs(path("in.npz"), 2);
  const auto pairs_fail = [&](const std::string& tier, const std::string& option,
                              const std::string& value, const std::string& part) {
    expect_error({"pairs", path("in.npz"), "-o", path("out.npz"), "--tier", tier, option, value},
                 {part});
  };
  pairs_fail("standard", "--tolerance", "-1", "--tolerance -1: not a number of metres");
  pairs_fail("exact", "--tolerance", "1", "not with --tier exact");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, TimesOfImpactHaveOneTier) {
  write_pairs(path("in.npz"), 2);
  const auto fails = [&](std::vector<std::string> options, const std::string& part) {
    options.insert(options.begin(),
                   {"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", "toi"});
    expect_error(options, {"--detail toi", part});
  };
  fails({"--tier", "certified"}, "has the tier standard alone (--tier certified was given)");
  fails({"--tier", "exact"}, "has the tier standard alone (--tier exact was given)");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, Motions) {
  io::PairsFile file;
  file.pairs = 2;
  file.shapes = shapes_with(2);
  for (io::PairSide* side : {&file.a, &file.b}) {
    side->shape = {0, 0};
    side->position32 = {{0, 0, 0}, {0, 0, 0}};
  }
  const auto fails = [&](std::initializer_list<std::string> parts) {
    ASSERT_TRUE(io::write_pairs(path("in.npz"), file));
    expect_error({"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", "toi"}, parts);
  };
  fails({"in.npz: member displacement_a: is missing", "displacement_b", "--detail toi"});
  file.a.rotation = {{0, 0, 0}, {0, 0, 0}};
  fails({"member displacement_a: is missing"});
  file.a.displacement = {{0, 0, 0}};
  fails({"member displacement_a: has shape (1, 3)", "(2, 3)"});
  file.a.displacement = {{0, 0, 0}, {0, 0, 0}};
  file.b.rotation = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  fails({"member rotation_b: has shape (3, 3)", "(2, 3)"});
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, OptionsOfVerify) {
  expect_error({"verify", "--threads", "0"}, {"--threads 0"});
  expect_error({"verify", path("absent.npz")}, {"absent.npz"});
}

TEST_F(ErrorsTest, Generators) {
  const auto fails = [&](const std::string& spec, std::initializer_list<std::string> parts) {
    expect_error({"generate", spec, "-o", path("out.npz")}, parts);
  };
  fails("tornado", {"unknown generator 'tornado'", "brownian, varied, static, still, bullets"});
  fails("tornado:n=5", {"unknown generator 'tornado'"});
  fails("brownian:", {"'' is not key=value"});
  fails("brownian:n", {"'n' is not key=value"});
  fails("brownian:mass=3", {"unknown key 'mass'", "density"});
  fails("still:speed=3", {"unknown key 'speed'"});
  fails("brownian:motion=static", {"unknown key 'motion'"});
  fails("brownian:n=0", {"'n=0'"});
  fails("brownian:n=ten", {"'n=ten'"});
  fails("brownian:n=1e30", {"'n=1e30'"});
  fails("brownian:n=5,n=6", {"'n=6' again"});
  fails("brownian:n=5,", {"'' is not key=value"});
  fails("brownian:density=0", {"'density=0'"});
  fails("brownian:density=nan", {"'density=nan'"});
  fails("brownian:speed=-1", {"'speed=-1'"});
  fails("brownian:shape=prism",
        {"'shape=prism'", "cube, sphere, box, capsule", "ellipsoid, mixed"});
  fails("brownian:shape=box,spin=-1", {"'spin=-1'", "from 0"});
  fails("brownian:spin=2", {"'spin' needs a shape that turns"});
  fails("varied:spin=2,shape=sphere", {"'spin' needs a shape that turns"});
  fails("still:shape=box,spin=2", {"unknown key 'spin'", "shape, rounding, positions"});
  fails("brownian:positions=float16", {"float32"});
  fails("bullets:shape=box", {"unknown key 'shape'", "n, frames, seed, speed, dt, spin"});
  fails("bullets:density=1", {"unknown key 'density'"});
  expect_error({"generate", "bullets:n=4", "-o", path("out.aabb")}, {"out.aabb", "(.npz)"});
  expect_error({"run", "tornado:n=5"}, {"unknown generator 'tornado'"});
  expect_error({"generate", "still:n=3,frames=1", "-o", path("no/such/folder.npz")},
               {"folder.npz"});
  EXPECT_EQ(files(), 0u);
}

TEST_F(ErrorsTest, FilesThatAreNone) {
  expect_error({"run", path("absent.npz")}, {"absent.npz"});
  expect_error({"run", path("absent.aabb")}, {"absent.aabb"});
  expect_error({"pairs", path("absent.npz"), "-o", path("out.npz")}, {"absent.npz"});
  std::ofstream(path("text.npz")) << "this is no archive";
  expect_error({"run", path("text.npz")}, {"text.npz"});
  std::ofstream(path("short.aabb")) << "short";
  expect_error({"run", path("short.aabb")}, {"short.aabb"});
  EXPECT_EQ(files(), 2u);
}

TEST_F(ErrorsTest, ShapesOfNothing) {
  struct Case {
    uint8_t kind;
    void (*spoil)(io::SceneShapes&);
    std::string what;
  };
  const Case cases[] = {
      {4, [](io::SceneShapes&) {}, "a dop of k = 7 (6, 14, 18 or 26 was expected)"},
      {4,
       [](io::SceneShapes& s) {
         s.vertex_range[1] = {0, 0};
       },
       "a dop without vertices"},
      {5,
       [](io::SceneShapes& s) {
         s.vertex_range[1] = {0, 0};
       },
       "a hull without vertices"},
      {6,
       [](io::SceneShapes& s) {
         s.triangle_range[1] = {0, 0};
       },
       "a mesh without triangles"},
      {7,
       [](io::SceneShapes& s) {
         s.child_range[1] = {0, 0};
       },
       "a compound without children"},
      {7, [](io::SceneShapes& s) { s.kind[0] = 8; }, "a compound with a halfspace as a child"}};
  for (const auto& [kind, spoil, what] : cases) {
    io::SceneShapes shapes = shapes_with(kind);
    spoil(shapes);
    if (shapes.vertex_range[1][1] == 0) shapes.triangle_range[1] = {0, 0};
    const std::string text = "file.npz: shape_kind: shape 1 is " + what;
    write_scene(path("file.npz"), shapes);
    expect_error({"run", path("file.npz"), "--json", path("out.json")}, {text});
    expect_error({"verify", path("file.npz")}, {text});
    write_pairs(path("file.npz"), shapes);
    expect_error({"pairs", path("file.npz"), "-o", path("out.npz")}, {text});
    expect_error({"verify", path("file.npz")}, {text});
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, HalfspacesAgainstEachOther) {
  write_pairs(path("in.npz"), 8, 1);
  const std::string text = "no kernel for halfspace against halfspace";
  expect_error({"pairs", path("in.npz"), "-o", path("out.npz")}, {"in.npz: ", text});
  expect_error({"verify", path("in.npz")}, {"in.npz: ", "pair 0: ", text});
  io::PairsFile moving = *io::read_pairs(path("in.npz"));
  moving.a.displacement = {{0, 0, 0}};
  ASSERT_TRUE(io::write_pairs(path("in.npz"), moving));
  expect_error({"pairs", path("in.npz"), "-o", path("out.npz"), "--detail", "toi"},
               {"in.npz: ", text});
  expect_error({"verify", path("in.npz")}, {"in.npz: ", "pair 0: ", text});
  EXPECT_EQ(files(), 1u);
}

TEST_F(ErrorsTest, ControlCharactersDoNotBreakTheLine) {
  expect_error({"fro\nb"}, {"unknown command 'fro\\x0ab'"});
  expect_error({"generate", "brown\nian", "-o", path("x.npz")}, {"'brown\\x0aian'"});
  expect_error({"run", "brownian:n=\n5"}, {"'n=\\x0a5'"});
  expect_error({"run", "still:n=5", "--detail", "so\nme"}, {"'so\\x0ame'"});
  expect_error({"run", path("a\nb.npz")}, {"a\\x0ab.npz"});
  write_scene(path("a\nb.npz"), 4);
  expect_error({"run", path("a\nb.npz")}, {"a\\x0ab.npz: shape_kind"});
  expect_error({"verify", path("a\nb.npz")}, {"a\\x0ab.npz: shape_kind"});
  write_pairs(path("a\nb.npz"), 4);
  expect_error({"pairs", path("a\nb.npz"), "-o", path("x.npz")}, {"a\\x0ab.npz: shape_kind"});
  expect_error({"verify", path("a\nb.npz")}, {"a\\x0ab.npz: shape_kind"});
  write_pairs(path("a\nb.npz"), 2);
  const std::string table = run_command({"verify", path("a\nb.npz"), "--threads", "1"}).out;
  EXPECT_NE(table.find("a\\x0ab.npz"), std::string::npos) << table;
}

TEST_F(ErrorsTest, ForeignBytesDoNotReachTheTerminal) {
  const std::string steering =
      "\x1b]0;owned\x07\x9b"
      "31m\xff";
  const std::string shown = "\\x1b]0;owned\\x07\\x9b31m\\xff";
  expect_error({steering}, {"unknown command '" + shown + "'"});
  expect_error({"run", steering}, {shown});
  expect_error({"run", "still:n=" + steering}, {"'n=" + shown + "'"});
  expect_error({"run", "still:n=5", "--detail", steering}, {"'" + shown + "'"});
  expect_error({"run", "still:n=5", "--isa", steering}, {shown});
  expect_error({"run", "still:n=5", "--" + steering}, {shown});
  expect_error({"accuracy", "--pairs", steering}, {shown});
  const std::string endless(100'000, 'x');
  const std::string message = run_command({endless}).err;
  EXPECT_LT(message.size(), 1000u) << message;
}

TEST_F(ErrorsTest, OutputsOfAFailedRunDoNotAppear) {
  write_scene(path("scene.npz"), 2, 5, 3);
  expect_error({"run", path("scene.npz"), "--json", path("out.json"), "--pairs-out",
                path("out.npz"), "--page", path("out.html")},
               {"scene.npz", "position"});
  EXPECT_EQ(files(), 1u);
  // A file that existed before stays as it was.
  std::ofstream(path("out.json")) << "before";
  expect_error({"run", path("scene.npz"), "--json", path("out.json")}, {"scene.npz"});
  std::string text;
  std::ifstream(path("out.json")) >> text;
  EXPECT_EQ(text, "before");
}

TEST_F(ErrorsTest, OutputsThatCannotBeWritten) {
  const std::string scene = "still:n=5,frames=2";
  expect_error({"run", scene, "--json", path("no/folder.json")}, {"folder.json"});
  expect_error({"run", scene, "--pairs-out", path("no/folder.npz")}, {"folder.npz"});
  expect_error({"run", scene, "--page", path("no/folder.html")}, {"folder.html"});
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace carom::cli
