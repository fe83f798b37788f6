// carom_ray_peers [--smoke]: rays against one mesh of triangles, Carom beside Embree, on one
// thread. Closest hits and any hits; coherent rays of a camera, and random ones. Prints a table in
// Markdown. Exit code 1 if the hits differ by more than rays at edges may.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <vector>

#include "bench/peers/queries/fastest_pass.h"
#include "carom/queries/cast.h"
#include "carom/shapes/mesh_geometry.h"
#include "oracle/random.h"

namespace carom::bench {
namespace {

using Eigen::Vector3f;

struct Triangles {
  std::vector<Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

Triangles terrain(uint32_t n) {
  Triangles mesh;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      const float x = 100.0f * float(i) / float(n), y = 100.0f * float(j) / float(n);
      mesh.vertices.push_back(
          {x, y, 4 * std::sin(0.3f * x) * std::cos(0.2f * y) + std::sin(2 * x + y)});
      if (i == n || j == n) continue;
      const uint32_t at = i * (n + 1) + j;
      mesh.triangles.push_back({at, at + n + 1, at + n + 2});
      mesh.triangles.push_back({at, at + n + 2, at + 1});
    }
  }
  return mesh;
}

struct RayList {
  const char* name;
  std::vector<Vector3f> origins, ways;
};

RayList camera_rays(size_t side) {
  RayList rays{"coherent", {}, {}};
  for (size_t i = 0; i < side; ++i) {
    for (size_t j = 0; j < side; ++j) {
      const float u = float(i) / float(side) - 0.5f, v = float(j) / float(side) - 0.5f;
      rays.origins.push_back({50, -40, 40});
      rays.ways.push_back(Vector3f(u, 1, v - 0.5f).normalized() * 250);
    }
  }
  return rays;
}

RayList random_rays(size_t count) {
  RayList rays{"random", {}, {}};
  oracle::Random random(1);
  for (size_t i = 0; i < count; ++i) {
    rays.origins.push_back({static_cast<float>(random.uniform(0, 100)),
                            static_cast<float>(random.uniform(0, 100)),
                            static_cast<float>(random.uniform(-5, 20))});
    rays.ways.push_back((random.direction() * 250).cast<float>());
  }
  return rays;
}

// The times of all hits; infinite where there is none.
using Times = std::vector<float>;

class Embree {
 public:
  explicit Embree(const Triangles& mesh) : device_(rtcNewDevice("threads=1")) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
      std::copy_n(mesh.vertices[i].data(), 3, vertices + 3 * i);
    }
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), mesh.triangles.size()));
    std::copy_n(mesh.triangles[0].data(), 3 * mesh.triangles.size(), indices);
    rtcCommitGeometry(geometry);
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void run(const RayList& rays, bool any, Times& times) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (size_t i = 0; i < rays.origins.size(); ++i) {
      const Vector3f &o = rays.origins[i], &d = rays.ways[i];
      RTCRayHit hit;
      hit.ray = {o.x(), o.y(), o.z(), 0, d.x(), d.y(), d.z(), 0, 1, ~0u, 0, 0};
      hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      if (any) {
        rtcOccluded1(scene_, &context, &hit.ray);
        times[i] = hit.ray.tfar < 0 ? 0 : INFINITY;
      } else {
        rtcIntersect1(scene_, &context, &hit);
        times[i] = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : hit.ray.tfar;
      }
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

class Carom {
 public:
  explicit Carom(const Triangles& mesh) : geometry_(*make_mesh(mesh.vertices, mesh.triangles)) {
    rows_ = shape_rows(Mesh{geometry_});
    body_ = points(position_, 1);
    body_.uniform_kind = ShapeKind::mesh;
    body_.rows.data = rows_[0].data();
  }

  void run(const RayList& rays, bool any, Times& times) {
    const Rays list(rays.origins[0].data(), rays.ways[0].data(), rays.origins.size(), 1);
    if (!cast(list.queries(), list.sweep(), body_, hits_,
              {.hits = any ? CastHits::any : CastHits::closest})) {
      return;
    }
    std::fill(times.begin(), times.end(), INFINITY);
    for (const CastHit& hit : hits_) times[hit.query] = hit.toi;
  }

 private:
  const std::shared_ptr<const MeshGeometry> geometry_;
  std::array<std::array<float, 4>, kMostRows> rows_;
  float position_[3] = {};
  Collidables body_;
  std::vector<CastHit> hits_;
};

size_t differences(const Times& a, const Times& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const bool both = a[i] <= 1 && b[i] <= 1;
    count += both ? std::abs(a[i] - b[i]) > 1e-4f : (a[i] <= 1) != (b[i] <= 1);
  }
  return count;
}

int run(bool smoke) {
  const Triangles mesh = terrain(smoke ? 50 : 400);
  const Embree embree(mesh);
  Carom carom(mesh);
  const size_t side = smoke ? 64 : 512;
  bool same = true;
  std::printf("%zu triangles; ns a ray; ratio: Embree / Carom\n\n", mesh.triangles.size());
  std::printf(
      "| rays | hits | share that hits | Embree | Carom | ratio |\n|---|---|---|---|---|---|\n");
  for (const RayList& rays : {camera_rays(side), random_rays(side * side)}) {
    for (const bool any : {false, true}) {
      const size_t count = rays.origins.size();
      Times theirs(count), ours(count);
      const int passes = smoke ? 1 : 5;
      const double of_embree = fastest_pass(count, passes, [&] { embree.run(rays, any, theirs); });
      const double of_carom = fastest_pass(count, passes, [&] { carom.run(rays, any, ours); });
      const auto hits = std::count_if(ours.begin(), ours.end(), [](float t) { return t <= 1; });
      same = same && differences(ours, theirs) * 10'000 <= count;
      std::printf("| %s | %s | %.2f | %.0f | %.0f | %.2f |\n", rays.name, any ? "any" : "closest",
                  double(hits) / double(count), of_embree, of_carom, of_embree / of_carom);
    }
  }
  if (!same) std::fprintf(stderr, "carom_ray_peers: the hits differ\n");
  return same ? 0 : 1;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  return carom::bench::run(argc > 1 && std::string_view(argv[1]) == "--smoke");
}
