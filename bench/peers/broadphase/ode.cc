// ODE: the spaces dHashSpace, dQuadTreeSpace and dSweepAndPruneSpace, with unrotated dGeomBox.
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/peers/broadphase/peer.h"

namespace carom::bench {
namespace {

struct Library {
  Library() { dInitODE2(0); }
  ~Library() { dCloseODE(); }
};

// The axes of the world, longest first: the quadtree divides the first two, the sweep sorts along
// the first.
using AxisOrder = std::array<size_t, 3>;

AxisOrder longest_first(const Box& world) {
  const auto extent = [&](size_t axis) { return world.upper[axis] - world.lower[axis]; };
  AxisOrder order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return extent(a) > extent(b); });
  return order;
}

struct Span {
  dReal centre;
  dReal half;

  // ODE takes centres and lengths, which round. One ulp of the larger coordinate is added, so that
  // no touching pair is lost. The length is never zero, because ODE ignores boxes with an edge of
  // length zero.
  static Span covering(float lower, float upper) {
    using Limits = std::numeric_limits<float>;
    const dReal largest = std::max(std::abs(lower), std::abs(upper));
    return {(dReal{lower} + upper) / 2,
            (dReal{upper} - lower) / 2 + Limits::epsilon() * largest + Limits::min()};
  }
};

// Tests pairs again, because the boxes are slightly too large.
class OdePeer final : public Peer {
 public:
  OdePeer(dSpaceID space, const FrameBounds& first, const AxisOrder& order)
      : space_(space), order_(order), boxes_(first.boxes.begin(), first.boxes.end()) {
    for (size_t i = 0; i < boxes_.size(); ++i) {
      geoms_.push_back(dCreateBox(nullptr, 1, 1, 1));
      dGeomSetData(geoms_[i], reinterpret_cast<void*>(i));
      place(i);
      dSpaceAdd(space_, geoms_[i]);
    }
  }
  OdePeer(const OdePeer&) = delete;
  OdePeer& operator=(const OdePeer&) = delete;
  ~OdePeer() override { dSpaceDestroy(space_); }  // and its geoms

  void update(const FrameBounds& frame) override {
    for (size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i] == frame.boxes[i]) continue;
      boxes_[i] = frame.boxes[i];
      place(i);
    }
  }

  void find(std::vector<Pair>& pairs) override {
    pairs.clear();
    pairs_ = &pairs;
    dSpaceCollide(space_, this, collect);
  }

 private:
  void place(size_t i) {
    const auto span = [&](size_t axis) {
      return Span::covering(boxes_[i].lower[order_[axis]], boxes_[i].upper[order_[axis]]);
    };
    const std::array<Span, 3> spans = {span(0), span(1), span(2)};
    dGeomSetPosition(geoms_[i], spans[0].centre, spans[1].centre, spans[2].centre);
    dGeomBoxSetLengths(geoms_[i], 2 * spans[0].half, 2 * spans[1].half, 2 * spans[2].half);
  }

  static void collect(void* data, dGeomID a, dGeomID b) {
    auto& self = *static_cast<OdePeer*>(data);
    const Pair pair = {index(a), index(b)};
    if (overlap(self.boxes_[pair.a], self.boxes_[pair.b])) self.pairs_->push_back(pair);
  }
  static uint32_t index(dGeomID geom) {
    return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(dGeomGetData(geom)));
  }

  dSpaceID space_;
  AxisOrder order_;
  std::vector<Box> boxes_;
  std::vector<dGeomID> geoms_;
  std::vector<Pair>* pairs_ = nullptr;
};

dSpaceID hash_space(const FrameBounds& /*first*/, const Box& /*world*/, const AxisOrder&) {
  return dHashSpaceCreate(nullptr);
}

// About as many leaves as boxes.
dSpaceID quadtree_space(const FrameBounds& first, const Box& world, const AxisOrder& order) {
  const int depth = static_cast<int>(std::log2(static_cast<double>(first.boxes.size())) / 2);
  dVector3 centre = {};
  dVector3 half = {};
  for (size_t axis = 0; axis < 3; ++axis) {
    const Span span = Span::covering(world.lower[order[axis]], world.upper[order[axis]]);
    centre[axis] = span.centre;
    half[axis] = span.half;
  }
  return dQuadTreeSpaceCreate(nullptr, centre, half, std::max(depth, 1));
}

dSpaceID sweep_space(const FrameBounds& /*first*/, const Box& /*world*/, const AxisOrder&) {
  return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
}

template <dSpaceID (*kCreate)(const FrameBounds&, const Box&, const AxisOrder&)>
std::unique_ptr<Peer> make(const FrameBounds& first, const Box& world) {
  static const Library library;
  const AxisOrder order = longest_first(world);
  return std::make_unique<OdePeer>(kCreate(first, world, order), first, order);
}

}  // namespace

std::vector<PeerKind> ode_kinds() {
  constexpr size_t kMostHashed = 100'000;  // the hash space keeps one bit for every pair of boxes
  return {{"ode_hash", 1, kMostHashed, make<hash_space>},
          {"ode_quadtree", 1, kAnyNumber, make<quadtree_space>},
          {"ode_sweep", 1, kAnyNumber, make<sweep_space>}};
}

}  // namespace carom::bench
