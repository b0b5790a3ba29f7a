#pragma once

#include <string_view>

namespace tourmaline::report {

/// The page as web/ builds it, without data; embedded by cmake/EmbedPage.cmake.
std::string_view page_template();

}  // namespace tourmaline::report
