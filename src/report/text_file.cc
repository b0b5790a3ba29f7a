#include "report/text_file.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "tourmaline/error.h"
#include "whole_file.h"

namespace tourmaline::report {

std::string read_text_file(const std::filesystem::path &path) {
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw CaseError(path.string() + ": cannot be read: it is a folder");
  errno = 0;
  std::optional<std::string> text = whole_file(path);
  if (!text)
    throw CaseError(path.string() + ": cannot be read" +
                    (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()));
  return *std::move(text);
}

}  // namespace tourmaline::report
