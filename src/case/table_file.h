#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "case/load_table.h"

namespace tourmaline::casefile {

/// Values over time from a file of comma, semicolon or tab separated columns, the first of which is
/// t [s]. A first line that is no numbers names the columns; lines that are empty or begin with #
/// do not count. `column`: its name; without one the second column. Throws CaseError with file and
/// line, without the place in the case.
LoadTable::Points points_in_file(const std::filesystem::path &file,
                                 const std::optional<std::string> &column);

/// The same of a file's text.
LoadTable::Points points_in_text(const std::string &text, const std::string &file,
                                 const std::optional<std::string> &column);

}  // namespace tourmaline::casefile
