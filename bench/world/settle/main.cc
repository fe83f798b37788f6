// carom_settle SCENE.npz FRAMES OUT.npz [OPTION VALUE]...: lets the bodies of a scene fall from its
// last frame on until they rest, and writes what they did as a scene.
//   --skip N       frames that are not written, 0
//   --up y|z       if not the axis along which the bodies of the scene fall
//   --damping X    the share of their velocities that bodies lose in a frame, 0.02
//   --friction X   0.6
//   --substeps N   of the solver in a frame, 10
// Bodies are never put to sleep: the scene keeps the tremble that a solver leaves.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "bench/world/settle/heap.h"
#include "bench/world/settle/motion_shares.h"
#include "cli/scenes/player.h"
#include "io/scene.h"

namespace carom::bench {
namespace {

constexpr float kGravity = 9.81f;  // metres a second, squared
constexpr int kPrintEvery = 60;    // frames

struct Order {
  std::string scene, out;
  int frames = 0;
  int skip = 0;
  char up = 0;  // 0: as the scene says
  rigid::SolverSettings solver = {.damping = 0.02f};
};

bool set_option(Order& order, const char* name, const char* value) {
  const auto is = [name](const char* option) { return std::strcmp(name, option) == 0; };
  if (is("--skip")) order.skip = std::atoi(value);
  if (is("--up")) order.up = *value;
  if (is("--damping")) order.solver.damping = std::strtof(value, nullptr);
  if (is("--friction")) order.solver.friction = std::strtof(value, nullptr);
  if (is("--substeps")) order.solver.substeps = std::atoi(value);
  return is("--skip") || is("--up") || is("--damping") || is("--friction") || is("--substeps");
}

// Whether the command line makes sense.
bool read_order(int argc, char** argv, Order& order) {
  if (argc < 4 || argc % 2 != 0) return false;
  order.scene = argv[1];
  order.frames = std::atoi(argv[2]);
  order.out = argv[3];
  for (int i = 4; i < argc; i += 2) {
    if (!set_option(order, argv[i], argv[i + 1])) return false;
  }
  return order.skip >= 0 && order.frames > order.skip && order.solver.substeps > 0 &&
         (order.up == 0 || order.up == 'y' || order.up == 'z');
}

// The first and the last frame of a scene.
Result<void> read_ends(io::SceneReader& scene, io::SceneFrame& first, io::SceneFrame& last) {
  for (uint64_t i = 0; i < scene.info().frames; ++i) {
    if (const Result<void> read = scene.read_frame(last); !read) return read.error();
    if (i == 0) first = last;
  }
  return {};
}

// The written scene holds bodies and shapes as they were, and all that the heap writes.
io::SceneInfo written_info(const io::SceneInfo& read) {
  io::SceneInfo info = read;
  info.has_orientation = true;
  info.has_linear_velocity = true;
  info.has_angular_velocity = true;
  return info;
}

Result<void> run(Heap& heap, const Order& order, io::SceneWriter& writer) {
  MotionShares shares(heap);
  io::SceneFrame frame;
  for (int i = 1; i <= order.frames; ++i) {
    shares.start();
    heap.step();
    if (i % kPrintEvery == 0 || i == order.frames) shares.print(i);
    if (i <= order.skip) continue;
    heap.write(frame);
    if (const Result<void> written = writer.write_frame(frame); !written) return written.error();
  }
  return writer.finish();
}

Result<void> settle(Order order) {
  const auto scene = io::open_scene(order.scene);
  if (!scene) return scene.error();
  const io::SceneInfo& info = (*scene)->info();
  const Result<cli::Player> player = cli::Player::create(info, order.scene);
  if (!player) return player.error();
  // Refuses recordings of bounds, which have no shapes.
  Result<io::SceneWriter> writer = io::SceneWriter::create(order.out, written_info(info));
  if (!writer) return writer.error();
  io::SceneFrame first, last;
  if (const Result<void> read = read_ends(**scene, first, last); !read) return read.error();

  order.solver.dt = static_cast<float>(info.dt);
  Eigen::Vector3f down = find_down(*player, first, last);
  if (order.up == 'y') down = -Eigen::Vector3f::UnitY();
  if (order.up == 'z') down = -Eigen::Vector3f::UnitZ();
  order.solver.gravity = kGravity * down;
  Heap heap(*player, last, order.solver);
  std::printf("%zu bodies move, %c is up\n", heap.moving().size(), down.y() != 0 ? 'y' : 'z');
  return run(heap, order, *writer);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  carom::bench::Order order;
  if (!carom::bench::read_order(argc, argv, order)) {
    std::fprintf(stderr,
                 "usage: carom_settle SCENE.npz FRAMES OUT.npz [--skip N] [--up y|z] "
                 "[--damping SHARE] [--friction X] [--substeps N]\n");
    return 2;
  }
  const carom::Result<void> settled = carom::bench::settle(order);
  if (!settled) std::fprintf(stderr, "carom_settle: %s\n", settled.error().message.c_str());
  return settled ? 0 : 1;
}
