// For tests of models: files of text, and where bodies are.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "io/models/read_model.h"
#include "tests/io/io_test_util.h"

namespace carom::io {

class ModelTest : public TemporaryFolder {
 protected:
  // Reads the text as a file of this name, which must be a good model.
  Model model_of(const std::string& name, const std::string& text) {
    Result<Model> model = read_model(write_file(name, text));
    EXPECT_TRUE(succeeds(model));
    return model ? std::move(*model) : Model();
  }

  // The error of a file, without the folder.
  std::string error_of(const std::string& name, const std::string& text) {
    std::string message = message_of(read_model(write_file(name, text)));
    const std::string folder = path("");
    for (size_t at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
      message.erase(at, folder.size());
    }
    return message;
  }
};

inline ShapeKind kind_of(const Model& model, size_t body) {
  return static_cast<ShapeKind>(model.info.shapes.kind[model.info.body_shape[body]]);
}

inline std::array<float, 8> params_of(const Model& model, size_t body) {
  return model.info.shapes.params[model.info.body_shape[body]];
}

inline Eigen::Vector3d position_of(const Model& model, size_t body) {
  return Eigen::Map<const Eigen::Vector3d>(&model.frame.position64[3 * body]);
}

inline Eigen::Quaterniond orientation_of(const Model& model, size_t body) {
  return Eigen::Quaternionf(&model.frame.orientation[4 * body]).cast<double>();
}

// Where the body has this point of its frame, up to the rounding of float32.
inline ::testing::AssertionResult has_at(const Model& model, size_t body,
                                         const Eigen::Vector3d& own, const Eigen::Vector3d& at) {
  const Eigen::Vector3d found = position_of(model, body) + orientation_of(model, body) * own;
  if ((found - at).norm() < 2e-6) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "(" << found.transpose() << ")";
}

}  // namespace carom::io
