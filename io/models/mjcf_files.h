// The files of an MJCF model: the main one and those that it includes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/models/xml_file.h"

namespace carom::io {

class MjcfFiles {
 public:
  explicit MjcfFiles(const Xml& main) : main_(main) {}

  // Reads all included files; their names are relative to the folder of the main one. Fails if one
  // is included twice, as MuJoCo does, so that no file includes itself.
  Result<void> read_includes();

  const Xml& main() const { return main_; }

  // Calls visit(child) for all children. The children of an included file's root stand in the place
  // of the include.
  template <class Visit>
  void for_each_child(const Xml& parent, const Visit& visit) const {
    for (const Xml* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const auto included = included_.find(e);
      if (included == included_.end()) {
        visit(*e);
      } else {
        for_each_child(included->second->root(), visit);
      }
    }
  }

 private:
  Result<void> read_includes_of(const Xml& parent);
  Result<void> include(const Xml& element);

  const Xml& main_;
  std::map<const Xml*, std::unique_ptr<XmlFile>> included_;
  std::vector<std::string> paths_;  // without links
};

}  // namespace carom::io
