// XML documents whose elements know the file and line that they come from.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "carom/base/result.h"

namespace carom::io {

using Xml = tinyxml2::XMLElement;

class XmlFile {
 public:
  // Fails if the file cannot be read, is no XML, or nests elements deeper than tinyxml2 allows (100
  // or 500).
  static Result<std::unique_ptr<XmlFile>> open(const std::string& path);

  const Xml& root() const { return *document_.RootElement(); }

 private:
  explicit XmlFile(std::string path) : path_(std::move(path)) {}

  std::string path_;
  tinyxml2::XMLDocument document_;
};

// The file of an element, as it was named to open().
const std::string& file_of(const Xml& element);
// The value of an attribute, or "".
std::string attribute_of(const Xml& element, const char* attribute);

// An error "FILE:LINE: <element> 'name': text".
Error xml_error(const Xml& element, const std::string& text);

// Readers of models go on after an error, with numbers that do no harm, and ask here at the end.
class FirstError {
 public:
  void add(const Xml& element, const std::string& text) { add(xml_error(element, text)); }
  void add(Error error) {
    if (!error_) error_ = std::move(error);
  }
  bool is_there() const { return error_.has_value(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

// The numbers of an attribute, between `least` and `most` of them; none if it is absent or wrong.
// Each must be finite, in float32 too.
std::vector<double> numbers_of(const Xml& element, const char* attribute, size_t least, size_t most,
                               FirstError& errors);
// Writes the three numbers of an attribute to `out`; leaves it alone if there are none.
void read_vector(const Xml& element, const char* attribute, Eigen::Vector3d& out,
                 FirstError& errors);

// Reports attributes whose names are not in the list.
void expect_attributes(const Xml& element, std::initializer_list<std::string_view> known,
                       FirstError& errors);

}  // namespace carom::io
