#include "io/models/read_model.h"

#include <string_view>
#include <utility>

#include "io/files/file.h"
#include "io/models/mjcf.h"
#include "io/models/urdf.h"
#include "io/models/xml_file.h"

namespace carom::io {
namespace {

class ModelReader final : public SceneReader {
 public:
  ModelReader(Model model, const SceneArrays& wanted) : model_(std::move(model)), wanted_(wanted) {}

  const SceneInfo& info() const override { return model_.info; }
  void want(const SceneArrays& wanted) override { wanted_ = wanted; }

  Result<void> read_frame(SceneFrame& frame) override {
    frame = model_.frame;
    if (!wanted_.orientation) frame.orientation.clear();
    return {};
  }

 private:
  Model model_;
  SceneArrays wanted_;
};

}  // namespace

bool names_model(const std::string& path) {
  return has_extension(path, ".urdf") || has_extension(path, ".xml") ||
         has_extension(path, ".mjcf");
}

Result<Model> read_model(const std::string& path) {
  Result<std::unique_ptr<XmlFile>> file = XmlFile::open(path);
  if (!file) return file.error();
  const Xml& root = (*file)->root();
  const std::string_view kind = root.Name();
  if (kind != "robot" && kind != "mujoco") {
    return xml_error(root, "is no model (a robot or mujoco element was expected)");
  }
  Result<Model> model = kind == "robot" ? read_urdf(root) : read_mjcf(root);
  if (!model) return model;
  model->info.name = stem_of(path);
  if (Result<void> checked = check_scene(model->info, path); !checked) return checked.error();
  return model;
}

Result<std::unique_ptr<SceneReader>> open_model(const std::string& path,
                                                const SceneArrays& wanted) {
  Result<Model> model = read_model(path);
  if (!model) return model.error();
  return std::unique_ptr<SceneReader>(std::make_unique<ModelReader>(std::move(*model), wanted));
}

}  // namespace carom::io
