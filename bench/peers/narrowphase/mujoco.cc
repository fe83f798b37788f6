// MuJoCo: the colliders of its table of pairs, called with a model that holds one geom a side, or
// one for each hull; the pose and the size of a body are written into it before the call. It has no
// distances.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "bench/peers/narrowphase/pair_peer.h"

namespace carom::bench {
namespace {

mjtGeom geom_type(PeerShape shape) {
  switch (shape) {
    case PeerShape::sphere:
      return mjGEOM_SPHERE;
    case PeerShape::capsule:
      return mjGEOM_CAPSULE;
    case PeerShape::hull:
      return mjGEOM_MESH;
    default:
      return mjGEOM_BOX;
  }
}

// Meshes without faces: MuJoCo makes the hull of their points.
void write_meshes(std::ostream& out, const PeerBodies& bodies, char side) {
  for (size_t i = 0; i < bodies.hulls.size(); ++i) {
    out << "<mesh name='" << side << i << "' vertex='";
    for (const auto& point : bodies.hulls[i].points) {
      for (const float x : point) out << x << ' ';
    }
    out << "'/>";
  }
}

void write_geoms(std::ostream& out, const PeerBodies& bodies, char side) {
  for (size_t i = 0; i < bodies.hulls.size(); ++i) {
    out << "<geom type='mesh' mesh='" << side << i << "'/>";
  }
  if (bodies.shape == PeerShape::sphere) out << "<geom type='sphere' size='1'/>";
  if (bodies.shape == PeerShape::capsule) out << "<geom type='capsule' size='1 1'/>";
  if (bodies.shape == PeerShape::box) out << "<geom type='box' size='1 1 1'/>";
}

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

Model make_model(const PeerBodies& a, const PeerBodies& b, PeerDetail detail) {
  std::ostringstream text;
  text.precision(9);
  text << "<mujoco><option><flag multiccd='"
       << (detail == PeerDetail::manifold ? "enable" : "disable") << "'/></option><asset>";
  write_meshes(text, a, 'a');
  write_meshes(text, b, 'b');
  text << "</asset><worldbody>";
  write_geoms(text, a, 'a');
  write_geoms(text, b, 'b');
  text << "</worldbody></mujoco>";
  const std::string xml = text.str();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "pairs.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  std::array<char, 1000> error = {};
  Model model(mj_loadXML("pairs.xml", files.get(), error.data(), error.size()), mj_deleteModel);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
  return model;
}

// A body with the pose of its geom: capsules lie along z, those of the streams along y, and
// MuJoCo moves a mesh to its centre of mass and turns it to its axes of inertia.
struct Body {
  int geom;
  std::array<mjtNum, 3> size;
  std::array<mjtNum, 3> position;
  std::array<mjtNum, 9> turn;
};

class Bodies {
 public:
  Bodies(const PeerBodies& source, const mjModel& model, int first_geom) {
    for (const PeerBody& body : source.bodies) {
      bodies_.push_back(make_body(source.shape, body, model, first_geom));
    }
  }

  size_t count() const { return bodies_.size(); }

  // Writes body i into the model and returns its geom.
  int put(size_t i, mjModel& model, mjData& data) const {
    const Body& body = bodies_[i];
    std::copy(body.size.begin(), body.size.end(), model.geom_size + 3 * body.geom);
    std::copy(body.position.begin(), body.position.end(), data.geom_xpos + 3 * body.geom);
    std::copy(body.turn.begin(), body.turn.end(), data.geom_xmat + 9 * body.geom);
    return body.geom;
  }

 private:
  static Body make_body(PeerShape shape, const PeerBody& source, const mjModel& model,
                        int first_geom) {
    Body body = {
        .geom = first_geom + static_cast<int>(source.hull), .size = {}, .position = {}, .turn = {}};
    std::copy_n(source.size.begin(), 3, body.size.begin());
    const mjtNum* const own_size = model.geom_size + 3 * body.geom;
    if (shape == PeerShape::hull) std::copy_n(own_size, 3, body.size.begin());

    const auto& p = source.position;
    const auto& q = source.orientation;
    const std::array<mjtNum, 3> position = {p[0], p[1], p[2]};
    std::array<mjtNum, 4> orientation = {q[3], q[0], q[1], q[2]};
    mju_normalize4(orientation.data());
    const mjtNum* const own_position = model.geom_pos + 3 * body.geom;
    std::array<mjtNum, 4> own_turn;
    std::copy_n(model.geom_quat + 4 * body.geom, 4, own_turn.begin());
    if (shape == PeerShape::capsule) own_turn = {std::sqrt(0.5), -std::sqrt(0.5), 0, 0};
    std::array<mjtNum, 4> turn;
    mju_mulPose(body.position.data(), turn.data(), position.data(), orientation.data(),
                own_position, own_turn.data());
    mju_quat2Mat(body.turn.data(), turn.data());
    return body;
  }

  std::vector<Body> bodies_;
};

class MujocoPairs final : public PairPeer {
 public:
  MujocoPairs(const PeerBodies& a, const PeerBodies& b, PeerDetail detail)
      : model_(make_model(a, b, detail)),
        data_(mj_makeData(model_.get()), mj_deleteData),
        a_(a, *model_, 0),
        b_(b, *model_, std::max(1, static_cast<int>(a.hulls.size()))),
        collide_(mjCOLLISIONFUNC[geom_type(a.shape)][geom_type(b.shape)]) {}

  void run(PairAnswers& answers) override {
    std::array<mjContact, mjMAXCONPAIR> contacts;
    for (size_t i = 0; i < a_.count(); ++i) {
      const int a = a_.put(i, *model_, *data_);
      const int b = b_.put(i, *model_, *data_);
      const int found = collide_(model_.get(), data_.get(), contacts.data(), a, b, 0);
      float separation = kNotReported;
      for (int contact = 0; contact < found; ++contact) {
        const mjtNum distance = contacts[static_cast<size_t>(contact)].dist;
        separation = std::fmin(separation, static_cast<float>(distance));
      }
      answers.separations[i] = separation;
      answers.overlaps[i] = found > 0 ? 1 : 0;
    }
  }

 private:
  Model model_;
  Data data_;
  const Bodies a_, b_;
  const mjfCollision collide_;
};

bool is_known(PeerShape shape) {
  return shape == PeerShape::sphere || shape == PeerShape::capsule || shape == PeerShape::box ||
         shape == PeerShape::hull;
}

}  // namespace

std::unique_ptr<PairPeer> make_mujoco_pairs(const PeerBodies& a, const PeerBodies& b,
                                            PeerDetail detail) {
  if (!is_known(a.shape) || !is_known(b.shape) || detail == PeerDetail::distance) return nullptr;
  return std::make_unique<MujocoPairs>(a, b, detail);
}

}  // namespace carom::bench
