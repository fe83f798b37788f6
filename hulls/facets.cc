#include "hulls/facets.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <unordered_map>

namespace carom::hulls {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// One run of Qhull and its results.
class QhullRun {
 public:
  // Messages go to `messages`. The points must live as long as the run.
  explicit QhullRun(std::FILE* messages) : messages_(messages) { qh_zero(&qh_, messages); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left, bytes;
    qh_memfreeshort(&qh_, &left, &bytes);
  }

  // Returns false if Qhull failed.
  bool run(std::vector<double>& coordinates, const char* options) {
    std::string command = std::string("qhull ") + options;
    const int points = static_cast<int>(coordinates.size() / 3);
    return qh_new_qhull(&qh_, 3, points, coordinates.data(), False, command.data(), nullptr,
                        messages_) == qh_ERRnone;
  }

  Facets facets() {
    Facets facets;
    facets.thickness = std::max(qh_.max_outside, -qh_.min_vertex);
    std::unordered_map<const facetT*, uint32_t> index;
    for (const facetT* f = qh_.facet_list; f && f->next; f = f->next) {
      index.emplace(f, static_cast<uint32_t>(index.size()));
    }
    for (const facetT* f = qh_.facet_list; f && f->next; f = f->next) {
      Facet& facet = facets.list.emplace_back();
      facet.normal = Eigen::Vector3d(f->normal);
      for_each<vertexT>(f->vertices, [&](vertexT* vertex) {
        facet.vertices.push_back(static_cast<uint32_t>(qh_pointid(&qh_, vertex->point)));
      });
      for_each<facetT>(f->neighbors, [&](facetT* neighbor) {
        if (const auto found = index.find(neighbor); found != index.end()) {
          facet.neighbors.push_back(found->second);
        }
      });
    }
    return facets;
  }

 private:
  // Sets end with a null pointer.
  template <class Element, class Visit>
  static void for_each(const setT* set, const Visit& visit) {
    if (set == nullptr) return;
    for (const setelemT* e = set->e; e->p != nullptr; ++e) visit(static_cast<Element*>(e->p));
  }

  std::FILE* messages_;
  qhT qh_;
};

}  // namespace

std::optional<Facets> find_facets(std::span<const Eigen::Vector3d> points, bool joggle) {
  if (points.size() > size_t{std::numeric_limits<int>::max()}) return std::nullopt;
  const std::unique_ptr<std::FILE, CloseFile> messages(std::fopen("/dev/null", "w"));
  if (!messages) return std::nullopt;
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  QhullRun qhull(messages.get());
  if (!qhull.run(coordinates, joggle ? "QJ Pp" : "Pp")) return std::nullopt;
  Facets facets = qhull.facets();
  if (joggle) facets.thickness = std::numeric_limits<double>::infinity();
  return facets;
}

}  // namespace carom::hulls
