#include "report/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "tourmaline/error.h"

namespace tourmaline::report {

std::string read_text_file(const std::filesystem::path &path) {
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw CaseError(path.string() + ": cannot be read: it is a folder");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  if (!in)
    throw CaseError(path.string() + ": cannot be read" +
                    (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()));
  return text;
}

}  // namespace tourmaline::report
