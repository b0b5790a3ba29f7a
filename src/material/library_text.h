#pragma once

#include <string_view>

namespace tourmaline::material {

/// The built-in library as the text of a file of materials.
extern const std::string_view library_text;

}  // namespace tourmaline::material
