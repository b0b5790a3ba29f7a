#pragma once

#include <string>
#include <string_view>

namespace tourmaline::casefile {

/// Whether a text is UTF-8, as result files and the report page must be.
bool is_utf8(std::string_view text);

/// The text with the bytes that are not UTF-8 as \xE4, for a message about them.
std::string readable(std::string_view text);

/// Throws CaseError, "FILE:LINE: is not UTF-8 ...", if a file's text is not.
void require_utf8(std::string_view text, const std::string &file);

}  // namespace tourmaline::casefile
