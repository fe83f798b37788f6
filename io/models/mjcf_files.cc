#include "io/models/mjcf_files.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files/file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

std::string without_links(const std::string& path) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  return error ? path : real.string();
}

}  // namespace

Result<void> MjcfFiles::read_includes() {
  paths_ = {without_links(file_of(main_))};
  return read_includes_of(main_);
}

Result<void> MjcfFiles::read_includes_of(const Xml& parent) {
  for (const Xml* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    Result<void> done =
        std::string_view(e->Name()) == "include" ? include(*e) : read_includes_of(*e);
    if (!done) return done;
  }
  return {};
}

Result<void> MjcfFiles::include(const Xml& element) {
  const std::string name = attribute_of(element, "file");
  if (name.empty()) return xml_error(element, "has no file");
  const std::string path =
      (std::filesystem::path(folder_of(file_of(main_))) / name).lexically_normal().string();
  const std::string real = without_links(path);
  if (std::find(paths_.begin(), paths_.end(), real) != paths_.end()) {
    return xml_error(element, quoted_name(name) + " is included again");
  }
  paths_.push_back(real);
  Result<std::unique_ptr<XmlFile>> file = XmlFile::open(path);
  if (!file) return xml_error(element, file.error().message);
  const Xml& root = (*file)->root();
  included_.emplace(&element, std::move(*file));
  return read_includes_of(root);
}

}  // namespace carom::io
