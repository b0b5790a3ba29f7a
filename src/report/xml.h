#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace tourmaline::report {

/// An element of VTK's XML: its name, its attributes, and the text up to the next tag.
struct XmlElement {
  std::string_view name;
  std::map<std::string, std::string, std::less<>> attributes;
  std::string_view text;

  /// Empty when there is no such attribute.
  std::string attribute(std::string_view key) const;
};

/// Calls `visit` for every opening tag of `text` in order. Knows what VTK's files consist of:
/// elements and quoted attributes; no entities, no comments, no CDATA. Throws CaseError, which
/// begins with `name`, when a tag does not end.
void for_each_element(std::string_view text, const std::string &name,
                      const std::function<void(const XmlElement &)> &visit);

}  // namespace tourmaline::report
