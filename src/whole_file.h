#pragma once

#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <optional>
#include <string>

namespace tourmaline {

/// All bytes of a file; nothing where it cannot be read, and then errno may say why.
inline std::optional<std::string> whole_file(const std::filesystem::path &path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    return std::nullopt;
  try {
    return std::string{std::istreambuf_iterator<char>(in), {}};
  } catch (const std::ios_base::failure &) {  // by the buffer itself, of a folder or a bad disk
    return std::nullopt;
  }
}

}  // namespace tourmaline
