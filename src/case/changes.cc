#include "case/changes.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace tourmaline::casefile {

namespace {

/// The path of the table that a line opens: [mesh.box], or [[boundary]], whose entries are counted;
/// a table inside an entry belongs to the last one.
class Place {
 public:
  void open(const std::string &line) {
    const bool entry = line.starts_with("[[");
    const std::size_t bracket = entry ? 2 : 1;
    const std::string name = line.substr(bracket, line.size() - 2 * bracket);
    if (entry)
      ++entries_[name];
    path_ = counted(name) + ".";
  }
  std::string of(const std::string &key) const { return path_ + key; }

 private:
  std::string counted(const std::string &name) const {
    const std::size_t dot = name.find('.');
    const std::string head = name.substr(0, dot);
    const auto entries = entries_.find(head);
    return (entries == entries_.end() ? head : fmt::format("{}[{}]", head, entries->second - 1)) +
           (dot == std::string::npos ? "" : name.substr(dot));
  }

  std::string path_;
  std::map<std::string, int> entries_;
};

/// By path of the key. Every key that `resolved` writes has a line of its own.
std::map<std::string, std::string> values(const std::string &text) {
  std::map<std::string, std::string> values;
  std::istringstream lines(text);
  Place place;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('#'))
      continue;
    else if (line.starts_with('['))
      place.open(line);
    else if (const std::size_t equals = line.find(" = "); equals != std::string::npos)
      values[place.of(line.substr(0, equals))] = line.substr(equals + 3);
  return values;
}

}  // namespace

std::vector<Change> changes(const std::string &then, const std::string &now) {
  const auto before = values(then), after = values(now);
  std::vector<Change> changes;
  for (const auto &[key, value] : before) {
    const auto found = after.find(key);
    if (found == after.end() || found->second != value)
      changes.push_back({key, value, found == after.end() ? "" : found->second});
  }
  for (const auto &[key, value] : after)
    if (!before.contains(key))
      changes.push_back({key, "", value});
  return changes;
}

}  // namespace tourmaline::casefile
