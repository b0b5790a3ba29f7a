#include "output/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "output/atomic_file.h"
#include "output/checksum.h"
#include "tourmaline/error.h"
#include "whole_file.h"

namespace tourmaline::output {
namespace {

constexpr std::string_view magic = "Tourmaline checkpoint\n";
constexpr std::uint64_t format_version = 7;

/// Writes one member behind the other.
class Writer {
 public:
  explicit Writer(const std::filesystem::path &path) : file_(path) { bytes(magic); }

  void number(std::uint64_t value) {
    bytes({reinterpret_cast<const char *>(&value), sizeof value});
  }
  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void text(std::string_view value) {
    number(std::uint64_t{value.size()});
    bytes(value);
  }
  void numbers(std::span<const double> values) {
    number(std::uint64_t{values.size()});
    bytes({reinterpret_cast<const char *>(values.data()), values.size_bytes()});
  }
  void finish() {
    number(sum_);
    file_.sync();
    file_.finish();
  }

 private:
  void bytes(std::string_view part) {
    sum_ = checksum(sum_, part);
    file_.append(part);
  }

  AtomicFile file_;
  std::uint64_t sum_ = 0;
};

[[noreturn]] void refuse(const std::filesystem::path &path, const std::string &reason) {
  throw MachineError(fmt::format(
      "{} {}, so that the run cannot go on from it; the files beside it are those of the steps so "
      "far. Start again from the beginning without --resume, which removes them, or with -o in "
      "another folder",
      path.string(), reason));
}

/// Reads what `Writer` wrote.
class Reader {
 public:
  Reader(const std::filesystem::path &path, std::string_view rest) : path_(path), rest_(rest) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(bytes(number())); }
  std::vector<double> numbers() {
    const std::uint64_t count = number();
    need(count <= rest_.size() / sizeof(double));
    std::vector<double> values(count);
    const std::string_view part = bytes(count * sizeof(double));
    std::copy(part.begin(), part.end(), reinterpret_cast<char *>(values.data()));
    return values;
  }

 private:
  void need(bool is_there) const {
    if (!is_there)
      refuse(path_, "is damaged: it holds less than it says");
  }
  std::string_view bytes(std::size_t size) {
    need(size <= rest_.size());
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }

  const std::filesystem::path &path_;
  std::string_view rest_;
};

std::string contents(const std::filesystem::path &path) {
  if (!std::filesystem::is_regular_file(path))  // nobody may ever write to a pipe
    refuse(path, "is no checkpoint");
  std::optional<std::string> text = whole_file(path);
  if (!text)
    throw MachineError(fmt::format("cannot read {}", path.string()));
  return *std::move(text);
}

/// What stands between the version and the checksum.
std::string_view body(const std::filesystem::path &path, std::string_view file) {
  constexpr std::size_t word = sizeof(std::uint64_t);
  if (file.substr(0, magic.size()) != magic)
    refuse(path, "is no checkpoint");
  if (file.size() < magic.size() + 2 * word)
    refuse(path, "is damaged: its end is missing");
  if (const std::uint64_t version = Reader(path, file.substr(magic.size())).number();
      version != format_version)
    refuse(path, fmt::format("has version {} of the format, this program reads version {}", version,
                             format_version));
  const std::string_view summed = file.substr(0, file.size() - word);
  if (Reader(path, file.substr(summed.size())).number() != checksum(0, summed))
    refuse(path, "is damaged: its checksum is wrong");
  return summed.substr(magic.size() + word);
}

}  // namespace

void SavedNumbers::put(const std::string &name, std::initializer_list<double> values) {
  values_[name] = values;
}

void SavedNumbers::put_field(const std::string &name, const std::vector<double> &values) {
  put(name, values);
  fields_.insert(name);
}

// In the same order everywhere.
void SavedNumbers::for_each_field(const std::function<void(std::vector<double> &)> &visit) {
  for (const std::string &name : fields_)
    visit(values_.at(name));
}

std::size_t SavedNumbers::size(const std::string &name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? 0 : found->second.size();
}

std::span<const double> SavedNumbers::get(const std::string &name, std::size_t size) const {
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.size() != size)
    throw MachineError(
        fmt::format("the checkpoint does not have {} numbers \"{}\", as this run needs; start "
                    "again without --resume",
                    size, name));
  return found->second;
}

void write_checkpoint(const std::filesystem::path &path, const Checkpoint &checkpoint) {
  Writer file(path);
  file.number(format_version);
  file.text(checkpoint.program);
  file.text(checkpoint.inputs);
  file.number(checkpoint.ranks);
  file.number(checkpoint.step);
  file.number(std::uint64_t{checkpoint.position.tables.size()});
  for (const auto &[name, table] : checkpoint.position.tables) {
    file.text(name);
    file.number(table.bytes);
    file.number(table.checksum);
  }
  file.number(std::uint64_t{checkpoint.position.series.size()});
  for (const PvdEntry &entry : checkpoint.position.series) {
    file.number(entry.time);
    file.text(entry.file);
  }
  file.number(checkpoint.position.field_bytes);
  file.number(std::uint64_t{checkpoint.numbers.all().size()});
  for (const auto &[name, values] : checkpoint.numbers.all()) {
    file.text(name);
    file.number(std::uint64_t{checkpoint.numbers.is_field(name)});
    file.numbers(values);
  }
  file.finish();
  sync_path(path.parent_path());
}

Checkpoint read_checkpoint(const std::filesystem::path &path) {
  const std::string whole = contents(path);
  Reader file(path, body(path, whole));
  Checkpoint checkpoint;
  checkpoint.program = file.text();
  checkpoint.inputs = file.text();
  checkpoint.ranks = file.number();
  checkpoint.step = file.number();
  for (std::uint64_t left = file.number(); left > 0; --left) {
    TablePosition &table = checkpoint.position.tables[file.text()];
    table.bytes = file.number();
    table.checksum = file.number();
  }
  for (std::uint64_t left = file.number(); left > 0; --left) {
    const double time = std::bit_cast<double>(file.number());
    checkpoint.position.series.push_back({time, file.text()});
  }
  checkpoint.position.field_bytes = file.number();
  for (std::uint64_t left = file.number(); left > 0; --left) {
    const std::string name = file.text();
    const bool is_field = file.number() != 0;
    if (is_field)
      checkpoint.numbers.put_field(name, file.numbers());
    else
      checkpoint.numbers.put(name, file.numbers());
  }
  return checkpoint;
}

void require_bytes(const std::filesystem::path &file, std::uint64_t bytes) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error)
    throw MachineError(
        fmt::format("{}, on which the checkpoint counts, is missing; start again without --resume",
                    file.string()));
  if (size < bytes)
    throw MachineError(
        fmt::format("{} is shorter than the {} bytes that the checkpoint counts on; start again "
                    "without --resume",
                    file.string(), bytes));
}

}  // namespace tourmaline::output
