#include "material/library.h"

#include <fmt/format.h>

#include "case/nearest.h"
#include "library_text.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

const std::vector<Entry> &library() {
  static const std::vector<Entry> entries =
      casefile::read_materials(std::string(library_text), "library");
  return entries;
}

std::vector<Entry> materials_in(const std::string &file) {
  return casefile::read_materials(std::filesystem::path(file));
}

Entry find(const casefile::MaterialCase &asked) {
  const std::vector<Entry> own = asked.file ? materials_in(*asked.file) : std::vector<Entry>{};
  std::vector<std::string> names;
  for (const Entry &entry : asked.file ? own : library()) {
    if (entry.name == *asked.library && !entry.mistake.empty())
      throw CaseError(entry.mistake);
    if (entry.name == *asked.library)
      return entry;
    names.push_back(entry.name);
  }
  throw CaseError(fmt::format(
      "{} library = \"{}\": no such material{}{}", asked.where.empty() ? "[material]" : asked.where,
      *asked.library, casefile::did_you_mean(*asked.library, names),
      asked.file ? fmt::format("; {} has {}", *asked.file, fmt::join(names, ", "))
                 : "; `tourmaline materials` lists them"));
}

}  // namespace tourmaline::material
