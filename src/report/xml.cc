#include "report/xml.h"

#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

constexpr std::string_view blank = " \t\r\n";

/// key="value" pairs until the tag is used up.
void read_attributes(std::string_view tag, XmlElement &element) {
  while (true) {
    const std::size_t begin = tag.find_first_not_of(blank);
    const std::size_t equals = tag.find('=', begin == std::string_view::npos ? 0 : begin);
    if (begin == std::string_view::npos || equals == std::string_view::npos)
      return;
    const std::size_t open = tag.find('"', equals);
    const std::size_t close = open == std::string_view::npos ? open : tag.find('"', open + 1);
    if (close == std::string_view::npos)
      return;
    element.attributes.emplace(tag.substr(begin, equals - begin),
                               tag.substr(open + 1, close - open - 1));
    tag.remove_prefix(close + 1);
  }
}

}  // namespace

std::string XmlElement::attribute(std::string_view key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string() : found->second;
}

void for_each_element(std::string_view text, const std::string &name,
                      const std::function<void(const XmlElement &)> &visit) {
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos)
      throw CaseError(name + ": the file ends inside a tag; it is not whole");
    const std::string_view tag = text.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.empty() || tag[0] == '/' || tag[0] == '?')
      continue;
    XmlElement element;
    element.name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    read_attributes(tag.substr(element.name.size()), element);
    element.text = text.substr(at, text.find('<', at) - at);
    visit(element);
  }
}

}  // namespace tourmaline::report
