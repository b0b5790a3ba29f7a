#include "material/library.h"

#include <fmt/format.h>

#include "case/given.h"
#include "case/nearest.h"
#include "library_text.h"
#include "material/completeness.h"
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

namespace {

// Where the file is none, its case says who asks for it.
std::vector<Entry> own_entries(const casefile::MaterialCase &asked) {
  try {
    return materials_in(*asked.file);
  } catch (const CaseError &error) {
    throw CaseError(asked.place() + " file: " + error.what());
  }
}

// Of an entry with all else that it lacks, so that one reading of the error is enough.
std::string mistake_of(const Entry &entry, const casefile::MaterialCase &asked) {
  const std::string lack =
      entry.is_read() ? missing_words(casefile::merged(entry.given, asked)) : "";
  return entry.mistake + (lack.empty() ? "" : "; the entry also lacks: " + lack);
}

}  // namespace

Entry find(const casefile::MaterialCase &asked) {
  const std::vector<Entry> own = asked.file ? own_entries(asked) : std::vector<Entry>{};
  std::vector<std::string> names;
  for (const Entry &entry : asked.file ? own : library()) {
    if (entry.name == *asked.library && !entry.mistake.empty())
      throw CaseError(mistake_of(entry, asked));
    if (entry.name == *asked.library)
      return entry;
    names.push_back(entry.name);
  }
  throw CaseError(fmt::format("{} library = \"{}\": no such material{}{}", asked.place(),
                              *asked.library, casefile::did_you_mean(*asked.library, names),
                              asked.file
                                  ? fmt::format("; {} has {}", *asked.file, fmt::join(names, ", "))
                                  : "; `tourmaline materials` lists them"));
}

}  // namespace tourmaline::material
