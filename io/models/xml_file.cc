#include "io/models/xml_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include "io/files/file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Whatever the locale, unlike the conversions of tinyxml2.
std::optional<double> number_from(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_whole = error == std::errc() && end == word.data() + word.size();
  // NaN is not below anything.
  if (!is_whole || !(std::fabs(value) <= double{std::numeric_limits<float>::max()})) {
    return std::nullopt;
  }
  return value;
}

std::string expected_count(size_t least, size_t most) {
  if (least == most) return std::to_string(least) + (least == 1 ? " number" : " numbers");
  return std::to_string(least) + " to " + std::to_string(most) + " numbers";
}

Result<std::string> text_of(const std::string& path) {
  Result<File> file = File::open(path, "a model");
  if (!file) return file.error();
  Result<uint64_t> size = file->size(path);
  if (!size) return size.error();
  std::string text(*size, '\0');
  Result<void> read =
      file->read_at(0, std::as_writable_bytes(std::span(text.data(), text.size())), path);
  if (!read) return read.error();
  return text;
}

}  // namespace

Result<std::unique_ptr<XmlFile>> XmlFile::open(const std::string& path) {
  const Result<std::string> text = text_of(path);
  if (!text) return text.error();
  std::unique_ptr<XmlFile> file(new XmlFile(path));
  tinyxml2::XMLDocument& document = file->document_;
  document.SetUserData(&file->path_);
  document.Parse(text->data(), text->size());
  if (document.Error()) {
    const std::string line = std::to_string(document.ErrorLineNum());
    return file_error(path + ":" + line,
                      std::string("cannot be read as XML (") + document.ErrorName() + ")");
  }
  if (document.RootElement() == nullptr) return file_error(path, "holds no XML element");
  return file;
}

const std::string& file_of(const Xml& element) {
  return *static_cast<const std::string*>(element.GetDocument()->GetUserData());
}

std::string attribute_of(const Xml& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return value == nullptr ? "" : value;
}

Error xml_error(const Xml& element, const std::string& text) {
  std::string what = "<" + printable_name(element.Name()) + ">";
  if (const char* name = element.Attribute("name")) what += " " + quoted_name(name);
  return {file_of(element) + ":" + std::to_string(element.GetLineNum()) + ": " + what + ": " +
          text};
}

std::vector<double> numbers_of(const Xml& element, const char* attribute, size_t least, size_t most,
                               FirstError& errors) {
  const char* value = element.Attribute(attribute);
  if (value == nullptr) return {};
  std::vector<double> numbers;
  std::string_view rest = value;
  while (true) {
    while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
    if (rest.empty()) break;
    const auto end = std::find_if(rest.begin(), rest.end(), is_space);
    const std::string_view word = rest.substr(0, static_cast<size_t>(end - rest.begin()));
    const std::optional<double> number = number_from(word);
    if (!number) {
      errors.add(element, std::string(attribute) + " holds " + quoted_name(word) +
                              " (a finite number was expected)");
      return {};
    }
    numbers.push_back(*number);
    rest.remove_prefix(word.size());
  }
  if (numbers.size() >= least && numbers.size() <= most) return numbers;
  errors.add(element, std::string(attribute) + " holds " + std::to_string(numbers.size()) +
                          " numbers (" + expected_count(least, most) + " expected)");
  return {};
}

void read_vector(const Xml& element, const char* attribute, Eigen::Vector3d& out,
                 FirstError& errors) {
  const std::vector<double> numbers = numbers_of(element, attribute, 3, 3, errors);
  if (!numbers.empty()) out = Eigen::Map<const Eigen::Vector3d>(numbers.data());
}

void expect_attributes(const Xml& element, std::initializer_list<std::string_view> known,
                       FirstError& errors) {
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (std::find(known.begin(), known.end(), a->Name()) != known.end()) continue;
    errors.add(element, "has the unknown attribute " + quoted_name(a->Name()));
  }
}

}  // namespace carom::io
