#include "run/resumption.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "case/changes.h"
#include "case/resolved.h"
#include "case/toml_text.h"
#include "output/result_folder.h"
#include "parallel/ranks.h"
#include "run/schedule.h"
#include "run/start_state.h"
#include "run/versions.h"
#include "tourmaline/error.h"
#include "whole_file.h"

namespace tourmaline::run {

namespace {

namespace fs = std::filesystem;

// FNV-1a, 64 bits: tells a changed file from the one before, not from a forged one.
class Digest {
 public:
  template <class Number>
  void add(std::span<const Number> values) {
    for (const std::byte byte : std::as_bytes(values))
      value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211U;
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 14695981039346656037U;
};

// Of what was read, not of the file: a geometry may include others.
std::string digest(const casefile::MeshFile &mesh) {
  Digest digest;
  for (const auto &point : mesh.points)
    digest.add(std::span<const double>(point));
  digest.add(std::span<const std::uint32_t>(mesh.cells));
  digest.add(std::span<const std::uint32_t>(mesh.facets));
  for (const casefile::Groups *groups : {&mesh.regions, &mesh.boundaries}) {
    digest.add(std::span<const int>(groups->set_of));
    for (const std::string &name : groups->names)
      digest.add(std::span<const char>(name));
    for (const std::vector<int> &set : groups->sets)
      digest.add(std::span<const int>(set));
  }
  return digest.text();
}

std::string text_in(const fs::path &file) {
  return whole_file(file).value_or("");
}

std::string digest_of_file(const fs::path &file) {
  Digest digest;
  digest.add(std::span<const char>(text_in(file)));
  return digest.text();
}

// Of a run that is over.
nlohmann::json summary_in(const fs::path &directory) {
  const fs::path file = directory / "summary.json";
  auto json = nlohmann::json::parse(text_in(file), nullptr, false);
  if (!json.is_object())
    throw MachineError(file.string() +
                       " is damaged, and nothing else says whether the results are whole; start "
                       "again without --resume");
  return json;
}

// The digests that a run which is over has left.
std::map<std::string, std::string> contents_in(const nlohmann::json &json) {
  std::map<std::string, std::string> digests;
  if (json.contains("inputs") && json["inputs"].is_object())
    for (const auto &[file, digest] : json["inputs"].items())
      digests[file] = digest.is_string() ? digest.get<std::string>() : "";
  return digests;
}

std::string inputs(const std::string &resolved, const std::string &friction_name,
                   const std::map<std::string, std::string> &digests) {
  std::string text = resolved;
  if (!friction_name.empty())
    text += fmt::format("\n[program]\nfriction = {}\n", friction_name);
  text += "\n[contents]\n";
  for (const auto &[file, digest] : digests)
    text += fmt::format("{} = {}\n", file, digest);
  return text;
}

constexpr std::string_view contents = "contents.";  // of keys that are files
constexpr std::string_view friction = "program.friction";

std::string words_of_laws(const casefile::Change &change) {
  const auto law = [](const std::string &name) {
    return name.empty() ? "that of the case" : fmt::format("\"{}\" of a program", name);
  };
  return fmt::format("the friction law was {}, is {}", law(change.then), law(change.now));
}

std::string words(const casefile::Change &change) {
  if (change.key.starts_with(contents))
    return fmt::format("the content of {} has changed", change.key.substr(contents.size()));
  if (change.key == friction)
    return words_of_laws(change);
  constexpr std::size_t most = 200;  // of a table of values
  const auto value = [](const std::string &text) {
    if (text.size() > most)
      return casefile::shortened(text);
    return text.empty() ? "not given" : text;
  };
  return fmt::format("{} was {}, is {}", change.key, value(change.then), value(change.now));
}

void require_same(const std::string &then, const std::string &now, const fs::path &directory) {
  if (const std::string list = differences(then, now); !list.empty())
    throw CaseError(fmt::format(
        "{} holds a run of another case, which --resume cannot go on with: {}. Give the same case, "
        "choose another folder with -o, or start again without --resume, which removes that run",
        directory.string(), list));
}

void require_same_ranks(const output::Checkpoint &checkpoint, const fs::path &directory) {
  if (checkpoint.ranks == static_cast<std::uint64_t>(parallel::n_ranks()))
    return;
  throw CaseError(fmt::format(
      "the run in {} has {} MPI ranks, this process has {}; go on with mpirun -np {}, or start "
      "again without --resume",
      directory.string(), checkpoint.ranks, parallel::n_ranks(), checkpoint.ranks));
}

void require_same_program(const output::Checkpoint &checkpoint, const fs::path &directory) {
  if (checkpoint.program != program_version())
    throw MachineError(fmt::format(
        "the run in {} is one of Tourmaline {}, this is {}; go on with that version, or start "
        "again without --resume",
        directory.string(), checkpoint.program, program_version()));
}

// All field files together, among the summary's files.
constexpr std::array field_groups{"result_*", "contact_*"};

bool is_of_fields(const std::string &name) {
  return std::find(field_groups.begin(), field_groups.end(), name) != field_groups.end();
}

int size_of(const nlohmann::json &summary, const char *name, int otherwise) {
  const auto sizes = summary.value("sizes", nlohmann::json::object());
  return sizes.is_object() && sizes.contains(name) && sizes[name].is_number_integer()
             ? sizes[name].get<int>()
             : otherwise;
}

std::vector<std::string> names_of_step(int n, bool of_contact, int ranks) {
  return of_contact ? std::vector{output::contact_field_file(n)} : output::field_files(n, ranks);
}

// Which steps the program chose is known from the collection alone.
bool has_fields(const casefile::Case &asked, const std::string &collection, int n,
                const std::vector<std::string> &names) {
  if (!asked.time.tolerance)
    return writes_fields(asked, casefile::TimeSteps(asked.time), n);
  return std::any_of(names.begin(), names.end(), [&](const std::string &name) {
    return collection.find('"' + name + '"') != std::string::npos;
  });
}

std::vector<std::string> field_names(const casefile::Case &asked, const nlohmann::json &summary,
                                     const fs::path &directory, bool of_contact) {
  const char *collection = of_contact ? "contact.pvd" : "result.pvd";
  const std::string listed = text_in(directory / collection);
  std::vector<std::string> names;
  for (int n = of_contact ? 1 : 0; n <= size_of(summary, "steps", asked.time.steps); ++n) {
    const auto of_step = names_of_step(n, of_contact, size_of(summary, "ranks", 1));
    if (has_fields(asked, listed, n, of_step))
      names.insert(names.end(), of_step.begin(), of_step.end());
  }
  names.emplace_back(collection);
  return names;
}

std::vector<std::string> missing_fields(const casefile::Case &asked, const nlohmann::json &summary,
                                        const fs::path &directory) {
  std::vector<std::string> missing;
  for (const char *group : field_groups)
    if (summary["files"].contains(group))
      for (const std::string &name : field_names(asked, summary, directory, group[0] == 'c'))
        if (std::error_code error; !fs::exists(directory / name, error))
          missing.push_back(name);
  return missing;
}

// "a, b and c", and of many "a, b, c, d and 96 more"
std::string list_of(const std::vector<std::string> &names) {
  constexpr std::size_t most = 4;
  const std::size_t told = names.size() <= most ? names.size() - 1 : most;
  std::string text = names.front();
  for (std::size_t i = 1; i < told; ++i)
    text += ", " + names[i];
  if (names.size() == 1)
    return text;
  return text + " and " +
         (names.size() <= most ? names.back() : fmt::format("{} more", names.size() - most));
}

// "" where all is there.
std::string trouble_with_fields(const casefile::Case &asked, const nlohmann::json &summary,
                                std::map<std::string, std::uint64_t> &sizes,
                                const fs::path &directory) {
  const auto missing = missing_fields(asked, summary, directory);
  if (!missing.empty())
    return fmt::format("{} of the complete run in {} {} missing", list_of(missing),
                       directory.string(), missing.size() == 1 ? "is" : "are");
  for (const auto &[name, bytes] : summary["files"].items())
    if (is_of_fields(name) && bytes != sizes[name])
      return fmt::format(
          "the field files {} of the complete run in {} have {} bytes, and should have {}", name,
          directory.string(), sizes[name], bytes.dump());
  return "";
}

void require_tables(const nlohmann::json &files, const std::map<std::string, std::uint64_t> &sizes,
                    const fs::path &directory) {
  for (const auto &[name, bytes] : files.items()) {
    const auto found = sizes.find(name);
    if (!is_of_fields(name) && (found == sizes.end() || bytes != found->second))
      throw MachineError(fmt::format(
          "{} of the complete run in {} {}, and should have {} bytes; start again without --resume",
          name, directory.string(),
          found == sizes.end() ? "is missing" : fmt::format("has {} bytes", found->second),
          bytes.dump()));
  }
}

// Field files may have been taken away to make room, unless the page is still to be made of them.
void require_whole(const casefile::Case &asked, const nlohmann::json &summary,
                   const fs::path &directory, Resumption &found) {
  if (!summary.contains("files"))
    return;
  auto sizes = output::file_sizes(directory);
  require_tables(summary["files"], sizes, directory);
  const std::string trouble = trouble_with_fields(asked, summary, sizes, directory);
  if (!trouble.empty() && !found.has_report)
    throw MachineError(trouble +
                       ", and its page is to be made of them; start again without --resume");
  if (!trouble.empty())
    found.warning = trouble + "; without --resume it is run again";
}

}  // namespace

// How often checkpoints are saved changes no result.
std::string differences(const std::string &then, const std::string &now) {
  std::string list;
  for (const casefile::Change &change : casefile::changes(then, now))
    if (change.key != "output.checkpoint")
      list += (list.empty() ? "" : "; ") + words(change);
  return list;
}

std::map<std::string, std::string> contents_of(const casefile::Case &asked) {
  std::map<std::string, std::string> digests;
  if (asked.mesh.content)
    digests[*asked.mesh.file] = digest(*asked.mesh.content);
  const auto add = [&](const casefile::MaterialCase &material) {
    if (material.file)
      digests[*material.file] = digest_of_file(*material.file);
  };
  add(asked.material);
  for (const casefile::RegionCase &region : asked.regions)
    add(region.material);
  for (const fs::path &file : start_files(asked.initial))
    digests[file.string()] = digest_of_file(file);
  return digests;
}

std::string inputs_of(const casefile::Case &asked, const std::string &friction_name) {
  return inputs(casefile::resolved(asked), friction_name, contents_of(asked));
}

Resumption resumption(const casefile::Case &asked, const fs::path &directory,
                      const std::string &friction_name) {
  Resumption found;
  // The summary says that all steps are done, also where a run was killed before it could take its
  // checkpoint away.
  if (fs::exists(directory / "summary.json")) {
    const nlohmann::json summary = summary_in(directory);
    const std::string resolved = text_in(directory / "resolved.toml");
    require_same(inputs(resolved, casefile::friction_name_in(resolved), contents_in(summary)),
                 inputs_of(asked, friction_name), directory);
    found.has_all_steps = true;
    found.has_report = !asked.output.report || fs::exists(directory / "report.html");
    require_whole(asked, summary, directory, found);
  } else if (const fs::path file = directory / output::checkpoint_name; fs::exists(file)) {
    found.checkpoint = output::read_checkpoint(file);
    require_same_program(*found.checkpoint, directory);
    require_same(found.checkpoint->inputs, inputs_of(asked, friction_name), directory);
    require_same_ranks(*found.checkpoint, directory);
    output::require_position(directory, found.checkpoint->position);
  }
  return found;
}

}  // namespace tourmaline::run
