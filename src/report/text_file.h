#pragma once

#include <filesystem>
#include <string>

namespace tourmaline::report {

/// The file's bytes. Throws CaseError when it cannot be read.
std::string read_text_file(const std::filesystem::path &path);

}  // namespace tourmaline::report
